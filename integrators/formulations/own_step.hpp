// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Steps beside those of an integrator: from where its last step began to a time within it, by the
// explicit Runge-Kutta method of Dormand and Prince, order 5(4). Dense output is less accurate than
// steps, and where the step passes over an event, it is a polynomial through what lies on both
// sides: a law like d^1.1 ends at zero with a corner in its higher derivatives.
#pragma once

#include <functional>
#include <vector>

struct ARKodeButcherTableMem;  // of SUNDIALS

namespace yoke {

class OwnStep {
 public:
  /// y' at t, y; false if it cannot be computed. All vectors have `size` entries.
  using Rates = std::function<bool(double t, const double* y, double* y_dot)>;
  /// An error in units of what is allowed.
  using Norm = std::function<double(const double* error)>;

  OwnStep(int size, Rates rates);
  ~OwnStep();
  OwnStep(const OwnStep&) = delete;
  OwnStep& operator=(const OwnStep&) = delete;

  /// Where steps begin; y is not copied.
  void from(double t, const double* y);
  /// y at t by one step, which ends there; false if the rates fail.
  bool to(double t, double* y);
  /// The same in as many steps as it takes to err by less than one in each.
  bool to(double t, double* y, const Norm& norm);
  /// y' at the end of to(); null if it fails.
  const double* rate(double t, const double* y);

 private:
  bool calc_stages(double t);
  void combine(const double* weights, int count, double h, double* y) const;
  double error_of_step(double h, const Norm& norm);

  Rates rates_;
  ARKodeButcherTableMem* table_;
  int stages_;                          // without the last one, which is the first of the next step
  std::vector<std::vector<double>> k_;  // rates of the stages
  std::vector<double> stage_, start_;
  const double* y_ = nullptr;
  double t_ = 0.0;
  bool first_known_ = false, last_known_ = false;
};

}  // namespace yoke
