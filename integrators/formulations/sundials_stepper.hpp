// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What the formulations on top of SUNDIALS' integrators have in common: the vector of unknowns, its
// error weights, events, counters and failures.
//
// y = (q - q_0, v, z, ..., energies). Positions are displacements from a base, so rounding in the
// integrator's sums does not depend on where the origin is; elements get absolute positions. A
// restart makes its positions the base; a method of one step also moves the base as it goes.
#pragma once

#include <utility>
#include <vector>

#include <yoke/integrators/formulations/event_guard.hpp>
#include <yoke/integrators/formulations/explicit/own_step.hpp>
#include <yoke/integrators/formulations/formulation.hpp>
#include <yoke/integrators/formulations/rounding_floor.hpp>
#include <yoke/integrators/sundials/callback_failure.hpp>
#include <yoke/integrators/sundials/context.hpp>
#include <yoke/integrators/sundials/vector.hpp>

namespace yoke {

class SundialsStepper : public Formulation {
 public:
  void tighten(double share) override { share_ = share; }
  double time() const override { return t_; }
  const std::vector<int>& fired() const override { return guard_.fired(); }
  const std::vector<int>& passed() const override { return guard_.passed(); }
  std::string failure() const override { return failure_.text; }

 protected:
  static constexpr RoundingFloor::Noise one_step{.own = 8.0}, multistep{.own = 128.0};

  /// Energies begin at y[energies]; for `noise` see RoundingFloor.
  SundialsStepper(Dynamics& dynamics, const Tolerances& tolerances, int energies,
                  const RoundingFloor::Noise& noise);

  double* y() const { return y_.data(); }
  const double* v_of(const double* y) const { return y + n_; }
  const double* z_of(const double* y) const { return y + 2 * n_; }
  /// Absolute positions for the displacements in y, in scratch [n].
  double* q_of(const double* y);

  /// t, q, v, z and energies between the state and y_; pack() makes its positions the new origin.
  void pack(const State& state);
  void unpack(double t, State& state);
  /// Moves the base to the positions of y, without loss, and the displacements to zero.
  void move_base();
  /// Have the displacements grown so large that their rounding counts against the tolerance?
  bool is_far_from_base() const;
  /// 1 / tolerance for q, v, z and energies; other unknowns are left.
  void set_weights();
  void accept_step() { guard_.accept(t_, q_of(y()), v_of(y()), z_of(y())); }
  /// After a root at t_, with found_ as the integrator reports it.
  void collect_events() { guard_.collect(t_, q_of(y()), v_of(y()), z_of(y()), found_); }
  bool evaluate_events(double t, const double* y, double* g) {
    return guard_.evaluate(t, q_of(y), v_of(y), z_of(y), g);
  }
  /// Says which equation could not be satisfied.
  void report_failed_projection();

  /// y' of the differential equations at t, y; false if accelerations cannot be computed.
  virtual bool calc_rates(double t, const double* y, double* y_dot) = 0;
  /// Around a step of the integrator: where it began and ended is kept. One that failed is undone.
  void begin_step();
  void undo_step();
  /// y' where it began, which own steps need not evaluate then.
  void know_begin(const double* rates);
  void end_step();
  /// After a root at t_: time and state there are computed anew by steps of our own from the
  /// beginning of the integrator's step, which reached t_limit. What finds no root nearby changes
  /// nothing.
  void refine_event(double t_limit);
  /// The same where the dense output, whose derivative is `slope`, does not agree with the equations
  /// there, and in as many steps as it takes to keep the tolerances in sensible_weights_.
  void refine_event_if_rough(double t_limit, const double* slope);
  /// Of an error, in units of the tolerances in sensible_weights_.
  double norm_of(const double* error);

  /// SUNDIALS' user data is the stepper; `Derived` is what it was created as.
  template <class Derived>
  static Derived& from(void* user_data) {
    return static_cast<Derived&>(*static_cast<SundialsStepper*>(user_data));
  }
  void* user_data() { return this; }
  /// The callback for error weights: those of set_weights(), within the floor of rounding.
  static int calc_weights(N_Vector y, N_Vector weights, void* user_data);
  /// Every event counts upwards.
  std::vector<int> directions() const { return std::vector<int>(found_.size(), 1); }

  Dynamics& dynamics_;
  Tolerances tolerances_;
  CallbackFailure failure_;
  EventGuard guard_;
  int n_, nz_, quadratures_, energies_, size_;
  RoundingFloor floor_;
  SundialsContext context_;
  ErrorGroups groups_;
  SundialsVector y_, weights_;
  SundialsVector sensible_weights_;  // within the floor of rounding
  double share_ = 1.0;               // of the tolerances, that is asked for
  double t_ = 0.0;
  double t_stop_ = 0.0;              // as the integrator knows it
  std::vector<int> found_;           // [events]
  StepCounters before_;              // of integrations before the last restart
  std::vector<double> q_start_;      // the base, to double precision
  std::vector<double> begin_, end_;  // y where the last step began and ended
  double t_begin_ = 0.0, t_end_ = 0.0;
  const double* begin_rates_ = nullptr;
  OwnStep own_step_;

 private:
  void refine_event(double t_limit, const OwnStep::Norm& norm);
  double time_to_root(int slot, const double* rate, double h);

  std::vector<double> shifted_, g_, refined_;  // scratch
  std::vector<double> q_low_;                  // what the base has beyond that
  std::vector<double> q_;                      // scratch
  SundialsVector error_;                       // scratch
};

}  // namespace yoke
