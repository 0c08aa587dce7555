// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The checks find what they are there to find: elements with one thing wrong each.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <yoke/core/authoring/check.hpp>
#include <yoke/core/equations/curvature_pattern.hpp>
#include <yoke/core/model.hpp>
#include <yoke/tests/messages.hpp>

using namespace yoke;
using namespace yoke::tests;

namespace {

struct OneBody {
  Model model;
  BodyId body = model.add({.name = "body", .mass = 1.3, .inertia = 0.4, .pose = {{0.3, 0.7}, 0.2}});
};

enum class Fault { none, G, phi_t, gamma, H, K, pattern, curvature, rheonomic, alone, zeros, nan };

// Phi = x y + sin(theta) - t^2 on one body, right but for one fault.
class Faulty final : public Constraint, public CurvaturePattern {
 public:
  Faulty(BodyId body, Fault fault)
      : Constraint("faulty", {body}, {{"row", Measure::length}},
                   {true, true, fault != Fault::pattern}),
        body_(body),
        fault_(fault) {}

  void evaluate(const Motion& motion, const ConstraintRequest& out) const override {
    if (fault_ == Fault::zeros) return;
    const BodyMotion& b = motion[body_];
    const double w = b.omega;
    if (out.phi != nullptr) out.phi[0] = b.x * b.y + b.s - motion.t * motion.t;
    if (out.G != nullptr) {
      out.G[0] = b.y, out.G[1] = b.x, out.G[2] = b.c * wrong(Fault::G);
      if (fault_ == Fault::nan) out.G[1] = std::nan("");
      if (fault_ == Fault::alone && out.phi == nullptr) out.G[0] += 1e-6;
    }
    if (out.phi_t != nullptr) out.phi_t[0] = -2.0 * motion.t * wrong(Fault::phi_t);
    if (out.gamma != nullptr)
      out.gamma[0] = (-2.0 * b.vx * b.vy + w * w * b.s + 2.0) * wrong(Fault::gamma);
    if (out.H != nullptr) out.H[0] = b.vy, out.H[1] = b.vx * wrong(Fault::H), out.H[2] = -w * b.s;
    if (out.K != nullptr) {
      out.K[1] = out.K[3] = out.lambda[0];
      out.K[8] = -out.lambda[0] * b.s * wrong(Fault::K);
    }
  }
  bool rheonomic() const override { return fault_ != Fault::rheonomic; }
  bool is_curved(int j, int l) const override {
    return (j == 2 && l == 2) || (j + l == 1 && fault_ != Fault::curvature);
  }

 private:
  double wrong(Fault f) const { return f == fault_ ? 1.0 + 1e-5 : 1.0; }

  BodyId body_;
  Fault fault_;
};

ElementCheck check_constraint(Fault fault) {
  const OneBody m;
  return check_element(Faulty(m.body, fault), m.model);
}

enum class Slip { none, Q, dq, dv, dz, z_dot, potential, dissipated, quiet, dependence, zeros };

// A spring -k (x - z) with z' = -z + x and a damper -c v on the x of one body. What the spring
// gives to z is dissipated.
class Slipping final : public ForceElement {
 public:
  Slipping(BodyId body, Slip slip, std::string name = "slipping")
      : ForceElement(std::move(name), {body}, {.velocity = slip != Slip::dependence}),
        body_(body),
        slip_(slip) {}

  void evaluate(const ForceInput& in, const ForceRequest& out) const override {
    if (slip_ == Slip::zeros) return;
    const double k = in.parameters[0], c = 3.0;
    const double d = in.motion[body_].x - in.z[0], v = in.motion[body_].vx;
    if (out.Q != nullptr) out.Q[0] = (-k * d - c * v) * wrong(Slip::Q);
    if (out.dQ_dq != nullptr) out.dQ_dq[0] = -k * wrong(Slip::dq);
    if (out.dQ_dv != nullptr) out.dQ_dv[0] = -c * wrong(Slip::dv);
    if (out.dQ_dz != nullptr) out.dQ_dz[0] = k * wrong(Slip::dz);
    if (out.z_dot != nullptr) out.z_dot[0] = d * wrong(Slip::z_dot);
    if (out.dz_dq != nullptr) out.dz_dq[0] = 1.0;
    if (out.dz_dz != nullptr) out.dz_dz[0] = -1.0;
    if (out.energy != nullptr) {
      out.energy->potential = 0.5 * k * d * d * wrong(Slip::potential);
      out.energy->dissipated_power = (k * d * d + c * v * v) * wrong(Slip::dissipated);
    }
  }
  bool dissipates() const override { return slip_ != Slip::quiet; }
  std::vector<Channel> states() const override { return {{"creep", "m"}}; }
  std::vector<Parameter> parameters() const override { return {{"stiffness", "N/m", 20.0}}; }

