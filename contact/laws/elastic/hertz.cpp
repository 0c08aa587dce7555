// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/contact/laws/elastic/hertz.hpp>

#include <cmath>

#include <yoke/core/types.hpp>

namespace yoke {

PowerLaw hertz(double modulus, double relative_radius) {
  require_positive("law 'hertz'", "modulus", modulus, "Pa");
  require_positive("law 'hertz'", "relative_radius", relative_radius, "m");
  return {4.0 / 3.0 * modulus * std::sqrt(relative_radius), 1.5, "hertz"};
}

PowerLaw hertz(const RoundPair& pair) {
  pair.check("hertz", true);
  return hertz(pair.modulus(), pair.relative_radius());
}

PowerLaw lankarani_nikravesh(const RoundPair& pair, double length, Reading reading) {
  pair.check("lankarani-nikravesh", true);
  PowerLaw law = hertz(pair.modulus(), pair.relative_radius());
  law.label = "lankarani-nikravesh";
  if (reading == Reading::tabulated) {
    require_positive("law 'lankarani-nikravesh'", "length", length, "m");
    law.K *= pi * length / 10e-3;
  }
  return law;
}

}  // namespace yoke
