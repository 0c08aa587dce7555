// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A force on a point of a body: a function of time, or of time and the motion of the body.
//
//   d = A(theta) s                        arm of the point, p = r + d
//   F = f(t)               frame global   F = A(theta) f(t)      frame body
//   Q = (F, d x F);   supplied power = F . p' [W]
//   global: dQ/dq has -d . F at (theta, theta);   body: perp(F) in the column of theta
//
// Time and motion, differentiated automatically (auto_scalar.hpp explains how to write it):
//   model.add(applied_force("drag", body, at, [](auto t, const auto& b) {
//     return vec(-0.3 * b.vx, -0.3 * b.vy);
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

enum class Frame { global, body };  ///< whose axes the components of a force are given in

struct AppliedForce {
  std::string name;
  BodyId body;
  Vec2 at{0.0, 0.0};                      // [m] the point, global, in the start pose
  std::function<Vec2(double t)> force{};  // f [N]
  Frame frame = Frame::global;            // of the components of `force`
  /// [N] Added to f, and alone if there is none: the changeable parameters "name.fx" and "name.fy".
  std::optional<Vec2> value{};

  std::unique_ptr<ForceElement> build(const Model& model) const;
};

/// The body of a load and the point in its axes; checked. Throws ModelError.
Vec2 load_point(const Model& model, const std::string& name, BodyId body, const Vec2& at);

/// The element behind applied_force().
template <class F>
class StateForce : public AutoForce<StateForce<F>, 1> {
 public:
  /// `s` [m] the point in axes of the body, `frame` of the components.
  StateForce(const std::string& name, BodyId body, const Vec2& s, F force, Frame frame)
      : AutoForce<StateForce<F>, 1>(name, {body}), s_(s), force_(std::move(force)), frame_(frame) {}

  /// Adds the force and its power.
  template <class T>
  void apply(AutoBody<T>& body, AutoElement<T>& e) const {
    const Eigen::Vector2<T> f = force_(e.t, std::as_const(body));
    const Eigen::Vector2<T> F_global = frame_ == Frame::global ? f : body.to_global(f);
    body.add_force(F_global, body.point(s_));
    e.supplied_power += F_global.dot(body.point_velocity(s_));
  }
  bool supplies() const override { return true; }

 private:
  Vec2 s_;
  F force_;
  Frame frame_;
};

/// The description applied_force() makes.
template <class F>
struct StateForceDescription {
  std::string name;
  BodyId body;
  Vec2 at;      // [m] global, in the start pose
  F force;      // f(t, body) [N]
  Frame frame;  // of its components

  std::unique_ptr<ForceElement> build(const Model& model) const {
    return std::make_unique<StateForce<F>>(name, body, load_point(model, name, body, at), force,
                                           frame);
  }
};

/// A force f(t, body) [N] at a point of a body, see above. `body` is an AutoBody: x, y, angle, vx,
/// vy, omega, point(...).
template <class F>
StateForceDescription<F> applied_force(std::string name, BodyId body, const Vec2& at, F force,
                                       Frame frame = Frame::global) {
  return {std::move(name), body, at, std::move(force), frame};
}

}  // namespace yoke
