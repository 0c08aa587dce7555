// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/contact/laws/elastic/radzimovsky.hpp>

#include <cmath>

#include <yoke/core/error.hpp>
#include <yoke/core/types.hpp>

namespace yoke {

LogarithmicLaw radzimovsky(const RoundPair& pair, double length, Reading reading) {
  pair.check("radzimovsky");
  require_positive("law 'radzimovsky'", "length", length, "m");
  const double factor = reading == Reading::tabulated ? 16.0 : 8.0;
  return {1.0 / (pi * pair.modulus() * length),
          factor * std::exp(-1.0 / 3.0) / (1.6 * 1.6 * pi) * pair.radius_difference(),
          "radzimovsky"};
}

}  // namespace yoke
