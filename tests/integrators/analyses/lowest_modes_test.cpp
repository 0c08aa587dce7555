// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The lowest modes from sparse matrices: as from dense ones, and of models too large for these.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include <yoke/core/equations/dynamics.hpp>
#include <yoke/integrators/analyses/details/linearisation.hpp>
#include <yoke/integrators/analyses/details/lowest_modes.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/forces/torsional_spring.hpp>
#include <yoke/joints/revolute.hpp>
#include <yoke/tests/messages.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;

/// A hanging rope of 1 m and 1 kg in rigid links with springs and dampers in its pins.
Model rope(int links, double stiffness, double damping) {
  Model m;
  BodyId last = ground;
  const double l = 1.0 / links;
  for (int i = 0; i < links; ++i) {
    const Vec2 a(0.0, -l * i), b(0.0, -l * (i + 1));
    const std::string name = std::to_string(i);
    const BodyId link = m.add(Body{.name = "link " + name,
                                   .mass = l,
                                   .inertia = l * l * l / 12.0,
                                   .pose = {0.5 * (a + b), -0.5 * pi}});
    m.add(Revolute{"pin " + name, last, link, a});
    m.add(TorsionalSpring{.name = "coil " + name,
                          .a = last,
                          .b = link,
                          .stiffness = stiffness * links,
                          .damping = damping * links});
    last = link;
  }
  m.add(Gravity{});
  return m;
}

}  // namespace

TEST_CASE("the lowest modes from the sparse matrices are those from the dense ones") {
  for (const double damping : {0.0, 1e-3}) {
    INFO("damping " << damping);
    const Model m = rope(12, 0.01, damping);
    const State state = assembled_state(m);
    const Modes all = modes(m, state);
    Dynamics dynamics(m);
    State at_rest = state;
    REQUIRE(dynamics.assemble(at_rest));
    const Linearisation l = linearise_sparse(dynamics, at_rest);
    CHECK(l.degrees_of_freedom() == 12);
    const LowestModes few = damping > 0.0 ? lowest_general(l, 8) : lowest_undamped(l, 4);
    for (std::size_t i = 0; i < few.values.size(); ++i) {
      double nearest = 1e300;
      for (const Mode& mode : all.modes)
        for (const std::complex<double> s : {mode.eigenvalue, std::conj(mode.eigenvalue)})
          nearest = std::min(nearest, std::abs(s - few.values[i]) / std::abs(s));
      CHECK(nearest < 1e-9);
    }
  }
}

TEST_CASE("ten modes of a rope of 10 000 coordinates: those of a heavy string, Bessel's zeros") {
  // Without bending stiffness: J_0(2 omega sqrt(l / g)) = 0.
  const Model m = rope(3334, 0.0, 0.0);
  const Modes found = modes(m, assembled_state(m));
  REQUIRE(found.modes.size() == 10);
  CHECK(found.linearisation.degrees_of_freedom() == 3334);
  CHECK(found.stable);
  const double zeros[] = {2.404825557695773, 5.520078110286311, 8.653727912911013};
  for (std::size_t i = 0; i < 3; ++i)
    CHECK(2.0 * pi * found.modes[i].frequency ==
          doctest::Approx(0.5 * zeros[i] * std::sqrt(9.81)).epsilon(1e-5));
}

TEST_CASE(
    "a large damped rope gives its slow swings and says where its modes cannot be told apart") {
  // Bending motions creep at about -stiffness/damping = -10 1/s, hundreds of them within 1e-3.
  const Model m = rope(1500, 0.01, 1e-3);
  const Modes found = modes(m, assembled_state(m), {.lowest = 10});
  REQUIRE(found.modes.size() >= 2);
  CHECK(found.modes.size() < 10);
  CHECK(contains(found.linearisation.warning, "lie too close together to be told apart"));
  const Modes few = modes(rope(40, 0.01, 1e-3), assembled_state(rope(40, 0.01, 1e-3)));
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(found.modes[i].frequency == doctest::Approx(few.modes[i].frequency).epsilon(0.02));
    CHECK(found.modes[i].damping_ratio ==
          doctest::Approx(few.modes[i].damping_ratio).epsilon(0.05));
  }
}

TEST_CASE("how many modes is checked, and a large model in motion is refused") {
  const Model m = rope(4, 0.01, 0.0);
  CHECK(modes(m, assembled_state(m), {.lowest = 2}).modes.size() == 2);
  CHECK(contains(message_of([&] { modes(m, assembled_state(m), {.lowest = -1}); }),
                 "lowest = -1 must be at least 0"));
  const Model large = rope(600, 0.01, 0.0);
  State moving = assembled_state(large);
  moving.v[2] = 1.0;
  CHECK(contains(message_of([&] { modes(large, moving); }), "too many for the modes of a motion"));
}
