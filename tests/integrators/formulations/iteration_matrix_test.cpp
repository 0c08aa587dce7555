// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <doctest/doctest.h>

#include <functional>
#include <random>
#include <vector>

#include <yoke/contact/disc_on_curve.hpp>
#include <yoke/contact/laws/dissipative/hunt_crossley.hpp>
#include <yoke/contact/laws/elastic/power_law.hpp>
#include <yoke/contact/laws/friction/coulomb.hpp>
#include <yoke/contact/laws/friction/lugre.hpp>
#include <yoke/contact/laws/friction/stribeck.hpp>
#include <yoke/core/curves/lines_and_arcs.hpp>
#include <yoke/integrators/formulations/equations/baumgarte_equations.hpp>
#include <yoke/integrators/formulations/equations/ggl_equations.hpp>
#include <yoke/joints/forces/translational_spring.hpp>
#include <yoke/joints/prismatic.hpp>
#include <yoke/joints/revolute.hpp>
#include <yoke/tests/integrators/mechanisms.hpp>
#include <yoke/tests/integrators/relaxing_spring.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;

/// Every entry of the iteration matrix against central differences of the residual, at a state with
/// no zeros, including coordinates nothing should depend on; but for entries left out by design.
void check_matrix(DaeEquations& equations, const SparseMatrix& matrix, const State& state,
                  const std::function<bool(int row, int column)>& left_out) {
  const auto n = static_cast<std::size_t>(equations.size());
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<double> y(n), y_dot(n), r_plus(n), r_minus(n);
  for (double& x : y) x = uniform(random);
  for (double& x : y_dot) x = 20.0 * uniform(random);
  std::copy_n(state.q.data(), state.q.size(), y.begin());
  std::copy_n(state.v.data(), state.v.size(), y.begin() + equations.v());

  const double t = 0.0137, shift = 321.7;
  equations.calc_jacobian(t, shift, y.data(), y_dot.data());
  std::vector<double> row_size(n, 0.0);
  for (std::size_t k = 0; k < matrix.row.size(); ++k) {
    double& size = row_size[static_cast<std::size_t>(matrix.row[k])];
    size = std::max(size, std::abs(matrix.value[k]));
  }
  double worst = 0.0;
  int nonzero = 0;
  for (std::size_t j = 0; j < n; ++j) {
    const double h = 1e-7;
    const auto residual_at = [&](double step, std::vector<double>& r) {
      const double y0 = y[j], p0 = y_dot[j];
      y[j] += step;
      y_dot[j] += shift * step;
      REQUIRE(equations.calc_residual(t, y.data(), y_dot.data(), r.data()));
      y[j] = y0;
      y_dot[j] = p0;
    };
    residual_at(h, r_plus);
    residual_at(-h, r_minus);
    std::vector<double> column(n, 0.0);
    for (int k = matrix.column_start[j]; k < matrix.column_start[j + 1]; ++k)
      column[static_cast<std::size_t>(matrix.row[static_cast<std::size_t>(k)])] =
          matrix.value[static_cast<std::size_t>(k)];
    for (std::size_t i = 0; i < n; ++i) {
      if (left_out(static_cast<int>(i), static_cast<int>(j))) continue;
      const double numeric = (r_plus[i] - r_minus[i]) / (2.0 * h);
      // Relative to the row: the rounding of a residual goes with its steepest direction.
      const double error = std::abs(column[i] - numeric) / (1.0 + row_size[i]);
      worst = std::max(worst, error);
      nonzero += column[i] != 0.0 ? 1 : 0;
    }
  }
  CHECK(worst < 1e-7);
  CHECK(nonzero > static_cast<int>(n));
}

void check_ggl(const Model& model, const State& state, const std::vector<int>& dropped = {}) {
  System system(model);
  system.bind(state);
  system.leave_out(dropped);
  GglEquations equations(system);
  check_matrix(equations, equations.matrix(), state, [](int, int) { return false; });
}

