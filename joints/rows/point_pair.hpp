// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Two points, one of each body, kept together: the two rows shared by revolute and weld.
//
//   d_i  = A(theta_i) s_i                 arm of the point in global axes, s_i in body axes
//   p_i  = r_i + d_i
//   Phi  = p_b - p_a                      [m]
//   G    = [ -1 0  d_a.y    1 0 -d_b.y ]  columns (x, y, theta) of a, then of b
//          [ 0 -1 -d_a.x    0 1  d_b.x ]
//   gamma = w_b^2 d_b - w_a^2 d_a
//   H    : column theta_a is w_a d_a, column theta_b is -w_b d_b
//   K    : theta_a theta_a  d_a . lambda,   theta_b theta_b  -d_b . lambda
//
// lambda [N]: the joint pushes b with -lambda and a with +lambda, at the point.
#pragma once

#include <yoke/core/constraint.hpp>
#include <yoke/core/equations/curvature_pattern.hpp>

namespace yoke {

/// The rows of the pair, for two bodies in columns 0 to 5 and row-major blocks 6 wide.
class PointPair {
 public:
  PointPair(const BodyMotion& a, const Vec2& s_a, const BodyMotion& b, const Vec2& s_b)
      : a_(a), b_(b), da_(a.to_global(s_a)), db_(b.to_global(s_b)) {}

  void write_phi(double* phi) const {
    phi[0] = (b_.x + db_.x()) - (a_.x + da_.x());
    phi[1] = (b_.y + db_.y()) - (a_.y + da_.y());
  }
  void write_G(double* G) const {
    G[0] = -1.0, G[2] = da_.y(), G[3] = 1.0, G[5] = -db_.y();
    G[7] = -1.0, G[8] = -da_.x(), G[10] = 1.0, G[11] = db_.x();
  }
  void write_gamma(double* gamma) const {
    const double wa2 = a_.omega * a_.omega, wb2 = b_.omega * b_.omega;
    gamma[0] = wb2 * db_.x() - wa2 * da_.x();
    gamma[1] = wb2 * db_.y() - wa2 * da_.y();
  }
  void write_H(double* H) const {
    H[0] = 0.0, H[2] = a_.omega * da_.x(), H[3] = 0.0, H[5] = -b_.omega * db_.x();
    H[7] = 0.0, H[8] = a_.omega * da_.y(), H[10] = 0.0, H[11] = -b_.omega * db_.y();
  }
  void write_K(const double* lambda, double* K) const {
    K[2 * 6 + 2] = da_.x() * lambda[0] + da_.y() * lambda[1];
    K[5 * 6 + 5] = -(db_.x() * lambda[0] + db_.y() * lambda[1]);
  }

  /// The pattern of the two rows. A point at the centre of a body has no arm.
  static std::vector<bool> pattern(const Vec2& s_a, const Vec2& s_b) {
    const bool a = !s_a.isZero(0.0), b = !s_b.isZero(0.0);
    return {true, false, a, true, false, b, false, true, a, false, true, b};
  }

  /// Only the turn of a body moves its arm otherwise than in a straight line.
  static bool is_curved(int j, int l) { return j == l && j % 3 == 2; }

 private:
  const BodyMotion& a_;
  const BodyMotion& b_;
  Vec2 da_, db_;
};

}  // namespace yoke
