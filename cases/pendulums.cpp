// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/pendulums.hpp>

#include <boost/math/special_functions/ellint_1.hpp>
#include <cmath>

#include <yoke/cases/case.hpp>
#include <yoke/joints/distance.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/revolute.hpp>

namespace yoke::cases {

namespace {

const Vec2 origin{0.0, 0.0};

/// A uniform rod of 1 m and 1 kg along x.
Body rod(const char* name, double from) {
  return {.name = name, .mass = 1.0, .inertia = 1.0 / 12.0, .pose = {{from + 0.5, 0.0}, 0.0}};
}

}  // namespace

Model point_pendulum() {
  Model m;  // the mass does not turn; its inertia plays no part
  const BodyId mass =
      m.add(Body{.name = "mass", .mass = 1.0, .inertia = 1.0, .pose = {{1.0, 0.0}, 0.0}});
  m.add(Distance{.name = "rod", .a = ground, .b = mass, .at_a = origin, .at_b = {1.0, 0.0}});
  m.add(Gravity{});
  return m;
}

Model rod_pendulum() {
  Model m;
  const BodyId b = m.add(rod("rod", 0.0));
  m.add(Revolute{.name = "pivot", .a = ground, .b = b, .at = origin});
  m.add(Gravity{});
  return m;
}

Model double_pendulum() {
  Model m;
  const BodyId a = m.add(rod("a", 0.0)), b = m.add(rod("b", 1.0));
  m.add(Revolute{.name = "pivot", .a = ground, .b = a, .at = origin});
  m.add(Revolute{.name = "elbow", .a = a, .b = b, .at = {1.0, 0.0}});
  m.add(Gravity{});
  return m;
}

namespace {

/// Through the lowest point to the right, every period 4 K(sin(90 deg / 2)) sqrt(L / g).
std::vector<Check> point_pendulum_checks(const Parameters&, const Model&, const Result& run) {
  std::vector<Check> checks = {energy_check(run)};
  const std::vector<double> times = rising_times(run, "mass.x_m", "mass.vx_m_per_s");
  const double period = 4.0 * boost::math::ellint_1(std::sin(0.25 * pi)) / std::sqrt(9.81);
  for (Check& check : period_check(run, times, period)) checks.push_back(std::move(check));
  return checks;
}

/// Released at rest at the height of the pivot: kinetic and potential energy cancel at all times.
std::vector<Check> double_pendulum_checks(const Parameters&, const Model&, const Result& run) {
  const double g = 9.81;
  return {energy_check(run),
          deviation_check("kinetic energy off that of the height fallen", run, "kinetic_J", "J",
                          "closed form", [&, a = run["a.y_m"], b = run["b.y_m"]](std::size_t i) {
                            const auto row = static_cast<Eigen::Index>(i);
                            return -g * (a[row] + b[row]);
                          })};
}

}  // namespace

Case point_pendulum_case() {
  Case c = case_without_choices("benchmarks", "point_pendulum",
                                "IFToMM benchmark A01: a point mass on a massless rod",
                                point_pendulum, "10");
  c.checks = point_pendulum_checks;
  c.paths = {"mass"};
  return c;
}

Case double_pendulum_case() {
  Case c =
      case_without_choices("pendulums and chains", "double_pendulum",
                           "two uniform rods in a row, released horizontal", double_pendulum, "10");
  c.checks = double_pendulum_checks;
  c.paths = {"a", "b"};
  return c;
}

}  // namespace yoke::cases
