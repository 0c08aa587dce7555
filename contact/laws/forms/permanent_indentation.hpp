// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What laws that leave a dent share. Loading follows F_e(d); unloading from the largest penetration
// d_m follows F_e stretched between d_p = d_m (1 - e^2), where the contact ends, and d_m:
//   F = F_e((d - d_p)/e^2),   for F_e = K d^n   F_m ((d - d_p)/(d_m - d_p))^n
// The unloading line returns e^2 of the work of loading, so e is delivered exactly for every
// elastic law, mass and speed. Stored while loading is what unloading from there would give back,
// e^2 U; the rest is dissipated as it is done. Nothing is dissipated on the unloading line.
//
// Memory. A reload before separation runs up the unloading line to d_m and is loading again beyond.
// After separation the dent is met again at d_p until the surfaces have been apart at d = 0. There
// is no velocity in the law, so none in a lasting contact: it loses energy only where it passes its
// largest penetration.
#pragma once

#include <yoke/contact/laws/law.hpp>

namespace yoke {

/// Force and energies of a law that returns e^2 of the work of loading, see above.
inline ContactOutput with_permanent_indentation(const ContactInput& in, const ElasticLaw& elastic,
                                                double e) {
  const double returned = e * e;
  if (in.memory.phase != ContactPhase::restituting) {
    const ElasticResponse r = elastic.response(in.penetration);
    return {.force = r.force,
            .dforce_dpenetration = r.stiffness,
            .stored_energy = returned * r.energy,
            .dissipated_power = (1.0 - returned) * r.force * in.rate};
  }
  const double x = (in.penetration - in.memory.permanent_set) / returned;
  if (x < -elastic.limit()) {  // far below the set, where the law has no value
    const ElasticResponse r = elastic.response(elastic.limit());
    return {.force = -r.force,
            .stored_energy = returned * r.energy,
            .dissipated_power = -r.force * in.rate};
  }
  const ElasticResponse r = elastic.response(x);
  return {.force = r.force,
          .dforce_dpenetration = r.stiffness / returned,
          .stored_energy = returned * r.energy};
}

/// [m] d_p = d_m (1 - e^2).
inline double permanent_indentation(const ContactMemory& memory, double e) {
  return memory.largest_penetration * (1.0 - e) * (1.0 + e);
}

}  // namespace yoke
