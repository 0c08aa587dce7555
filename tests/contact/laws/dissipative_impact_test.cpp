// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What every dissipative law returns in a free central impact, through the whole engine: bodies,
// events, integrators. The closed forms here are written again and share no code with the laws.
#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <yoke/contact/laws/catalog/calibrated.hpp>
#include <yoke/contact/laws/catalog/dissipative_catalog.hpp>
#include <yoke/contact/laws/elastic/johnson.hpp>
#include <yoke/contact/laws/elastic/power_law.hpp>
#include <yoke/core/model.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/tests/integrators/wall.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;

const PowerLaw linear{3.1e7, 1.0};
const PowerLaw hertzian{2.7e9, 1.5};
const PowerLaw flat{4.4e7, 1.1};
const Johnson logarithmic{1.137e11, 60.1e-3, 10e-3};
constexpr double mass = 0.83, speed = 0.19;  // [kg], [m/s]
const std::vector<double> asked_for = {0.1, 0.3, 0.5, 0.7, 0.9, 0.99};

// ---- references

/// Root of X (1 + e) = ln((1 + X)/(1 - e X)), by its fixed point from above: e = (1 - (1 + X)
/// exp(-X (1 + e)))/X, polished by Newton in long double.
double proportional(double X_given) {
  const long double X = X_given;
  if (X == 0.0L) return 1.0;
  long double e = std::min(1.0L, 1.0L / X) * 0.999999L;
  for (int i = 0; i < 20000; ++i) {
    const long double rest = (1.0L + X) * std::exp(-X * (1.0L + e));
    const long double change = (1.0L - X * e - rest) / (X * (rest - 1.0L));
    const long double next = e - change;
    if (!(std::abs(next - e) > 1e-18L)) break;
    e = next;
  }
  return static_cast<double>(e);
}

/// Release at zero force of a linear oscillator that would return e if it could pull.
double clamped(double e) {
  const double l = std::log(e), xi = -l / std::hypot(l, pi), s = std::sqrt(1.0 - xi * xi);
  return std::exp(-(xi / s) * (pi - std::atan2(2.0 * xi * s, 1.0 - 2.0 * xi * xi)));
}

/// Lee and Wang's second law with w = v_i = 1: v dv/dd = -d - 2 xi T v below eps, a damped
/// oscillator above.
double lee_wang(double e, double q, double eps) {
  const double l = std::log(e), xi = -l / std::hypot(l, pi), s = std::sqrt(1.0 - xi * xi);
  const auto slope = [&](double d, double v) {
    return -d / v - 2.0 * xi * std::exp(2.0 * q * (d - eps) / eps);
  };
  const auto through = [&](double from, double to, double v) {
    const int steps = 20000;
    const double h = (to - from) / steps;
    for (int i = 0; i < steps; ++i) {
      const double d = from + h * i;
      const double k1 = slope(d, v), k2 = slope(d + 0.5 * h, v + 0.5 * h * k1);
      const double k3 = slope(d + 0.5 * h, v + 0.5 * h * k2), k4 = slope(d + h, v + h * k3);
      v += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    }
    return v;
  };
  const double v1 = through(0.0, eps, 1.0), a = eps, b = (v1 + xi * eps) / s;
  const auto d_at = [&](double t) {
    return std::exp(-xi * t) * (a * std::cos(s * t) + b * std::sin(s * t));
  };
  const auto v_at = [&](double t) {
    return std::exp(-xi * t) *
           ((s * b - xi * a) * std::cos(s * t) - (s * a + xi * b) * std::sin(s * t));
  };
  const auto root = [](double low, double high, const std::function<double(double)>& falling) {
    for (int i = 0; i < 100; ++i) {
      const double middle = 0.5 * (low + high);
      (falling(middle) > 0.0 ? low : high) = middle;
    }
    return low;
  };
  const double turn = root(0.0, pi / s, v_at);
  const double back = root(turn, pi / s, [&](double t) { return d_at(t) - eps; });
  return -through(eps, 0.0, v_at(back));
}

