// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The derivative of the equations of rest, directly against differences of them.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include <yoke/contact/laws/elastic/power_law.hpp>
#include <yoke/integrators/analyses/details/rest_equations.hpp>
#include <yoke/joints/distance.hpp>
#include <yoke/joints/forces/applied_force.hpp>
#include <yoke/joints/forces/torsional_spring.hpp>
#include <yoke/joints/forces/translational_spring.hpp>
#include <yoke/tests/integrators/analyses/analysed.hpp>
#include <yoke/tests/integrators/relaxing_spring.hpp>
#include <yoke/tests/integrators/wall.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;
using Vector = Statics::Vector;

/// Closed loop, sprung rod, a body that presses against a floor, a state z, a redundant joint.
Model everything() {
  Model m = four_bar(0.3, 1.0, 0.5, 0.9, 1.1, 0.0);
  m.add(TorsionalSpring{.name = "torsion",
                        .a = m.find_body("coupler"),
                        .b = m.find_body("rocker"),
                        .stiffness = 30.0,
                        .free_angle = 0.4});
  const auto ball =
      m.add(Body{.name = "ball", .mass = 0.4, .inertia = 1e-4, .pose = {{0.2, -1e-4}, 0.1}});
  m.add(Wall{.name = "floor", .body = ball, .law = {PowerLaw{2e7, 1.5}}});
  m.add(TranslationalSpring{.name = "tie",
                            .a = m.find_body("coupler"),
                            .b = ball,
                            .at_a = {0.4, 0.3},
                            .at_b = {0.21, 0.0},
                            .stiffness = 250.0,
                            .free_length = 0.2});
  m.add(Distance{.name = "rod", .a = ground, .b = ball, .at_a = {-0.7, 0.5}, .at_b = {0.2, 0.01}});
  m.add(RelaxingSpring{.name = "maxwell", .body = ball});
  m.add(AppliedForce{
      .name = "load", .body = m.find_body("rocker"), .at = {0.8, 0.3}, .force = [](double) {
        return Vec2(5.0, -7.0);
      }});
  m.add(Gravity{});
  return m;
}

}  // namespace

TEST_CASE("the derivative of the equations of rest is that of their differences") {
  const Model m = everything();
  for (const double load : {1.0, 0.3}) {
    INFO("load ", load);
    Statics statics(m, m.start_state(), {});
    statics.set_load(load);
    Vector x = statics.unknowns();
    // Away from the start, where multipliers, z and turns are at work.
    for (Eigen::Index i = 0; i < x.size(); ++i)
      x[i] += 1e-5 * std::cos(1.0 + 2.4 * static_cast<double>(i));
    x.tail(6).array() += 0.7;
    Vector F;
    REQUIRE(statics.residual(x, F));
    REQUIRE(statics.factorise(x));
    int nonzero = 0;
    for (Eigen::Index j = 0; j < x.size(); ++j) {
      Vector column, plus, minus;
      statics.multiply(Vector::Unit(x.size(), j), column);
      const double h = 1e-6;
      REQUIRE(statics.residual(x + h * Vector::Unit(x.size(), j), plus));
      REQUIRE(statics.residual(x - h * Vector::Unit(x.size(), j), minus));
      const Vector difference = (plus - minus) / (2.0 * h);
      const double size = std::max(1.0, column.cwiseAbs().maxCoeff());
      INFO("unknown ", j, ": ", (difference - column).cwiseAbs().maxCoeff(), " of ", size);
      CHECK((difference - column).cwiseAbs().maxCoeff() < 1e-6 * size);
      nonzero += column.cwiseAbs().maxCoeff() > 1e-3 ? 1 : 0;
    }
    CHECK(nonzero == x.size());
    // And the solve undoes the product.
    Vector b, start = Vector::LinSpaced(x.size(), -1.0, 2.0);
    statics.multiply(start, b);
    REQUIRE(statics.solve(b));
    CHECK((b - start).cwiseAbs().maxCoeff() < 1e-6);
  }
}
