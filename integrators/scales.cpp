// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/scales.hpp>

#include <algorithm>
#include <cmath>

namespace yoke {

Scales choose_scales(const System& system, const State& state, const SimulationOptions& options) {
  const double length = options.length_scale > 0.0 ? options.length_scale : system.natural_length();
  if (options.time_scale > 0.0) return {length, options.time_scale};
  double rate = 1.0 / (options.until - state.t);
  for (Eigen::Index i = 0; i < state.q.size(); ++i) {
    const double size = i % 3 == 2 ? 1.0 : length;
    rate = std::max({rate, std::abs(state.v[i]) / size, std::sqrt(std::abs(state.a[i]) / size)});
  }
  return {length, 1.0 / rate};
}

Tolerances choose_tolerances(const System& system, const SimulationOptions& options) {
  const Scales scales = system.scales();
  const double rtol = options.relative_tolerance;
  Tolerances tolerances;
  tolerances.relative = rtol;
  tolerances.q.resize(system.dofs());
  tolerances.v.resize(system.dofs());
  double mass = 0.0;
  for (int i = 0; i < system.dofs(); ++i) {
    const double size = i % 3 == 2 ? 1.0 : scales.length;
    tolerances.q[i] = rtol * size;
    tolerances.v[i] = rtol * size / scales.time;
    if (i % 3 == 0) mass = std::max(mass, system.mass()[static_cast<std::size_t>(i)]);
  }
  for (const ForceSlot& f : system.forces()) {
    const double penetration = f.element->penetration_scale();
    if (!(penetration > 0.0 && penetration < scales.length)) continue;
    const double size = std::sqrt(scales.length * penetration);
    for (int j = 0; j < f.columns; ++j) {
      const int dof = system.dof()[static_cast<std::size_t>(f.dofs + j)];
      if (dof < 0) continue;
      const double weight = rtol * (dof % 3 == 2 ? size / scales.length : size);
      tolerances.q[dof] = std::min(tolerances.q[dof], weight);
    }
  }
  tolerances.z.resize(system.states());
  for (const ForceSlot& f : system.forces()) {
    const std::vector<Channel> states = f.element->states();
    for (int i = 0; i < f.states; ++i)
      tolerances.z[f.z + i] = rtol * states[static_cast<std::size_t>(i)].scale;
  }
  // A tenth of the kinetic energy at the scales: ledgers are judged by what is exchanged, often
  // less.
  tolerances.energy = 0.1 * rtol * mass * std::pow(scales.length / scales.time, 2);
  tolerances.baumgarte_rate = std::max(0.0, options.baumgarte_rate);
  // Steps of a method of order 5 go with the fifth root of the tolerance; half of that keeps the
  // gain well below what an explicit step bears.
  tolerances.natural_rate = std::pow(rtol, -0.1) / scales.time;
  tolerances.spectral_radius = options.spectral_radius;
  return tolerances;
}

}  // namespace yoke
