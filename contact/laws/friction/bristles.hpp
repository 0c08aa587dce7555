// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What the laws with bristles share. z is the deflection of bristles of stiffness k, which slip where
// the surfaces slide; G = N g(v) is the force under which they do:
//   z' = v - k |v| z/G        T = k z + c(v) z' + c_v v        S = k z^2/2
//   D = T v - S' = |v| (G u^2 + c |v| (1 - u) + c_v |v|)        u = k z sgn(v)/G
// With a constant c that is negative for some u where c |v| > 4 G (Barabanov, N.; Ortega, R. Necessary
// and sufficient conditions for passivity of the LuGre friction model. IEEE Trans. Autom. Control 2000,
// 45, 830-832). So the damping fades: c(v) = c/(1 + c |v|/(4 G)), which is c in presliding, and D >= 0
// always. N may change: k does not depend on it, and neither does S.
//
// Towards N = 0 the bristles slip ever faster. G is no less than a millionth of the friction under the
// reference force, which bounds the rate. Where the contact ends, the element sets z to zero and
// counts S as dissipated.
#pragma once

#include <cmath>

#include <yoke/contact/laws/friction/sliding_curve.hpp>

namespace yoke {

struct Bristles {
  double stiffness = 0.0;  // [N/m] k
  double damping = 0.0;    // [N s/m] c
  double viscous = 0.0;    // [N s/m] c_v
};

/// `g`: coefficient at the sliding velocity, > 0; `least`: its least value.
inline FrictionOutput friction_of_bristles(const FrictionInput& in, const Bristles& b,
                                           const FrictionCoefficient& g, double least) {
  const double v = in.sliding, speed = std::abs(v), sign = v < 0.0 ? -1.0 : 1.0;
  const double floor = 1e-6 * least * in.reference_force, limit = in.normal_force * g.value;
  const bool bounded = limit < floor;
  const double G = bounded ? floor : limit;
  // Relative change of G by N and by v.
  const double by_N = bounded ? 0.0 : g.value / G, by_v = bounded ? 0.0 : g.slope / g.value;

  const double slip_rate = b.stiffness * speed / G, slip = slip_rate * in.state;
  const double slip_N = -slip * by_N;
  const double slip_v = sign * b.stiffness * in.state / G - slip * by_v;
  const double rate = v - slip;

  const double fade = 1.0 + 0.25 * b.damping * speed / G, c = b.damping / fade;
  const double c_N = c / fade * (fade - 1.0) * by_N;
  const double c_v = -c / fade * (0.25 * b.damping * sign / G - (fade - 1.0) * by_v);

  FrictionOutput out;
  out.rate = rate;
  out.drate_dnormal = -slip_N;
  out.drate_dsliding = 1.0 - slip_v;
  out.drate_dstate = -slip_rate;
  out.force = b.stiffness * in.state + c * rate + b.viscous * v;
  out.dforce_dnormal = c_N * rate - c * slip_N;
  out.dforce_dsliding = c_v * rate + c * (1.0 - slip_v) + b.viscous;
  out.dforce_dstate = b.stiffness - c * slip_rate;
  out.stored_energy = 0.5 * b.stiffness * in.state * in.state;
  // T v - k z z' written so that nothing cancels.
  out.dissipated_power = b.stiffness * in.state * slip + (c * rate + b.viscous * v) * v;
  return out;
}

}  // namespace yoke
