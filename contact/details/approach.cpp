// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/contact/details/approach.hpp>

#include <algorithm>
#include <array>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/generation/generation_runge_kutta_dopri5.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <cmath>
#include <limits>

namespace yoke {

namespace {

namespace odeint = boost::numeric::odeint;

constexpr double backwards_tolerance = 1e-11;
constexpr int max_backward_steps = 20000;
constexpr int max_doublings = 60;
constexpr double speed_accuracy = 1e-13;

/// The free impact in its own units: penetration in parts of the one met, the rate in parts of
/// `speed`; time runs backwards.
struct Impact {
  const ContactLaw& law;
  ContactMemory memory;
  double depth, speed;  // [m, m/s]

  using Point = std::array<double, 2>;  // penetration, rate

  double deceleration(double d, double v) const {
    const double force = law.evaluate({depth * d, speed * v, memory}).force;
    return force * depth / (memory.effective_mass * speed * speed);
  }

  /// Rate at the touch; NaN if the way back does not lead there.
  double at_touch(double rate) const;
};

double Impact::at_touch(double rate) const {
  Point x{1.0, rate};
  const auto backwards = [this](const Point& at, Point& slope, double) {
    slope = {-at[1], deceleration(at[0], at[1])};
  };
  auto stepper = odeint::make_controlled<odeint::runge_kutta_dopri5<Point>>(backwards_tolerance,
                                                                            backwards_tolerance);
  double t = 0.0, step = 1e-3;
  for (int i = 0; i < max_backward_steps; ++i) {
    const Point before = x;
    if (stepper.try_step(backwards, x, t, step) == odeint::fail) continue;
    if (!std::isfinite(x[0]) || !std::isfinite(x[1])) break;
    if (x[0] > 0.0) continue;
    // The last step again, over the penetration, to end exactly at the touch.
    const double way = before[0];
    double v = before[1], s = way;
    const auto slope = [this](double d, double w) { return deceleration(d, w) / w; };
    constexpr int parts = 16;
    for (int k = 0; k < parts; ++k, s -= way / parts) {
      const double h = way / parts;
      const double k1 = slope(s, v), k2 = slope(s - 0.5 * h, v + 0.5 * h * k1);
      const double k3 = slope(s - 0.5 * h, v + 0.5 * h * k2), k4 = slope(s - h, v + h * k3);
      v += h * (k1 + 2.0 * k2 + 2.0 * k3 + k4) / 6.0;
    }
    return v;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

double approach_velocity_to(const ContactLaw& law, ContactMemory memory, double penetration,
                            double rate) {
  const double m = memory.effective_mass;
  if (!std::isfinite(m)) return std::abs(rate);  // moved as drivers want, whatever the force
  const double stored = law.elastic.response(penetration).energy;
  const double energetic = std::sqrt(rate * rate + 2.0 * stored / m);
  if (!(energetic > 0.0) || !std::isfinite(energetic)) return std::max(rate, 0.0);
  if (law.dissipation.none()) return energetic;
  memory.phase = ContactPhase::compressing;
  Impact impact{law, memory, penetration, energetic};
  // Is the impact that begins with v slower than what its own damping asks for? With too much of it
  // no impact leads here at all: it would pull.
  const auto too_slow = [&](double v) {
    impact.memory.approach_velocity = v * energetic;
    return !(impact.at_touch(rate / energetic) <= v);
  };
  double low = 1.0, high = 1.0;
  for (int i = 0; i < max_doublings && !too_slow(low); ++i) low *= 0.5;
  for (int i = 0; i < max_doublings && too_slow(high); ++i) high *= 2.0;
  if (!too_slow(low) || too_slow(high)) return energetic;
  while (high - low > speed_accuracy * high) {
    const double middle = 0.5 * (low + high);
    (too_slow(middle) ? low : high) = middle;
  }
  return 0.5 * (low + high) * energetic;
}

}  // namespace yoke
