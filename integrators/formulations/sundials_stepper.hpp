// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What the formulations on top of SUNDIALS' integrators have in common: the vector of unknowns, its
// error weights, events, counters and failures.
//
// y = (q - q_0, v, z, ..., energies). Positions are displacements from the last restart, so
// rounding in the integrator's sums does not depend on where the origin is; elements get absolute
// positions.
#pragma once

#include <vector>

#include <yoke/integrators/formulations/event_guard.hpp>
#include <yoke/integrators/formulations/formulation.hpp>
#include <yoke/integrators/sundials/callback_failure.hpp>
#include <yoke/integrators/sundials/context.hpp>
#include <yoke/integrators/sundials/vector.hpp>

namespace yoke {

class SundialsStepper : public Formulation {
 public:
  double time() const override { return t_; }
  const std::vector<int>& fired() const override { return guard_.fired(); }
  const std::vector<int>& passed() const override { return guard_.passed(); }
  std::string failure() const override { return failure_.text; }

 protected:
  /// Energies begin at y[energies].
  SundialsStepper(Dynamics& dynamics, const Tolerances& tolerances, int energies);

  double* y() const { return y_.data(); }
  const double* v_of(const double* y) const { return y + n_; }
  const double* z_of(const double* y) const { return y + 2 * n_; }
  /// Absolute positions for the displacements in y, in scratch [n].
  double* q_of(const double* y);

  /// t, q, v, z and energies between the state and y_; pack() makes its positions the new origin.
  void pack(const State& state);
  void unpack(double t, State& state);
  /// 1 / (share * tolerance) for q, v, z and energies; other unknowns are left.
  void set_weights(double share = 1.0);
  void accept_step() { guard_.accept(t_, q_of(y()), v_of(y()), z_of(y())); }
  /// After a root at t_, with found_ as the integrator reports it.
  void collect_events() { guard_.collect(t_, q_of(y()), v_of(y()), z_of(y()), found_); }
  bool evaluate_events(double t, const double* y, double* g) {
    return guard_.evaluate(t, q_of(y), v_of(y), z_of(y), g);
  }
  /// Says which equation could not be satisfied.
  void report_failed_projection();

  /// SUNDIALS' user data is the stepper; `Derived` is what it was created as.
  template <class Derived>
  static Derived& from(void* user_data) {
    return static_cast<Derived&>(*static_cast<SundialsStepper*>(user_data));
  }
  void* user_data() { return this; }
  /// The callback for error weights: they do not depend on y, so they are only copied.
  static int copy_weights(N_Vector y, N_Vector weights, void* user_data);
  /// Every event counts upwards.
  std::vector<int> directions() const { return std::vector<int>(found_.size(), 1); }

  Dynamics& dynamics_;
  Tolerances tolerances_;
  CallbackFailure failure_;
  EventGuard guard_;
  int n_, nz_, quadratures_, energies_, size_;
  SundialsContext context_;
  SundialsVector y_, weights_;
  double t_ = 0.0;
  double t_stop_ = 0.0;     // as the integrator knows it
  std::vector<int> found_;  // [events]
  StepCounters before_;     // of integrations before the last restart
  std::vector<double> q_start_;

 private:
  std::vector<double> q_;  // scratch
};

}  // namespace yoke
