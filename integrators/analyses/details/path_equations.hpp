// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The equations of rest with one unknown more: the progress of a parameter from 0 to 1.
//
//   [ F_x  F_p ] [ dx ]   [ -F            ]     b . y = c: the plane across a direction, or a fixed
//   [   b^T    ] [ dp ] = [ c - b^T y     ]     progress
#pragma once

#include <algorithm>
#include <functional>
#include <memory>

#include <yoke/core/equations/linear/sparse.hpp>
#include <yoke/integrators/analyses/details/rest_equations.hpp>

namespace yoke {

class PathEquations {
 public:
  using Vector = Eigen::VectorXd;

  /// `set` makes the parameter that of a progress; `step` [progress] is small enough for the
  /// difference that gives F_p, or anything where F is linear in it.
  PathEquations(Statics& statics, std::function<void(double progress)> set, double step)
      : statics_(statics), set_(std::move(set)), step_(step) {}

  static double progress(const Vector& y) { return y[y.size() - 1]; }
  /// y [unknowns of rest, progress]
  Vector point(const Vector& x, double progress) const;
  /// F at y; false if it is not finite or a contact is beyond its law.
  bool residual(const Vector& y, Vector& F);

  /// From now on displacements are measured in this many length scales: what the parameter moves,
  /// if that is more than the mechanism's size says.
  void set_reach(double reach) { reach_ = std::max(1.0, reach); }

  /// b . d is the product of the directions whose border b is, in reaches, rad and progress.
  Vector border(const Vector& direction) const;
  Vector border_of_progress(Eigen::Index size) const { return Vector::Unit(size, size - 1); }
  double norm(const Vector& d) const { return std::sqrt(border(d).dot(d)); }
  /// The largest part of a direction, in the same units.
  double largest(const Vector& d) const;

  /// Moves y to the path on the plane border . y = target. False: it stays as it was.
  bool correct(Vector& y, const Vector& border, double target);
  /// The direction of the path at y, of norm 1, on the side of `border`.
  bool tangent(const Vector& y, const Vector& border, Vector& direction);
  long iterations() const { return iterations_; }

 private:
  bool factorise(const Vector& y, const Vector& border);
  bool factorise_bordered(const Tangent::Matrix& inner, const Vector& column, const Vector& border);
  bool slope(const Vector& y, Vector& F_p);
  bool solve(Vector& b);

  Statics& statics_;
  std::function<void(double)> set_;
  double step_, reach_ = 1.0;
  long iterations_ = 0;
  std::unique_ptr<SparseLU> lu_;
};

}  // namespace yoke
