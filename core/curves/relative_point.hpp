// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A point of body a in the frame of a shape that body b carries, and the distances D(p) of such a
// shape as functions of the coordinates q = (x, y, angle) of a and of b. With s = P - r_a and w = P
// - r_b the arms of the point P, n = dD/dp in global axes, t = perp(n), and bend t t^T the Hessian
// of D over p:
//   g = dD/dq = [n, n.perp(s), -n, -n.perp(w)]      tau = the same with t for n
//   H = dg/dq = bend tau^T tau, and in addition
//       H[angle_a, angle_a] -= n.s      H[angle_b, angle_b] -= n.w      H[angle_a, angle_b] += n.s
//       H[r_a, angle_b] += perp(n)      H[r_b, angle_b] -= perp(n)
#pragma once

#include <array>

#include <yoke/core/model.hpp>
#include <yoke/core/motion.hpp>

namespace yoke {

class RelativePoint {
 public:
  static constexpr std::size_t columns = 6;              // coordinates of both bodies
  using Row = std::array<double, columns>;               // over q of a, then of b
  using Square = std::array<double, columns * columns>;  // row-major

  /// At one motion.
  struct Place {
    Vec2 s{0.0, 0.0}, w{0.0, 0.0};  // [m] from the centres of a and b to the point, global axes
  };

  /// The point, and where the frame of the shape is: global, in the start pose of the model.
  RelativePoint(const Model& model, BodyId a, const Vec2& at, BodyId b, const Vec2& origin,
                double angle)
      : a_(a),
        b_(b),
        point_(model.to_local(a, at)),
        origin_(model.to_local(b, origin)),
        x_axis_(model.direction_to_local(b, rotate(angle, {1.0, 0.0}))) {}

  /// That carries the point.
  BodyId a() const { return a_; }
  /// That carries the shape.
  BodyId b() const { return b_; }
  const Vec2& point() const { return point_; }  ///< [m] in axes of a
  /// A point of the frame of the shape in axes of b [m].
  Vec2 on_body(const Vec2& p) const { return origin_ + p.x() * x_axis_ + p.y() * perp(x_axis_); }

  /// Where the point is as both bodies see it.
  Place place(const Motion& motion) const {
    const BodyMotion &a = motion[a_], &b = motion[b_];
    const Vec2 s = a.to_global(point_);
    return {s, a.position() - b.position() + s};  // in this order: exact far from the origin
  }

  /// [m] in the frame of the shape.
  Vec2 local(const Motion& motion, const Place& place) const {
    const Vec2 p = motion[b_].to_local(place.w) - origin_;
    return {x_axis_.dot(p), cross(x_axis_, p)};
  }
  Vec2 local(const Motion& motion) const { return local(motion, place(motion)); }

  /// A direction of the frame of the shape in global axes.
  Vec2 to_global(const Motion& motion, const Vec2& direction) const {
    return motion[b_].to_global(direction.x() * x_axis_ + direction.y() * perp(x_axis_));
  }

  /// g for dD/dp = n.
  static Row gradient(const Vec2& n, const Place& at) {
    return {n.x(), n.y(), n.dot(perp(at.s)), -n.x(), -n.y(), -n.dot(perp(at.w))};
  }

  static void calc_hessian(double bend, const Vec2& n, const Place& at, Square& H) {
    const Row tau = gradient(perp(n), at);
    for (std::size_t i = 0; i < columns; ++i)
      for (std::size_t j = 0; j < columns; ++j) H[columns * i + j] = bend * tau[i] * tau[j];
    add_turning(n, at, H);
  }

  /// Of any function of the place whose gradient is `along` t and whose Hessian is
  /// tt t t^T + tn (t n^T + n t^T), t = perp(n).
  static void calc_hessian(double along, double tt, double tn, const Vec2& n, const Place& at,
                           Square& H) {
    const Row nu = gradient(n, at), tau = gradient(perp(n), at);
    for (std::size_t i = 0; i < columns; ++i)
      for (std::size_t j = 0; j < columns; ++j)
        H[columns * i + j] = tt * tau[i] * tau[j] + tn * (tau[i] * nu[j] + nu[i] * tau[j]);
    add_turning(along * perp(n), at, H);
  }

 private:
  /// What the turning of the bodies adds, `slope` being the gradient of the function over the place.
  static void add_turning(const Vec2& slope, const Place& at, Square& H) {
    const auto add = [&H](std::size_t i, std::size_t j, double value) {
      H[columns * i + j] += value;
      if (i != j) H[columns * j + i] += value;
    };
    add(2, 2, -slope.dot(at.s));
    add(5, 5, -slope.dot(at.w));
    add(2, 5, slope.dot(at.s));
    const Vec2 turned = perp(slope);
    for (std::size_t e = 0; e < 2; ++e) {
      const double value = turned[static_cast<Eigen::Index>(e)];
      add(e, 5, value);
      add(3 + e, 5, -value);
    }
  }

  BodyId a_, b_;
  Vec2 point_;   // [m] in a's frame
  Vec2 origin_;  // [m] of the shape's frame, and its x axis, in b's frame
  Vec2 x_axis_;
};

}  // namespace yoke
