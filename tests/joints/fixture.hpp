// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Two bodies and a third, and one motion of them with numbers that can be followed by hand: angles
// with cosine and sine 0.8, 0.6 and 0.6, 0.8.
#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <yoke/core/authoring/check.hpp>
#include <yoke/core/model.hpp>

namespace yoke::tests {

struct Trio {
  Model model;
  BodyId a = model.add({.name = "a", .mass = 2.5, .inertia = 0.7, .pose = {{1.0, 3.0}, 0.0}});
  BodyId b = model.add({.name = "b", .mass = 1.3, .inertia = 0.4, .pose = {{2.0, 3.0}, 0.0}});
  BodyId c = model.add({.name = "c", .mass = 0.8, .inertia = 0.2, .pose = {{-1.2, 0.7}, 0.9}});
};

/// The motion followed by hand: a and b away from where they started, c at rest.
class HandMotion {
 public:
  explicit HandMotion(const Trio& trio) : inertia_(trio.model.bodies()), bodies_(4) {
    bodies_[1] = {1.2, 2.2, std::atan2(0.6, 0.8), 0.8, 0.6, 0.4, -0.7, 2.0};
    bodies_[2] = {2.2, 2.6, std::atan2(0.8, 0.6), 0.6, 0.8, -0.5, 0.9, -3.0};
    bodies_[3] = {-1.2, 0.7, 0.9, std::cos(0.9), std::sin(0.9), 0.0, 0.0, 0.0};
  }
  Motion at(double t = 0.0) const { return {.t = t, .bodies = bodies_, .inertia = inertia_}; }

 private:
  std::span<const Body> inertia_;
  std::vector<BodyMotion> bodies_;
};

/// All blocks of a constraint.
struct Blocks {
  std::vector<double> phi, G, phi_t, gamma, H, K;
};

inline Blocks evaluate(const Constraint& joint, const Motion& motion,
                       std::vector<double> lambda = {}) {
  const auto rows = static_cast<std::size_t>(joint.rows());
  const auto columns = static_cast<std::size_t>(joint.columns());
  lambda.resize(rows);
  Blocks b;
  b.phi.resize(rows), b.phi_t.resize(rows), b.gamma.resize(rows);
  b.G.resize(rows * columns), b.H.resize(rows * columns), b.K.resize(columns * columns);
  joint.evaluate(motion, {b.phi.data(), b.G.data(), b.phi_t.data(), b.gamma.data(), b.H.data(),
                          b.K.data(), lambda.data()});
  return b;
}

struct Loads {
  std::vector<double> Q;
  Energy energy;
};

inline Loads evaluate(const ForceElement& force, const Model& model, const Motion& motion) {
  Loads loads;
  loads.Q.resize(3 * force.bodies(model).size());
  std::vector<double> parameters;
  for (const Parameter& p : force.parameters()) parameters.push_back(p.value);
  force.evaluate({.motion = motion, .parameters = parameters.data()},
                 {.Q = loads.Q.data(), .energy = &loads.energy});
  return loads;
}

inline bool near(double x, double expected, double tolerance = 1e-12) {
  return std::abs(x - expected) <= tolerance * std::max(1.0, std::abs(expected));
}

inline bool near(const std::vector<double>& x, const std::vector<double>& expected,
                 double tolerance = 1e-12) {
  if (x.size() != expected.size()) return false;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (!near(x[i], expected[i], tolerance)) return false;
  return true;
}

}  // namespace yoke::tests