/// What the law of that name delivers; negative where it must refuse.
double expected(const std::string& name, double e) {
  const double log_e = std::log(e);
  if (name == "none") return 1.0;
  if (name == "hunt-crossley") return proportional(1.5 - 1.5 * e);
  if (name == "herbert-mcwhannell")
    return proportional((6.0 - 6.0 * e) / (4.0 * e * e - 4.0 * e + 4.0));
  if (name == "lee-wang-1") return proportional(0.75 - 0.75 * e);
  if (name == "lee-wang-2") return lee_wang(e, 3.0, 0.1);
  if (name == "khulief-shabana" || name == "lankarani-nikravesh")
    return proportional(0.75 - 0.75 * e * e);
  if (name == "marhefka-orin") return proportional((3.0 - 3.0 * e * e) / (2.0 + 2.0 * e * e * e));
  if (name == "marhefka-orin-simplified")
    return e > 1.0 / 3.0 ? proportional((3.0 - 3.0 * e * e) / (6.0 * e - 2.0)) : -1.0;
  if (name == "flores") return proportional(8.0 / (5.0 * e) - 8.0 / 5.0);
  if (name == "gharib-hurmuzlu") return proportional(1.0 / e);
  if (name == "hu-guo") return proportional(1.5 / e - 1.5);
  if (name == "carvalho-martins")
    return proportional((33.0 - 36.0 * e + 3.0 * e * e) / (2.0 + 18.0 * e));
  if (name == "kelvin-voigt" || name == "tsuji" || name == "exact-restitution") {
    const double xi = -log_e / std::hypot(log_e, pi);
    return std::exp(-pi * xi / std::sqrt(1.0 - xi * xi));
  }
  return e;  // gonthier, zhang-sharf and the laws with a permanent set say so
}

// ---- the engine

Result thrown(const ContactLaw& law, const std::string& formulation) {
  Model m;
  const BodyId ball = m.add(Body{.name = "ball",
                                 .mass = mass,
                                 .inertia = 1e-3,
                                 .pose = {{0.2, 1e-4}, 0.3},
                                 .twist = {{0.4, -speed}, 1.1}});
  m.add(Wall{.name = "floor", .body = ball, .law = law});
  return simulate(
      m, {.until = 0.03, .relative_tolerance = 1e-12, .formulation = formulation, .samples = 2});
}

double delivered(const ContactLaw& law, const std::string& formulation) {
  const Result run = thrown(law, formulation);
  REQUIRE(run.summary.ok());
  REQUIRE(run.events.size() >= 2);
  CHECK(run.events.front().kind == "onset");
  CHECK(run.events.back().kind == "release");
  return -run.events.back().speed / run.events.front().speed;
}

double relative(double value, double reference) { return std::abs(value / reference - 1.0); }

ContactLaw with(const ElasticLaw& elastic, const std::string& name, double e,
                TensilePhase tensile = TensilePhase::keep) {
  return {elastic, make_dissipative(name, {.restitution = e, .tensile = tensile})};
}

}  // namespace

TEST_CASE("every dissipative law returns its closed form in an impact") {
  for (const DissipativeNote& note : dissipative_catalog()) {
    for (const double e : asked_for) {
      const double reference = expected(note.name, e);
      if (reference < 0.0) {
        CHECK_THROWS_AS(make_dissipative(note.name, {.restitution = e}), ModelError);
        continue;
      }
      INFO(note.name, " e = ", e);
      const PowerLaw& elastic = note.linear_only ? linear : hertzian;
      CHECK(relative(delivered(with(elastic, note.name, e), "arkode-projection"), reference) <
            1e-8);
    }
  }
}

