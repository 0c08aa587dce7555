// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Friction of an ideal joint, from the reaction it bears. The surfaces slide along the row s(q); the
// normal force N >= 0 follows from the multipliers lambda of the joint:
//
//   v_t = s v                          [m/s] of body b relative to a
//   T(N + preload, v_t, z)             any friction law (core/friction_law.hpp)
//   Q = -T s^T,   z' = f(N, v_t, z);   with S = ds/dq:
//   dQ/dq = -T_v s^T (S^T v)^T - T S   dQ/dv = -T_v s^T s   dQ/dlambda = -T_N s^T dN/dlambda
//
// lambda depends on T in turn. Both are solved for together (core/equations/loaded_forces.hpp, and as
// unknowns of implicit formulations): nothing is lagged. Laws that hold (Coulomb) hold by a row of the
// equations of motion, as in contacts; then Q = 0.
#pragma once

#include <memory>

#include <yoke/core/force.hpp>
#include <yoke/core/friction_law.hpp>

namespace yoke {

/// What slides on what in a joint, and how hard it is pressed. Rows are over (x, y, angle) of a and b.
class JointSurface {
 public:
  virtual ~JointSurface() = default;
  /// s [6]; and S = ds/dq [6 x 6], which is zero on entry, if not null.
  virtual void calc_slip(const Motion& motion, double* row, double* slope) const = 0;
  /// [N] N for the multipliers of the joint, and dN/dlambda [rows] if not null.
  virtual double calc_load(const double* lambda, double* slope) const = 0;
};

/// The law and what a joint adds to it.
struct JointFrictionLaw {
  FrictionLaw law;         // any friction law
  double preload;          // [N] >= 0
  double reference_force;  // [N] > 0
};

/// The element "joint.friction". Throws ModelError for what is wrong; `joint` must be in the same model.
std::unique_ptr<ForceElement> joint_friction(const Constraint& joint, JointFrictionLaw law,
                                             std::unique_ptr<const JointSurface> surface);

}  // namespace yoke
