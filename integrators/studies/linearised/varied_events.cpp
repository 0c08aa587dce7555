// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Variations at an event; see carried_variation.hpp.
#include <algorithm>
#include <cmath>

#include <yoke/core/error.hpp>
#include <yoke/integrators/studies/linearised/carried_variation.hpp>

namespace yoke {

namespace {

constexpr double small_change = 1e-7;  // of the model's scales, for differences
constexpr double smaller = 1.0 / 30.0;
constexpr int most_attempts = 4;
constexpr double straight = 0.05;  // curvature of a difference against its slope
constexpr double grazing = 1e-9;   // rate of an event function against that of a fast motion
constexpr std::size_t most_notes = 5;

/// Whether two contacts are in the same place of their state machines.
bool same_phase(const std::vector<ContactMemory>& x, const std::vector<ContactMemory>& y) {
  return std::ranges::equal(x, y, [](const ContactMemory& a, const ContactMemory& b) {
    return a.phase == b.phase && a.region == b.region && a.past_kink == b.past_kink &&
           a.grip == b.grip;
  });
}

}  // namespace

std::string CarriedVariation::owner_of(int slot) const {
  for (const ForceSlot& force : dynamics_.system().forces())
    if (slot >= force.events && slot < force.events + force.element->events())
      return force.element->name();
  return {};
}

void CarriedVariation::note(std::string text) {
  if (notes_.size() < most_notes) notes_.push_back(std::move(text));
}

/// How the state moves by itself.
CarriedVariation::Direction CarriedVariation::rates_of(const State& state) {
  State there = state;
  Direction rates{.q = state.v,
                  .v = state.v,
                  .z = Vector::Zero(state.z.size()),
                  .m = Vector::Zero(numbers_.size()),
                  .t = 1.0};
  dynamics_.system().bind(there);
  if (!dynamics_.calc_accelerations(
          {.t = there.t, .q = there.q.data(), .v = there.v.data(), .z = there.z.data()},
          {.a = rates.v.data(), .lambda = there.lambda.data(), .z_dot = rates.z.data()}))
    throw ModelError(fmt::format("variation: no accelerations at t = {:.9g} s", state.t));
  return rates;
}

/// `beside_` becomes the state that far along.
void CarriedVariation::move(const State& from, const Direction& along, double by) {
  beside_ = from;
  beside_.t += by * along.t;
  beside_.q += by * along.q;
  beside_.v += by * along.v;
  beside_.z += by * along.z;
  for (int i = 0; i < numbers_.size(); ++i) numbers_.add(beside_, i, by * along.m[i]);
}

/// In scales of the model; of memory numbers relative to their own size.
double CarriedVariation::size_of(const Direction& along, const State& state) const {
  const auto [length, time] = scales();
  double size = std::abs(along.t) / time;
  for (Eigen::Index i = 0; i < along.q.size(); ++i) {
    const double unit = i % 3 == 2 ? 1.0 : length;
    size = std::max({size, std::abs(along.q[i]) / unit, std::abs(along.v[i]) * time / unit});
  }
  for (Eigen::Index i = 0; i < along.z.size(); ++i)
    if (state.z[i] != 0.0) size = std::max(size, std::abs(along.z[i] / state.z[i]));
  for (int i = 0; i < numbers_.size(); ++i)
    if (const double value = numbers_.get(state, i); value != 0.0)
      size = std::max(size, std::abs(along.m[i] / value));
  return size;
}

/// Of `beside_`.
double CarriedVariation::value_of_event(int slot) {
  dynamics_.system().bind(beside_);
  if (!dynamics_.calc_events(
          {.t = beside_.t, .q = beside_.q.data(), .v = beside_.v.data(), .z = beside_.z.data()},
          g_.data()))
    throw ModelError(
        fmt::format("variation: an event function of '{}' is not known at t = {:.9g} s",
                    owner_of(slot), beside_.t));
  return g_[static_cast<std::size_t>(slot)];
}

/// Derivative of an event function along a direction. Functions may have corners near by (a margin
/// of rounding): the change is made smaller until they are not met.
double CarriedVariation::slope_of_event(const State& at, int slot, const Direction& along) {
  const double size = size_of(along, at);
  if (size == 0.0) return 0.0;
  double by = small_change / size;
  for (int attempt = 1;; ++attempt, by *= smaller) {
    move(at, along, 0.0);
    const double here = value_of_event(slot);
    move(at, along, by);
    const double ahead = value_of_event(slot);
    move(at, along, -by);
    const double behind = value_of_event(slot);
    const double change = ahead - behind;
    if (attempt == most_attempts ||
        std::abs(ahead + behind - 2.0 * here) <= straight * std::abs(change))
      return change / (2.0 * by);
  }
}

/// Which of the events at this instant has made the change; the first of those of the element whose
/// contacts are not what they were, else the first.
int CarriedVariation::slot_of(const State& before, const std::vector<int>& fired,
                              const State& after) {
  std::vector<std::string> owners;
  int found = -1;
  for (const int slot : fired) {
    const auto& forces = dynamics_.system().forces();
    const auto owner = std::ranges::find_if(forces, [&](const ForceSlot& f) {
      return slot >= f.events && slot < f.events + f.element->events();
    });
    if (owner == forces.end()) continue;
    bool changes = owner->element->contacts() == 0;
    for (int i = 0; i < owner->element->contacts(); ++i) {
      const auto k = static_cast<std::size_t>(owner->contacts + i);
      changes = changes || !(before.contacts[k] == after.contacts[k]);
    }
    if (!changes) continue;
    if (found < 0) found = slot;
    if (std::ranges::find(owners, owner->element->name()) == owners.end())
      owners.push_back(owner->element->name());
  }
  if (owners.size() > 1)
    note(fmt::format(
        "at t = {:.9g} s events of '{}' and '{}' are at one instant: what is beside the motion depends "
        "on which comes first, and was taken as if the first of them came with the others",
        before.t, owners[0], owners[1]));
  return found >= 0 ? found : fired.front();
}

/// What the event adds to a state beside `before`; false if it takes another course.
bool CarriedVariation::pass_event(const State& before, const std::vector<int>& fired,
                                  const State& after, const Direction& along, double by,
                                  Direction& change) {
  move(before, along, by);
  stopped_ = false;
  if (!dynamics_.project(beside_)) return false;
  scratch_.events.clear();
  scratch_.summary.notes.clear();
  const State arrived = beside_;
  events_.handle(fired);
  if (stopped_ || !same_phase(beside_.contacts, after.contacts)) return false;
  change.q = beside_.q - arrived.q;
  change.v = beside_.v - arrived.v;
  change.z = beside_.z - arrived.z;
  change.m.resize(numbers_.size());
  for (int i = 0; i < numbers_.size(); ++i)
    change.m[i] = numbers_.get(beside_, i) - numbers_.get(arrived, i);
  return true;
}

CarriedVariation::Direction CarriedVariation::derivative_of_event(const State& before,
                                                                  const std::vector<int>& fired,
                                                                  const State& after,
                                                                  const Direction& along) {
  const double size = size_of(along, before);
  Direction ahead = along, behind = along;
  if (size == 0.0) return ahead;
  double by = small_change / size;
  for (int attempt = 0; attempt < most_attempts; ++attempt, by *= smaller) {
    if (!pass_event(before, fired, after, along, by, ahead) ||
        !pass_event(before, fired, after, along, -by, behind))
      continue;
    for (auto member : {&Direction::q, &Direction::v, &Direction::z, &Direction::m})
      ahead.*member = along.*member + (ahead.*member - behind.*member) / (2.0 * by);
    return ahead;
  }
  throw ModelError(fmt::format(
      "variation: the event of '{}' at t = {:.9g} s takes another course for motions beside this one",
      owner_of(fired.front()), before.t));
}

void CarriedVariation::jump(const State& before, const std::vector<int>& fired,
                            const State& after) {
  refuse_grips(after);
  ++jumps_;
  jumped_ = true;
  const Eigen::Index columns = y.cols();
  const Direction f_before = rates_of(before), f_after = rates_of(after);
  // y is in the frame that has turned along up to here.
  State there = before;
  if (!dynamics_.calc_accelerations(there))
    throw ModelError(fmt::format("variation: no accelerations at t = {:.9g} s", before.t));
  frame_.at(dynamics_.system(), there);
  const Matrix dq = positions(), dv = velocities(), dz = y.bottomRows(before.z.size());
  const int slot = slot_of(before, fired, after);
  const double rate = slope_of_event(before, slot, f_before);
  Matrix q_after(dq.rows(), columns), v_after(dv.rows(), columns), z_after(dz.rows(), columns);
  for (Eigen::Index i = 0; i < columns; ++i) {
    Direction along{.q = dq.col(i), .v = dv.col(i), .z = dz.col(i), .m = m.col(i)};
    const double slope = slope_of_event(before, slot, along);
    const double later = slope == 0.0 ? 0.0 : -slope / rate;
    if (!std::isfinite(later) ||
        std::abs(later) * grazing > scales().time * std::max(size_of(along, before), 1e-300))
      throw ModelError(fmt::format(
          "variation: the event of '{}' at t = {:.9g} s is met without speed; what is beside the motion "
          "has no linear equations",
          owner_of(slot), before.t));
    along.q += later * f_before.q;
    along.v += later * f_before.v;
    along.z += later * f_before.z;
    along.t = later;
    const Direction passed = derivative_of_event(before, fired, after, along);
    q_after.col(i) = passed.q - later * f_after.q;
    v_after.col(i) = passed.v - later * f_after.v;
    z_after.col(i) = passed.z - later * f_after.z;
    m.col(i) = passed.m;
  }
  for (int i = 0; i < numbers_.size(); ++i)
    if (!numbers_.counts(dynamics_.system(), after, i)) m.row(i).setZero();
  refuse_varied_drivers(after);
  look_at(after);
  const Matrix N_M = frame_.basis().transpose() * frame_.mass().asDiagonal();
  const int f = frame_.freedom();
  y.topRows(f) = N_M * q_after;
  y.middleRows(f, f) = N_M * v_after;
  y.bottomRows(z_after.rows()) = z_after;
}

/// The motion a driver has been given may not depend on the state: no equation here says how the
/// joints then follow.
void CarriedVariation::refuse_varied_drivers(const State& state) const {
  const auto& parameters = dynamics_.system().model().parameters();
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (parameters[i].of_constraint &&
        !m.row(numbers_.contact_numbers() + static_cast<Eigen::Index>(i)).isZero(1e-12))
      throw ModelError(fmt::format(
          "variation: at t = {:.9g} s an event gives driver '{}' a motion that depends on the state",
          state.t, parameters[i].element));
}

}  // namespace yoke
