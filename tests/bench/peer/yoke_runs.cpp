// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The problems in Yoke: its own choice of formulation, only the tolerance given.
#include <string>

#include <yoke/cases/n_four_bar.hpp>
#include <yoke/tests/bench/chain.hpp>
#include <yoke/tests/bench/peer/problems.hpp>
#include <yoke/tests/integrators/problems.hpp>

namespace yoke::bench::peer {

namespace {

/// take(rows, i, values) appends what is compared.
template <class Take>
Trajectory run_yoke(const Model& model, double end, double accuracy, Take take) {
  const auto begin = Clock::now();
  const Result run =
      simulate(model, {.until = end, .relative_tolerance = accuracy, .samples = samples});
  Trajectory trajectory{.values = {}, .seconds = seconds_since(begin)};
  if (!run.summary.ok()) return trajectory;
  for (std::size_t i = 0; i < run.samples.rows(); ++i) take(run.samples, i, trajectory.values);
  return trajectory;
}

}  // namespace

Trajectory yoke_chain(int links, double accuracy) {
  return run_yoke(
      tests::horizontal_chain(links), chain_end, accuracy,
      [](const Table& rows, std::size_t i, std::vector<double>& values) {
        const std::size_t y = rows.index("link 0.y_m");
        const std::size_t angle = rows.index("link 0.angle_rad");
        const std::size_t next = rows.has("link 1.y_m") ? rows.index("link 1.y_m") - y : 1;
        for (std::size_t k = y; k < rows.names().size() && rows.part(k) == "motion"; k += next)
          values.push_back(rows.value(i, k) + 0.5 * std::sin(rows.value(i, k + angle - y)));
      });
}

Trajectory yoke_four_bar(int loops, double accuracy) {
  return run_yoke(cases::n_four_bar({.loops = loops}), four_bar_end, accuracy,
                  [](const Table& rows, std::size_t i, std::vector<double>& values) {
                    values.push_back(std::cos(rows.value(i, rows.index("link 0.angle_rad"))));
                  });
}

std::vector<double> exact_four_bar(int loops) {
  std::vector<double> values;
  for (int i = 0; i < samples; ++i)
    values.push_back(std::cos(cases::n_four_bar_angle(loops, sample_time(i, four_bar_end))));
  return values;
}

Trajectory yoke_scotch_yoke(double accuracy) {
  return run_yoke(tests::scotch_yoke(), yoke_data::end, accuracy,
                  [](const Table& rows, std::size_t i, std::vector<double>& values) {
                    values.push_back(rows.value(i, rows.index("slider.x_m")));
                  });
}

Trajectory yoke_disc(double accuracy) {
  namespace d = disc_data;
  const Model model = tests::bouncing_disc({.height = d::height,
                                            .radius = d::radius,
                                            .mass = d::mass,
                                            .gravity = d::gravity,
                                            .stiffness = d::stiffness,
                                            .alpha = d::alpha});
  return run_yoke(model, d::end, accuracy,
                  [](const Table& rows, std::size_t i, std::vector<double>& values) {
                    values.push_back(rows.value(i, rows.index("disc.y_m")));
                  });
}

}  // namespace yoke::bench::peer
