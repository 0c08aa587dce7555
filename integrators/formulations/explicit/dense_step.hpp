// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What lies within a step of any method: a polynomial through both of its ends, with accelerations there,
// raised by evaluations within until what the last one added is within the tolerance (the boot-strapping of
// Enright, Jackson, Norsett and Thomsen, ACM Trans. Math. Softw. 12 (1986) 193, with positions that are
// known by accelerations). A few evaluations serve as many times as are asked for; where something
// happens within the step, as where a contact begins, the additions do not decay and it says so.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include <yoke/integrators/formulations/explicit/own_step.hpp>

namespace yoke {

class DenseStep {
 public:
  using Rates = OwnStep::Rates;
  using Norm = OwnStep::Norm;
  /// An end of a step. `rates`: y' there, or null: not known.
  struct End {
    double t = 0.0;  // [s]
    const double* y = nullptr;
    const double* rates = nullptr;
  };

  /// Of y = (q [n], v [n], others), `size` entries in all.
  DenseStep(int size, int n, Rates rates);

  /// The step; nothing is copied.
  void from(const End& begin, const End& end);
  /// Evaluates what it needs, at the first call for a step; false if the error would not be within the
  /// tolerance.
  bool raise(const Norm& norm);
  /// y' at the end of the step, if it is known by now, or null.
  const double* end_rates() const { return end_.rates; }
  /// Before raise(): positions by Hermite's quintic where accelerations are known at both ends, or cubic,
  /// velocities by its derivative; the rest by a cubic or linear. Behind it: within the tolerance.
  void at(double t, double* y) const;

 private:
  static constexpr int most = 4;  // times within the step at which it evaluates
  enum class Verdict { open, good, bad };
  struct Factors {
    std::array<double, 3> by_acceleration, by_rate;  // with their derivatives
  };

  bool converges(const Norm& norm);
  bool find_slopes();
  bool evaluate(std::size_t node);
  double size_of_change(std::size_t node, const Norm& norm);
  void calc_cubic(double s, double* y) const;
  void calc_quintic(double s, double* y, bool velocities) const;
  void calc_hermite(double s, std::size_t first, double* y) const;
  void calc_hermite_rates(double s, double* y_dot) const;
  std::pair<double, double> beyond_cubic(std::size_t i) const;
  Factors factors(std::size_t node, double s) const;

  Rates rates_;
  std::size_t size_, n_;
  End begin_, end_;
  double h_ = 0.0;                                // [s]
  std::array<std::vector<double>, most> beyond_;  // y' less that of the polynomial through the ends
  std::size_t count_ = 0;                         // of them
  std::vector<double> begin_rates_, end_rates_, stage_, change_, scratch_;
  Verdict verdict_ = Verdict::open;
};

}  // namespace yoke
