// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Periodic orbits by shooting: a start is sought to which the motion returns after a period, by Newton's
// method with the derivative of the flow (variation.hpp), in the motions that the joints allow. The
// derivative over the period is the monodromy matrix; its eigenvalues, Floquet's multipliers, say whether
// motions beside the orbit come nearer.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <string>
#include <vector>

#include <yoke/integrators/simulate.hpp>

namespace yoke {

/// What is sought, and how.
struct PeriodicOrbitOptions {
  /// [s] > 0. Of a model driven in time a multiple of the period of what drives it; else a guess, which
  /// is first replaced by the time between 0.6 and 1.6 of it at which the start comes back nearest.
  double period = 0.0;
  /// Nothing depends on time: the period is an unknown too.
  bool autonomous = false;
  double settle = 0.0;  // [s] run before, from the start given; >= 0
  /// Largest |q(T) - q(0)| in length scales or rad, and |v(T) - v(0)| in these over time scales.
  double tolerance = 1e-8;      // 1e-12 to 1e-2
  int largest_iterations = 30;  // >= 1
  /// Bodies may be turned by whole turns after a period, as a crank is.
  bool whole_turns = true;
  /// Of every run; `until` is of no meaning, `samples` are those of the one period that is kept.
  SimulationOptions run{.relative_tolerance = 1e-10};
};

/// What small motions beside an orbit do.
enum class OrbitStability {
  stable,    ///< they die out: all multipliers but trivial ones are within the unit circle
  neutral,   ///< some neither grow nor die out, to the accuracy of the multipliers
  unstable,  ///< some grow
};

/// How an orbit is about to change, by the multiplier nearest to the unit circle. Pairs of a model that keeps
/// volumes are on the circle wherever the orbit is stable: they are not named.
enum class BifurcationKind {
  none,            ///< none is near
  fold,            ///< +1: two orbits meet and vanish, or branches cross
  flip,            ///< -1: the period doubles
  neimark_sacker,  ///< a conjugate pair: a second frequency appears
};
/// As summaries write it.
std::string_view name_of(OrbitStability stability);
std::string_view name_of(BifurcationKind bifurcation);

/// One of Floquet's multipliers.
struct FloquetMultiplier {
  std::complex<double> value;  // by which a motion beside the orbit grows in a period
  /// 1 for a reason: along the orbit of an autonomous model, along a family of orbits of a conservative
  /// one, a coordinate that nothing depends on. Says nothing about stability.
  bool trivial = false;
};

/// An orbit, or how far the search for it got.
struct PeriodicOrbit {
  bool found = false;                 // it returns within the tolerance
  std::string reason;                 // a sentence
  double period = 0.0;                // [s]
  State start;                        // on the orbit, consistent; simulate() continues from it
  Result run;                         // one period from there
  std::vector<double> residuals;      // as `tolerance` measures them, of each iteration
  std::string worst;                  // what returns least exactly: "crank.angle"
  double residual = 0.0;              // the last of them
  Eigen::MatrixXd monodromy;          // [s x s] of y = (a, b, dz) and memories, see variation.hpp
  Eigen::MatrixXd basis, basis_rate;  // N, N' [n x f] at the start
  std::vector<FloquetMultiplier> multipliers;           // by falling size
  OrbitStability stability = OrbitStability::neutral;   // by the multipliers
  BifurcationKind bifurcation = BifurcationKind::none;  // that is near
  /// Largest modulus of those that are not trivial; 0 if there are none.
  double largest_multiplier = 0.0;
  double determinant = 0.0;         // of the monodromy matrix: how volumes change in a period
  int degrees_of_freedom = 0;       // f
  std::vector<std::string> memory;  // what contacts remember at the start, see variation.hpp
  std::vector<std::string> notes;   // what was assumed, a sentence each
};

/// Searches from `start`, after PeriodicOrbitOptions::settle. Where the equations leave orbits free (a
/// family, a coordinate that nothing depends on) the nearest one is taken: the smallest change that does
/// it. Throws ModelError for options out of range and as flow_derivative(); a search that does not end is
/// no error but `found = false`, with the best that was found; so is one of an autonomous model that ends at
/// rest.
PeriodicOrbit periodic_orbit(const Model& model, const State& start,
                             const PeriodicOrbitOptions& options);
/// From the model's own start.
PeriodicOrbit periodic_orbit(const Model& model, const PeriodicOrbitOptions& options);

}  // namespace yoke
