// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/core/curves/pieces/exact_pieces.hpp>

#include <cmath>

namespace yoke {

std::shared_ptr<const CurvePiece> LinePiece::moved(double angle, const Vec2& shift) const {
  return std::make_shared<LinePiece>(rotate(angle, start_) + shift, rotate(angle, tangent_),
                                     length_);
}

ArcPiece::ArcPiece(const Vec2& center, double radius, double start, double sweep, bool closed)
    : center_(center),
      radius_(radius),
      start_(start),
      sweep_(sweep),
      turn_(sweep > 0.0 ? 1.0 : -1.0),
      middle_(rotate(start + 0.5 * sweep, Vec2(1.0, 0.0))),
      closed_(closed) {}

CurvePoint ArcPiece::at(double u) const {
  const Vec2 out = rotate(start_ + turn_ * u / radius_, Vec2(1.0, 0.0));
  return {center_ + radius_ * out, turn_ * perp(out), turn_ / radius_, 1.0};
}

/// From the middle of the arc, so that the jump of the angle lies opposite to it.
double ArcPiece::foot(const Vec2& p) const {
  const Vec2 from = p - center_;
  const double angle = std::atan2(cross(middle_, from), middle_.dot(from));
  return radius_ * (0.5 * std::abs(sweep_) + turn_ * angle);
}

std::shared_ptr<const CurvePiece> ArcPiece::moved(double angle, const Vec2& shift) const {
  return std::make_shared<ArcPiece>(rotate(angle, center_) + shift, radius_, start_ + angle, sweep_,
                                    closed_);
}

}  // namespace yoke
