// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A smooth function of time f(t) with f' and f'', as a value: what drivers follow. The unit is that
// of the quantity driven, [rad] or [m], and per s and s^2 for the derivatives.
#pragma once

#include <concepts>
#include <functional>
#include <string_view>
#include <utility>

#include <yoke/core/auto_scalar.hpp>

namespace yoke {

/// f, f', f'' at one time.
struct TimeValue {
  double value = 0.0;         // in the unit of the function
  double rate = 0.0;          // a second
  double acceleration = 0.0;  // a second squared
};

class TimeFunction {
 public:
  TimeFunction() = default;  // empty: drivers reject it
  /// From anything that returns all three: [](double t) { return TimeValue{...}; }.
  template <class F>
  requires(!std::same_as<std::decay_t<F>, TimeFunction>) &&
      std::is_invocable_r_v<TimeValue, const F&, double> TimeFunction(F f)
      : f_(std::move(f)) {}  // implicit: a lambda can be passed to a driver directly

  /// At time t [s].
  TimeValue operator()(double t) const { return f_(t); }
  /// Whether there is a function.
  explicit operator bool() const { return static_cast<bool>(f_); }

 private:
  std::function<TimeValue(double)> f_;
};

/// f = value at all times.
TimeFunction constant(double value);

/// f = start + speed t.
TimeFunction constant_speed(double start, double speed);

/// Rest at `start` up to t = 0, then a speed that rises over `duration` [s] >= 0 and stays. With
/// x = t / duration the speed is speed (10 x^3 - 15 x^4 + 6 x^5), so that acceleration and its rate
/// are continuous; f is the exact integral, half a duration behind constant_speed in the end. A
/// duration of 0 is constant_speed. Throws ModelError.
TimeFunction smooth_ramp(double start, double speed, double duration);

/// From f alone, differentiated automatically; functions of t are written without std::.
///   time_function([](auto t) { return 0.1 * sin(3.0 * t); })
template <class F>
TimeFunction time_function(F f) {
  return TimeFunction([f = std::move(f)](double t) {
    using First = Dual<double, 1>;
    using Second = Dual<First, 1>;
    const First inner = auto_variable<First>(t, 0);
    const Second y = f(Second(inner, typename Second::Gradient(First(1.0))));
    return TimeValue{.value = y.value().value(),
                     .rate = y.value().gradient()[0],
                     .acceleration = y.gradient()[0].gradient()[0]};
  });
}

/// Throws ModelError unless f is given and finite at t = 0. `owner` as in error.hpp.
void require_time_function(std::string_view owner, std::string_view parameter,
                           const TimeFunction& f);

}  // namespace yoke
