// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/contact/laws/law.hpp>

#include <algorithm>

namespace yoke {

double ElasticLaw::penetration_at(double force) const {
  double low = 1e-15, high = std::min(limit_, 1e3);
  if (!(force > response(low).force)) return low;
  if (!(response(high).force > force)) return high;
  // Forces span many decades, so the bisection halves the ratio, not the difference.
  while (high / low > 1.0 + 1e-14) {
    const double middle = std::sqrt(low * high);
    if (middle <= low || middle >= high) break;
    (response(middle).force > force ? high : low) = middle;
  }
  return low;
}

std::string ContactLaw::name() const {
  return dissipation.none() ? elastic.name() : elastic.name() + " with " + dissipation.name();
}

}  // namespace yoke
