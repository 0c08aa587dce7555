// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/contact/laws/elastic/esdu_78035.hpp>

#include <yoke/core/error.hpp>
#include <yoke/core/types.hpp>

namespace yoke {

LogarithmicLaw esdu_78035(const RoundPair& pair, double length, Reading reading) {
  pair.check("esdu-78035");
  require_positive("law 'esdu-78035'", "length", length, "m");
  if (reading == Reading::consistent)
    return {1.0 / (pi * pair.modulus() * length), 4.0 * pair.radius_difference(), "esdu-78035"};
  return {1.0 / (pair.modulus() * length), 4.0 * pair.printed_radius_difference("esdu-78035"),
          "esdu-78035"};
}

}  // namespace yoke
