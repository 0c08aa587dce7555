// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What the checks of joints and of forces share. Not meant for users: see check.hpp.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include <yoke/core/authoring/check.hpp>

namespace yoke::checking {

/// A block, row-major.
using Values = std::vector<double>;

/// For subscripts of vectors.
inline std::size_t index(int i) { return static_cast<std::size_t>(i); }

/// The largest size; 0 of none.
double largest(std::span<const double> values);

/// d f / d h at h = 0, entry by entry; `scale` is the size of h over which f is smooth.
Values differentiate(const std::function<Values(double h)>& f, double scale);

/// The state an element is evaluated at, with the cosines and sines of the bodies.
class Probe {
 public:
  /// At the motion of `state`, which is copied.
  Probe(const Model& model, const State& state);

  /// As elements take it; valid until the probe is changed.
  Motion motion() const { return {.t = t_, .bodies = bodies_, .inertia = model_->bodies()}; }
  /// Moves the time alone [s].
  void advance_time(double h) { t_ += h; }
  /// Moves x, y or angle (axis 0, 1, 2) by h [m, rad].
  void move_coordinate(BodyId id, int axis, double h);
  /// Moves a rate by h [m/s, rad/s].
  void move_velocity(BodyId id, int axis, double h);
  /// Everything moves on with its velocity for the time h.
  void drift(double h);
  /// Velocities of the given bodies, in the order of an element's columns.
  Values velocities(const std::vector<BodyId>& ids) const;

 private:
  const Model* model_;
  std::vector<BodyMotion> bodies_;
  double t_;
};

/// Collects comparisons into an ElementCheck.
class Comparison {
 public:
  /// Into `check`, which must outlive it.
  explicit Comparison(ElementCheck& check) : check_(check) {}

  /// Of several problems the first is kept.
  void complain(const std::string& problem);
  /// Complains of a number that is not finite.
  void require_finite_block(const char* name, const Values& block);
  /// Relative to the row, but a row of zeros is judged by its block, and a block of zeros by
  /// `natural`, the size rounding errors come from. Columns to `skip` are not compared.
  void compare(const char* name, int rows, int columns, const Values& analytic,
               const Values& numeric, const std::vector<bool>& skip, double natural);
  /// The same block obtained in another way, equal up to rounding.
  void require_same(const char* name, const Values& alone, const Values& together);

 private:
  void entry(const char* name, int r, int c, double analytic, double numeric, double scale);

  ElementCheck& check_;
};

/// Columns of the ground: it does not move, so what an element writes there is ignored.
std::vector<bool> ground_columns(const std::vector<BodyId>& bodies);

/// The size of steps for a coordinate: length or angle.
double step_scale(int column, const CheckOptions& options);

/// [s] within which the motion stays where the element is smooth.
double drift_scale(const Values& v, const CheckOptions& options);

/// Whether a block has an entry that is not zero in a column that is not skipped.
bool any_nonzero(const Values& block, const std::vector<bool>& skip);

/// Checks an element at one state. True if something was seen that is not zero.
bool check_at(const Constraint& element, const Model& model, const State& state,
              const CheckOptions& options, ElementCheck& check);
bool check_at(const ForceElement& element, const Model& model, const State& state,
              const CheckOptions& options, ElementCheck& check);

}  // namespace yoke::checking
