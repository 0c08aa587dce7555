// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/contact/laws/elastic/logarithmic_law.hpp>

#include <yoke/core/error.hpp>

namespace yoke {

LogarithmicLaw::LogarithmicLaw(double a, double limit, std::string label)
    : a_(a),
      limit_(limit),
      inverse_a_(1.0 / a),
      inverse_limit_(1.0 / limit),
      label_(std::move(label)) {
  const std::string owner = "law '" + label_ + "'";
  require_range(owner, "a", a_, 1e-200, 1e200, "m/N");
  require_range(owner, "limit", limit_, 1e-200, 1e200, "m");
}

double LogarithmicLaw::penetration(double force) const {
  // ln(B/F) = 1 + ln(F_max/F)
  return force > 0.0 ? a_ * force * (1.0 + std::log(largest_force() / force)) : 0.0;
}

}  // namespace yoke
