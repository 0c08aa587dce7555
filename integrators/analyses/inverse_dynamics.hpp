// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Inverse dynamics: the forces and torques of the drives, and all reactions, for a given motion.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <yoke/core/assembly.hpp>
#include <yoke/core/model.hpp>
#include <yoke/core/result.hpp>

namespace yoke {

/// Until when, and how many rows.
struct InverseDynamicsOptions {
  double until = 0.0;  // [s] end time, > 0
  int samples = 1001;  // rows, uniform in time, both ends; >= 2
};

/// Of a mechanism whose drivers leave no degree of freedom: the motion is that of kinematics(), the
/// torque of a drive is its reaction. Columns: those of simulate(), and for every quadrature its
/// rate, `motor.power_W`, `damper.dissipated_power_W`. Energies are integrated along the motion by
/// Gauss' rule of order 6, so `balance_J` is a check. Nearly singular positions are listed in
/// `summary.singular_positions` as by kinematics(): reactions next to them grow without bound or
/// are lost to rounding; powers and energies are interpolated from both sides and remain accurate.
/// A force with a memory (contacts, element states z) depends on its history: such a model is
/// integrated by simulate() at a tolerance of 1e-10, with the same columns except the powers.
/// Errors as for kinematics().
Result inverse_dynamics(const Model& model, const InverseDynamicsOptions& options);

/// A drive that may act on one coordinate of a body: a force [N] on the centre of mass along x or
/// y, or a torque [N m], the opposite on `against` (empty: the ground).
struct Drive {
  std::string body;                           // its name
  Coordinate coordinate = Coordinate::angle;  // a force along x or y, a torque
  std::string against{};                      // a body; empty: the ground
};

/// Of a motion given as rows (Result::samples of a run, or a table with the same first columns),
/// for a model that need not be driven: what the drives must add to the forces of the model to
/// produce this motion. There must be as many drives as degrees of freedom. Columns: those of
/// simulate() up to the reactions and channels, kinetic, potential and stored energy, and for each
/// drive `crank.angle.drive_N_m` and `crank.angle.drive_power_W`. Throws ModelError if the columns
/// are not those of the model, if the motion violates a joint, if the drives are too few, too many
/// or cannot act on the degrees of freedom, and for contacts, whose memory rows do not hold.
Result inverse_dynamics(const Model& model, const Table& motion, const std::vector<Drive>& drives);

/// The same for a motion given as a function of time: q [3 nb], v and a of the State at time t.
using MotionFunction = std::function<State(double t)>;
Result inverse_dynamics(const Model& model, const MotionFunction& motion,
                        const std::vector<Drive>& drives, const InverseDynamicsOptions& options);

}  // namespace yoke
