// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// From a description to a model, written in the units the description asks for.
#pragma once

#include <Eigen/Core>

#include <yoke/core/model.hpp>
#include <yoke/tests/random/description.hpp>

namespace yoke::tests::random {

/// Throws ModelError where the model refuses a part.
Model build(const Description& d);

/// The law in SI units. Throws ModelError.
ContactLaw make_law(const LawData& law);

/// [J] kinetic energy, and potential energy of gravity and springs, from the formulas: `q` and `v`
/// (x, y, angle, rates of each body, SI) in the frame of the description.
double mechanical_energy(const Description& d, const Eigen::VectorXd& q, const Eigen::VectorXd& v);

/// [J] by which the energy may change, to first order, if every position and angle errs by
/// `length` [m] and 1 rad, every rate by that per `time` [s]: the scale in which an error of the
/// ledger is judged.
double energy_per_error(const Description& d, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                        double length, double time);

/// How far the constraints of the model are from dependent at a pose: the singular values of their
/// Jacobian, equations of length divided by, and angles multiplied with, the length; relative to
/// the largest, in falling order. Geometry alone: no mass enters. Computed from the elements, not
/// from what the engine thinks of them.
Eigen::VectorXd relative_singular_values(const Model& model, const Eigen::VectorXd& q, double t,
                                         double length);

/// Number of them above 1e-9.
int rank(const Eigen::VectorXd& relative_singular_values);

/// Largest violation of the constraints: of positions, in lengths or rad, and of velocities, in
/// lengths per time or rad per time.
struct Violation {
  double position = 0.0, velocity = 0.0;
};
Violation violation(const Model& model, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                    double t, double length, double time);

}  // namespace yoke::tests::random
