// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Interface of joints: a constraint Phi(q, t) = 0 on one or more bodies, as blocks over the
// coordinates of those bodies. A joint never sees the global matrix.
//
//   Phi(q, t) = 0                    rows equations, [m] or [rad]
//   G  = dPhi/dq                     rows x 3k, k bodies, (x, y, angle) of each in turn
//   G v + Phi_t = 0                  velocity level
//   G v' = gamma                     acceleration level, gamma = -(H v + d(G v + Phi_t)/dt)
//   H  = d(G v + Phi_t)/dq           rows x 3k
//   K  = d(G^T lambda)/dq            3k x 3k, symmetric
//   M v' + G^T lambda = Q            so the joint acts on the bodies with -G^T lambda
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <yoke/core/motion.hpp>
#include <yoke/core/parameter.hpp>

namespace yoke {

class Drawing;
class Model;

enum class Measure { length, angle };  ///< unit of an equation of Phi: [m] or [rad]

/// One scalar equation of a joint; errors call it "pivot: x".
struct Equation {
  std::string label;                  // as "x"
  Measure measure = Measure::length;  // its unit
};

/// The blocks that evaluate() computes; null pointers are skipped. All blocks are row-major. G and
/// H keep the zeros outside the declared pattern; K is zero on entry.
struct ConstraintRequest {
  double* phi = nullptr;               // [rows]
  double* G = nullptr;                 // [rows x 3k]
  double* phi_t = nullptr;             // [rows] partial derivative by time
  double* gamma = nullptr;             // [rows]
  double* H = nullptr;                 // [rows x 3k]
  double* K = nullptr;                 // [3k x 3k] for the multipliers `lambda`
  const double* lambda = nullptr;      // [rows], given if K is requested
  const double* parameters = nullptr;  // [parameters().size()], given
};

/// Base of every joint. Immutable once built, so threads may share it.
class Constraint {
 public:
  /// `pattern` marks the entries of G that can be non-zero, row-major rows x 3k; empty: all can.
  Constraint(std::string name, std::vector<BodyId> bodies, std::vector<Equation> equations,
             std::vector<bool> pattern = {});
  virtual ~Constraint() = default;

  /// Unique in the model.
  const std::string& name() const { return name_; }
  /// The k bodies it joins, in the order of its blocks.
  const std::vector<BodyId>& bodies() const { return bodies_; }
  /// One for each row of Phi.
  const std::vector<Equation>& equations() const { return equations_; }
  /// Of Phi.
  int rows() const { return static_cast<int>(equations_.size()); }
  /// 3 k.
  int columns() const { return 3 * static_cast<int>(bodies_.size()); }
  /// Whether the entry of G can be non-zero.
  bool in_pattern(int row, int column) const {
    return pattern_.empty() || pattern_[static_cast<std::size_t>(row * columns() + column)];
  }

  /// Fills the requested blocks. Called in the innermost loop: must not allocate or throw.
  virtual void evaluate(const Motion& motion, const ConstraintRequest& out) const = 0;

  /// Which of bodies() the reported reaction acts on. Default: the last.
  virtual std::size_t reaction_body() const { return bodies_.size() - 1; }
  /// Where it is reported: a global point [m]. Default: the centre of that body.
  virtual Vec2 reaction_point(const Motion& motion) const;

  /// True if Phi depends on time, so that the joint does work on the mechanism (a driver).
  virtual bool rheonomic() const { return false; }

  /// Changeable parameters, ConstraintRequest::parameters.
  virtual std::vector<Parameter> parameters() const { return {}; }
  /// Writes its parameters `own` in the form they have at time t [s], of the same motion: what reads or
  /// sets them then finds the present speed, and a change moves no body. Phi_t may change: a blow.
  virtual void update_parameters(double /*t*/, double* /*own*/) const {}

  /// What it looks like (core/drawing/drawing.hpp); by default nothing is drawn.
  virtual void draw(Drawing&) const {}

 private:
  std::string name_;
  std::vector<BodyId> bodies_;
  std::vector<Equation> equations_;
  std::vector<bool> pattern_;
};

}  // namespace yoke
