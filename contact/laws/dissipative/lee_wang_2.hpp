// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Lee and Wang 1983, second damping function (J. Mech. Transm. Autom. Des. 105, 534-540):
//   F = K d + 2 m_r w xi T(d) d',   w = sqrt(K/m_r),   xi = -ln e/sqrt(ln^2 e + pi^2)
//   T = exp(((d - eps) - |d - eps|) q/eps)
// Kelvin and Voigt's damper, faded in between first touch and d = eps. They leave eps undetermined
// between 0 and the largest penetration; here it is a share of v_i/w, the largest penetration
// without damping.
//
// Needs a linear elastic law; with another, K is the local stiffness and the derivative of the
// force by the penetration neglects its change. There is no closed form. Delivered is more than e,
// and the more the wider the transition: for e = 0.5 and q = 3, 0.554 with a share of 0.1, 0.755
// with 0.5. The force steps at first touch by exp(-2 q) of c v_i and pulls at the end unless q and
// eps are large. e = 0 is refused. v_i enters through eps and has the floor `slowest_approach`.
//
// Lee and Wang require q and eps such that the force never becomes tensile. If it does and is
// clamped, the contact ends, may begin once more because T fades before the spring force does, and
// ends again just before d = 0.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include <yoke/contact/laws/forms/proportional_damping.hpp>
#include <yoke/contact/laws/forms/viscous_damping.hpp>

namespace yoke {

struct LeeWang2 {
  double e = 1.0;        // least_restitution <= e <= 1
  double q = 3.0;        // 0 < q <= 100; 2, 3 and 4 are theirs
  double epsilon = 0.1;  // eps as a share of v_i/w, 1e-6 to 1
  TensilePhase tensile = TensilePhase::keep;
  double slowest_approach = 1e-3;  // [m/s], > 0

  static constexpr LawField<LeeWang2> fields[] = {{"restitution", "", &LeeWang2::e}};

  ContactOutput operator()(const ContactInput& in, const ElasticLaw& elastic) const {
    const ElasticResponse r = elastic.response(in.penetration);
    if (!(r.stiffness > 1e-100 && in.memory.effective_mass > 0.0))
      return damped_beside(r, 0.0, 0.0, in.rate);
    const double m = in.memory.effective_mass, w = std::sqrt(r.stiffness / m);
    const double eps = end_of_transition(in.memory, w);
    const bool within = in.penetration < eps;
    const double T = within ? std::exp(2.0 * q * (in.penetration - eps) / eps) : 1.0;
    const double c = 2.0 * m * w * damping_ratio(e) * T;
    return damped_beside(r, c, within ? 2.0 * q / eps * c : 0.0, in.rate);
  }
  /// T has a corner at d = eps.
  double kink(const ContactInput& in, const ElasticLaw& elastic) const {
    const ElasticResponse r = elastic.response(in.penetration);
    if (!(r.stiffness > 1e-100 && in.memory.effective_mass > 0.0)) return -1.0;
    return in.penetration -
           end_of_transition(in.memory, std::sqrt(r.stiffness / in.memory.effective_mass));
  }
  Release release() const { return release_of(tensile); }
  std::string name() const { return "lee-wang-2"; }
  void check() const {
    require_range("law 'lee-wang-2'", "e", e, least_restitution, 1.0);
    require_positive("law 'lee-wang-2'", "q", q, "");
    require_range("law 'lee-wang-2'", "q", q, 0.0, 100.0);
    require_range("law 'lee-wang-2'", "epsilon", epsilon, 1e-6, 1.0);
    require_positive("law 'lee-wang-2'", "slowest_approach", slowest_approach, "m/s");
  }

 private:
  double end_of_transition(const ContactMemory& memory, double w) const {  // eps [m]
    return epsilon * std::max(memory.approach_velocity, slowest_approach) / w;
  }
};

}  // namespace yoke