TEST_CASE("the restitution of laws for any elastic law does not depend on it") {
  for (const std::string name :
       {"flores", "hunt-crossley", "lankarani-nikravesh-1994", "exact-restitution"}) {
    for (const ElasticLaw& elastic :
         {ElasticLaw(linear), ElasticLaw(flat), ElasticLaw(logarithmic)}) {
      INFO(name, " ", elastic.name());
      CHECK(relative(delivered(with(elastic, name, 0.6), "arkode-projection"),
                     expected(name, 0.6)) < 1e-8);
    }
  }
}

TEST_CASE("an impact returns the closed form of its dissipative law with the other formulation") {
  for (const std::string name : {"flores", "lankarani-nikravesh", "gonthier", "tsuji",
                                 "kelvin-voigt", "gharib-hurmuzlu-2", "lee-wang-2"}) {
    for (const double e : {0.3, 0.9}) {
      INFO(name, " e = ", e);
      const PowerLaw& elastic = find_dissipative(name).linear_only ? linear : hertzian;
      CHECK(relative(delivered(with(elastic, name, e), "ida-ggl"), expected(name, e)) < 1e-8);
    }
  }
}

TEST_CASE("with the tensile phase clamped, more is returned") {
  for (const double e : {0.1, 0.3, 0.5, 0.7, 0.9}) {
    INFO("e = ", e);
    for (const std::string name : {"tsuji", "exact-restitution", "kelvin-voigt"}) {
      const PowerLaw& elastic = find_dissipative(name).linear_only ? linear : hertzian;
      const ContactLaw law = with(elastic, name, e, TensilePhase::clamp);
      CHECK(relative(delivered(law, "arkode-projection"), clamped(e)) < 1e-8);
    }
  }
}

TEST_CASE("a permanent set is left as deep as it should be") {
  const double d_m = std::pow(0.5 * mass * speed * speed * 2.5 / hertzian.K, 1.0 / 2.5);
  for (const std::string name : {"lankarani-nikravesh-1994", "gharib-hurmuzlu-2"}) {
    for (const double e : asked_for) {
      INFO(name, " e = ", e);
      const Result run = thrown(with(hertzian, name, e), "arkode-projection");
      REQUIRE(run.summary.ok());
      REQUIRE(run.events.size() == 3);
      CHECK(run.events[1].kind == "turn");
      CHECK(relative(run.events[1].penetration, d_m) < 1e-8);
      CHECK(relative(run.events[2].penetration, d_m * (1.0 - e * e)) < 1e-8);
    }
  }
}

TEST_CASE("a calibrated law returns the restitution asked for") {
  for (const std::string name : {"hunt-crossley", "lankarani-nikravesh", "lee-wang-1", "flores",
                                 "hu-guo", "marhefka-orin-simplified", "carvalho-martins"})
    CHECK(relative(delivered({hertzian, calibrated(name, 0.75)}, "arkode-projection"), 0.75) <
          1e-8);
  CHECK(relative(delivered({hertzian, calibrated("gharib-hurmuzlu", 0.3)}, "arkode-projection"),
                 0.3) < 1e-8);
  CHECK(relative(delivered({hertzian, calibrated("tsuji", 0.4, {.tensile = TensilePhase::clamp})},
                           "arkode-projection"),
                 0.4) < 1e-8);
  CHECK(relative(delivered({hertzian, calibrated_alpha(0.4, speed)}, "arkode-projection"), 0.4) <
        1e-8);
}

TEST_CASE("the energy a law dissipates in an impact is what is missing in the speed") {
  const double kinetic = 0.5 * mass * speed * speed;
  for (const DissipativeNote& note : dissipative_catalog()) {
    INFO(note.name);
    const PowerLaw& elastic = note.linear_only ? linear : hertzian;
    const Result run = thrown(with(elastic, note.name, 0.7), "arkode-projection");
    REQUIRE(run.summary.ok());
    const double e = expected(note.name, 0.7);
    const auto dissipated = run["dissipated_J"];
    CHECK(std::abs(dissipated(dissipated.size() - 1) / kinetic - (1.0 - e * e)) < 1e-8);
  }
}
