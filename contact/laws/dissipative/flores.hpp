// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Flores, Machado, Silva and Martins 2011: F = K d^n (1 + 8 (1 - e)/(5 e) d'/v_i) (Multibody Syst.
// Dyn. 25, 357-375). The factor 8/5 was derived for n = 3/2; here with any elastic law F_e for K
// d^n.
//
// Meant for all e > 0. Delivered: 0.894 for e = 0.9, 0.683 for 0.7, 0.470 for 0.5, 0.069 for 0.1. e
// = 0 would take infinite damping and is refused. No tension in a free impact. Floor on v_i:
// proportional_damping.hpp.
#pragma once

#include <string>

#include <yoke/contact/laws/forms/proportional_damping.hpp>

namespace yoke {

struct Flores {
  double e = 1.0;                  // least_restitution <= e <= 1
  double slowest_approach = 1e-3;  // [m/s], > 0

  static constexpr LawField<Flores> fields[] = {{"restitution", "", &Flores::e}};

  double damping() const { return 1.6 * (1.0 - e) / e; }  ///< X, that is chi v_i
  ContactOutput operator()(const ContactInput& in, const ElasticLaw& elastic) const {
    return damped_by_approach(in, elastic, damping(), slowest_approach);
  }
  std::string name() const { return "flores"; }
  void check() const {
    check_damped_by_approach("law 'flores'", e, least_restitution, slowest_approach);
  }
};

}  // namespace yoke
