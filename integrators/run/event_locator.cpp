// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/run/event_locator.hpp>

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include <yoke/integrators/formulations/event_guard.hpp>

namespace yoke {

namespace {

constexpr double nowhere = std::numeric_limits<double>::infinity();
constexpr int golden_steps = 30;  // a part of 5e-7 of where it is looked for
constexpr double steepest = 2.0;  // rise of a gap beyond a look, of that between looks
constexpr double wide = 8.0;      // a gap, of how far it strays from a line within a step
constexpr double flat = 64.0 * std::numeric_limits<double>::epsilon();  // of the function

}  // namespace

EventLocator::EventLocator(Dynamics& dynamics)
    : dynamics_(dynamics), values_(static_cast<std::size_t>(dynamics.system().events()), 0.0) {
  fired_.reserve(values_.size());
  for (const ForceSlot& f : dynamics.system().forces())
    for (int i = 0; i < f.element->events(); ++i)
      if (f.element->may_hide(i))
        watched_.push_back({.slot = f.events + i,
                            .first_contact = f.contacts,
                            .last_contact = f.contacts + f.element->contacts()});
}

// Gaps do not jump with loads: what was seen at the end of the last step is still so.
void EventLocator::start(const State& state, bool loads_only) {
  if (loads_only) return;
  looks_ = false;
  for (Watched& w : watched_) {
    w.active = !w.of_contact();
    for (int i = w.first_contact; i < w.last_contact; ++i)
      w.active =
          w.active || state.contacts[static_cast<std::size_t>(i)].phase == ContactPhase::apart;
    looks_ = looks_ || w.active;
  }
  if (!looks_) return;
  calc_watched(state);
  for (Watched& w : watched_) {
    w.seen.back() = values_[static_cast<std::size_t>(w.slot)];
    w.armed = w.seen.back() < 0.0;
    w.negative = 0.0;
    if (state.handled_at != state.t || std::ranges::count(state.handled, w.slot) == 0) continue;
    w.armed = false;
    w.negative = below_zero(w.seen.back());
  }
}

double EventLocator::locate(Formulation& formulation, Step step, double from, State& scratch) {
  fired_.clear();
  t_fired_ = nowhere;
  if (step == Step::event) locate_passed(formulation, from, scratch);
  const double to = formulation.time();
  if (looks_ && to > from) look_inside(formulation, step, from, to, scratch);
  if (step == Step::event && t_fired_ < to) add_simultaneous(formulation, scratch);
  return std::min(t_fired_, to);
}

void EventLocator::locate_passed(Formulation& formulation, double from, State& scratch) {
  fired_ = formulation.fired();
  t_fired_ = formulation.time();
  for (const int slot : formulation.passed())
    note(std::min(locate_crossing(formulation, slot, from, formulation.time(), scratch),
                  formulation.time()),
         slot);
}

/// What was found later, but by rounding only: its function has crossed zero here already, and a
/// restart from here would not see it cross.
void EventLocator::add_simultaneous(Formulation& formulation, State& scratch) {
  formulation.interpolate(t_fired_, scratch);
  calc(scratch);
  for (const std::vector<int>* slots : {&formulation.fired(), &formulation.passed()})
    for (const int slot : *slots)
      if (values_[static_cast<std::size_t>(slot)] >= 0.0) note(t_fired_, slot);
}

/// The first win, and all that fire at one instant.
void EventLocator::note(double t, int slot) {
  if (t < t_fired_) {
    t_fired_ = t;
    fired_.clear();
  }
  if (t == t_fired_ && t < nowhere && std::ranges::count(fired_, slot) == 0) fired_.push_back(slot);
}

/// All functions. What cannot be computed has not crossed zero: the formulation says what is wrong.
void EventLocator::calc(const State& state) {
  const Dynamics::Instant at{
      .t = state.t, .q = state.q.data(), .v = state.v.data(), .z = state.z.data()};
  if (!dynamics_.calc_events(at, values_.data())) std::ranges::fill(values_, -1.0);
}

/// Those of watched slots need no forces of friction that holds.
void EventLocator::calc_watched(const State& state) {
  System& system = dynamics_.system();
  system.set_motion(state.t, state.q.data(), state.v.data());
  system.set_states(state.z.data());
  system.calc_events(values_.data());
}

double EventLocator::value(Formulation& formulation, int slot, double t, State& scratch) {
  formulation.interpolate(t, scratch);
  calc(scratch);
  return values_[static_cast<std::size_t>(slot)];
}

void EventLocator::look_inside(Formulation& formulation, Step step, double from, double to,
                               State& scratch) {
  for (Watched& w : watched_) w.seen.front() = w.seen.back();
  const auto look = [&](std::size_t i) {
    formulation.glance(i + 1 < looks.size() ? from + looks[i] * (to - from) : to, scratch);
    calc_watched(scratch);
    for (Watched& w : watched_) w.seen[i] = values_[static_cast<std::size_t>(w.slot)];
  };
  for (const std::size_t i : few_looks) look(i);
  const bool far = std::ranges::all_of(watched_, is_far);
  for (std::size_t i = 1; !far && i < looks.size(); ++i)
    if (std::ranges::count(few_looks, i) == 0) look(i);
  for (Watched& w : watched_) {
    if (far || !w.active) continue;
    const bool known =
        step == Step::event && (std::ranges::count(formulation.fired(), w.slot) > 0 ||
                                std::ranges::count(formulation.passed(), w.slot) > 0);
    // What the formulation has located at the end of the step it knows better.
    const std::size_t last = looks.size() - (known ? 2 : 1);
    note(first_crossing(formulation, w, last, from, to, scratch), w.slot);
  }
  for (Watched& w : watched_)
    w.armed = std::ranges::count(fired_, w.slot) == 0 && (w.armed || w.seen.back() < w.negative);
}

/// [s] Where a function first crosses zero upwards up to look `last`.
double EventLocator::first_crossing(Formulation& formulation, const Watched& w, std::size_t last,
                                    double from, double to, State& scratch) {
  const auto time = [&](std::size_t i) {
    return i + 1 == looks.size() ? to : from + looks[i] * (to - from);
  };
  bool armed = w.armed;
  // Times are known to their last places alone.
  const double change = std::abs(w.seen.back() - w.seen.front()) / (to - from);
  const double negative = w.negative < 0.0 ? w.negative - flat * std::abs(to) * change : w.negative;
  for (std::size_t i = 1; i <= last; ++i) {
    double above = nowhere;
    if (armed && w.seen[i] >= 0.0)
      above = time(i);
    else if (w.seen[i] < 0.0 && i + 1 < looks.size() && is_largest(w, i))
      above = find_above(formulation, w.slot, {time(i - 1), time(i), time(i + 1)}, scratch);
    armed = armed || w.seen[i] < negative;
    if (above == nowhere) continue;
    const double crossing = locate_crossing(formulation, w.slot, time(i - 1), above, scratch);
    if (crossing < nowhere) return crossing;
  }
  return nowhere;
}

/// A gap that is wide against how far it strays from a straight line within a step needs no closer look.
bool EventLocator::is_far(const Watched& w) {
  if (!w.active) return true;
  if (!w.of_contact()) return false;
  const double change = w.seen.back() - w.seen.front();
  double most = w.seen.front(), astray = 0.0;
  for (const std::size_t i : few_looks) {
    most = std::max(most, w.seen[i]);
    astray = std::max(astray, std::abs(w.seen[i] - w.seen.front() - looks[i] * change));
  }
  return most + wide * astray < 0.0;
}

bool EventLocator::is_largest(const Watched& w, std::size_t i) {
  const double before = w.seen[i] - w.seen[i - 1], after = w.seen[i] - w.seen[i + 1];
  const double rise = std::max(before, after);
  // The gap of a contact is smooth: where it is wide, a maximum of rounding means nothing.
  const double some = w.of_contact() ? std::abs(w.seen[i]) / steepest : flat * std::abs(w.seen[i]);
  return before >= 0.0 && after >= 0.0 && rise > some;
}

/// [s] A time at which the function is not negative, by golden section for its maximum, which three
/// times enclose; or nowhere.
double EventLocator::find_above(Formulation& formulation, int slot, const std::array<double, 3>& t,
                                State& scratch) {
  constexpr double golden = 0.3819660112501051;
  auto [a, m, b] = t;
  double largest = value(formulation, slot, m, scratch);
  for (int i = 0; i < golden_steps && largest < 0.0; ++i) {
    const bool left = m - a > b - m;
    const double next = left ? m - golden * (m - a) : m + golden * (b - m);
    const double there = value(formulation, slot, next, scratch);
    if (there > largest) {
      (left ? b : a) = std::exchange(m, next);
      largest = there;
    } else {
      (left ? a : b) = next;
    }
  }
  return largest >= 0.0 ? m : nowhere;
}

/// [s] Where a function that is negative at `from` and is not at `to` crosses zero, or nowhere.
double EventLocator::locate_crossing(Formulation& formulation, int slot, double from, double to,
                                     State& scratch) {
  const double at_from = value(formulation, slot, from, scratch);
  const double at_to = value(formulation, slot, to, scratch);
  if (!(at_from < 0.0 && at_to >= 0.0)) return nowhere;
  if (at_to == 0.0) return to;
  std::uintmax_t iterations = 100;
  const auto bracket = boost::math::tools::toms748_solve(
      [&](double t) { return value(formulation, slot, t, scratch); }, from, to, at_from, at_to,
      boost::math::tools::eps_tolerance<double>(std::numeric_limits<double>::digits), iterations);
  return bracket.second;
}

}  // namespace yoke
