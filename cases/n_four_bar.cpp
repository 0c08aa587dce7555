// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/n_four_bar.hpp>

#include <yoke/cases/case.hpp>

namespace yoke::cases {

namespace {

Model model_of(const Parameters& p) { return n_four_bar({.loops = p.whole("N")}); }

/// The upright links turn like one pendulum.
std::vector<Check> checks_of(const Parameters& p, const Model&, const Result& run) {
  const int loops = p.whole("N");
  return {energy_check(run),
          deviation_check("angle of the links off by", run, "link 0.angle_rad", "rad",
                          "closed form, elliptic functions", [&, t = run["t_s"]](std::size_t i) {
                            return n_four_bar_angle(loops, t[static_cast<Eigen::Index>(i)]);
                          })};
}

}  // namespace

Case n_four_bar_case() {
  return {.name = "n_four_bar",
          .group = "benchmarks",
          .description = "IFToMM benchmark A02: N four-bar loops through singular positions",
          .parameters = {{.name = "N",
                          .quantity = Quantity::number,
                          .default_text = "1",
                          .low = 1.0,
                          .high = 1000.0,
                          .whole = true,
                          .description = "four-bar loops side by side"},
                         {.name = "duration",
                          .quantity = Quantity::number,
                          .default_text = "10",
                          .low = 1e-3,
                          .high = 1000.0,
                          .description = "of the run, in seconds"}},
          .default_output = "results/n_four_bar",
          .model = [](const Parameters& p, const WallLaws&) { return model_of(p); },
          .duration = [](const Parameters& p) { return p.number("duration"); },
          .checks = checks_of};
}

}  // namespace yoke::cases
