// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The family of the laws of two parallel cylinders that are given as penetration of force,
//   d = a F ln(B/F)      d [m], F [N], a [m/N], B [N],
// evaluated exactly for force of penetration (log_law_inverse.hpp). With w = ln(B/F) >= 1:
//   F = d/(a w),   dF/dd = 1/(a (w - 1)),   U = int F dd = a F^2 (w/2 - 1/4).
// The law ends where its stiffness is infinite, w = 1: d_max = a B/e, F_max = B/e. It is held as
// the pair a, d_max. As d -> 0 the stiffness goes to zero like 1/(a ln(d_max/d)), that is hardly:
// at 1e-300 m it is a few thousandths of 1/a. At d = 0 it is given as at the smallest number above.
// Machines 2022, 10, 966, Table 1; R. M. Corless et al., On the Lambert W function, 1996.
#pragma once

#include <limits>
#include <string>

#include <yoke/contact/laws/elastic/log_law_inverse.hpp>
#include <yoke/contact/laws/law.hpp>

namespace yoke {

class LogarithmicLaw {
 public:
  /// `a` [m/N], `limit` d_max [m], both between 1e-200 and 1e200; `label` is the law's name. Throws
  /// ModelError.
  LogarithmicLaw(double a, double limit, std::string label);

  ElasticResponse operator()(double penetration) const {
    const double x = penetration * inverse_limit_;
    if (x > LogLawInverse::fold) {
      if (penetration > limit_) return {not_a_number, not_a_number, not_a_number};
      const double v = table_->near_fold((limit_ - penetration) * inverse_limit_);
      const double force = penetration * inverse_a_ / (1.0 + v);
      return {force, inverse_a_ / v, a_ * force * force * (0.5 * v + 0.25)};
    }
    const double v = table_->away(x > 1e-290 ? -std::log(x) : small(penetration));
    const double w = 1.0 + v;
    const double r = inverse_a_ / (v * w);
    const double force = penetration * (r * v);
    return {force, r * w, a_ * force * force * (0.5 * v + 0.25)};
  }

  double a() const { return a_; }                       ///< [m/N]
  double limit() const { return limit_; }               ///< [m]
  double largest_force() const { return limit_ / a_; }  ///< [N] at the limit
  double penetration(double force) const;               ///< [m] of 0 <= force <= largest_force()
  std::string name() const { return label_; }

 private:
  static constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

  /// u where x may have lost digits or be zero.
  double small(double penetration) const {
    return std::log(limit_) -
           std::log(std::fmax(penetration, std::numeric_limits<double>::denorm_min()));
  }

  const LogLawInverse* table_ = &LogLawInverse::tables();
  double a_, limit_, inverse_a_, inverse_limit_;
  std::string label_;
};

}  // namespace yoke
