// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Steps beside those of an integrator: from where its last step began to a time within it, by an
// explicit Runge-Kutta method. Dense output is less accurate than steps, and where the step passes
// over an event, it is a polynomial through what lies on both sides: a law like d^1.1 ends at zero
// with a corner in its higher derivatives.
#pragma once

#include <functional>
#include <vector>

#include <yoke/integrators/formulations/explicit/explicit_pairs.hpp>

namespace yoke {

class OwnStep {
 public:
  /// y' at t, y; false if it cannot be computed. All vectors have `size` entries.
  using Rates = std::function<bool(double t, const double* y, double* y_dot)>;
  /// An error in units of what is allowed.
  using Norm = std::function<double(const double* error)>;

  /// Of order 5 until another pair is asked for.
  OwnStep(int size, Rates rates);
  /// Steps of another pair; from() is to be called again.
  void use(const ExplicitPair& pair);

  /// Where steps begin; y is not copied. `rate`: y' there, if it is known.
  void from(double t, const double* y, const double* rate = nullptr);
  /// y at t by one step, which ends there; false if the rates fail.
  bool to(double t, double* y);
  /// The same in as many steps as it takes to err by less than one in each; false if these are too many, as
  /// where explicit steps are not stable.
  bool to(double t, double* y, const Norm& norm);
  /// y' at the end of to(); null if it fails.
  const double* rate(double t, const double* y);
  /// The error of the step that to(t, y) made; infinite if the rates fail.
  double error(double t, const double* y, const Norm& norm);

 private:
  bool calc_stages(int first, int last, double h);
  void combine(const double* weights, int count, double h, double* y) const;

  Rates rates_;
  const ExplicitPair* pair_ = nullptr;
  std::size_t size_;
  std::vector<std::vector<double>> k_;  // rates of the stages
  std::vector<double> end_rate_, stage_, start_;
  const double* y_ = nullptr;
  double t_ = 0.0;
  bool first_known_ = false, last_known_ = false;
};

}  // namespace yoke
