// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Marhefka and Orin 1999, powers of alpha v_i from the second on neglected in the denominator:
//   F = K d^n (1 + 3 alpha (2 - alpha v_i)/(2 (2 - 3 alpha v_i)) d'),   alpha v_i = 1 - e
// (IEEE Trans. Syst. Man Cybern. A 29, 566-572), here with any elastic law.
//
// With e: 3 (1 - e^2)/(2 (3 e - 1)), infinite at e = 1/3 and a source of energy below, so e <= 1/3
// is refused. Delivered: 0.8994 for e = 0.9, 0.680 for 0.7, 0.380 for 0.5. No tension in a free
// impact. Floor on v_i: proportional_damping.hpp.
#pragma once

#include <string>

#include <yoke/contact/laws/forms/proportional_damping.hpp>

namespace yoke {

struct MarhefkaOrinSimplified {
  double e = 1.0;                  // 1/3 < e <= 1
  double slowest_approach = 1e-3;  // [m/s], > 0

  static constexpr LawField<MarhefkaOrinSimplified> fields[] = {
      {"restitution", "", &MarhefkaOrinSimplified::e}};

  /// X, that is chi v_i
  double damping() const { return 1.5 * (1.0 - e) * (1.0 + e) / (3.0 * e - 1.0); }
  ContactOutput operator()(const ContactInput& in, const ElasticLaw& elastic) const {
    return damped_by_approach(in, elastic, damping(), slowest_approach);
  }
  std::string name() const { return "marhefka-orin-simplified"; }
  void check() const {
    if (!(3.0 * e - 1.0 > 0.0 && e <= 1.0))
      throw ModelError(
          fmt::format("law 'marhefka-orin-simplified': e = {:g} is outside the accepted range "
                      "1/3 < e <= 1: the damping is infinite at 1/3 and a source of energy below",
                      e));
    require_positive("law 'marhefka-orin-simplified'", "slowest_approach", slowest_approach, "m/s");
  }
};

}  // namespace yoke
