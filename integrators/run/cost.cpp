// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/run/cost.hpp>

namespace yoke {

Work Work::operator-(const Work& o) const {
  return {evaluations - o.evaluations, refactorisations - o.refactorisations, fresh - o.fresh};
}

void Work::operator+=(const Work& o) {
  evaluations += o.evaluations;
  refactorisations += o.refactorisations;
  fresh += o.fresh;
}

Work work_of(const Dynamics& dynamics) {
  const FactorCounters& factors = dynamics.counters();
  return {dynamics.evaluations(), factors.refactorisations, factors.fresh};
}

void RunCost::resume(const Summary& before) {
  before_ = before;
  wall_time_before_ = before.wall_time;
}

long RunCost::steps(const Formulation& formulation) const {
  return before_.steps + formulation.counters().steps;
}

void RunCost::write(const Dynamics& dynamics, const Formulation& formulation,
                    Summary& summary) const {
  const StepCounters counters = formulation.counters();
  const Work stepping = work_of(dynamics) - work_before_ - recording_;
  summary.steps = before_.steps + counters.steps;
  summary.rejected = before_.rejected + counters.rejected;
  summary.jacobians = before_.jacobians + counters.jacobians;
  summary.evaluations = before_.evaluations + stepping.evaluations + counters.evaluations;
  summary.refactorisations =
      before_.refactorisations + stepping.refactorisations + counters.factors.refactorisations;
  summary.fresh_factorisations =
      before_.fresh_factorisations + stepping.fresh + counters.factors.fresh;
  summary.recording_evaluations = before_.recording_evaluations + recording_.evaluations;
  summary.last_step = formulation.last_step();
  summary.wall_time =
      wall_time_before_ + std::chrono::duration<double>(Clock::now() - began_).count();
}

void RunCost::close(const Dynamics& dynamics, const Summary& summary) {
  before_ = summary;
  work_before_ = work_of(dynamics);
  recording_ = {};
}

}  // namespace yoke
