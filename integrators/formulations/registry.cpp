// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/formulations/formulation.hpp>
#include <yoke/integrators/simulate.hpp>

namespace yoke {

// One function per formulation, each defined in the file of its name.
std::unique_ptr<Formulation> make_arkode_projection(Dynamics&, const Tolerances&);
std::unique_ptr<Formulation> make_arkode_baumgarte(Dynamics&, const Tolerances&);
std::unique_ptr<Formulation> make_ida_ggl(Dynamics&, const Tolerances&);
std::unique_ptr<Formulation> make_ida_baumgarte(Dynamics&, const Tolerances&);
std::unique_ptr<Formulation> make_cvode_projection(Dynamics&, const Tolerances&);
std::unique_ptr<Formulation> make_adams_baumgarte(Dynamics&, const Tolerances&);
std::unique_ptr<Formulation> make_generalised_alpha(Dynamics&, const Tolerances&);

const std::vector<FormulationEntry>& formulation_registry() {
  static const std::vector<FormulationEntry> entries = {
      {"arkode-projection",
       "explicit Runge-Kutta 5(4) or 7(6), what costs less, on accelerations; positions and velocities "
       "projected every step",
       1, "Runge-Kutta", 7, make_arkode_projection},
      {"ida-ggl", "BDF on the stabilised index-2 equations of Gear, Gupta and Leimkuhler", 2, "BDF",
       5, make_ida_ggl},
      {"cvode-projection",
       "BDF on accelerations, positions and velocities projected every step; for stiff contacts", 1,
       "BDF", 5, make_cvode_projection},
      {"ida-baumgarte", "BDF on the index-1 equations stabilised after Baumgarte; drifts a little",
       1, "BDF", 5, make_ida_baumgarte},
      {"arkode-baumgarte",
       "explicit Runge-Kutta 5(4) or 7(6), what costs less, on accelerations stabilised after "
       "Baumgarte; drifts a little",
       1, "Runge-Kutta", 7, make_arkode_baumgarte},
      {"adams-baumgarte",
       "Adams on accelerations stabilised after Baumgarte; for long smooth motions; drifts a "
       "little",
       1, "Adams", 12, make_adams_baumgarte},
      {"generalised-alpha",
       "generalised-alpha on the index-3 equations, order 2, variable steps; numerical damping", 3,
       "generalised-alpha", 2, make_generalised_alpha},
  };
  return entries;
}

const FormulationEntry& find_formulation(std::string_view name) {
  std::string known = "'automatic'";
  for (const FormulationEntry& entry : formulation_registry()) {
    if (entry.name == name) return entry;
    known += fmt::format(", '{}'", entry.name);
  }
  throw ModelError(fmt::format("unknown formulation '{}'; known formulations are {}", name, known));
}

std::vector<FormulationNote> formulations() {
  std::vector<FormulationNote> notes;
  for (const FormulationEntry& e : formulation_registry())
    notes.push_back({e.name, e.description, e.index, e.family, e.order});
  return notes;
}

}  // namespace yoke
