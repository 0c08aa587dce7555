// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/analyses/kinematics.hpp>

#include <algorithm>

#include <yoke/integrators/analyses/details/driven_motion.hpp>
#include <yoke/integrators/run/constraint_summary.hpp>
#include <yoke/integrators/run/recorder.hpp>
#include <yoke/integrators/run/rows/sampling.hpp>

namespace yoke {

namespace {

/// Time and the nine columns of each body, under the names that simulate() gives them.
void add_columns(Dynamics& dynamics, Table& table) {
  Result names;
  const Recorder recorder(dynamics, names, 0);
  const auto count = static_cast<std::size_t>(1 + 3 * dynamics.system().dofs());
  for (std::size_t i = 0; i < count; ++i) table.add_column(names.samples.names()[i], "");
  table.add_column("independence", "");
}

void record(const State& state, double independence, Table& table) {
  double* row = table.append();
  *row++ = state.t;
  for (Eigen::Index i = 0; i < state.q.size(); i += 3)
    for (const Eigen::VectorXd* values : {&state.q, &state.v, &state.a})
      for (Eigen::Index j = 0; j < 3; ++j) *row++ = (*values)[i + j];
  *row = independence;
}

}  // namespace

Result kinematics(const Model& model, const KinematicsOptions& options) {
  if (options.samples < 2)
    throw ModelError(
        fmt::format("kinematics: samples = {} must be at least 2, the two ends", options.samples));
  require_range("kinematics", "warn_below", options.warn_below, 0.0, 1.0);
  DrivenMotion motion(model, "kinematics", options.until);
  SingularityWatch watch(motion, options.warn_below);
  Result result;
  Summary& summary = result.summary;
  note_constraints(motion.dynamics(), summary);
  summary.formulation = "kinematics";
  summary.formulation_reason = "fully driven";
  summary.length_scale = motion.dynamics().system().scales().length;
  summary.t_start = motion.state().t;
  summary.t_asked = options.until;
  add_columns(motion.dynamics(), result.samples);
  result.samples.reserve(static_cast<std::size_t>(options.samples));

  bool ok = true;
  watch.see(motion.state());
  for (long i = 0; i < options.samples && ok; ++i) {
    ok = motion.advance(sample_time(i, options.samples, summary.t_start, options.until),
                        [&](const State&, const State& after) {
                          watch.see(after);
                          return true;
                        });
    const State& state = motion.state();
    if (!ok && state.t <= summary.t_end && i > 0) break;  // that row is there already
    record(state, watch.last(), result.samples);
    summary.t_end = state.t;
    note_violation(motion.dynamics(), state, summary);
  }
  watch.finish();
  summary.singular_positions = watch.found();
  summary.stop = ok ? Stop::completed : Stop::failed;
  summary.reason = ok ? "reached the end time" : motion.failure();
  summary.steps = motion.steps();
  summary.evaluations = motion.dynamics().evaluations();
  result.final = motion.state();
  return result;
}

}  // namespace yoke
