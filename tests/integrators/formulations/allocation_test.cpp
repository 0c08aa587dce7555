// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Counts every call of malloc, calloc and realloc of this program, those of SUNDIALS and KLU too.
// Sanitizers bring their own malloc, so there the test has nothing to count.
#include <doctest/doctest.h>

#include <cstdlib>

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>
#include <vector>

#include <yoke/contact/disc_on_curve.hpp>
#include <yoke/contact/laws/dissipative/exact_restitution.hpp>
#include <yoke/contact/laws/friction/regularised_coulomb.hpp>
#include <yoke/core/control/sampled_controller.hpp>
#include <yoke/core/curves/lines_and_arcs.hpp>
#include <yoke/integrators/analyses/mechanics.hpp>
#include <yoke/integrators/analyses/state_space.hpp>
#include <yoke/integrators/simulation.hpp>
#include <yoke/joints/forces/applied_force.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/revolute.hpp>
#include <yoke/tests/integrators/problems.hpp>
#include <yoke/tests/integrators/relaxing_spring.hpp>

namespace {
std::atomic<long> allocations{0}, bytes{0};  // bytes asked for
}

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* malloc(std::size_t size) {
  ++allocations;
  bytes += static_cast<long>(size);
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  ++allocations;
  bytes += static_cast<long>(count * size);
  return __libc_calloc(count, size);
}
void* realloc(void* old, std::size_t size) {
  ++allocations;
  bytes += static_cast<long>(size);
  return __libc_realloc(old, size);
}
}

namespace {

using namespace yoke;
using namespace yoke::tests;

struct Count {
  long steps = 0;
  long allocations = 0;  // between the first accepted step that counts and the last
  long fresh = 0;
};

/// Steps of ARKODE count from a part of the run on, by which it has used both of its orders: each allocates
/// when it is first used.
Count count(const Model& model, SimulationOptions options) {
  const double from = options.formulation.starts_with("arkode") ? 0.25 : 0.0;
  long first = -1, last = 0;
  options.observer = [&](const Progress& progress) {
    last = allocations.load();
    if (first < 0 && progress.fraction >= from) first = last;
    return true;
  };
  const Result run = simulate(model, options);
  REQUIRE(run.summary.ok());
  return {run.summary.steps, last - first, run.summary.fresh_factorisations};
}

}  // namespace

TEST_CASE("the counter counts") {
  const long before = allocations.load();
  std::string long_enough(100, 'x');
  CHECK(long_enough.size() == 100);
  CHECK(allocations.load() > before);
}

TEST_CASE("stepping, events, restarts and recording allocate nothing") {
  for (const std::string formulation :
       {"arkode-projection", "ida-ggl", "cvode-projection", "adams-baumgarte", "arkode-baumgarte",
        "generalised-alpha"}) {
    INFO(formulation);
    Model model = scotch_yoke();
    model.add(RelaxingSpring{.name = "relaxing", .body = model.find_body("slider")});
    const Count c = count(model, {.until = 2.0 * yoke_period,
                                  .relative_tolerance = 1e-8,
                                  .formulation = formulation,
                                  .samples = 2001});
    CHECK(c.steps > 1000);
    CHECK(c.allocations == 0);
    CHECK(c.fresh <= 4);
  }
}

TEST_CASE("building a model takes no more per link of a long chain than of a short one") {
  struct Taken {
    double allocations, bytes;  // for each link
  };
  const auto build = [](int links) -> Taken {
    const long calls = allocations.load(), asked = bytes.load();
    const Model model = horizontal_chain(links);
    return {static_cast<double>(allocations - calls) / links,
            static_cast<double>(bytes - asked) / links};
  };
  const Taken few = build(200), many = build(2000);
  INFO(many.allocations, " allocations and ", many.bytes, " bytes a link");
  CHECK(many.allocations <
        few.allocations + 0.5);          // "body 'link 1000'" is too long for a short string
  CHECK(many.bytes < 1.25 * few.bytes);  // arrays that double as they grow
}

