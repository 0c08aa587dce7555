// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The part of a driver's motion that is set during a run, by its speed and acceleration:
//   f = offset + speed (t - since) + acceleration (t - since)^2 / 2
// All four are parameters in the State. A change at t leaves f(t) as it is: `offset` and `since` are
// brought to t first. A new speed is a blow, a new acceleration is none.
#pragma once

#include <optional>
#include <vector>

#include <yoke/core/constraint.hpp>
#include <yoke/core/time_function.hpp>

namespace yoke {

class SetMotion {
 public:
  /// `start` [m or rad]: f at t = 0. No speed: there is nothing to set.
  SetMotion(std::optional<double> speed, Measure measure, double start)
      : speed_(speed), measure_(measure), start_(start) {}

  /// Speed and acceleration, to be set, and where the motion is counted from; none without a speed.
  std::vector<Parameter> parameters() const {
    if (!speed_) return {};
    const std::string unit = measure_ == Measure::angle ? "rad" : "m";
    return {{.name = "speed", .unit = unit + "/s", .value = *speed_, .load = true},
            {.name = "acceleration", .unit = unit + "/s^2", .load = true},
            {.name = "offset", .unit = unit, .value = start_, .own = true, .load = true},
            {.name = "since", .unit = "s", .own = true, .load = true}};
  }

  /// f as set, or 0.
  TimeValue at(double t, const double* p) const {
    if (!speed_) return {};
    const double x = t - p[at_since];
    return {.value = p[at_offset] + (p[at_speed] + 0.5 * p[at_acceleration] * x) * x,
            .rate = p[at_speed] + p[at_acceleration] * x,
            .acceleration = p[at_acceleration]};
  }

  /// Counts the same motion from t [s] on: writes its value and rate there into `p`.
  void update(double t, double* p) const {
    if (!speed_) return;
    const TimeValue f = at(t, p);
    p[at_speed] = f.rate;
    p[at_offset] = f.value;
    p[at_since] = t;
  }

  /// With another motion, if there is one.
  TimeValue with(const TimeFunction& f, double t, const double* p) const {
    const TimeValue set = at(t, p);
    if (!f) return set;
    const TimeValue other = f(t);
    if (!speed_) return other;
    return {.value = other.value + set.value,
            .rate = other.rate + set.rate,
            .acceleration = other.acceleration + set.acceleration};
  }

 private:
  enum { at_speed, at_acceleration, at_offset, at_since };
  std::optional<double> speed_;
  Measure measure_;
  double start_;
};

}  // namespace yoke
