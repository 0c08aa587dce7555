// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Kelvin and Voigt: F = K d + c d', c = 2 xi sqrt(m_r K), xi = -ln e/sqrt(ln^2 e + pi^2); used for
// impacts by Dubowsky and Freudenstein 1971 (J. Eng. Ind. 93, 305-316) and many others.
//
// Needs a linear elastic law. With another, the secant F_e/d takes the place of K, which is
// no published law. The force steps to c v_i at first touch and pulls at the end of the impact.
// Delivered: exactly e if the tensile phase is kept; clamped, 0.902 for e = 0.9, 0.550 for 0.5,
// 0.253 for 0.1. e = 0 would be critical damping and never separate, and is refused. No floor on
// v_i is needed: c depends on the effective mass of the onset alone, and a lasting contact is
// damped with the ratio xi.
#pragma once

#include <cmath>
#include <string>

#include <yoke/contact/laws/forms/proportional_damping.hpp>
#include <yoke/contact/laws/forms/viscous_damping.hpp>

namespace yoke {

struct KelvinVoigt {
  double e = 1.0;  // least_restitution <= e <= 1
  TensilePhase tensile = TensilePhase::keep;

  static constexpr LawField<KelvinVoigt> fields[] = {{"restitution", "", &KelvinVoigt::e}};

  ContactOutput operator()(const ContactInput& in, const ElasticLaw& elastic) const {
    const ElasticResponse r = elastic.response(in.penetration);
    const double scale = 2.0 * damping_ratio(e) * std::sqrt(in.memory.effective_mass);
    if (!(std::abs(r.force) > 1e-100 && std::abs(in.penetration) > 1e-100))
      return damped_beside(r, scale * std::sqrt(r.stiffness), 0.0, in.rate);
    const double secant = r.force / in.penetration, c = scale * std::sqrt(secant);
    const double dc_dd = 0.5 * c * (r.stiffness / r.force - 1.0 / in.penetration);
    return damped_beside(r, c, dc_dd, in.rate);
  }
  double force_change(const ContactInput& in, const ElasticLaw& elastic,
                      const ElasticLaw& change) const {
    const ElasticResponse r = elastic.response(in.penetration),
                          dr = change.response(in.penetration);
    const double scale = damping_ratio(e) * std::sqrt(in.memory.effective_mass) * in.rate;
    if (!(std::abs(r.force) > 1e-100 && std::abs(in.penetration) > 1e-100)) return dr.force;
    return dr.force + scale * dr.force / std::sqrt(r.force * in.penetration);
  }
  Release release() const { return release_of(tensile); }
  std::string name() const { return "kelvin-voigt"; }
  void check() const { require_range("law 'kelvin-voigt'", "e", e, least_restitution, 1.0); }
};

}  // namespace yoke
