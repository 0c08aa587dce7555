// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Elimination in the range space, by blocks and by KLU, against a dense solution in extended precision, with
// KLU on the saddle matrix beside.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <yoke/contact/laws/friction/regularised_coulomb.hpp>
#include <yoke/core/equations/dynamics.hpp>
#include <yoke/core/equations/linear/index.hpp>
#include <yoke/core/units.hpp>
#include <yoke/joints/distance.hpp>
#include <yoke/joints/drivers/angle_driver.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/point_on_line.hpp>
#include <yoke/joints/prismatic.hpp>
#include <yoke/joints/revolute.hpp>
#include <yoke/joints/weld.hpp>

namespace {

using namespace yoke;
using Extended = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

struct Kind {
  int bodies;
  int loops;              // joints beyond those of the tree
  double decades;         // of the masses
  bool same_hub = false;  // all on one body
  bool friction = false;  // in pins and guides, so little that reactions satisfy it
};

/// Bodies on joints of all kinds at random places, each on one before it; then loops.
Model random_mechanism(const Kind& kind, unsigned seed) {
  std::mt19937 random(seed);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
  };
  Model model;
  std::vector<BodyId> bodies{ground};
  const auto point = [&] { return Vec2(uniform(-1.0, 1.0), uniform(-1.0, 1.0)); };
  for (int i = 0; i < kind.bodies; ++i) {
    const double mass = std::pow(10.0, uniform(-0.5, 0.5) * kind.decades);
    const BodyId body = model.add(Body{.name = fmt::format("body {}", i),
                                       .mass = mass,
                                       .inertia = mass * uniform(0.05, 0.2),
                                       .pose = {point(), uniform(-3.0, 3.0)},
                                       .twist = {point(), uniform(-2.0, 2.0)}});
    const BodyId on = kind.same_hub && i > 0 ? bodies[1] : bodies[random() % bodies.size()];
    const std::string name = fmt::format("joint {}", i);
    std::optional<PinFriction> of_pin;
    std::optional<GuideFriction> of_guide;
    if (kind.friction) {
      of_pin = {.law = RegularisedCoulomb{.mu = 0.1}, .radius = 0.02};
      of_guide = {.law = RegularisedCoulomb{.mu = 0.02}, .length = 1.0};
    }
    switch (random() % 6) {
      case 0:
        model.add(
            Prismatic{.name = name, .a = on, .b = body, .along = point(), .friction = of_guide});
        break;
      case 1:
        model.add(Weld{.name = name, .a = on, .b = body, .at = point()});
        break;
      default:
        model.add(Revolute{.name = name, .a = on, .b = body, .at = point(), .friction = of_pin});
    }
    bodies.push_back(body);
  }
  model.add(AngleDriver{.name = "motor", .body = bodies.back(), .angle = constant_speed(0.0, 3.0)});
  for (int i = 0; i < kind.loops; ++i) {
    const auto a = random() % bodies.size(), b = random() % bodies.size();
    if (a != b)
      model.add(Revolute{
          .name = fmt::format("loop {}", i), .a = bodies[a], .b = bodies[b], .at = point()});
  }
  model.add(Gravity{});
  return model;
}

struct Answer {
  Eigen::VectorXd a, lambda;
  LinearSolver used;
  FactorCounters counters;
};

Answer solve_by(const Model& model, const State& start, LinearSolver solver) {
  Dynamics dynamics(model, solver);
  State state = start;
  REQUIRE(dynamics.calc_accelerations(state));
  return {state.a, state.lambda, dynamics.saddle().in_use(), dynamics.counters()};
}

/// Accelerations and multipliers in extended precision, and how far the equations are from dependent: the
/// reciprocal condition of G M^-1 G^T with a diagonal of ones. Friction is that at the multipliers `loads`.
struct Reference {
  Extended x;
  double independence;
};

