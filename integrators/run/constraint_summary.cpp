// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/run/constraint_summary.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace yoke {

int degrees_of_freedom(const Dynamics& dynamics) {
  const Redundancy& redundancy = dynamics.redundancy();
  const System& system = dynamics.system();
  return system.dofs() - (redundancy.here.rank > 0 ? redundancy.rank : system.joint_rows());
}

namespace {

/// The solver takes one of the reactions there are, and friction takes it from there.
void note_undetermined_friction(const System& system, const std::vector<ReactionDoubt>& doubts,
                                Summary& summary) {
  for (const std::size_t i : system.loaded()) {
    const ForceSlot& f = system.forces()[i];
    const bool doubtful = std::ranges::any_of(doubts, [&](const ReactionDoubt& doubt) {
      return system.joints()[doubt.constraint].element == f.element->loaded_by();
    });
    if (!doubtful) continue;
    summary.notes.push_back(
        fmt::format("'{}' follows a reaction that the motion does not determine, as equations are "
                    "redundant: another split of the reactions gives another friction",
                    f.element->name()));
  }
}

}  // namespace

void note_constraints(Dynamics& dynamics, Summary& summary) {
  const Redundancy& redundancy = dynamics.redundancy();
  summary.degrees_of_freedom = degrees_of_freedom(dynamics);
  for (const int row : redundancy.redundant)
    summary.redundant_equations.push_back(dynamics.system().equation_name(row));
  summary.not_unique_reactions = column_names(dynamics.system(), redundancy.doubts);
  note_undetermined_friction(dynamics.system(), redundancy.doubts, summary);
}

void note_violation(Dynamics& dynamics, const State& state, Summary& s) {
  const Violation position = dynamics.position_violation(state);
  const Violation velocity = dynamics.velocity_violation(state);
  s.position_violation = std::max(s.position_violation, position.length);
  s.angle_violation = std::max(s.angle_violation, position.angle);
  s.velocity_violation = std::max(s.velocity_violation, velocity.length);
  s.angular_velocity_violation = std::max(s.angular_velocity_violation, velocity.angle);
}

// Positions last: they leave the worst row behind.
void note_drift(Dynamics& dynamics, const State& state, Summary& s) {
  const Violation velocity = dynamics.velocity_violation(state);
  const Violation position = dynamics.position_violation(state);
  s.position_drift = std::max(s.position_drift, position.length);
  s.angle_drift = std::max(s.angle_drift, position.angle);
  s.velocity_drift = std::max(s.velocity_drift, velocity.length);
  s.angular_velocity_drift = std::max(s.angular_velocity_drift, velocity.angle);
}

void copy_violations(const Summary& from, Summary& to) {
  to.position_violation = from.position_violation;
  to.angle_violation = from.angle_violation;
  to.velocity_violation = from.velocity_violation;
  to.angular_velocity_violation = from.angular_velocity_violation;
}

}  // namespace yoke
