// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The derivative of a run by its start against differences of whole runs, and against what is known of it.
#include <doctest/doctest.h>

#include <Eigen/LU>
#include <cmath>
#include <string>

#include <yoke/tests/integrators/mechanisms.hpp>
#include <yoke/tests/messages.hpp>
#include <yoke/yoke.hpp>

namespace {

using namespace yoke;
using namespace yoke::literals;
using Vector = Eigen::VectorXd;

Vector all_of(const State& s) {
  Vector x(s.q.size() + s.v.size() + s.z.size());
  x << s.q, s.v, s.z;
  return x;
}

/// A state of the run's start moved by h in component j of y.
State beside(const FlowDerivative& d, Eigen::Index j, double h) {
  const Eigen::Index f = d.start_basis.cols();
  State state = d.start;
  if (j < f) {
    state.q += h * d.start_basis.col(j);
    state.v += h * d.start_basis_rate.col(j);
  } else if (j < 2 * f) {
    state.v += h * d.start_basis.col(j - f);
  } else {
    state.z[j - 2 * f] += h;
  }
  return state;
}

/// Largest difference of a column from differences of runs, beside the size of the column; `change` is
/// that of the fastest coordinate [m, rad, m/s ...].
double error_of(const Model& model, const FlowDerivative& d, const SimulationOptions& options,
                double change) {
  double worst = 0.0;
  for (Eigen::Index j = 0; j < d.dq.cols() - std::ssize(d.memory); ++j) {
    const Eigen::Index f = d.start_basis.cols();
    const double size = j < 2 * f ? d.start_basis.col(j % f).cwiseAbs().maxCoeff() : 1.0;
    const double h = change / size;
    const auto end = [&](double by) {
      return all_of(simulate(model, beside(d, j, by), options).final);
    };
    const Vector difference =
        (8.0 * (end(h) - end(-h)) - (end(2.0 * h) - end(-2.0 * h))) / (12.0 * h);
    Vector column(difference.size());
    column << d.dq.col(j), d.dv.col(j), d.dz.col(j);
    worst = std::max(worst, (difference - column).norm() / column.norm());
  }
  return worst;
}

/// A ball thrown on a floor, 0.5 mm above it.
Model thrown(const ContactLaw& law, double along = 0.05) {
  Model m;
  const Vec2 centre{0.0, 20.5_mm};
  const BodyId ball = m.add({.name = "ball",
                             .mass = 0.1_kg,
                             .inertia = 2e-5_kg_m2,
                             .pose = {centre, 0.0},
                             .twist = {{along, 0.0}, 1.0}});
  m.add(Gravity{});
  m.add(DiscOnCurve{.name = "floor",
                    .disc = {ball, centre, 20.0_mm},
                    .body = ground,
                    .curve = straight_line({0.0, 0.0}, {1.0, 0.0}),
                    .law = law});
  return m;
}

}  // namespace

TEST_CASE("the derivative of a double pendulum's motion is that of differences of runs") {
  const Model m = tests::double_pendulum();
  const SimulationOptions options{.until = 0.8, .relative_tolerance = 1e-12, .samples = 0};
  const FlowDerivative d = flow_derivative(m, m.start_state(), options);
  REQUIRE(d.run.summary.ok());
  CHECK(d.degrees_of_freedom == 2);
  CHECK(d.jumps == 0);
  CHECK(error_of(m, d, options, 1e-3) < 1e-8);
  // At the tolerance that is usual here, the accuracy of a run.
  SimulationOptions usual = options;
  usual.relative_tolerance = 1e-10;
  const FlowDerivative e = flow_derivative(m, m.start_state(), usual);
  CHECK((e.dq - d.dq).norm() < 1e-7 * d.dq.norm());
  CHECK((e.dv - d.dv).norm() < 1e-7 * d.dv.norm());
}

TEST_CASE("a conservative motion keeps volumes, and its derivative is symplectic") {
  const Model m = tests::double_pendulum();
  const FlowDerivative d = flow_derivative(
      m, m.start_state(), {.until = 2.0, .relative_tolerance = 1e-10, .samples = 0});
  const Eigen::Matrix2d I = Eigen::Matrix2d::Identity(), O = Eigen::Matrix2d::Zero();
  Eigen::Matrix4d J;
  J << O, I, -I, O;
  CHECK((d.matrix.transpose() * J * d.matrix - J).norm() < 1e-9 * d.matrix.norm());
  CHECK(std::abs(d.matrix.determinant() - 1.0) < 1e-9);
  CHECK(std::abs(d.growth_of_volume) < 1e-12);
}

TEST_CASE("derivatives through impacts are those of differences of runs") {
  const PowerLaw hertz{1e7, 1.5};
  struct {
    std::string name;
    ContactLaw law;
    bool remembers;  // the force depends on what was recorded at the onset
  } const laws[] = {
      {"elastic", ContactLaw{hertz}, false},
      {"Flores", ContactLaw{hertz, Flores{.e = 0.8}}, true},
      {"Lankarani", ContactLaw{hertz, LankaraniNikravesh1990{.e = 0.8}}, true},
      {"Lankarani, permanent", ContactLaw{hertz, LankaraniNikravesh1994{.e = 0.8}}, true},
      {"Hunt and Crossley", ContactLaw{hertz, HuntCrossley{.alpha = 0.3_s_per_m}}, false},
      // A force that jumps at the onset, and depends on the effective mass.
      {"Kelvin and Voigt", ContactLaw{PowerLaw{1e5, 1.0}, KelvinVoigt{.e = 0.7}}, false}};
  for (const auto& [name, law, remembers] : laws) {
    INFO(name);
    const Model m = thrown(law);
    // Beyond the release of the first impact.
    const SimulationOptions options{.until = 0.02, .relative_tolerance = 1e-12, .samples = 0};
    const FlowDerivative d = flow_derivative(m, m.start_state(), options);
    REQUIRE(d.run.summary.ok());
    REQUIRE(d.jumps >= 2);
    CHECK(error_of(m, d, options, 1e-6) < 2e-6);
    // What is remembered takes part in how volumes change; else it is Liouville's formula.
    const double volume = d.matrix.determinant() / std::exp(d.growth_of_volume);
    CHECK((std::abs(volume - 1.0) > 0.1) == remembers);
    if (!remembers) CHECK(volume == doctest::Approx(1.0).epsilon(1e-7));
  }
}