Reference reference_of(const Model& model, State state, const Eigen::VectorXd* loads = nullptr) {
  Dynamics dynamics(model, LinearSolver::klu);
  if (!dynamics.calc_accelerations(state)) return {{}, 0.0};
  const SparseMatrix& sparse = dynamics.matrix();
  const int n = dynamics.system().dofs(), rows = dynamics.system().rows();
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(sparse.size, sparse.size);
  for (int j = 0; j < sparse.size; ++j)
    for (int k = sparse.column_start[at(j)]; k < sparse.column_start[at(j) + 1]; ++k)
      dense(sparse.row[at(k)], j) = sparse.value[at(k)];
  // The right-hand side of the solution there is, to extended precision: small errors of it are those of
  // another system close by, which all are compared with.
  Extended b = Extended::Zero(sparse.size);
  Eigen::VectorXd force = Eigen::VectorXd::Zero(n + 1), gamma = Eigen::VectorXd::Zero(rows);
  System& system = dynamics.system();
  if (loads != nullptr) system.set_multipliers(loads->data());
  system.add_forces(force.data(), nullptr, nullptr);
  for (const ConstraintSlot& c : system.constraints())
    system.evaluate(c, {.gamma = gamma.data() + c.row});
  for (int i = 0; i < n; ++i) b[i] = force[i];
  for (int i = 0; i < rows; ++i) b[n + i] = gamma[i];
  const Eigen::MatrixXd G = dense.bottomLeftCorner(rows, n);
  const Eigen::MatrixXd S =
      G * dense.topLeftCorner(n, n).diagonal().cwiseInverse().asDiagonal() * G.transpose();
  const Eigen::VectorXd d = S.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::VectorXd eigenvalues = Eigen::MatrixXd(d.asDiagonal() * S * d.asDiagonal())
                                          .selfadjointView<Eigen::Lower>()
                                          .eigenvalues();
  return {dense.cast<long double>().fullPivLu().solve(b), eigenvalues[0] / eigenvalues[rows - 1]};
}

double error_of(const Answer& answer, const Extended& x) {
  const Eigen::Index n = answer.a.size();
  const Extended a = answer.a.cast<long double>() - x.head(n);
  const Extended lambda = answer.lambda.cast<long double>() - x.tail(x.size() - n);
  return static_cast<double>(
      std::max(a.cwiseAbs().maxCoeff() / x.head(n).cwiseAbs().maxCoeff(),
               lambda.cwiseAbs().maxCoeff() / x.tail(x.size() - n).cwiseAbs().maxCoeff()));
}

/// Cranks of equal length on pins of the ground, those beside each other joined by a coupler, all at `angle` from
/// the line through the pins. At 0 as many equations depend on the others as there are couplers.
Model parallelograms(double angle) {
  const Vec2 apart = rotate(0.4, Vec2(0.034, 0.0)), crank = rotate(0.4 + angle, Vec2(0.036, 0.0));
  const std::vector<double> mass = {84.0, 0.3, 0.043, 24.0}, mass_of_couplers = {0.056, 0.45, 41.0};
  const std::vector<double> inertia = {2e-2, 4e-5, 2e-6, 4e-3},
                            inertia_of_couplers = {6e-6, 1e-5, 4e-3};
  const Twist twist = {perp(-2.3 * crank), 0.0};
  Model model;
  BodyId last = ground;
  for (std::size_t i = 0; i < mass.size(); ++i) {
    const Vec2 pin = -static_cast<double>(i) * apart;
    const BodyId body = model.add(Body{.name = fmt::format("crank {}", i),
                                       .mass = mass[i],
                                       .inertia = inertia[i],
                                       .pose = {pin + 0.5 * crank, 0.0},
                                       .twist = {0.5 * twist.velocity, -2.3}});
    model.add(Revolute{.name = fmt::format("pin {}", i), .a = ground, .b = body, .at = pin});
    if (i > 0) {
      const Vec2 end = pin + crank, other = end + apart;
      const BodyId coupler = model.add(Body{.name = fmt::format("coupler {}", i),
                                            .mass = mass_of_couplers[i - 1],
                                            .inertia = inertia_of_couplers[i - 1],
                                            .pose = {0.5 * (end + other), 0.0},
                                            .twist = twist});
      model.add(Revolute{.name = fmt::format("from {}", i), .a = last, .b = coupler, .at = other});
      model.add(Revolute{.name = fmt::format("to {}", i), .a = coupler, .b = body, .at = end});
    }
    last = body;
  }
  model.add(Gravity{});
  return model;
}

}  // namespace

