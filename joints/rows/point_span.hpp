// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The vector from a point of a to a point of b, shared by the distance joint and the spring.
//
//   d_i = A(theta_i) s_i                  arms in global axes
//   e   = r_b + d_b - r_a - d_a           [m]
//   J   = de/dq = [ -I, -perp(d_a), I, perp(d_b) ]    2 x 6
//   e'  = J v
//   for a fixed vector f:  d(J^T f)/dq = diag(theta_a: f . d_a, theta_b: -f . d_b)
#pragma once

#include <yoke/core/motion.hpp>

namespace yoke {

class PointSpan {
 public:
  PointSpan(const BodyMotion& a, const Vec2& s_a, const BodyMotion& b, const Vec2& s_b)
      : a_(a),
        b_(b),
        da_(a.to_global(s_a)),
        db_(b.to_global(s_b)),
        e_(b.x + db_.x() - a.x - da_.x(), b.y + db_.y() - a.y - da_.y()) {}

  const Vec2& e() const { return e_; }
  const Vec2& d_a() const { return da_; }
  const Vec2& d_b() const { return db_; }
  Vec2 rate() const {
    return {b_.vx - b_.omega * db_.y() - a_.vx + a_.omega * da_.y(),
            b_.vy + b_.omega * db_.x() - a_.vy - a_.omega * da_.x()};
  }
  /// row = f^T J.
  void write_row(const Vec2& f, double* row) const {
    row[0] = -f.x(), row[1] = -f.y(), row[2] = cross(f, da_);
    row[3] = f.x(), row[4] = f.y(), row[5] = cross(db_, f);
  }
  /// block += scale J^T J, 6 x 6.
  void add_gram(double scale, double* block) const {
    double jx[6], jy[6];
    write_row({1.0, 0.0}, jx);
    write_row({0.0, 1.0}, jy);
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) block[i * 6 + j] += scale * (jx[i] * jx[j] + jy[i] * jy[j]);
  }
  /// block += scale d(J^T f)/dq at fixed f, 6 x 6.
  void add_turning(double scale, const Vec2& f, double* block) const {
    block[2 * 6 + 2] += scale * f.dot(da_);
    block[5 * 6 + 5] -= scale * f.dot(db_);
  }

 private:
  const BodyMotion& a_;
  const BodyMotion& b_;
  Vec2 da_, db_, e_;
};

}  // namespace yoke