TEST_CASE("an impact that is under way depends on what it remembers") {
  const Model m = thrown(ContactLaw{PowerLaw{1e7, 1.5}, LankaraniNikravesh1990{.e = 0.8}});
  const State within =
      simulate(m, {.until = 0.0105, .relative_tolerance = 1e-12, .samples = 0}).final;
  REQUIRE(within.contacts.front().phase != ContactPhase::apart);
  const SimulationOptions options{.until = 0.02, .relative_tolerance = 1e-12, .samples = 0};
  const FlowDerivative d = flow_derivative(m, within, options);
  REQUIRE(d.memory.size() == 1);
  CHECK(d.memory.front() == "floor.approach_velocity");
  CHECK(d.memory_at_start[0] == within.contacts.front().approach_velocity);
  const auto end = [&](double by) {
    State start = d.start;
    start.contacts.front().approach_velocity += by;
    return all_of(simulate(m, start, options).final);
  };
  const double h = 1e-5;
  const Vector difference = (end(h) - end(-h)) / (2.0 * h);
  Vector column(difference.size());
  const Eigen::Index j = d.dq.cols() - 1;
  column << d.dq.col(j), d.dv.col(j), d.dz.col(j);
  CHECK(column.norm() > 1e-3);
  CHECK((difference - column).norm() < 1e-6 * column.norm());
}

TEST_CASE("derivatives through friction with bristles are those of differences of runs") {
  const Model m =
      thrown(ContactLaw{PowerLaw{1e5, 1.5}, HuntCrossley{.alpha = 0.3_s_per_m},
                        LuGre{.mu = 0.3, .mu_static = 0.4, .stiffness = 200.0, .damping = 0.1}},
             0.3);
  const SimulationOptions options{.until = 0.04, .relative_tolerance = 1e-11, .samples = 0};
  const FlowDerivative d = flow_derivative(m, m.start_state(), options);
  REQUIRE(d.run.summary.ok());
  REQUIRE(d.jumps >= 2);
  // Bristles of a contact that is apart are none: their column is not asked for.
  FlowDerivative moving = d;
  moving.dq.conservativeResize(Eigen::NoChange, 6);
  CHECK(error_of(m, moving, options, 1e-6) < 1e-6);
}

TEST_CASE("derivatives through blows and changed parameters are those of differences of runs") {
  Model m = tests::double_pendulum();
  m.add(TranslationalSpring{.name = "spring",
                            .a = ground,
                            .b = m.find_body("b"),
                            .at_a = {0.0, 2.0},
                            .at_b = {2.0, 0.0},
                            .stiffness = 3.0});
  const BodyId a = m.find_body("a");
  m.add(EventFunction{.name = "hammer",
                      .function = [a](const Motion& motion) { return motion[a].angle + 0.6; },
                      .action =
                          [a](const EventAction& at) {
                            at.impulse(a, {0.0, 0.0}, -0.05 + 0.02 * at.motion[a].omega);
                            at.parameter("spring.stiffness") = 5.0 + at.motion[a].omega;
                          }});
  const SimulationOptions options{.until = 0.8, .relative_tolerance = 1e-12, .samples = 0};
  const FlowDerivative d = flow_derivative(m, m.start_state(), options);
  REQUIRE(d.run.summary.ok());
  REQUIRE(d.jumps == 1);
  CHECK(error_of(m, d, options, 3e-5) < 1e-7);
}

TEST_CASE("a mechanism that drivers move altogether has no derivative") {
  Model m;
  const BodyId crank =
      m.add({.name = "crank", .mass = 1.0, .inertia = 1.0, .pose = {{0.5, 0.0}, 0.0}});
  m.add(Revolute{.name = "pivot", .a = ground, .b = crank});
  m.add(AngleDriver{.name = "motor", .body = crank, .angle = constant_speed(0.0, 1.0)});
  CHECK_THROWS_WITH_AS(flow_derivative(m, m.start_state(), {.until = 0.1, .samples = 0}),
                       doctest::Contains("no motion of its own"), ModelError);
}

TEST_CASE("where the linear equations end, a run says so and keeps what it has") {
  // Friction that takes hold.
  const Model m = thrown(
      ContactLaw{PowerLaw{1e5, 1.0}, KelvinVoigt{.e = 0.2}, Coulomb{.mu = 0.9, .mu_static = 0.9}});
  const FlowDerivative d =
      flow_derivative(m, m.start_state(), {.until = 1.0, .relative_tolerance = 1e-8});
  CHECK(d.run.summary.stop == Stop::failed);
  CHECK(tests::contains(d.run.summary.reason, "friction holds"));
  CHECK(d.run.summary.t_end > 0.01);
  CHECK(d.matrix.allFinite());
}
