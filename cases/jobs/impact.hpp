// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// One central impact through the engine: bodies, a contact element, located events, an integrator.
//
//   two bodies  a (mass 3/2 m) flies into b (mass 3 m) at rest; both end free, effective mass m
//   wall        a (mass m) flies into a wall
//   slot        a pin (mass 3/2 m) flies into the outer wall of an arc slot in b (mass 3 m), at
//   rest
//               and free; the normal passes through both centres of mass, effective mass m
//   pendulum    a body on a fixed pivot swings into a stop whose normal is perpendicular to the
//   arm;
//               no gravity. With c from the pivot to the centre of mass and the arm L, effective
//               mass m = (I + m_p c^2)/L^2. L is 1.25e5 times the elastic penetration, so that the
//               way along the arc and the way along the normal agree to 1e-11.
//
// Largest penetration and largest force are not read from samples: a gauge watches the rate and
// dF/dt and is called where they cross zero. It acts on nothing and does not restart the
// integrator.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <yoke/contact/laws/law.hpp>

namespace yoke::cases {

struct CentralImpact {
  enum class Setup { two_bodies, wall, slot, pendulum };

  ContactLaw law;
  double speed = 0.0;  // [m/s] of approach, > 0
  double mass = 0.0;   // [kg] effective, > 0
  Setup setup = Setup::two_bodies;
  double relative_tolerance = 1e-12;
  std::string formulation = "arkode-projection";
  int order = 0;    // of explicit steps, see SimulationOptions
  int samples = 0;  // of the loop
};

struct LoopPoint {
  double t, penetration, rate, force;  // [s, m, m/s, N]
};

struct ImpactOutcome {
  double restitution = 0.0;
  double max_penetration = 0.0;  // [m]
  double max_force = 0.0;        // [N]
  double duration = 0.0;         // [s] from first touch to the last separation
  double permanent_set = 0.0;    // [m]
  double dissipated = 0.0;       // [J] by the law's own formula, integrated along the run
  double kinetic_loss = 0.0;     // [J] of the bodies
  double momentum_error = 0.0;   // of the total momentum, relative; where nothing is fixed
  long steps = 0;
  std::vector<LoopPoint> loop;
};

/// "bodies", "wall", "slot", "pendulum", as on the command line.
std::string name_of(CentralImpact::Setup setup);
/// Throws ModelError that lists the names.
CentralImpact::Setup setup_named(std::string_view name);
inline constexpr CentralImpact::Setup all_setups[] = {
    CentralImpact::Setup::two_bodies, CentralImpact::Setup::wall, CentralImpact::Setup::slot,
    CentralImpact::Setup::pendulum};

/// Throws ModelError for a parameter out of range, and if the run fails or the surfaces do not
/// part.
ImpactOutcome simulate_impact(const CentralImpact& impact);

/// The loop as a table: t_s, penetration_m, rate_m_per_s, force_N; while the surfaces touch.
std::string loop_csv(const std::vector<LoopPoint>& loop);

/// n of a power law K d^n, found from the law itself; nothing for any other law.
std::optional<double> power_of(const ElasticLaw& law);

}  // namespace yoke::cases
