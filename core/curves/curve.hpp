// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Plane curves: centrelines of slots, walls, cams, paths of points. A curve is a value: one smooth
// piece or a chain of them, each with its own parameter u from 0 to end().
//
//   c(u) [m]    t = c'/|c'| unit tangent     n = perp(t) to the left     k = curvature, > 0 to the left
//   p = c(u*) + D n   with the foot u* of p: D is the distance of p from the curve, > 0 on the left
//   dD/dp = n         d2D/dp2 = -k/(1 - k D) t t^T
//
// Makers: lines_and_arcs.hpp, smooth_curves.hpp, absorber_paths.hpp. A kind of your own is one class
// derived from CurvePiece; most need none, as smooth_curves.hpp takes any function.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include <yoke/core/types.hpp>

namespace yoke {

/// A curve at one place.
struct CurvePoint {
  Vec2 point{0.0, 0.0};    // [m]
  Vec2 tangent{1.0, 0.0};  // unit, towards growing u
  double curvature = 0.0;  // [1/m] > 0 turns left
  double speed = 1.0;      // [m per unit of u] |dc/du|
};

/// A point as seen from the nearest point of a curve, its foot.
struct CurveOffset {
  double distance = 0.0;   // [m] > 0 on the left of the curve
  Vec2 normal{0.0, 1.0};   // unit, to the left, at the foot: the gradient of `distance`
  double curvature = 0.0;  // [1/m] of the curve at the foot
  double u = 0.0;          // the foot; 0 of lines and arcs, where nothing depends on it

  /// [1/m] b of the Hessian of `distance`, b t t^T with t along the curve.
  double bend() const { return -curvature / (1.0 - curvature * distance); }
};

/// How the curvature goes on along a curve, with its length l.
struct CurvatureChange {
  double first = 0.0;   // [1/m^2] dk/dl
  double second = 0.0;  // [1/m^3] d2k/dl2
};

/// A smooth piece. Beyond its ends it goes on smoothly: steps of an integrator look ahead. Immutable.
class CurvePiece {
 public:
  virtual ~CurvePiece() = default;

  virtual double end() const = 0;                ///< u of the last point; the first has 0
  virtual bool closed() const { return false; }  ///< u = 0 and u = end() are the same point
  /// The curve at u, also beyond its ends.
  virtual CurvePoint at(double u) const = 0;
  /// u of the point nearest to p; beyond the ends, the foot on the continuation.
  virtual double foot(const Vec2& p) const = 0;
  /// Of p [m] from the nearest point, or from the continuation.
  virtual CurveOffset offset(const Vec2& p) const = 0;
  /// At u. Nothing if the piece does not know: laws then cannot follow the curvature along it.
  virtual std::optional<CurvatureChange> curvature_change(double /*u*/) const { return {}; }
  virtual double length_to(double u) const = 0;  ///< [m] of the curve from 0 to u
  virtual double at_length(double s) const = 0;  ///< the inverse: u where length_to(u) = s
  /// The same piece turned about the origin by `angle` [rad], then shifted [m].
  virtual std::shared_ptr<const CurvePiece> moved(double angle, const Vec2& shift) const = 0;
};

/// A place on a curve.
struct CurvePlace {
  std::size_t piece = 0;  // its number
  double u = 0.0;         // within the piece
};

/// A curve in global axes of the start pose. Copies share their immutable pieces.
class Curve {
 public:
  /// One piece, its coordinates relative to `origin` [m]: close to it no digit is lost, however far
  /// it is from the origin of the global frame.
  explicit Curve(std::shared_ptr<const CurvePiece> piece, const Vec2& origin = Vec2(0.0, 0.0));
  Curve(const Curve&);
  Curve(Curve&&) noexcept;
  Curve& operator=(const Curve&);
  Curve& operator=(Curve&&) noexcept;
  ~Curve();

  const Vec2& origin() const { return origin_; }  ///< [m] of the coordinates of the pieces
  /// How many there are.
  std::size_t pieces() const { return pieces_.size(); }
  /// In coordinates relative to origin().
  const CurvePiece& piece(std::size_t i) const { return *pieces_[i]; }
  /// Whether it ends where it begins.
  bool closed() const { return closed_; }
  double length() const { return length_; }  ///< [m], infinite for a straight line

  /// [m], from the start of the curve along it, 0 <= s <= length(); global axes of the start pose.
  CurvePoint at(double s) const;
  /// s of a place [m].
  double length_to(const CurvePlace& place) const;
  /// The nearest point of the curve to p, a global point [m]; of an end that is nearest, the end.
  CurvePlace nearest(const Vec2& p) const { return nearest_local(p - origin_); }
  /// The same for p relative to origin().
  CurvePlace nearest_local(const Vec2& p) const;
  /// Of p [m] from the curve, where `nearest` is; global axes.
  CurveOffset offset(const Vec2& p) const;

  /// Turned about the global origin by `angle` [rad], then shifted [m].
  Curve moved(double angle, const Vec2& shift) const;
  /// Points along it [m], no further than `spacing` [m] apart along it, the ends of the pieces included. Only
  /// of a curve of finite length.
  std::vector<Vec2> sample(double spacing) const;

  /// One behind the other. Each must begin where the one before ends, to 1e-9 of the length; the
  /// chain is closed if the last ends where the first begins. Throws ModelError.
  friend Curve chain(const std::vector<Curve>& curves);

 private:
  void measure();

  std::vector<std::shared_ptr<const CurvePiece>> pieces_;
  std::vector<double> starts_;  // [m] of the pieces along the curve
  Vec2 origin_;
  bool closed_ = false;
  double length_ = 0.0;
};

Curve chain(const std::vector<Curve>& curves);

/// Where a chain turns by an angle between two pieces: the piece before, and the angle [rad] of the
/// turn, > 0 to the left. Turns below 1e-9 rad are none.
struct CurveCorner {
  std::size_t before = 0;  // number of the piece
  double turn = 0.0;       // [rad]
};
/// In the order of the pieces; that between the last and the first of a closed curve is the last.
std::vector<CurveCorner> corners_of(const Curve& curve);

/// Throws ModelError, whose message begins with the owner, if the curve crosses or touches itself.
void require_simple(std::string_view owner, const Curve& curve);

}  // namespace yoke
