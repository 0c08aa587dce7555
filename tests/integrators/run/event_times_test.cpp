// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Every event of a long train of bounces, against the slider's one equation integrated apart from
// this library in long double: steps of order 8, each compared with two half as long.
//   rho = |P - C|, C = (x, 0), P = r (cos phi, sin phi)      m x'' = -F(d, d') dd/dx
//   d = +-(rho - R) - gap, + on the outer wall
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <yoke/contact/laws/dissipative/lankarani_nikravesh_1994.hpp>
#include <yoke/tests/integrators/mechanisms.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;
using Real = long double;

struct Expected {
  Real t;
  const char* kind;
};

class Slider {
 public:
  using Y = std::array<Real, 2>;

  /// `e` > 0: the law that leaves a dent, otherwise Hunt and Crossley's.
  Slider(const YokeOptions& options, double e) : o_(options), e_(e) {
    const double omega = 24.0 * pi, phi = o_.start_angle, r = o_.crank_length;
    const Real root = std::sqrt(Real(R * R) - std::pow(Real(r) * std::sin(Real(phi)), 2));
    y_ = {r * std::cos(Real(phi)) + root,
          -r * std::sin(Real(phi)) * (1 + r * std::cos(Real(phi)) / root) * Real(omega)};
  }

  /// Its velocity is changed by `change` [m/s] after so many events.
  void kick(std::size_t after, Real change) {
    kick_after_ = after;
    kick_ = change;
  }

  std::vector<Expected> events_until(Real end) {
    std::vector<Expected> events;
    arm();
    Real h = shortest;
    while (t_ < end) {
      h = std::min(h, end - t_);
      Y half, once;
      const Y twice = step(h, half);
      stepper_.do_step(rates(), y_, t_, once, h);
      const Real error = std::max(std::abs(twice[0] - once[0]) * 100, std::abs(twice[1] - once[1]));
      if (error > tolerance) {
        h *= std::max(Real(0.2), Real(0.85) * std::pow(error / tolerance, Real(-1) / 6));
        continue;
      }
      if (const int first = first_event(h, twice); first < event_count) {
        handle(first, events);
        h = shortest;
        continue;
      }
      t_ += h;
      y_ = twice;
      for (int k = 0; k < event_count; ++k) armed_[k] = armed_[k] || function(k, t_, y_) < 0;
      h *= std::min(Real(4),
                    Real(0.85) * std::pow(std::max(error / tolerance, Real(1e-9L)), Real(-1) / 6));
      h = std::min(h, longest);
    }
    return events;
  }

 private:
  enum Phase { apart, compressing, restituting };
  enum Event { onset, turn, release, reload, forget, event_count };
  static constexpr double R = 60.0_mm, gap = 8.0_mm - 7.9_mm, mass = 2.353;
  static constexpr Real tolerance = 1e-17L, shortest = 1e-9L, longest = 2e-5L;

  struct Contact {
    Real d, rate, nx;
  };

  Contact contact(Real t, const Y& y, int side) const {
    const Real omega = 24.0 * pi, phi = Real(o_.start_angle) + omega * t, r = o_.crank_length;
    const Real px = r * std::cos(phi), py = r * std::sin(phi), dx = px - y[0];
    const Real rho = std::sqrt(dx * dx + py * py);
    const Real rate = (dx * (-omega * py - y[1]) + py * omega * px) / rho;
    return {side * (rho - R) - gap, side * rate, -side * dx / rho};
  }
  int nearest(Real t, const Y& y) const { return contact(t, y, 1).d + gap > 0 ? 1 : -1; }

