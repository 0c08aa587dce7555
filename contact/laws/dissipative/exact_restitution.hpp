// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// F = F_e + c d', c = 2 xi sqrt(m_r) F_e/sqrt(2 U), xi = -ln e/sqrt(ln^2 e + pi^2): the damper that
// makes any elastic law a linear oscillator (derived in viscous_damping.hpp). For K d^n it is
// Tsuji's.
//
// Delivered: exactly e for every elastic law, mass and speed if the tensile phase is kept; clamped,
// 0.902 for e = 0.9, 0.550 for 0.5, 0.253 for 0.1. The force pulls at the end, by up to 14 % of the
// largest force. e = 0 would never separate and is refused. No floor on v_i is needed: c depends on
// the effective mass of the onset alone, and a lasting contact is damped with a ratio of about xi.
#pragma once

#include <string>

#include <yoke/contact/laws/forms/proportional_damping.hpp>
#include <yoke/contact/laws/forms/viscous_damping.hpp>

namespace yoke {

struct ExactRestitution {
  double e = 1.0;  // least_restitution <= e <= 1
  TensilePhase tensile = TensilePhase::keep;

  static constexpr LawField<ExactRestitution> fields[] = {
      {"restitution", "", &ExactRestitution::e}};

  ContactOutput operator()(const ContactInput& in, const ElasticLaw& elastic) const {
    return damped_by_stored_energy(in, elastic.response(in.penetration), damping_ratio(e));
  }
  double force_change(const ContactInput& in, const ElasticLaw& elastic,
                      const ElasticLaw& change) const {
    return damped_by_stored_energy_change(in, elastic.response(in.penetration),
                                          change.response(in.penetration), damping_ratio(e));
  }
  Release release() const { return release_of(tensile); }
  std::string name() const { return "exact-restitution"; }
  void check() const { require_range("law 'exact-restitution'", "e", e, least_restitution, 1.0); }
};

}  // namespace yoke