TEST_CASE("every linear solver gives the accelerations and multipliers of random mechanisms") {
  const std::vector<Kind> kinds = {{1, 0, 0.0},  {2, 0, 1.0},  {6, 0, 1.0},
                                   {6, 1, 1.0},  {12, 2, 1.0}, {12, 0, 6.0},
                                   {12, 2, 6.0}, {25, 4, 6.0}, {25, 0, 6.0, true}};
  int judged = 0;
  for (const Kind& kind : kinds)
    for (unsigned seed = 1; seed <= 40; ++seed) {
      const Model model = random_mechanism(kind, seed);
      const State state = model.start_state();
      const Reference reference = reference_of(model, state);
      if (reference.independence < 1e-9) continue;  // rows that depend on each other
      INFO(kind.bodies, " bodies, ", kind.loops, " loops, ", kind.decades, " decades, seed ", seed,
           ", ", reference.independence);
      const double klu = error_of(solve_by(model, state, LinearSolver::klu), reference.x);
      for (const LinearSolver solver : {LinearSolver::range_klu, LinearSolver::blocks}) {
        const Answer answer = solve_by(model, state, solver);
        CHECK(answer.used == solver);
        const double error = error_of(answer, reference.x);
        INFO(name_of(solver), " ", error, ", KLU ", klu);
        CHECK(error < std::max(1e-12, 10.0 * klu));
      }
      ++judged;
    }
  CHECK(judged > 200);
}

// The smallest pivot says 1e-7 of three that follow each other: blocks alone lose all digits.
TEST_CASE(
    "where several equations come near to dependence at once, accelerations are those of KLU") {
  for (const double angle : {1e-1, 3e-3, 1e-3, 5e-4}) {
    const Model model = parallelograms(angle);
    const State state = model.start_state();
    const Extended x = reference_of(model, state).x;
    const double klu = error_of(solve_by(model, state, LinearSolver::klu), x);
    for (const LinearSolver solver : {LinearSolver::range_klu, LinearSolver::blocks}) {
      const double error = error_of(solve_by(model, state, solver), x);
      INFO("at ", angle, ": ", name_of(solver), " ", error, ", KLU ", klu);
      CHECK(error < std::max(1e-12, 10.0 * klu));
    }
  }
}

TEST_CASE("what joints leave no motion rests, also where a light body holds a heavy one") {
  Model model;
  const BodyId heavy = model.add(
      Body{.name = "heavy", .mass = 7.6e6, .inertia = 2.5e5, .pose = {{-0.16, -0.43}, 0.0}});
  const BodyId light =
      model.add(Body{.name = "light", .mass = 3.2, .inertia = 0.11, .pose = {{0.46, 0.29}, 0.0}});
  model.add(PointOnLine{.name = "line",
                        .a = heavy,
                        .at = {0.016, -0.12},
                        .b = ground,
                        .through = {0.13, -0.22},
                        .along = {0.75, -0.66}});
  model.add(Revolute{.name = "pin", .a = ground, .b = light, .at = {0.37, 0.16}});
  model.add(Prismatic{.name = "guide", .a = light, .b = heavy, .along = {0.99, 0.14}});
  model.add(Distance{
      .name = "rod", .a = light, .b = heavy, .at_a = {0.37, 0.43}, .at_b = {-0.036, -0.28}});
  model.add(Gravity{});
  for (const LinearSolver solver : {LinearSolver::klu, LinearSolver::blocks}) {
    const Answer answer = solve_by(model, model.start_state(), solver);
    INFO(name_of(solver));
    CHECK(answer.a.cwiseAbs().maxCoeff() < 1e-14 * 9.81);
  }
}

