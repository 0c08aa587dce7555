// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// T + V + stored + dissipated = initial + work, every term computed by itself.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include <yoke/joints/forces/applied_force.hpp>
#include <yoke/joints/forces/applied_torque.hpp>
#include <yoke/joints/forces/torsional_spring.hpp>
#include <yoke/joints/forces/translational_spring.hpp>
#include <yoke/tests/integrators/mechanisms.hpp>
#include <yoke/tests/integrators/relaxing_spring.hpp>
#include <yoke/tests/integrators/wall.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;

/// Hunt and Crossley that does not tell the truth about what it dissipates.
struct Misreporting {
  double alpha = 0.0, factor = 1.0;
  ContactOutput operator()(const ContactInput& in, const ElasticLaw& elastic) const {
    ContactOutput out = HuntCrossley{alpha}(in, elastic);
    out.dissipated_power *= factor;
    return out;
  }
};

double last(const Result& run, const std::string& column) {
  return run[column](static_cast<Eigen::Index>(run.samples.rows()) - 1);
}

}  // namespace

TEST_CASE("the scotch-yoke's ledger closes to 1e-7 at 1e-11 and better the tighter the tolerance") {
  const Model model = scotch_yoke();
  for (const std::string& formulation : both_formulations) {
    double previous = 1.0;
    for (const double rtol : {1e-5, 1e-8, 1e-11}) {
      INFO(formulation, " ", rtol);
      const Result run = simulate(model, {.until = 2.0 * yoke_period,
                                          .relative_tolerance = rtol,
                                          .formulation = formulation,
                                          .samples = 201});
      REQUIRE(run.summary.ok());
      CHECK(last(run, "slot.dissipated_J") > 0.05);
      const double error = run.summary.energy_balance / run.summary.energy_exchanged;
      CHECK(error < 0.2 * previous);
      if (rtol == 1e-11) CHECK(error < 1e-7);
      previous = error;
      // The balance in the table is the sum of its terms.
      const double sum = last(run, "kinetic_J") + last(run, "potential_J") + last(run, "stored_J") +
                         last(run, "dissipated_J") - last(run, "work_J") - run["kinetic_J"](0) -
                         run["stored_J"](0);
      CHECK(std::abs(sum - last(run, "balance_J")) < 1e-12);
      CHECK(last(run, "work_J") == last(run, "motor.work_J"));
      CHECK(last(run, "dissipated_J") == last(run, "slot.dissipated_J"));
    }
  }
}

TEST_CASE("a law that reports 1 % too much dissipation breaks the ledger by just that") {
  for (const std::string& formulation : every_formulation) {
    INFO(formulation);
    const SimulationOptions options{
        .until = yoke_period, .relative_tolerance = 1e-11, .formulation = formulation};
    const Result honest = simulate(scotch_yoke({}, Misreporting{0.32, 1.0}), options);
    const Result lying = simulate(scotch_yoke({}, Misreporting{0.32, 1.01}), options);
    REQUIRE(honest.summary.ok());
    REQUIRE(lying.summary.ok());
    const double excess = 0.01 * last(honest, "slot.dissipated_J");
    CHECK(excess > 1e-4);
    CHECK(std::abs(last(lying, "balance_J") - excess) < 1e-3 * excess);
    CHECK(std::abs(last(honest, "balance_J")) < 1e-3 * excess);
    CHECK(lying.summary.energy_balance >= 0.999 * excess);
  }
}

