// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/formulations/rounding_floor.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <yoke/core/equations/linear/index.hpp>

namespace yoke {

namespace {

constexpr double fast = 10.0;          // in units of the scales
constexpr double largest_ratio = 1e6;  // of masses; bodies without mass have no other
constexpr double handed_on = 0.25;     // of the noise of a fast body, to those it is joined to
constexpr double infinity = std::numeric_limits<double>::infinity();

/// [dofs] By how much rounding of the heaviest body of an assembly is enlarged in others.
std::vector<double> yielding_of(const System& system, const std::vector<int>& assembly,
                                const std::vector<double>& arm) {
  std::vector<double> heaviest(assembly.size(), 0.0), yielding(at(system.dofs()), 1.0);
  const auto mass = [&](int i) {
    return system.mass()[at(i)] / (i % 3 == 2 ? arm[at(i / 3)] * arm[at(i / 3)] : 1.0);
  };
  for (int i = 0; i < system.dofs(); i += 3) {
    double& most = heaviest[at(assembly[at(i / 3)])];
    most = std::max(most, mass(i));
  }
  for (int i = 0; i < system.dofs(); ++i) {
    const double ratio = heaviest[at(assembly[at(i / 3)])] / mass(i);  // infinite without mass
    if (ratio > 1.0) yielding[at(i)] = std::sqrt(std::min(ratio, largest_ratio));
  }
  return yielding;
}

}  // namespace

RoundingFloor::RoundingFloor(const Dynamics& dynamics, const Tolerances& tolerances,
                             const Noise& noise)
    : system_(dynamics.system()),
      relative_(tolerances.relative),
      own_(noise.own * machine_epsilon),
      followed_(noise.followed * machine_epsilon),
      assembly_(assemblies_of(dynamics.system())),
      size_(assembly_.size()),
      is_fast_(assembly_.size(), 0),
      steepness_(assembly_.size(), 0.0),
      q_(at(system_.dofs()), 0.0),
      v_(q_) {
  for (std::size_t body = 0; body < assembly_.size(); ++body)
    arm_.push_back(std::sqrt(dynamics.length_metric()[3 * body + 2]));
  yielding_ = yielding_of(system_, assembly_, arm_);
  harmless_ = {.position = infinity, .speed = infinity};
  for (int i = 0; i < system_.dofs(); ++i) {
    const double share = (i % 3 == 2 ? arm_[at(i / 3)] : 1.0) / (own_ * yielding_[at(i)]);
    harmless_.position = std::min(harmless_.position, tolerances.q[i] * share);
    harmless_.speed = std::min(harmless_.speed, tolerances.v[i] * share);
  }
}

void RoundingFloor::bound(std::size_t body, double length, double share, double* weight) {
  for (std::size_t k = 0; k < 3; ++k) {
    const double floor = length * yielding_[3 * body + k] / (k == 2 ? arm_[body] : 1.0);
    if (!(floor * weight[k] > 1.0)) continue;
    raised_ = std::max(raised_, floor * weight[k] * share);
    weight[k] = 1.0 / floor;
  }
}

void RoundingFloor::start() { has_last_ = false; }

double RoundingFloor::size_of(std::size_t body, const double* x) const {
  return std::max({std::abs(x[0]), std::abs(x[1]), arm_[body] * std::abs(x[2])});
}

void RoundingFloor::note_step(const double* q, const double* v) {
  for (std::size_t body = 0; body < arm_.size(); ++body) {
    double dq[3], dv[3];
    for (std::size_t k = 0, i = 3 * body; k < 3; ++k, ++i) {
      dq[k] = q[i] - q_[i];
      dv[k] = v[i] - v_[i];
    }
    const double moved = size_of(body, dq);
    if (!has_last_)
      steepness_[body] = 0.0;
    else if (moved > 0.0)
      steepness_[body] = size_of(body, dv) / moved;
  }
  std::copy_n(q, q_.size(), q_.begin());
  std::copy_n(v, v_.size(), v_.begin());
  has_last_ = true;
}

void RoundingFloor::apply(const double* q, const double* v, double* weight_q, double* weight_v,
                          double share) {
  const double limit = fast / (relative_ * share);
  note_step(q, v);
  Size largest;
  bool any_fast = false;
  std::ranges::fill(size_, Size{});
  for (std::size_t body = 0; body < arm_.size(); ++body) {
    const Size size = {size_of(body, q + 3 * body), size_of(body, v + 3 * body)};
    for (Size* s : {&size_[at(assembly_[body])], &largest}) {
      s->position = std::max(s->position, size.position);
      s->speed = std::max(s->speed, size.speed);
    }
    const double* u = v + 3 * body;
    double* w = weight_v + 3 * body;
    const double speed =
        std::max({std::abs(u[0]) * w[0], std::abs(u[1]) * w[1], std::abs(u[2]) * w[2]});
    is_fast_[body] = speed > limit;
    if (!(speed > limit)) continue;
    any_fast = true;
    double& steepness = size_[at(assembly_[body])].steepness;
    steepness = std::max(steepness, steepness_[body]);
    for (int k = 0; k < 3; ++k) w[k] *= limit / speed;
  }
  if (!any_fast && largest.position < harmless_.position && largest.speed < harmless_.speed) return;
  for (std::size_t body = 0; body < arm_.size(); ++body) {
    const Size& size = size_[at(assembly_[body])];
    const double position = own_ * size.position;
    // What rounding of the position makes of a fast body's velocity, joints hand on to the others: with
    // no more energy than it has there, so with the root of the ratio of masses that bound() has in it.
    const double own_steepness = is_fast_[body] != 0 ? steepness_[body] : 0.0;
    const double steepness = std::max(own_steepness, handed_on * size.steepness);
    const double speed = std::max(own_ * size.speed, steepness * followed_ * size.position);
    bound(body, position, share, weight_q + 3 * body);
    bound(body, speed, share, weight_v + 3 * body);
  }
}

}  // namespace yoke
