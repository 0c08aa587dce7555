// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A torque on a body: a function of time, or of time and the motion of the body.
//
//   Q = (0, 0, T(t)) [N m], positive counter-clockwise;   supplied power = T omega [W]
//
// Time and motion, differentiated automatically (auto_scalar.hpp explains how to write it):
//   model.add(applied_torque("motor", crank, [](auto t, const auto& b) {
//     return 2.0 * (1.0 - b.omega / 75.0);
//   }));
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <yoke/core/authoring/auto_force.hpp>
#include <yoke/core/model.hpp>

namespace yoke {

struct AppliedTorque {
  std::string name;
  BodyId body;
  std::function<double(double t)> torque{};  // T [N m]
  /// [N m] Added to T, and alone if there is none: the changeable parameter "name.torque".
  std::optional<double> value{};

  std::unique_ptr<ForceElement> build(const Model& model) const;
};

/// Checks the body of a torque. Throws ModelError.
void require_torque_body(const Model& model, const std::string& name, BodyId body);

/// The element behind applied_torque().
template <class F>
class StateTorque : public AutoForce<StateTorque<F>, 1> {
 public:
  /// `torque` is T(t, body) [N m].
  StateTorque(const std::string& name, BodyId body, F torque)
      : AutoForce<StateTorque<F>, 1>(name, {body}), torque_(std::move(torque)) {}

  /// Adds the torque and its power.
  template <class T>
  void apply(AutoBody<T>& body, AutoElement<T>& e) const {
    const T torque = torque_(e.t, std::as_const(body));
    body.add_torque(torque);
    e.supplied_power += torque * body.omega;
  }
  bool supplies() const override { return true; }

 private:
  F torque_;
};

/// The description applied_torque() makes.
template <class F>
struct StateTorqueDescription {
  std::string name;
  BodyId body;
  /// T(t, body) [N m]
  F torque;

  std::unique_ptr<ForceElement> build(const Model& model) const {
    require_torque_body(model, name, body);
    return std::make_unique<StateTorque<F>>(name, body, torque);
  }
};

/// A torque T(t, body) [N m], see above. `body` is an AutoBody: x, y, angle, vx, vy, omega.
template <class F>
StateTorqueDescription<F> applied_torque(std::string name, BodyId body, F torque) {
  return {std::move(name), body, std::move(torque)};
}

}  // namespace yoke