 private:
  double wrong(Slip s) const { return s == slip_ ? 1.0 + 1e-5 : 1.0; }

  BodyId body_;
  Slip slip_;
};

ElementCheck check_force(Slip slip) {
  const OneBody m;
  return check_element(Slipping(m.body, slip), m.model);
}

}  // namespace

TEST_CASE("a right constraint passes, far below the tolerance") {
  const ElementCheck c = check_constraint(Fault::none);
  INFO(c.message());
  CHECK(c.ok(1e-9));
  CHECK(c.entries == 5 * (3 + 3 + 9 + 1 + 1));
}

TEST_CASE("a constraint wrong by one part in 10^5 in one block is found, by the block's name") {
  const std::pair<Fault, std::string> faults[] = {
      {Fault::phi_t, "phi_t"}, {Fault::gamma, "gamma"}, {Fault::H, "H"}, {Fault::K, "K"}};
  for (const auto& [fault, block] : faults) {
    const ElementCheck c = check_constraint(fault);
    INFO(c.message());
    CHECK(!c.ok());
    CHECK(c.block == block);
    CHECK(c.worst_error < 2e-5);
  }
  // A wrong G is wrong against Phi, and what was derived from the right one is wrong against it.
  CHECK(!check_constraint(Fault::G).ok());
}

TEST_CASE("a constraint that breaks its word is found") {
  CHECK(contains(check_constraint(Fault::pattern).problem, "outside the declared pattern"));
  CHECK(
      contains(check_constraint(Fault::curvature).problem, "columns 0 and 1 are said to be zero"));
  CHECK(contains(check_constraint(Fault::rheonomic).problem, "rheonomic()"));
  CHECK(contains(check_constraint(Fault::alone).problem, "G asked for alone"));
  CHECK(check_constraint(Fault::nan).problem == "G holds a number that is not finite");
  CHECK(check_constraint(Fault::zeros).problem ==
        "only zeros were seen: nothing has been checked at these states");
}

TEST_CASE("a right force passes, with its state, its parameter and its energies") {
  const ElementCheck c = check_force(Slip::none);
  INFO(c.message());
  CHECK(c.ok(1e-9));
}

TEST_CASE("a force wrong by one part in 10^5 in one block is found, by the block's name") {
  const std::pair<Slip, std::string> slips[] = {
      {Slip::dq, "dQ_dq"},        {Slip::dv, "dQ_dv"},         {Slip::dz, "dQ_dz"},
      {Slip::potential, "power"}, {Slip::dissipated, "power"},
  };
  for (const auto& [slip, block] : slips) {
    const ElementCheck c = check_force(slip);
    INFO(c.message());
    CHECK(!c.ok());
    CHECK(c.block == block);
  }
  CHECK(!check_force(Slip::Q).ok());
  CHECK(!check_force(Slip::z_dot).ok());
}

TEST_CASE("a force that breaks its word is found") {
  CHECK(check_force(Slip::quiet).problem ==
        "dissipated_power is not zero but dissipates() is false");
  CHECK(check_force(Slip::dependence).problem ==
        "dQ_dv is not zero but dependence().velocity is false");
  CHECK(check_force(Slip::zeros).problem ==
        "only zeros were seen: nothing has been checked at these states");
}

TEST_CASE("states and parameters are read where the element has them in the state") {
  OneBody m;
  m.model.insert(std::make_unique<Slipping>(m.body, Slip::none, "first"));
  m.model.insert(std::make_unique<Slipping>(m.body, Slip::none, "second"));
  State state = ugly_state(m.model, 4);
  // With z of the second element at the place of the body its spring is slack; with no stiffness
  // either, half of the blocks are zero, yet the damper is seen.
  state.z[1] = state.q[0];
  state.parameters[1] = 0.0;
  CHECK(check_element(*m.model.forces()[1], m.model, state).ok());
  state.parameters[1] = std::nan("");
  CHECK(!check_element(*m.model.forces()[1], m.model, state).ok());
  CHECK(check_element(*m.model.forces()[0], m.model, state).ok());
}

TEST_CASE("ugly states have no zeroes, are different and can be had again") {
  const OneBody m;
  const State a = ugly_state(m.model, 1), b = ugly_state(m.model, 2);
  CHECK(a.q.cwiseAbs().minCoeff() > 0.0);
  CHECK(a.v.cwiseAbs().minCoeff() > 0.5);
  CHECK((a.q - b.q).norm() > 0.01);
  CHECK(a.q == ugly_state(m.model, 1).q);
}
