// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// One dissipative law of every kind the literature knows, to show that the interface takes them
// all: proportional damping (in the library), damping with the effective mass, a step of force at
// first touch, a permanent set with memory, a transition function of the penetration.
#pragma once

#include <cmath>

#include <yoke/contact/law.hpp>
#include <yoke/core/types.hpp>

namespace yoke::test {

/// F = F_e + c(d) d', D = c d'^2.
inline ContactOutput viscous(const ElasticResponse& e, double c, double dc_dd, double rate) {
  return {.force = e.force + c * rate,
          .dforce_dpenetration = e.stiffness + dc_dd * rate,
          .dforce_drate = c,
          .stored_energy = e.energy,
          .dissipated_power = c * rate * rate};
}

/// Damping ratio of a linear oscillator with restitution e, tension included.
inline double damping_ratio(double e) {
  return -std::log(e) / std::sqrt(std::log(e) * std::log(e) + pi * pi);
}

/// Kelvin and Voigt: F = K d + c d', c = 2 xi sqrt(m K), for a linear elastic law.
struct KelvinVoigt {
  double xi = 0.0;
  Release rule = Release::at_zero_force;
  ContactOutput operator()(const ContactInput& in, const ElasticLaw& elastic) const {
    const ElasticResponse e = elastic.response(in.penetration);
    const double c = 2.0 * xi * std::sqrt(in.memory.effective_mass * e.stiffness);
    return viscous(e, c, 0.0, in.rate);
  }
  Release release() const { return rule; }
};

/// Tsuji 1992 for F_e = K d^n: c = chi sqrt(m K) d^((n-1)/2), chi = xi sqrt(2 (n+1)).
struct Tsuji {
  double xi = 0.0, K = 0.0, n = 1.5;
  Release rule = Release::at_zero_force;
  ContactOutput operator()(const ContactInput& in, const ElasticLaw& elastic) const {
    const double m = in.memory.effective_mass, d = std::abs(in.penetration);
    const double c = xi * std::sqrt(2.0 * (n + 1.0) * m * K) * std::pow(d, 0.5 * (n - 1.0));
    const double dc_dd = d > 0.0 ? 0.5 * (n - 1.0) * c / in.penetration : 0.0;
    return viscous(elastic.response(in.penetration), c, dc_dd, in.rate);
  }
  Release release() const { return rule; }
};

/// The same for any elastic law: c = 2 xi sqrt(m) F_e / sqrt(2 U); delivers e exactly.
struct ExactRestitution {
  double e = 1.0;
  ContactOutput operator()(const ContactInput& in, const ElasticLaw& elastic) const {
    const ElasticResponse r = elastic.response(in.penetration);
    if (!(r.energy > 0.0)) return viscous(r, 0.0, 0.0, in.rate);
    const double scale = 2.0 * damping_ratio(e) * std::sqrt(0.5 * in.memory.effective_mass);
    const double root = std::sqrt(r.energy), force = std::abs(r.force);
    const double sign = in.penetration < 0.0 ? -1.0 : 1.0;
    const double c = scale * force / root;
    const double dc_dd = sign * scale * (r.stiffness - 0.5 * force * force / r.energy) / root;
    return viscous(r, c, dc_dd, in.rate);
  }
  Release release() const { return Release::at_zero_penetration; }
};

/// Lee and Wang 1983, second function: F = K d + 2 m w xi T(d) d', T = exp([(d-eps) - |d-eps|]
/// q/eps).
struct LeeWang2 {
  double xi = 0.0, q = 2.0;
  double width = 0.1;  // eps = width * v_i/w
  ContactOutput operator()(const ContactInput& in, const ElasticLaw& elastic) const {
    const ElasticResponse r = elastic.response(in.penetration);
    const double m = in.memory.effective_mass, w = std::sqrt(r.stiffness / m);
    const double eps = width * in.memory.approach_velocity / w;
    const bool within = in.penetration < eps;
    const double T = within ? std::exp(2.0 * q * (in.penetration - eps) / eps) : 1.0;
    const double c = 2.0 * m * w * xi * T;
    return viscous(r, c, within ? 2.0 * q / eps * c : 0.0, in.rate);
  }
  Release release() const { return Release::at_zero_penetration; }
};

/// Lankarani and Nikravesh 1994: loading F_e(d); unloading from d_m along F_e stretched between
/// d_p = d_m (1 - e^2) and d_m, which for F_e = K d^n is F_m ((d - d_p)/(d_m - d_p))^n. Stored
/// while loading is what unloading from there would give back, e^2 U.
struct PermanentSet {
  double e = 1.0;
  ContactOutput operator()(const ContactInput& in, const ElasticLaw& elastic) const {
    if (in.memory.phase != ContactPhase::restituting) {
      const ElasticResponse r = elastic.response(in.penetration);
      return {.force = r.force,
              .dforce_dpenetration = r.stiffness,
              .stored_energy = e * e * r.energy,
              .dissipated_power = (1.0 - e * e) * r.force * in.rate};
    }
    const double d_m = in.memory.largest_penetration, d_p = in.memory.permanent_set;
    const double stretch = d_m / (d_m - d_p);
    const ElasticResponse r = elastic.response(stretch * (in.penetration - d_p));
    return {.force = r.force,
            .dforce_dpenetration = stretch * r.stiffness,
            .stored_energy = r.energy / stretch};
  }
  double permanent_set(const ContactMemory& memory, const ElasticLaw&) const {
    return memory.largest_penetration * (1.0 - e * e);
  }
};

}  // namespace yoke::test
