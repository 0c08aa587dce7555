// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Gonthier, McPhee, Lange and Piedboeuf 2004: F = K d^n (1 + (d_G/(e v_i)) d') with d_G, 0 < d_G <
// 1, the root of (1 + d_G/e)/(1 - d_G) = exp(d_G (1 + 1/e)) (Multibody Syst. Dyn. 11, 209-233),
// here with any elastic law.
//
// With X = d_G/e that is the exact balance of proportional_damping.hpp, so the law delivers the
// requested e for every elastic law. Meant for all e > 0; towards e = 0 the damping grows as 1/e,
// and e = 0 is refused. No tension in a free impact. Floor on v_i: proportional_damping.hpp.
#pragma once

#include <string>

#include <yoke/contact/laws/forms/proportional_damping.hpp>

namespace yoke {

class Gonthier {
 public:
  /// least_restitution <= e <= 1, slowest_approach [m/s] > 0. Throws ModelError.
  explicit Gonthier(double e, double slowest_approach = 1e-3)
      : slowest_approach_(slowest_approach) {
    check_damped_by_approach("law 'gonthier'", e, least_restitution, slowest_approach);
    damping_ = damping_for_restitution(e);
  }

  double damping() const { return damping_; }  ///< X, that is chi v_i
  ContactOutput operator()(const ContactInput& in, const ElasticLaw& elastic) const {
    return damped_by_approach(in, elastic, damping_, slowest_approach_);
  }
  std::string name() const { return "gonthier"; }

 private:
  double damping_ = 0.0, slowest_approach_;
};

}  // namespace yoke
