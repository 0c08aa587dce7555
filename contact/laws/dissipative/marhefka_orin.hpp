// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Marhefka and Orin 1999 (IEEE Trans. Syst. Man Cybern. A 29, 566-572), with a = alpha v_i = 1 - e:
//   F = K d^n (1 + 3 alpha (2 - a)/(2 (2 - 3 a + 3 a^2 - a^3)) d')
// here with any elastic law. Reviews print the bracket closed before d', which is dimensionally
// wrong.
//
// With e the factor is 3 (1 - e^2)/(2 (1 + e^3)), identical to Herbert and McWhannell. The
// logarithm of the exact balance is cut after its third power, so the law is meant for e above
// about 0.7. Delivered: 0.9009 for e = 0.9, 0.723 for 0.7, 0.594 for 0.5, never less than 0.48. No
// tension in a free impact. Floor on v_i: proportional_damping.hpp.
#pragma once

#include <string>

#include <yoke/contact/laws/forms/proportional_damping.hpp>

namespace yoke {

struct MarhefkaOrin {
  double e = 1.0;                  // 0 <= e <= 1
  double slowest_approach = 1e-3;  // [m/s], > 0

  static constexpr LawField<MarhefkaOrin> fields[] = {{"restitution", "", &MarhefkaOrin::e}};

  /// X, that is chi v_i
  double damping() const {
    const double a = 1.0 - e;  // alpha v_i
    return 3.0 * a * (2.0 - a) / (2.0 * (2.0 - 3.0 * a + 3.0 * a * a - a * a * a));
  }
  ContactOutput operator()(const ContactInput& in, const ElasticLaw& elastic) const {
    return damped_by_approach(in, elastic, damping(), slowest_approach);
  }
  std::string name() const { return "marhefka-orin"; }
  void check() const { check_damped_by_approach("law 'marhefka-orin'", e, 0.0, slowest_approach); }
};

}  // namespace yoke
