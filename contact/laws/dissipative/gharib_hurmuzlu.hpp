// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Gharib and Hurmuzlu 2012, first law: F = K d^n (1 + d'/(e v_i)) (J. Appl. Mech. 79), here with
// any elastic law.
//
// For small e only: the rebound approaches the speed -e v_i but does not reach it, so the delivered
// restitution is less than e: 0.09998 for e = 0.1, 0.282 for 0.3, 0.411 for 0.5, and at e = 1,
// where nothing should be lost, 0.594. No tension in a free impact. Floor on v_i:
// proportional_damping.hpp.
#pragma once

#include <string>

#include <yoke/contact/laws/forms/proportional_damping.hpp>

namespace yoke {

struct GharibHurmuzlu {
  double e = 1.0;                  // least_restitution <= e <= 1
  double slowest_approach = 1e-3;  // [m/s], > 0

  static constexpr LawField<GharibHurmuzlu> fields[] = {{"restitution", "", &GharibHurmuzlu::e}};

  double damping() const { return 1.0 / e; }  ///< X, that is chi v_i
  ContactOutput operator()(const ContactInput& in, const ElasticLaw& elastic) const {
    return damped_by_approach(in, elastic, damping(), slowest_approach);
  }
  std::string name() const { return "gharib-hurmuzlu"; }
  void check() const {
    check_damped_by_approach("law 'gharib-hurmuzlu'", e, least_restitution, slowest_approach);
  }
};

}  // namespace yoke
