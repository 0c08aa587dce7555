// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A user's force element that owns a state z and a changeable parameter, written outside the
// library: a Maxwell spring-damper between the ground and a body along x,
//   F = k z,  z' = -v_x - (k/c) z      z [m] extension of the spring, F [N] on the body along x
#pragma once

#include <yoke/core/model.hpp>

namespace yoke::tests {

class RelaxingSpringElement final : public ForceElement {
 public:
  RelaxingSpringElement(std::string name, BodyId body, double k, double c)
      : ForceElement(std::move(name), {body}, {.position = false, .velocity = false}),
        k_(k),
        c_(c) {}

  void evaluate(const ForceInput& in, const ForceRequest& out) const override {
    const double k = in.parameters[0], z = in.z[0], vx = in.motion[own_bodies()[0]].vx;
    if (out.Q != nullptr) out.Q[0] = k * z;
    if (out.dQ_dz != nullptr) out.dQ_dz[0] = k;
    if (out.z_dot != nullptr) out.z_dot[0] = -vx - k / c_ * z;
    if (out.dz_dv != nullptr) out.dz_dv[0] = -1.0;
    if (out.dz_dz != nullptr) out.dz_dz[0] = -k / c_;
    if (out.energy != nullptr) {
      out.energy->potential = 0.5 * k * z * z;
      out.energy->dissipated_power = k * z * k * z / c_;
    }
  }
  bool dissipates() const override { return true; }
  std::vector<Channel> states() const override { return {{"extension", "m"}}; }
  void initial_states(double* z) const override { z[0] = 0.002; }
  std::vector<Parameter> parameters() const override { return {{"stiffness", "N/m", k_}}; }

 private:
  double k_, c_;
};

struct RelaxingSpring {
  std::string name;
  BodyId body;
  double stiffness = 140.0;  // [N/m]
  double damping = 9.0;      // [N s/m]
  std::unique_ptr<ForceElement> build(const Model&) const {
    return std::make_unique<RelaxingSpringElement>(name, body, stiffness, damping);
  }
};

}  // namespace yoke::tests
