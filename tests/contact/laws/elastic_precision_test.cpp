// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The inverse of the logarithmic laws against Newton's method with 50 digits, over the whole range.
// The law's constants are the doubles a and d_max, and the error is judged at those.
#include <doctest/doctest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include <yoke/contact/laws/elastic/johnson.hpp>
#include <yoke/contact/laws/elastic/logarithmic_law.hpp>
#include <yoke/core/error.hpp>

using namespace yoke;
using doctest::Approx;
using Exact = boost::multiprecision::cpp_bin_float_50;

namespace {

struct Errors {
  double force = 0.0, stiffness = 0.0, energy = 0.0;
  void add(const LogarithmicLaw& law, double d) {
    using boost::multiprecision::abs, boost::multiprecision::log, boost::multiprecision::sqrt;
    // v - ln(1 + v) = u, from above: v < u + sqrt(2u).
    const Exact a = law.a(), u = log(Exact(law.limit()) / d);
    Exact v = u + sqrt(2 * u);
    for (int i = 0; i < 100; ++i) {
      const Exact step = (v - log(1 + v) - u) * (1 + v) / v;
      v -= step;
      if (abs(step) < Exact(1e-25) * v) break;
    }
    const Exact F = d / (a * (1 + v));
    const ElasticResponse r = law(d);
    const auto relative = [](double value, const Exact& right) {
      return std::abs(static_cast<double>(value / right - 1));
    };
    force = std::max(force, relative(r.force, F));
    stiffness = std::max(stiffness, relative(r.stiffness, 1 / (a * v)));
    const Exact energy_right = a * F * F * (v / 2 + Exact(1) / 4);
    // The energy of the smallest penetrations is no normal number.
    if (energy_right > 1e-290) energy = std::max(energy, relative(r.energy, energy_right));
  }
  void check() const {
    CHECK(force < 2e-15);
    CHECK(stiffness < 2e-15);
    CHECK(energy < 4e-15);
  }
};

// A steel pin in its slot, a soft wheel, and limits that are hardly lengths of anything.
const std::vector<LogarithmicLaw>& laws() {
  static const std::vector<LogarithmicLaw> list{{2.798e-10, 5.4134e-5, "pin"},
                                                {3.3e-7, 0.71, "wheel"},
                                                {7e-12, 3e-9, "fine"},
                                                {0.013, 1.7e5, "coarse"}};
  return list;
}

}  // namespace

TEST_CASE("force and stiffness of the logarithmic law are exact to 2e-15, evenly over the range") {
  Errors errors;
  for (const LogarithmicLaw& law : laws())
    for (int i = 1; i < 4000; ++i) errors.add(law, law.limit() * (i / 4000.0));
  errors.check();
}

TEST_CASE("force and stiffness of the logarithmic law are exact to 2e-15 down to 1e-300 m") {
  Errors errors;
  for (const LogarithmicLaw& law : laws()) {
    const double decades = std::log10(law.limit()) + 300.0;
    for (int i = 0; i < 6000; ++i)
      errors.add(law, std::max(1e-300, law.limit() * std::pow(10.0, -decades * i / 6000.0 - 1e-9)));
    errors.add(law, 1e-300);
  }
  errors.check();
}

TEST_CASE("force and stiffness of the logarithmic law are exact to 2e-15 up to the limit") {
  Errors errors;
  for (const LogarithmicLaw& law : laws()) {
    double d = law.limit();
    for (int i = 0; i < 1000; ++i) errors.add(law, d = std::nextafter(d, 0.0));
    for (int i = 0; i < 3000; ++i)
      errors.add(law, law.limit() - law.limit() * std::pow(10.0, -15.5 * i / 3000.0 - 0.001));
  }
  errors.check();
}

TEST_CASE("force and stiffness of the logarithmic law are exact on both sides of every seam") {
  const LogarithmicLaw& law = laws()[0];
  Errors errors;
  const auto around = [&](double d) {
    for (double x = d * (1.0 - 5e-15), i = 0; i < 60; ++i, x = std::nextafter(x, 1.0))
      errors.add(law, x);
  };
  around(LogLawInverse::fold * law.limit());
  for (double octave = 0.25; octave < 700.0; octave *= 2.0)
    for (int j = 0; j < 16; ++j) {
      const double u = octave * (1.0 + j / 16.0);
      if (u > 0.29 && u < 670.0) around(law.limit() * std::exp(-u));
    }
  for (int j = 1; j < 23; ++j) around(law.limit() * (1.0 - 0.5 * (j / 32.0) * (j / 32.0)));
  errors.check();
}

TEST_CASE("the logarithmic law at its ends: zero, the smallest number, the limit, beyond") {
  for (const LogarithmicLaw& law : laws()) {
    CAPTURE(law.name());
    const double smallest = std::numeric_limits<double>::denorm_min();
    CHECK(law(0.0).force == 0.0);
    CHECK(law(0.0).energy == 0.0);
    CHECK(law(0.0).stiffness > 0.0);
    CHECK(law(0.0).stiffness == law(smallest).stiffness);
    CHECK(law(law.limit()).force == Approx(law.largest_force()).epsilon(1e-15));
    CHECK(law(law.limit()).stiffness == std::numeric_limits<double>::infinity());
    CHECK(law(law.limit()).energy ==
          Approx(0.25 * law.limit() * law.largest_force()).epsilon(1e-15));
    CHECK(std::isnan(law(1.01 * law.limit()).force));
    CHECK(std::isnan(law(std::numeric_limits<double>::quiet_NaN()).force));
    for (const double share : {1e-9, 0.1, 0.9})
      CHECK(law.penetration(law(share * law.limit()).force) ==
            Approx(share * law.limit()).epsilon(1e-13));
  }
  CHECK_THROWS_AS(LogarithmicLaw(0.0, 1e-3, "x"), ModelError);
  CHECK_THROWS_AS(LogarithmicLaw(1e-9, std::numeric_limits<double>::infinity(), "x"), ModelError);
}