/// Without velocities the whole matrix is exact; with them, all but d(convective term)/dq; and
/// of friction that holds, /dv.
void check_baumgarte(const Model& model, State state, const std::vector<int>& dropped = {}) {
  for (const bool moving : {true, false}) {
    INFO(moving);
    System system(model);
    system.bind(state);
    system.leave_out(dropped);
    BaumgarteEquations equations(system, {.alpha = 31.0, .beta = 17.0});
    if (!moving) state.v.setZero();
    check_matrix(equations, equations.matrix(), state, [&](int row, int column) {
      const bool no_gradient = system.is_of_velocity_level(row - equations.lambda());
      return moving && row >= equations.lambda() &&
             column < (no_gradient ? equations.z() : equations.v());
    });
  }
}

}  // namespace

TEST_CASE("iteration matrices are the derivatives of the residuals: contact, springs, own states") {
  Model model = scotch_yoke();
  const BodyId crank = model.find_body("crank"), slider = model.find_body("slider");
  model.add(TranslationalSpring{.name = "spring",
                                .a = crank,
                                .b = slider,
                                .at_a = {0.01, 0.02},
                                .at_b = {0.05, -0.03},
                                .stiffness = 310.0,
                                .damping = 2.1});
  model.add(RelaxingSpring{.name = "relaxing", .body = slider});
  State state = model.start_state();
  state.q << 0.003, -0.002, -0.4, 0.101, 0.0015, 0.02;
  state.v << 0.3, -0.2, 70.0, 1.5, 0.1, -0.3;
  SUBCASE("apart") {}
  SUBCASE("compressing, outer wall") {
    state.contacts[0].phase = ContactPhase::compressing;
    state.contacts[0].region = 1;
  }
  SUBCASE("restituting, inner wall") {
    state.contacts[0].phase = ContactPhase::restituting;
    state.contacts[0].region = 0;
  }
  check_ggl(model, state);
  check_baumgarte(model, state);
}

TEST_CASE(
    "iteration matrices are the derivatives of the residuals: friction that holds, slides, is apart") {
  Model model;
  const BodyId disc = model.add(
      Body{.name = "disc", .mass = 0.3, .inertia = 2e-4, .pose = {{0.0, 0.05 - 2e-3}, 0.3}});
  const BodyId table =
      model.add(Body{.name = "table", .mass = 1.7, .inertia = 4e-3, .pose = {{0.1, -0.02}, 0.02}});
  model.add(Revolute{.name = "hinge", .a = ground, .b = table, .at = {0.3, 0.0}});
  model.add(DiscOnCurve{.name = "floor",
                        .disc = {disc, {0.0, 0.05 - 2e-3}, 0.05},
                        .body = table,
                        .curve = straight_line({0.0, 0.0}, {1.0, 0.0}),
                        .law = ContactLaw{PowerLaw{1e6, 1.5}, HuntCrossley{0.4}, Coulomb{0.3, 0.4}},
                        .surface_speed = 0.2,
                        .reference_force = 10.0});
  State state = model.start_state();
  state.v << 0.3, -0.01, 7.0, 0.2, 0.1, -0.3;
  state.contacts[0].phase = ContactPhase::compressing;
  for (const Grip grip : {Grip::held, Grip::carried, Grip::forward, Grip::backward}) {
    INFO(static_cast<int>(grip));
    state.contacts[0].grip = grip;
    check_ggl(model, state);
    check_baumgarte(model, state);
  }
  state.contacts[0] = {};
  check_ggl(model, state);
  check_baumgarte(model, state);
}

