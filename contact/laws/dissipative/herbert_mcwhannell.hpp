// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Herbert and McWhannell 1977: F = K d^(3/2) (1 + 6 (1 - e)/((2 e - 1)^2 + 3) d'/v_i) (J. Eng. Ind.
// 99, 513-518), here with any elastic law. Identical to Marhefka and Orin, since the factor is
// 3 (1 - e^2)/(2 (1 + e^3)): Hunt and Crossley's balance to second order.
//
// Meant for e above about 0.7. Delivered: 0.9009 for e = 0.9, 0.723 for 0.7, 0.594 for 0.5, never
// less than 0.48. No tension in a free impact. Floor on v_i: proportional_damping.hpp.
//
// Their empirical restitution e = 1 - 0.026 v^(1/3), v in mm/s, is quoted by the literature; the
// original was not at hand. It falls to zero at 56.9 m/s and stays there.
#pragma once

#include <cmath>
#include <string>

#include <yoke/contact/laws/forms/proportional_damping.hpp>

namespace yoke {

struct HerbertMcWhannell {
  double e = 1.0;                  // 0 <= e <= 1
  double slowest_approach = 1e-3;  // [m/s], > 0

  static constexpr LawField<HerbertMcWhannell> fields[] = {
      {"restitution", "", &HerbertMcWhannell::e}};

  /// X, that is chi v_i.
  double damping() const { return 6.0 * (1.0 - e) / ((2.0 * e - 1.0) * (2.0 * e - 1.0) + 3.0); }
  ContactOutput operator()(const ContactInput& in, const ElasticLaw& elastic) const {
    return damped_by_approach(in, elastic, damping(), slowest_approach);
  }
  std::string name() const { return "herbert-mcwhannell"; }
  void check() const {
    check_damped_by_approach("law 'herbert-mcwhannell'", e, 0.0, slowest_approach);
  }
};

/// e = 1 - 0.026 v^(1/3), v in mm/s; not below 0. The argument is in m/s.
inline double empirical_restitution(double approach_velocity) {
  return std::max(0.0, 1.0 - 0.026 * std::cbrt(1e3 * approach_velocity));
}

/// The law with the empirical e of each contact's approach velocity.
struct HerbertMcWhannellEmpirical {
  double slowest_approach = 1e-3;  // [m/s], > 0

  ContactOutput operator()(const ContactInput& in, const ElasticLaw& elastic) const {
    const double v_i = std::max(in.memory.approach_velocity, slowest_approach);
    return HerbertMcWhannell{empirical_restitution(v_i), slowest_approach}(in, elastic);
  }
  std::string name() const { return "herbert-mcwhannell"; }
  void check() const {
    require_positive("law 'herbert-mcwhannell'", "slowest_approach", slowest_approach, "m/s");
  }
};

}  // namespace yoke
