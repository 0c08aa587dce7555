// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/contact/laws/elastic/goldsmith.hpp>

#include <yoke/core/error.hpp>
#include <yoke/core/types.hpp>

namespace yoke {

LogarithmicLaw goldsmith(const RoundPair& pair, double length, Reading reading) {
  pair.check("goldsmith");
  require_positive("law 'goldsmith'", "length", length, "m");
  const double H = 1.0 / ((reading == Reading::printed ? 1.0 : pi) * pair.modulus());
  const double area = reading == Reading::consistent ? length * length  // [m^2] for L^(m - 1)
                      : reading == Reading::printed  ? 1e-6             // 1 mm^2
                                                     : 1e8 * 1e-6;
  return {H / length, area / pair.relative_radius(), "goldsmith"};
}

}  // namespace yoke
