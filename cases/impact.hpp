// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// One central impact through the engine: bodies, a contact element, located events, an integrator.
//
//   two bodies  a (mass 3/2 m) flies into b (mass 3 m) at rest; both end free, effective mass m
//   wall        a (mass m) flies into a wall
//
// Largest penetration and largest force are not read from samples: a gauge watches the rate and
// dF/dt and is called where they cross zero. It acts on nothing and does not restart the
// integrator.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <yoke/contact/law.hpp>

namespace yoke::cases {

struct Impact {
  enum class Setup { two_bodies, wall };

  ContactLaw law;
  double speed = 0.0;  // [m/s] of approach, > 0
  double mass = 0.0;   // [kg] effective, > 0
  Setup setup = Setup::two_bodies;
  double relative_tolerance = 1e-12;
  std::string formulation = "arkode-projection";
  int samples = 0;  // of the loop
};

struct LoopPoint {
  double t, penetration, rate, force;  // [s, m, m/s, N]
};

struct ImpactOutcome {
  double restitution = 0.0;
  double max_penetration = 0.0;  // [m]
  double max_force = 0.0;        // [N]
  double duration = 0.0;         // [s] from first touch to separation
  double permanent_set = 0.0;    // [m]
  double dissipated = 0.0;       // [J] by the law's own formula, integrated along the run
  double kinetic_loss = 0.0;     // [J] of the bodies
  double momentum_error = 0.0;   // of the total momentum, relative; two bodies only
  long steps = 0;
  std::vector<LoopPoint> loop;
};

/// Throws ModelError for a parameter out of range, and if the run fails or the surfaces do not
/// part.
ImpactOutcome simulate_impact(const Impact& impact);

/// n of a power law K d^n, found from the law itself; nothing for any other law.
std::optional<double> power_of(const ElasticLaw& law);

}  // namespace yoke::cases
