// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Reactions and energies found again from states and rows.
#include <doctest/doctest.h>

#include <yoke/integrators/analyses/recovery.hpp>
#include <yoke/tests/integrators/analyses/analysed.hpp>
#include <yoke/tests/integrators/mechanisms.hpp>
#include <yoke/tests/integrators/relaxing_spring.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;

/// Largest difference between a recovered row and the row of a run, in parts of the column's peak.
double difference(const Recovery& found, const Result& run, std::size_t row) {
  double worst = 0.0;
  for (const std::string& name : run.samples.names()) {
    if (name == "balance_J") continue;
    const Eigen::VectorXd column = run[name];
    const double peak = std::max(column.cwiseAbs().maxCoeff(), 1e-6);
    worst = std::max(worst, std::abs(found[name] - column[static_cast<Eigen::Index>(row)]) / peak);
  }
  return worst;
}

}  // namespace

TEST_CASE("the last state of a run gives its last row again, with contacts and energies") {
  // Ends in contact: what the contact remembers is in the state.
  const Model model = scotch_yoke();
  const Result whole = simulate(model, {.until = 0.6 * yoke_period, .samples = 201});
  const Eigen::VectorXd force = whole["slot.normal_force_N"];
  Eigen::Index row = 200;
  while (row > 0 && force[row] < 1.0) --row;
  const Result run = simulate(model, {.until = whole["t_s"][row], .samples = 201});
  REQUIRE(run.summary.ok());
  REQUIRE(run["slot.normal_force_N"][200] > 1.0);
  const Recovery found = recover(model, run.final);
  CHECK(difference(found, run, 200) < 1e-12);
  CHECK(found["slot.normal_force_N"] == run["slot.normal_force_N"][200]);
  CHECK(found.row.names() == run.samples.names());
}

TEST_CASE("every stored row gives accelerations, reactions and energies again") {
  Model model = double_pendulum();
  model.add(RelaxingSpring{.name = "maxwell", .body = model.find_body("b")});
  const Result run = simulate(model, {.until = 1.0, .relative_tolerance = 1e-10, .samples = 101});
  REQUIRE(run.summary.ok());
  for (const std::size_t row : {0, 1, 37, 100}) {
    INFO("row " << row);
    const Recovery found = recover(model, run.samples, run["t_s"][static_cast<Eigen::Index>(row)]);
    CHECK(difference(found, run, row) < 1e-12);
    // The ledger counts from the first row, as that of the run does.
    CHECK(std::abs(found["balance_J"] - run["balance_J"][static_cast<Eigen::Index>(row)]) < 1e-12);
  }
}

TEST_CASE("between rows states are found with an error that falls like h^6") {
  const Model model = double_pendulum();
  const double t = 0.503;
  const Result exact = simulate(model, {.until = t, .relative_tolerance = 1e-13, .samples = 2});
  double before = 0.0;
  for (const int samples : {6, 11, 21}) {
    const Result run =
        simulate(model, {.until = 1.0, .relative_tolerance = 1e-13, .samples = samples});
    const State state = stored_state(model, run.samples, t);
    const double error = (state.q - exact.final.q).cwiseAbs().maxCoeff();
    if (before > 0.0) CHECK(error < before / 20.0);
    before = error;
  }
  CHECK(before < 1e-5);
}

TEST_CASE("states and rows that are not of the model are refused") {
  const Model model = double_pendulum();
  const Result run = simulate(model, {.until = 0.1, .samples = 3});
  State off = run.final;
  off.q[4] += 1e-4;
  CHECK(contains(message_of([&] { recover(model, off); }), "violates 'elbow: y' by 0.0001 m"));
  CHECK(contains(message_of([&] { recover(slider_crank({}), run.final); }), "not of this model"));
  CHECK(contains(message_of([&] { recover(model, run.samples, 0.2); }),
                 "outside the accepted range 0 to 0.1 s"));
  CHECK(contains(message_of([&] { recover(slider_crank({}), run.samples, 0.1); }),
                 "not samples of this model"));
  const Result contact = simulate(scotch_yoke(), {.until = 1e-3, .samples = 3});
  CHECK(contains(message_of([&] { recover(scotch_yoke(), contact.samples, 1e-3); }),
                 "what contact 'slot' remembers is not in them"));
}