TEST_CASE("iteration matrices are the derivatives of the residuals: friction of joints") {
  const GuideFriction guide{.law = Coulomb{0.3, 0.4}, .length = 0.2, .preload = 1.0};
  const LuGre lugre{.mu = 0.3, .mu_static = 0.4, .stiffness = 200.0};
  for (const FrictionLaw& law :
       {FrictionLaw(Stribeck{.mu = 0.3, .mu_static = 0.4}), FrictionLaw(lugre)}) {
    Model model;
    const BodyId crank =
        model.add(Body{.name = "crank", .mass = 0.9, .inertia = 0.02, .pose = {{0.1, 0.2}, 0.3}});
    const BodyId block =
        model.add(Body{.name = "block", .mass = 0.5, .inertia = 0.01, .pose = {{0.4, 0.1}, -0.2}});
    model.add(Revolute{.name = "pivot",
                       .a = ground,
                       .b = crank,
                       .friction = PinFriction{.law = law, .radius = 0.07}});
    model.add(
        Prismatic{.name = "slide", .a = crank, .b = block, .along = {0.9, 0.2}, .friction = guide});
    State state = model.start_state();
    state.v << 0.3, -0.01, 2.0, 0.2, 0.1, -0.3;
    for (const Grip grip : {Grip::held, Grip::carried, Grip::forward, Grip::backward}) {
      INFO(law.name(), static_cast<int>(grip));
      state.contacts[0].grip = grip;
      check_ggl(model, state);
      check_ggl(model, state, {3});
      // Bristles have a corner where nothing slides.
      if (!law.has_state()) check_baumgarte(model, state);
    }
  }
}

TEST_CASE("equations that the system has dropped leave the matrices exact and regular") {
  Model model = double_pendulum();  // the second pivot repeats the first
  const BodyId a = model.find_body("a");
  model.add(Revolute{.name = "again", .a = ground, .b = a, .at = {0.0, 0.0}});
  State state = model.start_state();
  state.v.setConstant(0.3);
  state.q[2] = 0.7;
  const std::vector<int> dropped{4, 5};
  check_ggl(model, state, dropped);
  check_baumgarte(model, state, dropped);

  System system(model);
  system.bind(state);
  GglEquations redundant(system);
  system.leave_out(dropped);
  GglEquations equations(system);
  std::vector<double> y(static_cast<std::size_t>(equations.size()), 0.1);
  for (const double shift : {1e1, 1e7}) {
    redundant.calc_jacobian(0.0, shift, y.data(), y.data());
    CHECK_FALSE(redundant.factorise());
    equations.calc_jacobian(0.0, shift, y.data(), y.data());
    CHECK(equations.factorise());
  }
  CHECK(equations.counters().fresh == 1);
  std::vector<double> r(y.size());
  REQUIRE(equations.calc_residual(0.0, y.data(), y.data(), r.data()));
  const auto unknown = static_cast<std::size_t>(equations.mu() + 5);
  CHECK(r[unknown] == y[unknown]);
}

TEST_CASE("GGL matrix keeps its pattern through any number of factorisations") {
  const Model model = double_pendulum();
  const State state = model.start_state();
  System system(model);
  system.bind(state);
  GglEquations equations(system);
  const std::vector<int> rows = equations.matrix().row;
  std::vector<double> y(static_cast<std::size_t>(equations.size()), 0.1);
  for (const double shift : {1e1, 1e4, 1e7, 1e2}) {
    equations.calc_jacobian(0.0, shift, y.data(), y.data());
    CHECK(equations.factorise());
  }
  CHECK(equations.matrix().row == rows);
  CHECK(equations.counters().fresh == 1);  // the scaling takes the step out of the pivots
}

TEST_CASE("pins take room for the second derivatives they have, by the angle of each body") {
  const Model model = double_pendulum();
  System system(model);
  const GglEquations equations(system);
  const SparseMatrix& matrix = equations.matrix();
  int by_positions = 0;
  for (int column = 0; column < system.dofs(); ++column)
    for (int k = matrix.column_start[static_cast<std::size_t>(column)];
         k < matrix.column_start[static_cast<std::size_t>(column) + 1]; ++k) {
      const int row = matrix.row[static_cast<std::size_t>(k)] - equations.v();
      if (row < 0 || row >= system.dofs()) continue;
      CHECK(row == column);
      CHECK(column % 3 == 2);
      ++by_positions;
    }
  CHECK(by_positions == 2);
}
