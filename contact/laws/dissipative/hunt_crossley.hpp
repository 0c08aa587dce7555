// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Hunt and Crossley 1975: F = F_e (1 + 3/2 alpha d'), with any elastic law F_e.
//
// They intend the restitution to be e = 1 - alpha v_i with constant alpha, and e with alpha =
// (1 - e)/v_i. A free impact delivers, for any F_e and mass,
//   X (1 + e') = ln((1 + X)/(1 - e' X)),   X = 3/2 alpha v_i,
// for instance e' = 0.909 for e = 0.9, 0.663 for e = 0.5.
#pragma once

#include <algorithm>
#include <string>

#include <yoke/contact/laws/law.hpp>
#include <yoke/core/error.hpp>

namespace yoke {

struct HuntCrossley {
  double alpha = 0.0;  // [s/m], >= 0; 0.08 to 0.32 for steel, bronze and ivory

  static constexpr LawField<HuntCrossley> fields[] = {{"alpha", "s/m", &HuntCrossley::alpha}};

  ContactOutput operator()(const ContactInput& in, const ElasticLaw& elastic) const {
    return damped_in_proportion(elastic.response(in.penetration), 1.5 * alpha, in.rate);
  }
  std::string name() const { return "hunt-crossley"; }
  void check() const { require_not_negative("law 'hunt-crossley'", "alpha", alpha, "s/m"); }
};

/// alpha = (1 - e)/v_i with the approach velocity v_i of each contact.
///
/// `slowest_approach` is a floor on v_i: a contact that begins at rest has v_i = 0 and alpha would
/// be infinite. Below the floor alpha stays at (1 - e)/slowest_approach, so slow impacts tend to e
/// = 1, as Hunt and Crossley observed. The default of 1 mm/s is a hundredth of the impacts in a
/// machine with clearance (0.1 to 1 m/s). With e = 0.9, 2.4 kg pressed with 1 kN on a steel wall
/// are then damped 8 times above critical; a floor of 1e-6 m/s would make it 8000 times, and the
/// equations as stiff as that.
struct HuntCrossleyRestitution {
  double e = 1.0;                  // 0 <= e <= 1
  double slowest_approach = 1e-3;  // [m/s], > 0

  static constexpr LawField<HuntCrossleyRestitution> fields[] = {
      {"restitution", "", &HuntCrossleyRestitution::e}};

  ContactOutput operator()(const ContactInput& in, const ElasticLaw& elastic) const {
    const double alpha = (1.0 - e) / std::max(in.memory.approach_velocity, slowest_approach);
    return damped_in_proportion(elastic.response(in.penetration), 1.5 * alpha, in.rate);
  }
  std::string name() const { return "hunt-crossley-restitution"; }
  void check() const {
    require_range("law 'hunt-crossley-restitution'", "e", e, 0.0, 1.0);
    require_positive("law 'hunt-crossley-restitution'", "slowest_approach", slowest_approach,
                     "m/s");
  }
};

/// The law with the chi that its authors give for a restitution e; `slowest_approach` [m/s].
inline HuntCrossleyRestitution hunt_crossley_restitution(double e, double slowest_approach = 1e-3) {
  return {e, slowest_approach};
}

}  // namespace yoke
