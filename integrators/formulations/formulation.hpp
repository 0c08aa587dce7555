// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Interface of formulations: advance a state in time by one internal step, with dense output and
// located events. One file per formulation; registry.cpp lists them.
#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <yoke/core/equations/dynamics.hpp>

namespace yoke {

/// Absolute error weights, free of where the origin is: tolerance times a size of the model.
struct Tolerances {
  double relative = 1e-8;
  Eigen::VectorXd q;            // [3 nb]
  Eigen::VectorXd v;            // [3 nb]
  Eigen::VectorXd z;            // [nz]
  double energy = 1e-8;         // [J] quadratures
  double baumgarte_rate = 0.0;  // [1/s] the user's gain of Baumgarte's stabilisation; 0: none given
  double natural_rate = 1.0;    // [1/s] grows with the time scale and slowly with the tolerance
  double spectral_radius = 0.8;  // at infinity, formulation generalised-alpha only
  int order = 0;                 // of explicit Runge-Kutta steps; 0: the run chooses
  /// [s] No step of a method without stages in between may be longer: its error test does not see the stroke
  /// of a driver there.
  double longest_step = std::numeric_limits<double>::infinity();
};

/// The least a position can be weighted with: a few units in its last place. Weights do not depend
/// on where the origin is but for this, what no tolerance can ask for.
inline double rounding_of(double coordinate) {
  return 8.0 * std::numeric_limits<double>::epsilon() * std::abs(coordinate);
}

/// Baumgarte's stabilisation of a method at acceleration level: critical damping at the user's rate
/// or, if none is given, at the natural one.
inline Baumgarte critically_damped(const Tolerances& tolerances) {
  const double rate =
      tolerances.baumgarte_rate > 0.0 ? tolerances.baumgarte_rate : tolerances.natural_rate;
  return {.alpha = rate, .beta = rate};
}

enum class Step { advanced, event, failed };

/// What a formulation has cost so far.
struct StepCounters {
  long steps = 0;
  long rejected = 0;
  long jacobians = 0;
  long evaluations = 0;    // of forces for residuals of its own, besides accelerations
  FactorCounters factors;  // of matrices of its own, besides the saddle matrix
  double raised = 1.0;     // largest factor by which rounding raised a tolerance
  long by_other = 0;  // steps made by the formulation that takes over in `stiffness_switch.hpp`
};

class Formulation {
 public:
  virtual ~Formulation() = default;
  /// Starts or restarts at a consistent state; the history is discarded.
  virtual void start(const State& state) = 0;
  /// As start(), where only loads have changed, as after a controller's sample: what is known of the
  /// step size stays.
  virtual void restart(const State& state) { start(state); }
  /// From the next step on its tolerances are this share of those it was made with, if it can do that.
  virtual void tighten(double /*share*/) {}
  /// One step, not beyond `t_stop`. `event`: the step ended at a root, see time() and fired(); the
  /// caller may restart there or simply continue.
  virtual Step step(double t_stop) = 0;
  virtual double time() const = 0;
  virtual double last_step() const = 0;
  /// Do its steps end on the constraints?
  virtual bool ends_projected() const { return false; }
  /// Of an explicit method: is it stability that has bounded its last steps, not accuracy?
  virtual bool is_bounded_by_stability() const { return false; }
  /// t, q, v, z and energy at a time inside the last step, not projected.
  virtual void interpolate(double t, State& state) = 0;
  /// The same for many times in a step, within the tolerances: not as near to an event as interpolate().
  virtual void sample(double t, State& state) { interpolate(t, state); }
  /// The same for looks into the last step: it may be less accurate, but asks for no evaluation of
  /// the equations of motion.
  virtual void glance(double t, State& state) { interpolate(t, state); }
  /// As sample(), but leaves no trace: equations of motion are evaluated by `equations`, which is
  /// bound to `state`, and not with the factors that the next step may use again.
  virtual void look(double t, State& state, Dynamics& /*equations*/) { sample(t, state); }
  /// Event slots that crossed zero upwards at time(), and those that were found to have crossed by
  /// then, at that time or earlier in the step.
  virtual const std::vector<int>& fired() const = 0;
  virtual const std::vector<int>& passed() const = 0;
  virtual StepCounters counters() const = 0;
  /// Why the last step failed.
  virtual std::string failure() const = 0;
};

struct FormulationEntry {
  std::string_view name;
  std::string_view description;
  int index = 1;              // of the equations as they are integrated
  std::string_view family{};  // of the method
  int order = 5;              // highest
  std::unique_ptr<Formulation> (*make)(Dynamics&, const Tolerances&) = nullptr;
};

/// All formulations, the default first.
const std::vector<FormulationEntry>& formulation_registry();
/// Throws ModelError that lists the names there are.
const FormulationEntry& find_formulation(std::string_view name);

}  // namespace yoke
