// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/studies/orbits/variation.hpp>

#include <yoke/core/error.hpp>
#include <yoke/integrators/studies/linearised/carried_run.hpp>

namespace yoke {

namespace {

/// Of the memory numbers with a column, those on which anything has depended; columns of others are taken
/// away.
std::vector<int> drop_idle_numbers(CarriedVariation& variation, Eigen::Index own) {
  std::vector<int> kept;
  Eigen::Index columns = own;
  for (std::size_t i = 0; i < variation.varied_numbers().size(); ++i) {
    const Eigen::Index from = own + static_cast<Eigen::Index>(i);
    if (variation.y.col(from).isZero(0.0)) continue;
    variation.y.col(columns) = variation.y.col(from).eval();
    variation.m.col(columns) = variation.m.col(from).eval();
    ++columns;
    kept.push_back(variation.varied_numbers()[i]);
  }
  variation.y.conservativeResize(Eigen::NoChange, columns);
  variation.m.conservativeResize(Eigen::NoChange, columns);
  return kept;
}

}  // namespace

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
  const Eigen::Index s = variation.size();
  const std::vector<int> numbers = drop_idle_numbers(variation, s);
  d.dq = variation.positions();
  d.dv = variation.velocities();
  d.dz = variation.y.bottomRows(end.z.size());
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
