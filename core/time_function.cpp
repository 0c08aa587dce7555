// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/core/time_function.hpp>

#include <yoke/core/error.hpp>

namespace yoke {

TimeFunction constant(double value) {
  require_finite("constant", "value", value);
  return TimeFunction([value](double) { return TimeValue{.value = value}; });
}

TimeFunction constant_speed(double start, double speed) {
  require_finite("constant_speed", "start", start);
  require_finite("constant_speed", "speed", speed);
  return TimeFunction(
      [start, speed](double t) { return TimeValue{.value = start + speed * t, .rate = speed}; });
}

TimeFunction smooth_ramp(double start, double speed, double duration) {
  require_finite("smooth_ramp", "start", start);
  require_finite("smooth_ramp", "speed", speed);
  require_not_negative("smooth_ramp", "duration", duration, "s");
  if (duration == 0.0) return constant_speed(start, speed);
  return TimeFunction([start, speed, duration](double t) {
    if (t <= 0.0) return TimeValue{.value = start};
    if (t >= duration)
      return TimeValue{.value = start + speed * (t - 0.5 * duration), .rate = speed};
    const double x = t / duration, x2 = x * x, x3 = x2 * x;
    return TimeValue{.value = start + speed * duration * x2 * x2 * (2.5 + x * (x - 3.0)),
                     .rate = speed * x3 * (10.0 + x * (6.0 * x - 15.0)),
                     .acceleration = speed / duration * 30.0 * x2 * (1.0 - x) * (1.0 - x)};
  });
}

void require_time_function(std::string_view owner, std::string_view parameter,
                           const TimeFunction& f) {
  if (!f)
    throw ModelError(
        fmt::format("{}: {} is missing; give a function of time such as constant_speed(start, "
                    "speed)",
                    owner, parameter));
  const TimeValue start = f(0.0);
  require_finite(owner, fmt::format("{} at t = 0", parameter), start.value);
  require_finite(owner, fmt::format("rate of {} at t = 0", parameter), start.rate);
  require_finite(owner, fmt::format("acceleration of {} at t = 0", parameter), start.acceleration);
}

}  // namespace yoke
