// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/impacts/forced_impacts.hpp>

#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>

namespace yoke::cases {

namespace {

constexpr double standard_gravity = 9.81;  // [m/s^2] of the case
constexpr double whole_turn = 2.0 * pi;

double wrapped(double angle) { return angle - whole_turn * std::floor(angle / whole_turn); }

/// x = A cos(w t - p) + exp(-z t) (b cos(w_d t) + c sin(w_d t)).
struct FreeOscillation {
  const ImpactOscillator& of;
  double shift, b, c;  // shift [rad] of the force at t = 0

  FreeOscillation(const ImpactOscillator& o, double phase, double x, double speed)
      : of(o), shift(phase - o.lag()) {
    b = x - o.amplitude() * std::cos(shift);
    c = (speed + o.amplitude() * o.omega() * std::sin(shift) + o.decay() * b) / o.damped_omega();
  }
  double position(double t) const {
    const double wd = of.damped_omega();
    return of.amplitude() * std::cos(of.omega() * t + shift) +
           std::exp(-of.decay() * t) * (b * std::cos(wd * t) + c * std::sin(wd * t));
  }
  double speed(double t) const {
    const double wd = of.damped_omega(), z = of.decay();
    return -of.amplitude() * of.omega() * std::sin(of.omega() * t + shift) +
           std::exp(-z * t) *
               ((wd * c - z * b) * std::cos(wd * t) - (wd * b + z * c) * std::sin(wd * t));
  }
};

}  // namespace

double ImpactOscillator::omega() const { return whole_turn * frequency; }
double ImpactOscillator::decay() const { return 0.5 * damping / mass; }
double ImpactOscillator::damped_omega() const {
  return std::sqrt(spring / mass - decay() * decay());
}
double ImpactOscillator::amplitude() const {
  return force / std::hypot(spring - mass * omega() * omega(), damping * omega());
}
double ImpactOscillator::lag() const {
  return std::atan2(damping * omega(), spring - mass * omega() * omega());
}
double ImpactOscillator::grazing_force() const {
  return gap * std::hypot(spring - mass * omega() * omega(), damping * omega());
}
double ImpactOscillator::free_motion(double x, double speed, double t) const {
  return FreeOscillation(*this, 0.0, x, speed).position(t);
}
double ImpactOscillator::free_speed(double x, double speed, double t) const {
  return FreeOscillation(*this, 0.0, x, speed).speed(t);
}

// With E = exp(-z T), c and s of w_d T: x = gap at both ends makes C = kappa B; the speeds -e v and v make
// B = beta v and A w sin(phi) = gamma v with phi = w t - p at the impact. Then
//   (gap - beta v)^2 + (gamma v / w)^2 = A^2.
std::vector<ImpactOrbit> ImpactOscillator::impact_orbits(int n) const {
  const double w = omega(), wd = damped_omega(), z = decay(), period = n / frequency;
  const double E = std::exp(-z * period), c = std::cos(wd * period), s = std::sin(wd * period);
  const double kappa = (1.0 - E * c) / (E * s);
  const double beta = (1.0 + restitution) / (wd * (E * (kappa * c - s) - kappa));
  const double gamma = restitution + beta * (wd * kappa - z);
  const double a = beta * beta + gamma * gamma / (w * w), b = gap * beta;
  const double root = b * b - a * (gap * gap - amplitude() * amplitude());
  if (!(root >= 0.0)) return {};
  std::vector<ImpactOrbit> orbits;
  for (const double v : {(b + std::sqrt(root)) / a, (b - std::sqrt(root)) / a}) {
    if (!(v > 0.0)) continue;
    const double phi = std::atan2(gamma * v / w, gap - beta * v);
    const FreeOscillation flight(*this, phi + lag(), gap, -restitution * v);
    constexpr int looks = 1000;
    bool clear = true;
    for (int i = 1; clear && i < looks; ++i) clear = flight.position(i * period / looks) < gap;
    if (clear) orbits.push_back({.phase = wrapped(phi + lag()), .approach = v});
  }
  return orbits;
}

double TableBall::omega() const { return whole_turn * frequency; }
double TableBall::table(double t) const { return amplitude * std::sin(omega() * t); }
double TableBall::table_speed(double t) const {
  return amplitude * omega() * std::cos(omega() * t);
}

TableBall::Impact TableBall::next(const Impact& from) const {
  const double height = table(from.t), step = 0.005 / frequency;
  const auto above = [&](double flight) {
    return height + (from.rebound - 0.5 * standard_gravity * flight) * flight -
           table(from.t + flight);
  };
  double before = 1e-9 / frequency;
  while (above(before + step) > 0.0) before += step;
  std::uintmax_t iterations = 100;
  const auto root = boost::math::tools::toms748_solve(
      above, before, before + step,
      boost::math::tools::eps_tolerance<double>(std::numeric_limits<double>::digits), iterations);
  const double flight = root.second, t = from.t + flight;
  return {.t = t,
          .rebound = -restitution * (from.rebound - standard_gravity * flight) +
                     (1.0 + restitution) * table_speed(t)};
}

TableBall::Impact TableBall::next_high(const Impact& from) const {
  const double t = from.t + 2.0 * from.rebound / standard_gravity;
  return {.t = t, .rebound = restitution * from.rebound + (1.0 + restitution) * table_speed(t)};
}

double TableBall::first_amplitude(int n) const {
  return standard_gravity / (omega() * omega()) * n * pi * (1.0 - restitution) /
         (1.0 + restitution);
}

double TableBall::flip_amplitude(int n) const {
  const double e = restitution, second = 2.0 * (1.0 + e * e) / ((1.0 + e) * (1.0 + e));
  return std::hypot(first_amplitude(n), standard_gravity / (omega() * omega()) * second);
}

double TableBall::high_flip_amplitude(int n) const {
  return std::hypot(first_amplitude(n), standard_gravity / (omega() * omega()));
}

std::optional<TableBall::Impact> TableBall::orbit(int n) const {
  const double cosine = first_amplitude(n) / amplitude;
  if (!(cosine <= 1.0)) return std::nullopt;
  return Impact{.t = std::acos(cosine) / omega(), .rebound = n * pi * standard_gravity / omega()};
}

}  // namespace yoke::cases
