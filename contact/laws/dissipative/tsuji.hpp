// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Tsuji, Tanaka and Ishida 1992: F = K d^(3/2) + chi sqrt(m_r K) d^(1/4) d' (Powder Technol. 71,
// 239-250), chi read from a curve against e. The curve is chi = -sqrt(5) ln e/sqrt(ln^2 e + pi^2).
//
// For F_e = K d^n the same is c = chi sqrt(m_r K) d^((n-1)/2), chi = sqrt(2 (n + 1)) xi. Since
// F_e/d = K d^(n-1) and F_e d/U = n + 1, that is c = 2 xi sqrt(m_r) F_e/sqrt(2 U), which is how it
// is written here and how it takes any elastic law.
//
// Delivered: exactly e if the tensile phase is kept, as the curve implies; clamped, 0.902 for e =
// 0.9, 0.550 for 0.5, 0.253 for 0.1. The force pulls at the end, by up to 14 % of the largest
// force. e = 0 would never separate and is refused. No floor on v_i is needed: c depends on the
// effective mass of the onset alone, and a lasting contact is damped with a ratio of about xi.
#pragma once

#include <string>

#include <yoke/contact/laws/forms/proportional_damping.hpp>
#include <yoke/contact/laws/forms/viscous_damping.hpp>

namespace yoke {

struct Tsuji {
  double e = 1.0;  // least_restitution <= e <= 1
  TensilePhase tensile = TensilePhase::keep;

  static constexpr LawField<Tsuji> fields[] = {{"restitution", "", &Tsuji::e}};

  ContactOutput operator()(const ContactInput& in, const ElasticLaw& elastic) const {
    return damped_by_stored_energy(in, elastic.response(in.penetration), damping_ratio(e));
  }
  double force_change(const ContactInput& in, const ElasticLaw& elastic,
                      const ElasticLaw& change) const {
    return damped_by_stored_energy_change(in, elastic.response(in.penetration),
                                          change.response(in.penetration), damping_ratio(e));
  }
  Release release() const { return release_of(tensile); }
  std::string name() const { return "tsuji"; }
  void check() const { require_range("law 'tsuji'", "e", e, least_restitution, 1.0); }
};

}  // namespace yoke