TEST_CASE("setting up a run takes no more per link of a long chain than of a short one") {
  struct SetUp {
    double allocations, bytes;  // for each link
  };
  const auto set_up = [](int links, const std::string& formulation) {
    const Model model = horizontal_chain(links);
    const long calls = allocations.load(), asked = bytes.load();
    SetUp taken{};
    const Result run = simulate(model, {.until = 1e-3,
                                        .formulation = formulation,
                                        .samples = 2,
                                        .columns = {"link 0.*"},
                                        .observer = [&](const Progress&) {
                                          if (taken.allocations > 0.0) return true;
                                          taken.allocations =
                                              static_cast<double>(allocations - calls) / links;
                                          taken.bytes = static_cast<double>(bytes - asked) / links;
                                          return true;
                                        }});
    REQUIRE(run.summary.ok());
    return taken;
  };
  for (const std::string formulation : {"arkode-projection", "ida-ggl", "generalised-alpha"}) {
    const SetUp few = set_up(200, formulation), many = set_up(2000, formulation);
    INFO(formulation, ": ", many.allocations, " allocations and ", many.bytes, " bytes a link");
    CHECK(many.allocations <= few.allocations);
    CHECK(many.bytes < 1.25 * few.bytes);  // arrays that double as they grow
  }
}

TEST_CASE("a pendulum that turns through all poses allocates only for fresh factors") {
  for (const std::string formulation : {"arkode-projection", "ida-ggl", "generalised-alpha"}) {
    INFO(formulation);
    const Count c = count(double_pendulum(), {.until = 5.0, .formulation = formulation});
    CHECK(c.steps > 200);
    // KLU allocates a dozen blocks and more for a factor with new pivots, of a large matrix more than of a small.
    CHECK(c.allocations <= 20 * c.fresh);
    CHECK(c.fresh < 40);
  }
}

TEST_CASE("friction of joints, in the equations and between its events, allocates nothing") {
  for (const std::string formulation :
       {"arkode-projection", "ida-ggl", "cvode-projection", "generalised-alpha"}) {
    INFO(formulation);
    const PinFriction pin{.law = RegularisedCoulomb{.mu = 0.2, .threshold = 0.1}, .radius = 0.02};
    Model model;
    const BodyId upper =
        model.add(Body{.name = "upper", .mass = 1.0, .inertia = 0.1, .pose = {{0.5, 0.0}, 0.0}});
    const BodyId lower =
        model.add(Body{.name = "lower", .mass = 1.0, .inertia = 0.1, .pose = {{1.5, 0.0}, 0.0}});
    model.add(Revolute{.name = "pivot", .a = ground, .b = upper, .friction = pin});
    model.add(Revolute{.name = "elbow", .a = upper, .b = lower, .at = {1.0, 0.0}, .friction = pin});
    model.add(Gravity{});
    const Count c = count(model, {.until = 1.0, .formulation = formulation});
    CHECK(c.steps > 50);
    CHECK(c.allocations <= 20 * c.fresh);
  }
}

TEST_CASE("stops of an embedded run, its controllers' samples and inputs allocate nothing") {
  for (const std::string formulation :
       {"arkode-projection", "ida-ggl", "adams-baumgarte", "generalised-alpha"}) {
    INFO(formulation);
    Model model = scotch_yoke();
    const BodyId slider = model.find_body("slider");
    const Vec2 at = model.body(slider).pose.position;
    model.add(AppliedForce{.name = "brake", .body = slider, .at = at, .value = Vec2(0.0, 0.0)});
    model.add(SampledController{.name = "computer",
                                .period = 1e-4,
                                .outputs = {"brake.fx"},
                                .update = [slider](const ControllerSample& s) {
                                  s.output(0) = -0.1 * s.motion[slider].vx;
                                }});
    Simulation run(model, {.until = yoke_period, .formulation = formulation, .samples = 0});
    run.advance_to(1e-3);
    const long before = allocations.load();
    while (run.time() < 0.5 * yoke_period) run.advance_to(run.time() + 3e-5);
    CHECK(allocations.load() - before == 0);
    REQUIRE_FALSE(run.ended());
    CHECK(run.get("computer.samples") > 400.0);
  }
}

