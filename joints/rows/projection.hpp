// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The coordinate of a point of body P along a direction fixed in body L: one row, shared by
// prismatic joint, point on line and driver of a displacement.
//
//   n = A(theta_L) n_L,  m = perp(n)      unit direction in global axes, and across
//   d = A(theta_P) s_P                    arm of the point in global axes
//   e = r_P + d - r_L                     from the centre of L to the point
//   c = n . e                             [m]
//   dc/dq : L  (-n, m . e)       P  (n, n . perp(d))
//   second derivatives, apart from zeros:
//     theta_L theta_L -n . e     theta_L r_P m      theta_L r_L -m
//     theta_L theta_P  n . d     theta_P theta_P -n . d
//   gamma = w_L^2 n . e - 2 w_L m . e' + w_P^2 n . d,   e' = v_P + w_P perp(d) - v_L
#pragma once

#include <yoke/core/constraint.hpp>

namespace yoke {

/// The row for body L in columns l to l + 2 and P in columns p to p + 2 of blocks 6 wide.
class Projection {
 public:
  Projection(const BodyMotion& line, const Vec2& n_l, const BodyMotion& point, const Vec2& s_p)
      : line_(line),
        point_(point),
        n_(line.to_global(n_l)),
        m_(perp(n_)),
        d_(point.to_global(s_p)),
        e_(point.x + d_.x() - line.x, point.y + d_.y() - line.y) {}

  double coordinate() const { return n_.dot(e_); }

  void write_G(double* row, int l, int p) const {
    row[l] = -n_.x(), row[l + 1] = -n_.y(), row[l + 2] = m_.dot(e_);
    row[p] = n_.x(), row[p + 1] = n_.y(), row[p + 2] = cross(d_, n_);
  }
  double gamma() const {
    const double wl = line_.omega, wp = point_.omega;
    return wl * wl * n_.dot(e_) - 2.0 * wl * m_.dot(e_rate()) + wp * wp * n_.dot(d_);
  }
  void write_H(double* row, int l, int p) const {
    const double wl = line_.omega, wp = point_.omega;
    row[l] = -wl * m_.x(), row[l + 1] = -wl * m_.y();
    row[l + 2] = m_.dot(e_rate()) - wl * n_.dot(e_);
    row[p] = wl * m_.x(), row[p + 1] = wl * m_.y(), row[p + 2] = (wl - wp) * n_.dot(d_);
  }
  void write_K(double lambda, double* K, int l, int p) const {
    const Vec2 f = lambda * m_;
    const double nd = lambda * n_.dot(d_);
    const int tl = l + 2, tp = p + 2;
    K[tl * 6 + l] = K[l * 6 + tl] = -f.x();
    K[tl * 6 + l + 1] = K[(l + 1) * 6 + tl] = -f.y();
    K[tl * 6 + p] = K[p * 6 + tl] = f.x();
    K[tl * 6 + p + 1] = K[(p + 1) * 6 + tl] = f.y();
    K[tl * 6 + tl] = -lambda * n_.dot(e_);
    K[tl * 6 + tp] = K[tp * 6 + tl] = nd;
    K[tp * 6 + tp] = -nd;
  }

  /// The pattern of the row. A direction along an axis of a line that cannot turn stays so; a point
  /// at the centre of its body has no arm.
  static std::vector<bool> pattern(BodyId line, const Vec2& n_l, const Vec2& s_p, int l, int p) {
    std::vector<bool> row(6, true);
    if (line == ground)
      for (int i = 0; i < 2; ++i) {
        const bool present = n_l[i] != 0.0;
        row[static_cast<std::size_t>(l + i)] = row[static_cast<std::size_t>(p + i)] = present;
      }
    row[static_cast<std::size_t>(p + 2)] = !s_p.isZero(0.0);
    return row;
  }

 private:
  Vec2 e_rate() const {
    return {point_.vx - point_.omega * d_.y() - line_.vx,
            point_.vy + point_.omega * d_.x() - line_.vy};
  }

  const BodyMotion& line_;
  const BodyMotion& point_;
  Vec2 n_, m_, d_, e_;
};

}  // namespace yoke
