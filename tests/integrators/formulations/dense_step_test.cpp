// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What lies within a step: polynomials raised by evaluations, and what samples cost and err by them.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <yoke/integrators/formulations/explicit/dense_step.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/tests/integrators/problems.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;

// y = (q, v, w): q and w move on their own, so ends of a step can be exact.
struct Exact {
  double (*q)(double);
  double (*v)(double);
  double (*w)(double);
  DenseStep::Rates rates;
  std::vector<double> at(double t) const { return {q(t), v(t), w(t)}; }
};

const Exact oscillator = {[](double t) { return std::cos(t); },
                          [](double t) { return -std::sin(t); },
                          [](double t) { return std::exp(std::sin(t)); },
                          [](double t, const double* y, double* y_dot) {
                            y_dot[0] = y[1];
                            y_dot[1] = -y[0];
                            y_dot[2] = std::cos(t) * y[2];
                            return true;
                          }};

struct Found {
  bool good;
  double position, velocity, other;  // errors
  int evaluations;
};

/// From t = 0.2, over h; `tolerance` of all, for what lies within.
Found look_into(const Exact& motion, double h, double tolerance) {
  Found found{};
  DenseStep step(3, 1, [&](double t, const double* y, double* y_dot) {
    ++found.evaluations;
    return motion.rates(t, y, y_dot);
  });
  const double t = 0.2;
  const std::vector<double> begin = motion.at(t), end = motion.at(t + h);
  step.from({.t = t, .y = begin.data()}, {.t = t + h, .y = end.data()});
  found.good = step.raise([&](const double* error) {
    return std::max({std::abs(error[0]), std::abs(error[1]), std::abs(error[2])}) / tolerance;
  });
  for (int i = 0; i <= 40; ++i) {
    const double time = t + h * i / 40.0;
    double y[3];
    step.at(time, y);
    const std::vector<double> exact = motion.at(time);
    found.position = std::max(found.position, std::abs(y[0] - exact[0]));
    found.velocity = std::max(found.velocity, std::abs(y[1] - exact[1]));
    found.other = std::max(found.other, std::abs(y[2] - exact[2]));
  }
  return found;
}

TEST_CASE("what lies within a step is within the tolerance, by as many evaluations as that takes") {
  int before = 0;
  for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-9}) {
    CAPTURE(tolerance);
    const Found found = look_into(oscillator, 0.2, tolerance);
    CHECK(found.good);
    CHECK(found.position < tolerance);
    CHECK(found.velocity < tolerance);
    CHECK(found.other < tolerance);
    CHECK(found.evaluations >= before);
    CHECK(found.evaluations <= 11);
    before = found.evaluations;
  }
  CHECK(before > 4);
}

TEST_CASE("the polynomial within a step is exact for a polynomial of its degree") {
  // Two slopes and two evaluations within, and two that find nothing to change: degree 5 in velocities and
  // what else has rates only, more in positions.
  const Exact motion = {[](double t) { return std::pow(t, 6.0); },
                        [](double t) { return 6.0 * std::pow(t, 5.0); },
                        [](double t) { return std::pow(t, 5.0); },
                        [](double t, const double* y, double* y_dot) {
                          y_dot[0] = y[1];
                          y_dot[1] = 30.0 * std::pow(t, 4.0);
                          y_dot[2] = 5.0 * std::pow(t, 4.0);
                          return true;
                        }};
  const Found found = look_into(motion, 1.0, 1e-3);
  CHECK(found.good);
  CHECK(found.evaluations == 6);
  CHECK(found.position < 1e-13);
  CHECK(found.velocity < 1e-12);
  CHECK(found.other < 1e-13);
}

TEST_CASE("a step with a corner within has no polynomial") {
  // A spring from x = 0 on, struck at t = 0.35.
  static constexpr double k = 400.0, struck = 0.35;
  const auto q = [](double t) {
    return t < struck ? t - struck : std::sin(20.0 * (t - struck)) / 20.0;
  };
  const auto v = [](double t) { return t < struck ? 1.0 : std::cos(20.0 * (t - struck)); };
  const Exact motion = {q, v, [](double) { return 1.0; },
                        [](double, const double* y, double* y_dot) {
                          y_dot[0] = y[1];
                          y_dot[1] = -k * std::max(y[0], 0.0);
                          y_dot[2] = 0.0;
                          return true;
                        }};
  const Found found = look_into(motion, 0.2, 1e-8);
  CHECK_FALSE(found.good);
  CHECK(found.evaluations <= 4);  // and that is seen early
}

TEST_CASE("many samples cost little more than one in each step, and err as the steps do") {
  const Model model = horizontal_chain(5);
  SimulationOptions options{.until = 1.0, .relative_tolerance = 1e-13, .samples = 401};
  const Result reference = simulate(model, options);
  for (const int order : {5, 7}) {
    CAPTURE(order);
    options.order = order;
    options.relative_tolerance = 1e-8;
    const Result run = simulate(model, options);
    // One evaluation for the accelerations in a row; polynomials take a few in each step.
    const Summary& s = run.summary;
    CHECK(s.recording_evaluations < options.samples + 6 * s.steps);
    double at_tenths = 0.0, worst = 0.0;  // of the last link
    for (std::size_t i = 0; i < run.samples.rows(); ++i)
      for (const char* name : {"link 4.x_m", "link 4.y_m"}) {
        const std::size_t column = run.samples.index(name);
        const double error =
            std::abs(run.samples.value(i, column) - reference.samples.value(i, column));
        worst = std::max(worst, error);
        if (i % 40 == 0) at_tenths = std::max(at_tenths, error);
      }
    CHECK(at_tenths > 1e-11);
    CHECK(worst < 3.0 * at_tenths);
  }
}

}  // namespace