TEST_CASE("changeable laws, and motors that a controller sets, allocate nothing") {
  for (const std::string formulation : {"arkode-projection", "ida-ggl", "generalised-alpha"}) {
    INFO(formulation);
    Model model;
    const BodyId disc =
        model.add(Body{.name = "disc", .mass = 1.0, .inertia = 0.01, .pose = {{0.0, 0.15}, 0.0}});
    const BodyId crank = model.add(Body{.name = "crank", .mass = 1.0, .inertia = 0.1});
    model.add(Gravity{});
    model.add(DiscOnCurve{
        .name = "floor",
        .disc = {.body = disc, .at = {0.0, 0.15}, .radius = 0.1},
        .body = ground,
        .curve = straight_line({-1.0, 0.0}, {1.0, 0.0}),
        .law = ContactLaw{changeable(per_mm(49070, 1.1)), changeable(ExactRestitution{0.8})}});
    model.add(Revolute{.name = "axle", .a = ground, .b = crank});
    model.add(AngleDriver{.name = "motor", .body = crank, .speed = 1.0});
    model.add(SampledController{.name = "plc",
                                .period = 0.01,
                                .outputs = {"motor.speed", "motor.acceleration"},
                                .update = [](const ControllerSample& s) {
                                  s.output(0) += s.number % 2 == 0 ? 0.5 : -0.5;
                                  s.output(1) = 0.1 * s.motion.t;
                                }});
    const Count c = count(model, {.until = 0.5, .formulation = formulation, .samples = 101});
    CHECK(c.steps > 300);
    CHECK(c.allocations == 0);
  }
}

TEST_CASE("mechanics allocate nothing once they are made") {
  const Model model = double_pendulum();
  State state = model.start_state();
  Mechanics mechanics(model);
  Eigen::VectorXd F = Eigen::VectorXd::Ones(6), a(6), lambda(4);
  mechanics.at(state);
  const long before = allocations.load();
  double sum = 0.0;
  for (int i = 0; i < 10; ++i) {
    state.v[2] += 0.1;
    mechanics.at(state);
    mechanics.accelerations(F, a, lambda);
    sum += mechanics.mass_matrix()[0] + mechanics.constraint_jacobian()(0, 0) +
           mechanics.gamma()[0] + mechanics.forces()[0] + mechanics.null_space()(0, 0) +
           mechanics.effective_mass(BodyId{2}, {2.0, 0.0}, {0.0, 1.0}) + a[0];
  }
  CHECK(allocations.load() - before == 0);
  CHECK(std::isfinite(sum));
}

namespace {

/// Allocations of linearising again and again along a run of `model`.
long of_linearising(const Model& model, const std::string& input,
                    const std::vector<std::string>& outputs, double until) {
  Simulation run(model, {.until = until, .samples = 0});
  LinearPlant plant(model, {input}, outputs);
  plant.at(run.state());  // sizes the matrices
  long sum = 0;
  while (!run.ended()) {
    run.advance_to(std::min(until, run.time() + 0.05 * until));
    const State& state = run.state();
    const long before = allocations.load();
    plant.at(state);
    sum += allocations.load() - before;
    CHECK(plant.A().allFinite());
    CHECK(plant.C().norm() > 0.0);
    CHECK(plant.B().norm() > 0.0);
  }
  return sum;
}

}  // namespace

TEST_CASE("linearising again and again allocates nothing") {
  // A contact and element states; a longer chain; rods without mass.
  Model yoke = scotch_yoke();
  const BodyId slider = yoke.find_body("slider");
  const Vec2 at = yoke.body(slider).pose.position;
  yoke.add(AppliedForce{.name = "push", .body = slider, .at = at, .value = Vec2(1.0, 0.0)});
  yoke.add(RelaxingSpring{.name = "relaxing", .body = slider});
  CHECK(of_linearising(yoke, "push.fx", {"slider.x_m", "guide.fy_N"}, yoke_period) == 0);

  for (const double mass : {0.1, 0.0}) {
    Model chain;
    BodyId last = ground;
    for (int i = 0; i < 40; ++i) {
      const double x = 0.1 * i;
      const BodyId link = chain.add(Body{.name = "link " + std::to_string(i),
                                         .mass = i % 2 == 1 ? 0.1 : mass,
                                         .inertia = i % 2 == 1 ? 1e-3 : 1e-2 * mass,
                                         .pose = {{x + 0.05, 0.0}, 0.0}});
      chain.add(
          Revolute{.name = "pin " + std::to_string(i), .a = last, .b = link, .at = Vec2(x, 0.0)});
      last = link;
    }
    chain.add(Gravity{});
    chain.add(AppliedForce{
        .name = "push", .body = BodyId{1}, .at = {0.05, 0.0}, .value = Vec2(0.0, 1.0)});
    CHECK(of_linearising(chain, "push.fy", {"link 2.y_m", "pin 0.fx_N"}, 0.05) == 0);
  }
}

#endif
