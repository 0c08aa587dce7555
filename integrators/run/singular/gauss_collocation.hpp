// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// One step of Gauss' collocation on the constraint manifold, 4 or 6 stages, order 8 or 12, solved
// by fixed point iteration (the motions it is used for are not stiff for its steps). No stage lies
// in the middle of a step. y = (q, v, z, energy).
#pragma once

#include <vector>

#include <yoke/integrators/formulations/formulation.hpp>

namespace yoke {

class GaussCollocation {
 public:
  enum class Outcome { solved, close, diverged };
  struct Segment {
    double t = 0.0, h = 0.0;                 // [s] begin and length
    std::vector<double> begin, end;          // y
    std::vector<std::vector<double>> rates;  // y' at the stages
    double least = 0.0;                      // smallest independence met
  };

  /// `stages` is 4 or 6; its equations are solved up to `converged`, in error weights.
  GaussCollocation(Dynamics& dynamics, const Tolerances& tolerances, int stages, double converged);

  int size() const { return size_; }
  Segment make_segment() const;
  /// From segment.begin at segment.t over segment.h, which are given; `a` [dofs] are accelerations
  /// to begin the iteration with. `close`: a stage or the end was closer to a singular position
  /// than `too_close`. The end may be if `end_is_free`: it is not projected then.
  Outcome step(Segment& segment, const double* a, double too_close, bool end_is_free);
  /// The same, beginning with what another method found over the same segment.
  Outcome step(Segment& segment, const GaussCollocation& other, const Segment& found,
               double too_close, bool end_is_free);
  /// y inside a segment, not projected.
  void interpolate(const Segment& segment, double t, double* y) const;
  /// Largest difference of two y in units of the error weights.
  double distance(const double* a, const double* b) const;
  /// Brings y on the constraints.
  Outcome project(double t, double* y, double too_close, double& independence);

 private:
  double time(const Segment& segment, std::size_t stage) const {
    return segment.t + node_[static_cast<Eigen::Index>(stage)] * segment.h;
  }
  Outcome iterate(Segment& segment, double too_close, bool end_is_free);
  Outcome calc_rates(double t, double* y, double* rates, double too_close, double& independence);

  Dynamics& dynamics_;
  int n_, nz_, quadratures_, size_;
  int stages_;
  double converged_;
  Eigen::VectorXd node_, weight_;
  Eigen::MatrixXd a_, lagrange_;  // [stage x stage]; column j of the second: powers of x
  double noise_;                  // change of an iteration that may be rounding, in error weights
  std::vector<double> error_weight_;
  std::vector<std::vector<double>> stage_, sum_;  // projected, and as summed up
};

}  // namespace yoke
