// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Many simulations in threads from one const Model give what one after the other gives. Built with
// -fsanitize=thread (preset tsan) this finds what they share.
#include <doctest/doctest.h>

#include <string>
#include <thread>
#include <vector>

#include <yoke/core/control/sampled_controller.hpp>
#include <yoke/integrators/analyses/mechanics.hpp>
#include <yoke/integrators/analyses/state_space.hpp>
#include <yoke/integrators/simulation.hpp>
#include <yoke/joints/forces/applied_torque.hpp>
#include <yoke/tests/integrators/mechanisms.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;

/// A pendulum of two rods with a controller, or the scotch-yoke with its contacts.
Model shared_model(bool contacts) {
  if (contacts) return scotch_yoke();
  Model m = double_pendulum();
  const BodyId a = m.find_body("a");
  m.add(AppliedTorque{.name = "motor", .body = a, .value = 0.0});
  m.add(SampledController{.name = "brake",
                          .period = 0.01,
                          .outputs = {"motor.torque"},
                          .memory = {{"count", "1"}},
                          .update = [a](const ControllerSample& s) {
                            s.memory(0) += 1.0;
                            s.output(0) = -0.2 * s.motion[a].omega;
                          }});
  return m;
}

/// What one thread does: a run with looks, a return and a fork, and the matrices behind it.
std::vector<double> work(const Model& model, const std::string& formulation, double until) {
  Simulation run(model, {.until = until, .formulation = formulation, .samples = 11});
  run.advance_to(0.3 * until);
  const Snapshot here = run.snapshot();
  run.advance_to(0.5 * until);
  run.restore(here);
  Simulation other = run.fork();
  run.advance_to(0.8 * until);
  std::vector<double> numbers(run.state().q.begin(), run.state().q.end());
  Mechanics mechanics(model);
  mechanics.at(run.state());
  numbers.push_back(mechanics.effective_mass(BodyId{2}, {0.1, 0.2}, {0.6, 0.8}));
  LinearPlant plant(model, {}, {"t_s"});
  plant.at(run.state());
  numbers.insert(numbers.end(), plant.A().data(), plant.A().data() + plant.A().size());
  const Result result = other.finish();
  numbers.insert(numbers.end(), result.samples.data().begin(), result.samples.data().end());
  return numbers;
}

}  // namespace

TEST_CASE("threads that share a model do not disturb one another") {
  const std::vector<std::string> names = {"arkode-projection", "ida-ggl", "cvode-projection",
                                          "adams-baumgarte"};
  for (const bool contacts : {false, true}) {
    const Model model = shared_model(contacts);
    const double until = contacts ? 0.2 * yoke_period : 0.5;
    std::vector<std::vector<double>> together(names.size());
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < names.size(); ++i)
      threads.emplace_back([&, i] { together[i] = work(model, names[i], until); });
    for (std::thread& thread : threads) thread.join();
    for (std::size_t i = 0; i < names.size(); ++i) {
      INFO(names[i]);
      CHECK(together[i] == work(model, names[i], until));
    }
  }
}
