// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// yoke inverse-dynamics CASE: drive torques, powers and all reactions of a fully driven mechanism.
#include <yoke/cases/program/analysis_verb.hpp>
#include <yoke/integrators/analyses/inverse_dynamics.hpp>

namespace yoke::cases {

namespace {

/// Extremes of what each driver has to give.
void print_drives(const Model& model, const Result& result) {
  for (const auto& joint : model.constraints()) {
    if (!joint->rheonomic()) continue;
    for (const char* what : {".fx_N", ".fy_N", ".moment_N_m", ".power_W"}) {
      const std::string column = joint->name() + what;
      if (!result.samples.has(column)) continue;
      const Eigen::VectorXd values = result[column];
      if (values.isZero(0.0)) continue;
      fmt::print("{:<28} {:>14.6g} to {:>14.6g}\n", column, values.minCoeff(), values.maxCoeff());
    }
  }
}

}  // namespace

void add_inverse_dynamics_verb(CLI::App& app, Action& action) {
  add_analysis_verb(
      app, action, "inverse-dynamics",
      "Drive torques, powers and all reactions of a fully driven case", add_motion_options,
      [](const Model& model, const RunRequest& request, const AnalysisOptions& options) {
        const Result result =
            inverse_dynamics(model, {.until = duration_of(options), .samples = request.samples});
        const int code = report_motion(result, request, options);
        if (options.format != "text") return code;
        if (!result.summary.singular_positions.empty())
          fmt::print(
              "next to a singular position reactions are lost to rounding; powers are not\n");
        print_drives(model, result);
        return code;
      });
}

}  // namespace yoke::cases
