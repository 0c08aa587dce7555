// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The code printed in docs/embedding.md, block by block. documentation_test.cpp compares and runs
// it.
#pragma once

#include <chrono>
#include <cstdio>
#include <string>
#include <thread>
#include <vector>

#include <yoke/core/error.hpp>
#include <yoke/core/units.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/forces/torsional_spring.hpp>
#include <yoke/joints/revolute.hpp>

namespace embedding {

using namespace yoke;
using namespace yoke::literals;

// A flap on a hinge with a torsion spring, let go lying level.
Model flap() {
  Model m;
  const BodyId flap = m.add({.name = "flap",
                             .mass = 0.8_kg,
                             .inertia = 2.4e-3_kg_m2,
                             .pose = {.position = {95.0_mm, 0.0}}});
  m.add(Gravity{});
  m.add(Revolute{.name = "hinge", .a = ground, .b = flap, .at = {0.0, 0.0}});
  m.add(TorsionalSpring{.name = "spring", .a = ground, .b = flap, .stiffness = 4.0_N_m_per_rad});
  return m;
}

// The lowest angle of the flap for each stiffness: one Model, one State for each run.
std::vector<double> lowest_angles(const Model& model, const std::vector<double>& stiffness) {
  const std::size_t parameter = model.find_parameter("spring.stiffness");
  std::vector<double> lowest(stiffness.size());
  std::vector<std::jthread> threads;
  for (std::size_t i = 0; i < stiffness.size(); ++i)
    threads.emplace_back([&, i] {
      State start = model.start_state();
      start.parameters[parameter] = stiffness[i];
      const Result run = simulate(model, start, {.until = 0.5_s});
      lowest[i] = run["flap.angle_rad"].minCoeff();
    });
  threads.clear();  // joins
  return lowest;
}

void read(const Result& run) {
  const Eigen::VectorXd t = run["t_s"], angle = run["flap.angle_rad"];
  for (Eigen::Index i = 0; i < t.size(); i += 250) std::printf("%.3f %.6f\n", t[i], angle[i]);

  const Table& table = run.samples;  // without copies: rows and columns by number
  const std::size_t fy = table.index("hinge.fy_N");
  double largest = 0.0;
  for (std::size_t row = 0; row < table.rows(); ++row)
    largest = std::max(largest, std::abs(table.value(row, fy)));
  std::printf("largest vertical force at the hinge %.3f N\n", largest);

  for (const EventRecord& e : run.events)
    std::printf("%.6f s: %s of %s\n", e.t, e.kind.c_str(), e.element.c_str());
}

// A run with a limit on wall time. What was computed up to there is in the Result.
Result run_for(const Model& model, double until, std::chrono::duration<double> limit) {
  const auto began = std::chrono::steady_clock::now();
  return simulate(model, {.until = until, .observer = [&](const Progress& progress) {
                            std::printf("\r%3.0f %%", 100.0 * progress.fraction);
                            return std::chrono::steady_clock::now() - began < limit;
                          }});
}

// The same run in two pieces: the end of the first is the start of the second.
double angle_after_two_pieces(const Model& model) {
  const Result first = simulate(model, {.until = 0.3_s});
  const Result second = simulate(model, first.final, {.until = 0.5_s});
  return second["flap.angle_rad"].tail(1)[0];
}

std::string outcome(const Model& model, const SimulationOptions& options) {
  try {
    const Result run = simulate(model, options);
    run.write("results/flap");
    if (run.summary.ok()) return "completed";
    return "stopped: " + run.summary.reason;  // interrupted or failed, results up to there
  } catch (const ModelError& error) {
    return std::string("the model or the options are wrong: ") + error.what();
  } catch (const OutputError& error) {
    return std::string("results were not written: ") + error.what();
  }
}

}  // namespace embedding