  Real force(const Contact& c) const {
    const auto elastic = [&](Real d) {
      const Real K = (side_ > 0 ? o_.outer : o_.inner) * std::pow(1000.0, o_.n);
      return std::copysign(K * std::pow(std::abs(d), Real(o_.n)), d);
    };
    if (!(e_ > 0)) return elastic(c.d) * (1 + Real(1.5) * o_.alpha * c.rate);
    return phase_ == compressing ? elastic(c.d) : elastic((c.d - set_) / (Real(e_) * e_));
  }
  std::function<void(const Y&, Y&, Real)> rates() const {
    return [this](const Y& y, Y& y_dot, Real t) {
      y_dot = {y[1], 0};
      if (phase_ == apart) return;
      const Contact c = contact(t, y, side_);
      y_dot[1] = -force(c) * c.nx / mass;
    };
  }
  Y step(Real h, Y& half) {
    Y end;
    stepper_.do_step(rates(), y_, t_, half, h / 2);
    stepper_.do_step(rates(), half, t_ + h / 2, end, h / 2);
    return end;
  }

  /// Crosses zero upwards where the event is.
  Real function(int event, Real t, const Y& y) const {
    const bool dented = phase_ == apart && set_ > 0;
    const Contact c = contact(t, y, phase_ == apart && !dented ? nearest(t, y) : side_);
    if (event == onset && phase_ == apart) return c.d - set_;
    if (event == turn && phase_ == compressing && e_ > 0) return -c.rate;
    if (event == release && phase_ != apart) return (phase_ == restituting ? set_ : 0) - c.d;
    if (event == reload && phase_ == restituting) return c.d - largest_;
    if (event == forget && dented) return -c.d;
    return -1;
  }
  void arm() {
    for (int k = 0; k < event_count; ++k) armed_[k] = function(k, t_, y_) < 0;
  }

  /// The earliest event within the step, by bisection on steps from its beginning; t_, y_ go there.
  int first_event(Real h, const Y& end) {
    int first = event_count;
    Real t_first = h;
    for (int k = 0; k < event_count; ++k) {
      if (!armed_[k] || function(k, t_ + h, end) < 0) continue;
      Real before = 0, after = h;
      Y half;
      for (int i = 0; i < 80; ++i) {
        const Real middle = (before + after) / 2;
        (function(k, t_ + middle, step(middle, half)) < 0 ? before : after) = middle;
      }
      if (first < event_count && after >= t_first) continue;
      first = k;
      t_first = after;
    }
    if (first == event_count) return first;
    Y half;
    y_ = step(t_first, half);
    t_ += t_first;
    return first;
  }

  void handle(int event, std::vector<Expected>& events) {
    static constexpr const char* names[] = {"onset", "turn", "release", "reload"};
    if (event == onset) {
      if (!(set_ > 0)) side_ = nearest(t_, y_);
      phase_ = set_ > 0 ? restituting : compressing;
    } else if (event == turn) {
      phase_ = restituting;
      largest_ = contact(t_, y_, side_).d;
      set_ = largest_ * (1 - Real(e_) * e_);
    } else if (event == release) {
      phase_ = apart;
    } else if (event == reload) {
      phase_ = compressing;
    } else {
      set_ = 0;
    }
    if (event != forget) events.push_back({t_, names[event]});
    if (event != forget && events.size() == kick_after_) y_[1] += kick_;
    arm();
  }

  YokeOptions o_;
  double e_;
  boost::numeric::odeint::runge_kutta_fehlberg78<Y, Real> stepper_;
  Y y_{};
  Real t_ = 0;
  Phase phase_ = apart;
  int side_ = 1;
  Real largest_ = 0, set_ = 0, kick_ = 0;
  std::size_t kick_after_ = 0;
  std::array<bool, event_count> armed_{};
};

/// [s] The largest error of an event time; infinite if the events are not the same.
double worst_time(const Result& run, const std::vector<Expected>& expected) {
  if (!run.summary.ok() || run.events.size() != expected.size()) return HUGE_VAL;
  double worst = 0.0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (run.events[i].kind != expected[i].kind) return HUGE_VAL;
    worst = std::max(worst, std::abs(static_cast<double>(run.events[i].t - expected[i].t)));
  }
  return worst;
}

