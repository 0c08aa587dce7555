// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A mechanism as a control engineer wants it: about any state, at rest or in motion,
//   x' = A x + B u      x = (p, p', dz), see modes.hpp: a neighbouring motion is q + N p
//   y  = C x + D u
// with changes u of changeable parameters and changes y of columns of the samples.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include <yoke/integrators/analyses/modes.hpp>

namespace yoke {

/// The matrices at one state after another, as a controller or an estimator wants them that linearises
/// as it goes: everything is sized by the constructor.
///
///   LinearPlant plant(model, {"motor.torque"}, {"slider.x_m"});
///   plant.at(run.state());
///   plant.A();
///
/// Not for use by two threads at once; the model may be shared, and must outlive it.
class LinearPlant {
 public:
  /// `inputs` are changeable parameters ("motor.torque"), `outputs` columns of the samples
  /// ("slider.x_m", "hinge.fx_N"). Assembles `start` once, to find redundant equations. Throws
  /// ModelError if that fails, for an unknown name, for an input that sets a motion, and for a model
  /// larger than largest_linearisation.
  LinearPlant(const Model& model, const State& start, const std::vector<std::string>& inputs,
              const std::vector<std::string>& outputs);
  /// The same from the model's own start.
  LinearPlant(const Model& model, const std::vector<std::string>& inputs,
              const std::vector<std::string>& outputs);
  ~LinearPlant();
  LinearPlant(LinearPlant&&) noexcept;
  LinearPlant& operator=(LinearPlant&&) noexcept;

  /// About `state`, which is moved to the nearest state on the constraints; contacts as they are. A is
  /// exact; B, C and D are central differences of forces and of outputs on the constraints, exact where
  /// these are linear, else to about 1e-9 of their size. Allocates nothing, but where the matrix of
  /// the accelerations needs new pivots, and where friction that takes hold changes the number of
  /// degrees of freedom.
  /// Throws ModelError for a state of another model or off the constraints, and as linearise().
  void at(const State& state);

  // Of the last at(), s = 2 f + nz, f degrees of freedom; before the first one, of no size.
  const Eigen::MatrixXd& A() const;           ///< [s x s]
  const Eigen::MatrixXd& B() const;           ///< [s x inputs]
  const Eigen::MatrixXd& C() const;           ///< [outputs x s]
  const Eigen::MatrixXd& D() const;           ///< [outputs x inputs]
  const Eigen::MatrixXd& basis() const;       ///< N [n x f]
  const Eigen::MatrixXd& basis_rate() const;  ///< N' [n x f] [1/s]
  /// On the constraints, with accelerations and multipliers; before the first at(), the start.
  const State& state() const;

 private:
  friend struct StateSpace state_space(const Model&, const State&, const std::vector<std::string>&,
                                       const std::vector<std::string>&);
  class Neighbourhood;
  std::unique_ptr<Neighbourhood> near_;
};

struct StateSpace {
  Eigen::MatrixXd A;    // [s x s], s = 2 f + nz
  Eigen::MatrixXd B;    // [s x inputs]
  Eigen::MatrixXd C;    // [outputs x s]
  Eigen::MatrixXd D;    // [outputs x inputs]
  Linearisation about;  // with the basis N that p belongs to
};

/// The same once, about `state`, which is assembled first. Throws ModelError as a LinearPlant.
StateSpace state_space(const Model& model, const State& state,
                       const std::vector<std::string>& inputs,
                       const std::vector<std::string>& outputs);

}  // namespace yoke
