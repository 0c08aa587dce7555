// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Event functions as a root finder should see them. A function fires when it crosses zero upwards;
// one that is zero or positive at a restart (the event just handled, a contact at rest) is shown
// with a negative sign until it has been negative, so that it neither fires again at once nor stops
// SUNDIALS, which refuses a function that stays at zero.
#pragma once

#include <cmath>
#include <vector>

#include <yoke/core/equations/dynamics.hpp>

namespace yoke {

/// What a function must fall below to have been negative after it was handled at `value`, which is zero up
/// to where the event was located: on either side, whatever the motion does next.
inline double below_zero(double value) { return -2.0 * std::abs(value); }

/// Does any contact touch?
bool touches(const State& state);

class EventGuard {
 public:
  explicit EventGuard(Dynamics& dynamics);

  int count() const { return static_cast<int>(last_.size()); }
  /// At a restart: arms the functions that are negative.
  void start(const State& state);
  void start(double t, const double* q, const double* v, const double* z);
  /// Hides the events that were handled at this very time.
  void settle(const State& state, double t);
  /// For the root finder. False if a function is not finite.
  bool evaluate(double t, const double* q, const double* v, const double* z, double* g);
  /// After an accepted step without event: arms what has become negative.
  void accept(double t, const double* q, const double* v, const double* z);
  /// After a root was found at this state: fired() are the slots the root finder reported in
  /// `found` [count], passed() those that crossed as well, now or earlier in the step.
  void collect(double t, const double* q, const double* v, const double* z,
               const std::vector<int>& found);
  const std::vector<int>& fired() const { return fired_; }
  const std::vector<int>& passed() const { return passed_; }

 private:
  void calc(double t, const double* q, const double* v, const double* z, double* g);

  Dynamics& dynamics_;
  std::vector<double> last_;
  std::vector<double> seen_;  // by the root finder last, before hiding
  double t_seen_ = 0.0;
  std::vector<char> armed_;
  std::vector<double> negative_;  // what a function must be below to be armed
  std::vector<int> fired_, passed_;
};

}  // namespace yoke
