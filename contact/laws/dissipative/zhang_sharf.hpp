// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Zhang and Sharf 2009: F = K d^n (1 + chi d') with chi the root of the exact balance
// chi v_i (1 + e) = ln((1 + chi v_i)/(1 - e chi v_i)) (J. Appl. Mech. 76, 051002), here with any
// elastic law. The same law as that of Gonthier and others 2004, found independently; the original
// was not at hand, the balance is derived in proportional_damping.hpp.
//
// Delivers the requested e for every elastic law. Meant for all e > 0; towards e = 0 the damping
// grows as 1/e, and e = 0 is refused. No tension in a free impact. Floor on v_i:
// proportional_damping.hpp.
#pragma once

#include <string>

#include <yoke/contact/laws/forms/proportional_damping.hpp>

namespace yoke {

class ZhangSharf {
 public:
  /// least_restitution <= e <= 1, slowest_approach [m/s] > 0. Throws ModelError.
  explicit ZhangSharf(double e, double slowest_approach = 1e-3)
      : slowest_approach_(slowest_approach) {
    check_damped_by_approach("law 'zhang-sharf'", e, least_restitution, slowest_approach);
    damping_ = damping_for_restitution(e);
  }

  double damping() const { return damping_; }  ///< X, that is chi v_i
  ContactOutput operator()(const ContactInput& in, const ElasticLaw& elastic) const {
    return damped_by_approach(in, elastic, damping_, slowest_approach_);
  }
  std::string name() const { return "zhang-sharf"; }

 private:
  double damping_ = 0.0, slowest_approach_;
};

}  // namespace yoke
