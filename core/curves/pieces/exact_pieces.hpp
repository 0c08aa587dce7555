// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Lines and arcs in closed form; u is the length along them.
#pragma once

#include <yoke/core/curves/curve.hpp>

namespace yoke {

class LinePiece final : public CurvePiece {
 public:
  /// `length` [m] may be infinite. `tangent` is a unit vector.
  LinePiece(const Vec2& start, const Vec2& tangent, double length)
      : start_(start), tangent_(tangent), length_(length) {}

  double end() const override { return length_; }
  CurvePoint at(double u) const override { return {start_ + u * tangent_, tangent_, 0.0, 1.0}; }
  double foot(const Vec2& p) const override { return tangent_.dot(p - start_); }
  CurveOffset offset(const Vec2& p) const override {
    return {cross(tangent_, p - start_), perp(tangent_), 0.0};
  }
  std::optional<CurvatureChange> curvature_change(double) const override {
    return CurvatureChange{};
  }
  double length_to(double u) const override { return u; }
  double at_length(double s) const override { return s; }
  std::shared_ptr<const CurvePiece> moved(double angle, const Vec2& shift) const override;

 private:
  Vec2 start_, tangent_;
  double length_;
};

class ArcPiece final : public CurvePiece {
 public:
  /// `radius` [m] > 0; from the angle `start` [rad] over `sweep` [rad], > 0 counter-clockwise; a
  /// full turn is closed.
  ArcPiece(const Vec2& center, double radius, double start, double sweep, bool closed);

  double end() const override { return radius_ * std::abs(sweep_); }
  bool closed() const override { return closed_; }
  CurvePoint at(double u) const override;
  double foot(const Vec2& p) const override;
  CurveOffset offset(const Vec2& p) const override {
    const Vec2 from = p - center_;
    const double rho = from.norm();
    const Vec2 inwards = rho > 0.0 ? Vec2(-from / rho) : Vec2(-1.0, 0.0);
    return {turn_ * (radius_ - rho), turn_ * inwards, turn_ / radius_};
  }
  std::optional<CurvatureChange> curvature_change(double) const override {
    return CurvatureChange{};
  }
  double length_to(double u) const override { return u; }
  double at_length(double s) const override { return s; }
  std::shared_ptr<const CurvePiece> moved(double angle, const Vec2& shift) const override;

 private:
  Vec2 center_;
  double radius_, start_, sweep_;
  double turn_;  // 1 counter-clockwise, -1 clockwise
  Vec2 middle_;  // unit vector from the centre to the middle of the arc
  bool closed_;
};

}  // namespace yoke
