// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/run/constraint_summary.hpp>

namespace yoke {

int degrees_of_freedom(const Dynamics& dynamics) {
  const Redundancy& redundancy = dynamics.redundancy();
  const System& system = dynamics.system();
  return system.dofs() - (redundancy.here.rank > 0 ? redundancy.rank : system.rows());
}

void note_constraints(Dynamics& dynamics, Summary& summary) {
  const Redundancy& redundancy = dynamics.redundancy();
  summary.degrees_of_freedom = degrees_of_freedom(dynamics);
  for (const int row : redundancy.redundant)
    summary.redundant_equations.push_back(dynamics.system().equation_name(row));
  summary.not_unique_reactions = column_names(dynamics.system(), redundancy.doubts);
}

}  // namespace yoke