TEST_CASE("springs, dampers, loads, gravity and an element's own state share one ledger") {
  for (const std::string& formulation : both_formulations) {
    double previous = 1.0;
    for (const double rtol : {1e-6, 1e-9, 1e-12}) {
      INFO(formulation, " ", rtol);
      Model m = double_pendulum();
      const BodyId a = m.find_body("a"), b = m.find_body("b");
      m.add(TorsionalSpring{.name = "hinge", .a = a, .b = b, .stiffness = 3.0, .damping = 0.4});
      m.add(TranslationalSpring{.name = "cable",
                                .a = ground,
                                .b = b,
                                .at_a = {1.1, 1.4},
                                .at_b = {2.0, 0.0},
                                .stiffness = 21.0,
                                .damping = 1.3});
      m.add(RelaxingSpring{.name = "maxwell", .body = b});
      m.add(AppliedTorque{
          .name = "push", .body = a, .torque = [](double t) { return 4.0 * std::sin(9.0 * t); }});
      const Result run =
          simulate(m, {.until = 1.0, .relative_tolerance = rtol, .formulation = formulation});
      REQUIRE(run.summary.ok());
      for (const char* column :
           {"hinge.dissipated_J", "cable.dissipated_J", "maxwell.dissipated_J"})
        CHECK(last(run, column) > 1e-3);
      CHECK(std::abs(last(run, "push.work_J")) > 1e-3);
      const double error = run.summary.energy_balance / run.summary.energy_exchanged;
      CHECK(error < 0.1 * previous);
      if (rtol == 1e-12) CHECK(error < 1e-8);
      previous = error;
    }
  }
}

TEST_CASE("work is as exact as the tolerance says where the motion itself is without error") {
  // A wheel at constant speed against a load 3 sin(40 t) N m: W = 10 * 3 (1 - cos 40 t)/40.
  Model m;
  const BodyId wheel =
      m.add(Body{.name = "wheel", .mass = 1.0, .inertia = 0.1, .twist = {{0.0, 0.0}, 10.0}});
  m.add(Revolute{.name = "axle", .a = ground, .b = wheel});
  m.add(AngleDriver{.name = "motor", .body = wheel, .angle = constant_speed(0.0, 10.0)});
  m.add(AppliedTorque{
      .name = "load", .body = wheel, .torque = [](double t) { return 3.0 * std::sin(40.0 * t); }});
  const double exact = 10.0 * 3.0 * (1.0 - std::cos(40.0)) / 40.0;
  for (const std::string& formulation : every_formulation) {
    for (const double rtol : {1e-4, 1e-6, 1e-8}) {
      INFO(formulation, " ", rtol);
      const Result run = simulate(
          m, {.until = 1.0, .relative_tolerance = rtol, .formulation = formulation, .samples = 11});
      REQUIRE(run.summary.ok());
      CHECK(std::abs(last(run, "load.work_J") - exact) < 100.0 * rtol);
      CHECK(std::abs(last(run, "motor.work_J") + exact) < 100.0 * rtol);
      CHECK(run.summary.steps < 5000);
    }
  }
}

TEST_CASE("a contact pulled off while compressed relaxes without breaking the ledger") {
  // Thrown out of a deep, strongly damped contact: it leaves at 1/chi and the surface follows
  // without a force; what it had stored is dissipated while the body flies on evenly.
  Model m;
  const double chi = 1.5;
  const BodyId ball =
      m.add(Body{.name = "ball", .mass = 0.83, .inertia = 1e-3, .pose = {{0.0, -2e-3}, 0.0}});
  m.add(Wall{.name = "floor",
             .body = ball,
             .law = ContactLaw(PowerLaw{2e7, 1.1}, HuntCrossley{chi / 1.5})});
  m.add(AppliedForce{.name = "pull", .body = ball, .force = [](double t) -> Vec2 {
                       return {0.0, 400.0 * std::exp(-t / 1e-3)};
                     }});
  for (const std::string& formulation : both_formulations) {
    for (const double rtol : {1e-6, 1e-9}) {
      INFO(formulation, " ", rtol);
      const Result run =
          simulate(m, {.until = 0.01, .relative_tolerance = rtol, .formulation = formulation});
      REQUIRE(run.summary.ok());
      CHECK(last(run, "stored_J") == 0.0);
      CHECK(run.summary.energy_balance < 1e3 * rtol * run.summary.energy_exchanged);
      CHECK(run.summary.steps < 20000);
    }
  }
}
