// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What no tolerance can ask for. Positions are numbers of double precision: after a thousand turns
// an angle is known to 1e-13 rad, and so is, times its length, the position of everything that
// joints tie to that body. A method that is asked for less follows rounding with ever shorter
// steps. Error weights are therefore bounded by a multiple of the rounding of positions and
// velocities within each assembly of bodies. For a body lighter than the heaviest of its assembly the
// multiple grows with the square root of the ratio: constraints are satisfied in the metric of the
// masses, which lets the light ones give way. The velocity of a body that has become fast compared
// with the scales of the model (a heavy body has handed its energy to a light one) is weighted with
// its speed, and not below what rounding of the position makes of it; nor are those of the bodies that it is
// joined to, which give way with it.
#pragma once

#include <vector>

#include <yoke/core/equations/assemblies.hpp>
#include <yoke/core/equations/dynamics.hpp>
#include <yoke/integrators/formulations/formulation.hpp>

namespace yoke {

class RoundingFloor {
 public:
  /// By how much noise of the coordinates is enlarged in the error estimate of a method, in units of
  /// their rounding.
  struct Noise {
    double own = 8.0;       // of the coordinate itself
    double followed = 2.0;  // of a position, in the velocity that follows it
  };
  RoundingFloor(const Dynamics& dynamics, const Tolerances& tolerances, const Noise& noise);

  /// A run begins anew.
  void start();
  /// Lowers weights (one over what a step may err by) of q and v, [dofs] each, to what is sensible at
  /// q, v, the end of a step. `share`: that part of the tolerances is what the weights stand for.
  void apply(const double* q, const double* v, double* weight_q, double* weight_v,
             double share = 1.0);

  double arm(int body) const { return arm_[static_cast<std::size_t>(body)]; }  ///< [m]
  /// By how much rounding of heavier bodies is enlarged in coordinate i.
  double yielding(int i) const { return yielding_[static_cast<std::size_t>(i)]; }
  /// The largest factor by which a tolerance was raised so far, 1: none was.
  double raised() const { return raised_; }

 private:
  const System& system_;
  double relative_, own_, followed_;
  /// For the weights of three coordinates, whose rounding is `length` (angles: over the arm).
  void bound(std::size_t body, double length, double share, double* weight);
  double size_of(std::size_t body, const double* x) const;
  void note_step(const double* q, const double* v);

  struct Size {
    double position = 0.0, speed = 0.0;  // [m], [m/s]
    double steepness = 0.0;              // [1/s] of the fast bodies
  };
  std::vector<double> arm_;        // [bodies] how rounding of an angle shows in lengths
  std::vector<double> yielding_;   // [3 bodies] root of the mass ratio
  std::vector<int> assembly_;      // [bodies] which bodies joints tie together
  std::vector<Size> size_;         // [assemblies] scratch
  std::vector<char> is_fast_;      // [bodies]
  std::vector<double> steepness_;  // [bodies] change of velocity over that of position [1/s]
  std::vector<double> q_, v_;      // of the last call
  bool has_last_ = false;
  Size harmless_;  // nothing is to be done below
  double raised_ = 1.0;
};

}  // namespace yoke
