// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The steps inside a crossing: their length, their error, events within them, what is reported.
#include <algorithm>
#include <cmath>
#include <utility>

#include <yoke/integrators/run/singular/crossing.hpp>

namespace yoke {

namespace {

constexpr double too_close = 1e-7;   // of a stage; errors of a position grow by its root
constexpr double longest = 0.5;      // of the time scale
constexpr double error_share = 0.5;  // of the error weights
// Of the largest independence: where rounding may be all that is left of accuracy.
constexpr double nearly_singular = 1e-4;
constexpr double shortest_regular = 1e-6;  // of the time scale, elsewhere
constexpr double bearable = 10.0;          // error that rounding may leave, of the tolerance
constexpr double energy_share = 100.0;     // of the relative tolerance
constexpr double far_enough = 0.6;         // of the largest independence
constexpr int max_attempts = 200;
constexpr int max_segments = 2000;                            // without getting away
constexpr double first_beside = 0.01, farthest_beside = 2.0;  // of the distance of looks
constexpr double further_beside = 1.5;                        // from look to look

}  // namespace

Step SingularCrossing::cross(double t_stop) {
  const double energy_before = energy(t_, segment_.end.data());
  if (!try_step(t_stop, energy_before)) return Step::failed;
  const Step step = accept_segment();
  if (step == Step::event || t_ >= t_stop) record_positions();  // the crossing may end here
  return step;
}

// [J] What a step, or the whole crossing, may change in the energy balance; more is not accepted where
// the rank does not fall, and is reported where it does.
double SingularCrossing::allowed_energy_change(double energy) const {
  return energy_share * tolerances_.relative * (kinetic_entry_ + std::abs(energy)) +
         1e2 * tolerances_.energy;
}

// The length of the next step, at most `most`: the singular position, where it is expected, is to lie in
// the middle or in another wide gap between stages.
double SingularCrossing::propose(double rest, double most) const {
  double h = std::min(h_, most);
  if (to_singular_ < 0.6 * h_) {
    for (const double gap : {0.5, 0.25, 0.12, 0.017}) {
      const double fitting = to_singular_ / gap;
      if (fitting < 0.4 * h_ || fitting > most) continue;
      h = fitting;
      break;
    }
  } else if (to_singular_ < 2.0 * h_) {
    h = 0.5 * to_singular_;
  }
  // Two steps to the end rather than one and a sliver.
  return h >= rest ? rest : h > 0.5 * rest ? 0.5 * rest : h;
}

// A step with 6 stages, judged by one with 4, until they agree or it is as short as is sensible.
// False, without a reason: none that is accurate can be had although the rank does not collapse.
bool SingularCrossing::try_step(double t_stop, double energy_before) {
  const double scale = dynamics_.system().scales().time;
  std::vector<double> y = segment_.end;
  const auto n = dynamics_.system().dofs();
  std::vector<double> a(static_cast<std::size_t>(n), 0.0);
  if (segments_ > 0)
    std::copy_n(segment_.rates.back().begin() + n, n, a.begin());
  else if (m_ > too_close * largest_)
    dynamics_.calc_accelerations({.t = t_, .q = y.data(), .v = y.data() + n, .z = y.data() + 2 * n},
                                 {.a = a.data()});
  using Stages = GaussCollocation::Outcome;
  constexpr double shift[] = {1.0, 1.3, 0.77, 1.7, 0.6};  // to move stages off a singular position
  int closes = 0;
  double last_error = far, most = far;
  const double closest = too_close * largest_;
  for (int attempt = 0; attempt < max_attempts; ++attempt) {
    const double rest = t_stop - t_, proposed = propose(rest, most);
    const double h = std::min({proposed * shift[closes], rest, most});
    const bool last = h == rest;
    for (GaussCollocation::Segment* s : {&trial_, &segment_}) {
      s->t = t_;
      s->h = h;
      s->begin = y;
    }
    Stages outcome = check_.step(trial_, a.data(), closest, last);
    if (outcome == Stages::solved) outcome = gauss_.step(segment_, check_, trial_, closest, last);
    if (outcome == Stages::close && ++closes < static_cast<int>(std::size(shift))) continue;
    if (outcome != Stages::solved) {
      closes = 0;
      h_ = 0.6 * std::min(h, h_);
      ++own_.rejected;
      if (h_ < 1e-10 * scale) break;
      continue;
    }
    const bool collapses = segment_.least < nearly_singular * largest_;
    const double change = std::abs(energy(t_ + h, segment_.end.data()) - energy_before);
    const double distance = gauss_.distance(trial_.end.data(), segment_.end.data()) /
                            std::max(error_share, 1e-10 / tolerances_.relative);
    const double error =
        collapses ? distance : std::max(distance, change / allowed_energy_change(energy_before));
    const double factor = std::clamp(0.9 * std::pow(std::max(error, 1e-12), -1.0 / 9.0), 0.3, 2.0);
    const double shortest = (collapses ? shortest_ : std::min(shortest_, shortest_regular)) * scale;
    // An error that does not fall with the step is rounding; a large one may be the corner of a
    // force, where a contact ends within the step.
    const bool unbearable = !collapses && error > bearable;
    if (error > 1.0 && h > shortest && (error < 0.5 * last_error || unbearable)) {
      last_error = error;
      h_ = most = std::max(factor * h, shortest);
      closes = 0;
      ++own_.rejected;
      continue;
    }
    if (unbearable) break;
    h_ = std::clamp(factor * std::max(h, h_), shortest, longest * scale);
    return true;
  }
  segment_.end = std::move(y);
  if (m_last_ >= nearly_singular * largest_) return false;  // not a matter of rank: see cross()
  failure_ = fmt::format(
      "the singular position of '{}' could not be crossed: no motion beyond it was found",
      dynamics_.system().equation_name(dynamics_.weakest_row()));
  return false;
}

bool SingularCrossing::find_event(int& slot, double& t) {
  const int n = dynamics_.system().dofs();
  const auto value = [&](double time, std::size_t i) {
    gauss_.interpolate(segment_, time, y_.data());
    guard_.evaluate(time, y_.data(), y_.data() + n, y_.data() + 2 * n, g_.data());
    return g_[i];
  };
  constexpr int looks = 8;
  double low = segment_.t;
  for (int look = 1; look <= looks; ++look) {
    const double high = segment_.t + segment_.h * look / looks;
    value(high, 0);
    const auto crossed = std::ranges::find_if(g_, [](double g) { return g >= 0.0; });
    if (crossed != g_.end()) {
      // The first of those that crossed here.
      slot = static_cast<int>(crossed - g_.begin());
      double above = high;
      for (int i = 0; i < 200 && above > std::nextafter(low, above); ++i) {
        const double middle = 0.5 * (low + above);
        if (middle <= low || middle >= above) break;
        value(middle, 0);
        const auto first = std::ranges::find_if(g_, [](double g) { return g >= 0.0; });
        if (first != g_.end()) {
          slot = static_cast<int>(first - g_.begin());
          above = middle;
        } else {
          low = middle;
        }
      }
      t = above;
      return true;
    }
    low = high;
  }
  return false;
}

Step SingularCrossing::accept_segment() {
  const int n = dynamics_.system().dofs();
  ++own_.steps;
  ++segments_;
  int slot = 0;
  double t_event = 0.0;
  if (guard_.count() > 0 && find_event(slot, t_event)) {
    look_into_segment(t_event);
    gauss_.interpolate(segment_, t_event, segment_.end.data());
    double m = 1.0;
    gauss_.project(t_event, segment_.end.data(), 0.0, m);
    t_ = t_event;
    std::ranges::fill(found_events_, 0);
    found_events_[static_cast<std::size_t>(slot)] = 1;
    guard_.collect(t_, segment_.end.data(), segment_.end.data() + n, segment_.end.data() + 2 * n,
                   found_events_);
    unpack(t_, segment_.end.data(), here_);
    return Step::event;
  }
  look_into_segment(segment_.t + segment_.h);
  t_ = segment_.t + segment_.h;
  unpack(t_, segment_.end.data(), here_);
  guard_.accept(t_, segment_.end.data(), segment_.end.data() + n, segment_.end.data() + 2 * n);
  check_redundant(t_, here_.q.data());
  gauss_.interpolate(segment_, t_ - 0.02 * segment_.h, y_.data());
  const double before = dynamics_.independence(t_ - 0.02 * segment_.h, y_.data(), sweeps);
  const double m = dynamics_.independence(t_, segment_.end.data(), sweeps);
  const bool rising = m > before;
  const double fall = (std::sqrt(before) - std::sqrt(m)) / (0.02 * segment_.h);
  to_singular_ = fall > 0.0 ? std::sqrt(m) / fall : far;
  m_last_ = m;
  largest_ = std::max(largest_, m);
  const double away =
      std::min(std::max(2.0 * m_entry_, 5.0 * near * largest_), far_enough * largest_);
  // Equations that are nearly dependent all along, as those of a gear of ratio 1.0003: nothing to get away from.
  const bool stays = m > far_enough * largest_ && to_singular_ > dynamics_.system().scales().time;
  if ((rising && m > away) || stays) end_crossing();
  if (!leaving_ && segments_ > max_segments) end_crossing();
  return failure_.empty() ? Step::advanced : Step::failed;
}

// All minima of the independence within the segment up to a time: there may be several. Looks beside the ends
// tell whether it falls or rises there.
void SingularCrossing::look_into_segment(double until) {
  constexpr int looks = 16;
  constexpr double edge = 0.02;
  const std::size_t known = positions_.size();
  const auto place = [&](int i) {
    const double part = i == 1 ? edge : i == looks + 1 ? looks - edge : std::clamp(i - 1, 0, looks);
    return segment_.t + (until - segment_.t) * part / looks;
  };
  double before = 1.0, now = measure_in_segment(place(0));
  double after = measure_in_segment(place(1));
  if (now <= after) {
    const bool at_end = find_minimum(place(0), place(1)) == place(0);
    if (!at_end || falls_at_end_ || segments_ == 1) note_position();
  }
  for (int i = 1; i <= looks + 1; ++i) {
    before = std::exchange(now, after);
    after = measure_in_segment(place(i + 1));
    if (now >= before || now > after) continue;
    find_minimum(place(i - 1), place(i + 1));
    note_position();
  }
  falls_at_end_ =
      after < now && find_minimum(place(looks + 1), place(looks + 2)) == place(looks + 2);
  if (after < now && !falls_at_end_) note_position();
  // Each found leads to its neighbours, and they to theirs; so do ends of the segment between two.
  const double distance = (until - segment_.t) / looks;
  for (const double end : {segment_.t, until})
    if (measure_in_segment(end) < near * largest_) look_beside(end, known, until, distance);
  for (std::size_t i = known; i < positions_.size(); ++i)
    look_beside(positions_[i].t, known, until, distance);
  std::ranges::sort(positions_, {}, &SingularPosition::t);
}

// Two positions closer than the looks are one minimum to them. Beside the one found the independence
// rises; where it falls again there is another, if the rank was full in between.
void SingularCrossing::look_beside(double t, std::size_t known, double until, double distance) {
  for (const double way : {-distance, distance}) {
    const auto place = [&](double part) { return std::clamp(t + part * way, segment_.t, until); };
    double before = 0.0, now = measure_in_segment(place(first_beside), 2 * sweeps), last = 0.0;
    for (double part = first_beside; part < farthest_beside && place(part) != place(last);) {
      const double next = further_beside * part;
      const double after = measure_in_segment(place(next), 2 * sweeps);
      if (now < before && now <= after && before > was_singular * largest_) {
        const double least =
            find_minimum(std::min(place(last), place(next)), std::max(place(last), place(next)));
        // Those at the ends are noted where it falls to one and rises from it.
        const bool inside = least != segment_.t && least != until;
        const auto is_it = [&](const SingularPosition& p) {
          return std::abs(p.t - least_.t) < 0.1 * first_beside * distance;
        };
        if (inside && std::none_of(positions_.begin() + static_cast<std::ptrdiff_t>(known),
                                   positions_.end(), is_it))
          note_position();
      }
      last = std::exchange(part, next);
      before = std::exchange(now, after);
    }
  }
}

double SingularCrossing::measure_in_segment(double t, int rounds) {
  gauss_.interpolate(segment_, t, y_.data());
  return dynamics_.independence(t, y_.data(), rounds);
}

/// Golden section: where, between a and b or at one of them.
double SingularCrossing::find_minimum(double a, double b) {
  constexpr double golden = 0.3819660112501051;
  const double first = a, last = b, close = 1e-7 * (b - a);
  double middle = a + golden * (b - a), least = measure_in_segment(middle);
  while (b - a > close) {
    const bool left = middle - a > b - middle;
    const double next = left ? middle - golden * (middle - a) : middle + golden * (b - middle);
    const double there = measure_in_segment(next);
    if (there < least) {
      (left ? b : a) = std::exchange(middle, next);
      least = there;
    } else {
      (left ? a : b) = next;
    }
  }
  const double at_end = 1e-3 * (last - first);  // beside an end rounding hides which way is down
  const double t = middle - first < at_end ? first : last - middle < at_end ? last : middle;
  least_ = {.t = t, .equation = {}, .independence = measure_in_segment(t)};
  least_.equation = dynamics_.system().equation_name(dynamics_.weakest_row());
  if (!has_found_ || least_.independence < found_.independence) found_ = least_;
  has_found_ = true;
  return t;
}

void SingularCrossing::note_position() {
  if (least_.independence < was_singular * largest_) positions_.push_back(least_);
}

}  // namespace yoke