// Newton's iteration is the same, its linear equations are not. What it ends with is judged by itself: forces at these
// multipliers must give them again.
TEST_CASE("friction from reactions is as exact by blocks as by KLU, and takes as many rounds") {
  const std::vector<Kind> kinds = {{1, 0, 0.0, false, true},
                                   {6, 0, 1.0, false, true},
                                   {8, 2, 1.0, false, true},
                                   {10, 0, 6.0, false, true},
                                   {10, 0, 2.0, true, true}};
  int judged = 0, by_blocks = 0;
  for (const Kind& kind : kinds)
    for (unsigned seed = 1; seed <= 16; ++seed) {
      const Model model = random_mechanism(kind, seed);
      const State state = model.start_state();
      if (reference_of(model, state).independence < 1e-9) continue;
      INFO(kind.bodies, " bodies, ", kind.loops, " loops, ", kind.decades, " decades, seed ", seed);
      const auto error = [&](const Answer& answer) {
        return error_of(answer, reference_of(model, state, &answer.lambda).x);
      };
      const Answer judge = solve_by(model, state, LinearSolver::klu);
      const Answer answer = solve_by(model, state, LinearSolver::blocks);
      const double klu = error(judge), blocks = error(answer);
      INFO("blocks ", blocks, ", KLU ", klu);
      CHECK(blocks < std::max(1e-12, 10.0 * klu));
      ++judged;
      if (answer.counters.fresh > 0) continue;  // KLU was asked where blocks were not good enough
      ++by_blocks;
      CHECK(answer.counters.refactorisations ==
            judge.counters.refactorisations + judge.counters.fresh);
    }
  CHECK(judged > 40);
  CHECK(by_blocks > 0.9 * judged);
}

TEST_CASE("automatic takes blocks where they cost less, and the saddle matrix where only it can") {
  const auto chosen = [](const Model& model) { return Dynamics(model).saddle().in_use(); };
  const auto star = [](int links, double mass) {
    Model model;
    const BodyId hub = model.add(Body{.name = "hub", .mass = 5.0, .inertia = 1.0});
    model.add(Revolute{.name = "pivot", .a = ground, .b = hub, .at = {0.1, 0.0}});
    for (int i = 0; i < links; ++i) {
      const Vec2 at = rotate(0.1 * i, {1.0, 0.0});
      const BodyId link = model.add(Body{.name = fmt::format("link {}", i),
                                         .mass = mass,
                                         .inertia = 0.1 * mass,
                                         .pose = {1.5 * at, 0.0}});
      model.add(Revolute{.name = fmt::format("joint {}", i), .a = hub, .b = link, .at = at});
    }
    return model;
  };
  CHECK(chosen(star(3, 1.0)) == LinearSolver::blocks);
  CHECK(chosen(star(60, 1.0)) == LinearSolver::klu);
  CHECK(chosen(star(3, 0.0)) == LinearSolver::klu);
  CHECK(Dynamics(star(60, 1.0), LinearSolver::blocks).saddle().in_use() == LinearSolver::blocks);
}

TEST_CASE("elimination steps back where equations are nearly dependent") {
  // A bar on two pins at almost the same place: the smallest pivot falls with the square of their distance.
  for (const double distance : {1e-2, 1e-4, 1e-6}) {
    INFO(distance);
    Model model;
    const BodyId bar = model.add(Body{.name = "bar", .mass = 1.0, .inertia = 0.1});
    const BodyId other = model.add(Body{.name = "other", .mass = 2.0, .inertia = 0.3});
    model.add(Revolute{.name = "near", .a = bar, .b = other, .at = {0.0, 1.0}});
    model.add(Revolute{.name = "nearer", .a = bar, .b = other, .at = {distance, 1.0}});
    model.add(Gravity{});
    Dynamics blocks(model), judge(model, LinearSolver::klu);
    State state = model.start_state(), expected = state;
    blocks.leave_out({2});  // one of the two, or they would be dependent
    judge.leave_out({2});
    REQUIRE(judge.calc_accelerations(expected));
    REQUIRE(blocks.calc_accelerations(state));
    // At a distance of 1e-6 KLU has done the work, and chosen pivots for it.
    CHECK((blocks.counters().fresh > 0) == (distance < 1e-5));
    CHECK((state.a - expected.a).cwiseAbs().maxCoeff() < 1e-10);
  }
}
