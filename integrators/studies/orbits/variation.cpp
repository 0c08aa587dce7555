// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/studies/orbits/variation.hpp>

#include <yoke/core/error.hpp>
#include <yoke/integrators/studies/linearised/carried_run.hpp>

namespace yoke {

FlowDerivative flow_derivative(const Model& model, const State& start,
                               const SimulationOptions& options) {
  FlowDerivative d;
  CarriedVariation variation(model, options.relative_tolerance, 0, true);
  variation.at_start = [&](CarriedVariation& v, const State& state) {
    d.start = state;
    d.start_basis = v.frame().basis();
    d.start_basis_rate = v.frame().basis_rate();
  };
  d.run = run_with(variation, model, start, options);
  if (d.start_basis.size() == 0) throw ModelError(d.run.summary.reason);
  // Where the linear equations have ended, friction may hold at the end of the run: what is carried is
  // given in the frame in which it ended.
  const State& end = d.run.final;
  const bool ended = d.run.summary.stop == Stop::failed;
  const TurningFrame& frame = ended ? variation.frame() : variation.look_at(end);
  d.end_basis = frame.basis();
  d.end_basis_rate = frame.basis_rate();
  d.dq = variation.positions();
  d.dv = variation.velocities();
  d.dz = variation.y.bottomRows(end.z.size());
  const auto& numbers = variation.varied_numbers();
  const Eigen::Index s = variation.size();
  d.matrix.resize(variation.y.cols(), variation.y.cols());
  d.matrix.topRows(s) = variation.y;
  d.memory_at_start.resize(std::ssize(numbers));
  d.memory_at_end.resize(std::ssize(numbers));
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    d.matrix.row(s + i) = variation.m.row(numbers[k]);
    d.memory.push_back(variation.numbers().name(numbers[k]));
    d.memory_at_start[i] = variation.numbers().get(d.start, numbers[k]);
    d.memory_at_end[i] = variation.numbers().get(end, numbers[k]);
  }
  d.degrees_of_freedom = variation.freedom();
  d.growth_of_volume = variation.growth_of_volume();
  d.jumps = variation.jumps();
  d.evaluations = variation.evaluations();
  d.notes = variation.notes();
  return d;
}

}  // namespace yoke
