// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/studies/orbits/variation.hpp>

#include <yoke/core/error.hpp>
#include <yoke/integrators/studies/linearised/carried_run.hpp>

namespace yoke {

FlowDerivative flow_derivative(const Model& model, const State& start,
                               const SimulationOptions& options) {
  FlowDerivative d;
  CarriedVariation variation(model, options.relative_tolerance, 0);
  variation.at_start = [&](const State& state, const TurningFrame& frame) {
    d.start = state;
    d.start_basis = frame.basis();
    d.start_basis_rate = frame.basis_rate();
  };
  d.run = run_with(variation, model, start, options);
  if (d.start_basis.size() == 0) throw ModelError(d.run.summary.reason);
  const State& end = d.run.final;
  const TurningFrame& frame = variation.look_at(end);
  d.end_basis = frame.basis();
  d.end_basis_rate = frame.basis_rate();
  d.dq = variation.positions();
  d.dv = variation.velocities();
  d.dz = variation.y.bottomRows(end.z.size());
  const auto& numbers = variation.varied_numbers();
  const Eigen::Index s = variation.size();
  d.matrix.resize(variation.y.cols(), variation.y.cols());
  d.matrix.topRows(s) = variation.y;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    d.matrix.row(s + static_cast<Eigen::Index>(i)) = variation.m.row(numbers[i]);
    d.memory.push_back(variation.numbers().name(numbers[i]));
  }
  d.degrees_of_freedom = variation.freedom();
  d.growth_of_volume = variation.growth_of_volume();
  d.jumps = variation.jumps();
  d.evaluations = variation.evaluations();
  d.notes = variation.notes();
  return d;
}

}  // namespace yoke