double worst_time(const YokeOptions& o, double e, double until, double rtol,
                  const std::string& formulation) {
  const DissipativeLaw law =
      e > 0.0 ? DissipativeLaw(LankaraniNikravesh1994{e}) : DissipativeLaw(HuntCrossley{o.alpha});
  const Result run = simulate(
      scotch_yoke(o, law),
      {.until = until, .relative_tolerance = rtol, .formulation = formulation, .samples = 0});
  return worst_time(run, Slider(o, e).events_until(until));
}

}  // namespace

TEST_CASE("sixty-six events of the scotch-yoke are where another integration has them") {
  for (const std::string formulation : {"arkode-projection", "ida-ggl", "adams-baumgarte"}) {
    INFO(formulation);
    CHECK(worst_time({}, 0.0, 1.5 * yoke_period, 1e-12, formulation) < 1e-10);
  }
  YokeOptions weaker;
  weaker.alpha = 0.30;  // seventy events
  for (const std::string formulation : {"arkode-projection", "ida-ggl", "adams-baumgarte"}) {
    INFO(formulation);
    CHECK(worst_time(weaker, 0.0, 1.5 * yoke_period, 1e-12, formulation) < 1e-10);
  }
  // Hardly damped, it enlarges errors a hundred times more.
  YokeOptions weak;
  weak.alpha = 0.08;
  CHECK(worst_time(weak, 0.0, 1.5 * yoke_period, 1e-12, "arkode-projection") < 1e-10);
}

TEST_CASE(
    "event times err by what an error of the first impact's speed of 2e-10 m/s makes of them") {
  // What this enlarges is not in the hands of a formulation: thirty-eight seconds per m/s.
  YokeOptions weak;
  weak.alpha = 0.18;
  const double until = 1.5 * yoke_period;
  const std::vector<Expected> expected = Slider(weak, 0.0).events_until(until);
  constexpr double change = 1e-11;  // [m/s]
  Slider slider(weak, 0.0);
  slider.kick(2, change);
  const std::vector<Expected> moved = slider.events_until(until);
  REQUIRE(moved.size() == expected.size());
  double sensitivity = 0.0;  // [s / (m/s)]
  for (std::size_t i = 0; i < moved.size(); ++i)
    sensitivity =
        std::max(sensitivity, std::abs(static_cast<double>(moved[i].t - expected[i].t)) / change);
  CHECK(sensitivity > 10.0);
  const auto worst = [&](const char* formulation) {
    return worst_time(simulate(scotch_yoke(weak), {.until = until,
                                                   .relative_tolerance = 1e-12,
                                                   .formulation = formulation,
                                                   .samples = 0}),
                      expected);
  };
  CHECK(worst("arkode-projection") < 1e-11 * sensitivity);
  CHECK(worst("ida-ggl") < 2e-10 * sensitivity);
  CHECK(worst("adams-baumgarte") < 2e-10 * sensitivity);
}

TEST_CASE("a flight, a touch and the next flight in one long step are told apart") {
  YokeOptions hertzian;
  hertzian.inner = hertzian.outer = 4e9 / std::pow(1000.0, 1.5);
  hertzian.n = 1.5;
  for (const std::string formulation : {"arkode-projection", "adams-baumgarte", "cvode-projection"})
    for (const double rtol : {1e-8, 1e-10}) {
      INFO(formulation, " ", rtol);
      CHECK(worst_time(hertzian, 0.0, 1.5 * yoke_period, rtol, formulation) < 1e3 * rtol);
    }
}

TEST_CASE("a dent is forgotten however short the way out of it") {
  for (const std::string formulation : {"arkode-projection", "ida-ggl", "adams-baumgarte"}) {
    INFO(formulation);
    CHECK(worst_time({}, 0.7, 0.9 * yoke_period, 1e-12, formulation) < 1e-9);
  }
}
