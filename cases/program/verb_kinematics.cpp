// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// yoke kinematics CASE: positions, velocities and accelerations of a fully driven mechanism.
#include <yoke/cases/program/analysis_verb.hpp>
#include <yoke/integrators/analyses/kinematics.hpp>

namespace yoke::cases {

void add_kinematics_verb(CLI::App& app, Action& action) {
  add_analysis_verb(
      app, action, "kinematics",
      "Positions, velocities, accelerations of a fully driven case, with singularity warnings",
      add_motion_options,
      [](const Model& model, const RunRequest& request, const AnalysisOptions& options) {
        const Result result =
            kinematics(model, {.until = duration_of(options), .samples = request.samples});
        return report_motion(result, request, options);
      });
}

}  // namespace yoke::cases
