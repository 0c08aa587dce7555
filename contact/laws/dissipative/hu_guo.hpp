// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Hu and Guo 2015: F = K d^n (1 + 3 (1 - e)/(2 e) d'/v_i) (Multibody Syst. Dyn. 35, 131-151).
// Derived for n = 3/2, the factor is the same for every n; here with any elastic law.
//
// Meant for all e > 0. Delivered: 0.8999 for e = 0.9, 0.697 for 0.7, 0.488 for 0.5, 0.074 for 0.1:
// the best of the explicit laws of its time. e = 0 would take infinite damping and is refused. No
// tension in a free impact. Floor on v_i: proportional_damping.hpp.
#pragma once

#include <string>

#include <yoke/contact/laws/forms/proportional_damping.hpp>

namespace yoke {

struct HuGuo {
  double e = 1.0;                  // least_restitution <= e <= 1
  double slowest_approach = 1e-3;  // [m/s], > 0

  static constexpr LawField<HuGuo> fields[] = {{"restitution", "", &HuGuo::e}};

  double damping() const { return 1.5 * (1.0 - e) / e; }  ///< X, that is chi v_i
  ContactOutput operator()(const ContactInput& in, const ElasticLaw& elastic) const {
    return damped_by_approach(in, elastic, damping(), slowest_approach);
  }
  std::string name() const { return "hu-guo"; }
  void check() const {
    check_damped_by_approach("law 'hu-guo'", e, least_restitution, slowest_approach);
  }
};

}  // namespace yoke
