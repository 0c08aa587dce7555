// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Rows within contacts, which are short beside the time from sample to sample.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <yoke/contact/laws/elastic/power_law.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/tests/integrators/wall.hpp>
#include <yoke/tests/messages.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;

constexpr double stiffness = 1e8;  // [N/m]

/// A mass of 1 kg above a floor.
Model dropped(double height) {
  Model m;
  const BodyId ball =
      m.add(Body{.name = "ball", .mass = 1.0, .inertia = 1.0, .pose = {{0.0, height}, 0.0}});
  m.add(Gravity{.acceleration = {0.0, -9.81}});
  m.add(Wall{.name = "floor", .body = ball, .law = {PowerLaw{stiffness, 1.0}}});
  return m;
}

std::ptrdiff_t rows_between(const Table& table, double from, double to) {
  const Eigen::VectorXd t = table["t_s"];
  return std::ranges::count_if(t, [&](double x) { return x >= from && x < to; });
}

}  // namespace

TEST_CASE("rows within contacts show each impact whole, beside samples that are the same") {
  const Model model = dropped(0.1);
  SimulationOptions options{.until = 1.0, .samples = 11};
  const Result plain = simulate(model, options);
  CHECK(plain.contact_samples.names().empty());
  options.contact_rows = 20;
  const Result run = simulate(model, options);
  REQUIRE(run.summary.ok());
  CHECK(run.samples.data() == plain.samples.data());
  CHECK(run.contact_samples.names() == run.samples.names());
  double onset = -1.0;
  int impacts = 0;
  for (const EventRecord& e : run.events) {
    if (e.kind == "onset") onset = e.t;
    if (e.kind != "release" || onset < 0.0) continue;
    ++impacts;
    CHECK(rows_between(run.contact_samples, onset, e.t) >= 20);
  }
  CHECK(impacts >= 3);
  const auto total = static_cast<std::ptrdiff_t>(run.contact_samples.rows());
  CHECK(rows_between(run.contact_samples, 0.0, 1.0) == total);
  // The first impact from the floor and back to it: the peak is sqrt(m k) v for a short one.
  const Eigen::VectorXd force = run.contact_samples["floor.normal_force_N"];
  const double peak = std::sqrt(stiffness * 2.0 * 9.81 * 0.1);
  CHECK(force.maxCoeff() > 0.98 * peak);
  CHECK(force.maxCoeff() < 1.002 * peak);
  CHECK(force[0] == doctest::Approx(0.0).scale(peak).epsilon(1e-6));
  CHECK(run.samples["floor.normal_force_N"].maxCoeff() < 0.5 * peak);
}

// Energy: k d^2/2 = m g (height + d). Without damping all impacts are alike.
TEST_CASE("there is a row at the peak of each impact, wherever steps end") {
  const double height = 0.1, weight = 9.81;
  const Model model = dropped(height);
  const double depth =
      (weight + std::sqrt(weight * weight + 2.0 * stiffness * weight * height)) / stiffness;
  for (const char* formulation : {"arkode-projection", "ida-ggl", "cvode-projection"}) {
    INFO(formulation);
    const Result run = simulate(model, {.until = 1.0,
                                        .relative_tolerance = 1e-10,
                                        .formulation = formulation,
                                        .samples = 2,
                                        .contact_rows = 1});
    REQUIRE(run.summary.ok());
    const Eigen::VectorXd t = run.contact_samples["t_s"];
    const Eigen::VectorXd d = run.contact_samples["floor.penetration_m"];
    const Eigen::VectorXd force = run.contact_samples["floor.normal_force_N"];
    int impacts = 0;
    double onset = -1.0;
    for (const EventRecord& e : run.events) {
      if (e.kind == "onset") onset = e.t;
      if (e.kind != "release" || onset < 0.0) continue;
      ++impacts;
      double deepest = 0.0, largest = 0.0;
      for (Eigen::Index i = 0; i < t.size(); ++i)
        if (t[i] >= onset && t[i] <= e.t)
          deepest = std::max(deepest, d[i]), largest = std::max(largest, force[i]);
      CHECK(deepest == doctest::Approx(depth).epsilon(1e-8));
      CHECK(largest == doctest::Approx(stiffness * depth).epsilon(1e-8));
    }
    CHECK(impacts >= 3);
    CHECK(std::is_sorted(t.begin(), t.end()));
  }
}

TEST_CASE("a contact that lasts has ever fewer rows") {
  const Model model = dropped(-1.5 * 9.81 / stiffness);  // swings about its place at rest
  SimulationOptions options{
      .until = 0.1, .relative_tolerance = 1e-11, .samples = 2, .contact_rows = 4};
  const Result run = simulate(model, options);
  REQUIRE(run.summary.ok());
  REQUIRE(run.summary.steps > 300);
  // 4 and 2 more each time that the number of steps doubles, one at the start.
  const double doublings = std::log2(static_cast<double>(run.summary.steps) / 4.0);
  CHECK(run.contact_samples.rows() >= 4);
  CHECK(static_cast<double>(run.contact_samples.rows()) <= 5.0 + 2.0 * std::ceil(doublings));
}

TEST_CASE("contact_rows must not be negative") {
  CHECK_THROWS_WITH_AS(simulate(dropped(0.1), {.until = 1.0, .contact_rows = -1}),
                       doctest::Contains("contact_rows = -1 must be 0 (none) or greater"),
                       ModelError);
}
