// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Shared by laws with a damper parallel to the spring: F = F_e + c(d) d', S = U, D = c d'^2.
//
// The damper c = 2 xi sqrt(m_r) F_e/sqrt(2 U) makes every elastic law a linear oscillator: with
// q = sqrt(2 U), dq = (F_e/q) dd, and a clock that runs with F_e/q,
//   m_r d'' = -F_e - c d'   becomes   m_r v. = -q - 2 xi sqrt(m_r) v,   q. = v.
// So a free impact that lasts until d = 0 delivers exp(-pi xi/sqrt(1 - xi^2)), whatever the elastic
// law, the mass and the speed; one that ends where the force vanishes
//   exp(-(xi/s)(pi - atan2(2 xi s, 1 - 2 xi^2))),   s = sqrt(1 - xi^2).
// For F_e = K d the damper is Kelvin and Voigt's, for K d^n Tsuji's.
#pragma once

#include <cmath>

#include <yoke/contact/laws/forms/tensile_phase.hpp>
#include <yoke/core/types.hpp>

namespace yoke {

/// F = F_e + c d' with the derivative of c by the penetration. At the very end of a law both
/// derivatives may be infinite; then the stiffness is answered.
inline ContactOutput damped_beside(const ElasticResponse& e, double c, double dc_dd, double rate) {
  return {.force = e.force + c * rate,
          .dforce_dpenetration = std::isinf(e.stiffness) ? e.stiffness : e.stiffness + dc_dd * rate,
          .dforce_drate = c,
          .stored_energy = e.energy,
          .dissipated_power = c * rate * rate};
}

/// xi of a linear oscillator that returns e, 0 < e <= 1, when its tensile phase is kept.
inline double damping_ratio(double e) {
  const double log_e = std::log(e);
  return -log_e / std::sqrt(log_e * log_e + pi * pi);
}

/// What xi, 0 <= xi < 1, delivers.
inline double restitution_of_ratio(double xi, TensilePhase tensile) {
  const double s = std::sqrt((1.0 - xi) * (1.0 + xi));
  const double until_zero_force =
      tensile == TensilePhase::keep ? 0.0 : std::atan2(2.0 * xi * s, 1.0 - 2.0 * xi * xi);
  return std::exp(-xi / s * (pi - until_zero_force));
}

/// c = 2 xi sqrt(m_r) F_e/sqrt(2 U), even in d. At first touch F_e/sqrt(2 U) is the root of the
/// stiffness, which is zero for n > 1; its slope grows without bound there if n < 3.
inline ContactOutput damped_by_stored_energy(const ContactInput& in, const ElasticResponse& e,
                                             double xi) {
  const double scale = 2.0 * xi * std::sqrt(in.memory.effective_mass);
  if (!(e.energy > 1e-200)) return damped_beside(e, scale * std::sqrt(e.stiffness), 0.0, in.rate);
  const double root = std::sqrt(2.0 * e.energy), size = std::abs(e.force);
  const double sign = in.penetration < 0.0 ? -1.0 : 1.0;
  const double dc_dd = sign * scale * (e.stiffness - (size / root) * (size / root)) / root;
  return damped_beside(e, scale * size / root, dc_dd, in.rate);
}

/// The derivative of its force while e changes by `change`.
inline double damped_by_stored_energy_change(const ContactInput& in, const ElasticResponse& e,
                                             const ElasticResponse& change, double xi) {
  const double scale = 2.0 * xi * std::sqrt(in.memory.effective_mass);
  if (!(e.energy > 1e-200)) return change.force;  // at first touch, where it is as good as zero
  const double root = std::sqrt(2.0 * e.energy), sign = in.penetration < 0.0 ? -1.0 : 1.0;
  const double c_change =
      sign * scale * (change.force - e.force * change.energy / (2.0 * e.energy)) / root;
  return change.force + c_change * in.rate;
}

}  // namespace yoke
