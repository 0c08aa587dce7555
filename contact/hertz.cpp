// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/contact/hertz.hpp>

#include <cmath>

namespace yoke {

PowerLaw hertz(double modulus, double relative_radius) {
  require_positive("law 'hertz'", "modulus", modulus, "Pa");
  require_positive("law 'hertz'", "relative_radius", relative_radius, "m");
  return {4.0 / 3.0 * modulus * std::sqrt(relative_radius), 1.5, "hertz"};
}

PowerLaw hertz(const RoundPair& pair) {
  pair.check("hertz");
  return hertz(pair.modulus(), pair.relative_radius());
}

}  // namespace yoke
