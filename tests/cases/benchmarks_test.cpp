// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A part of the benchmarks (tests/validation/benchmarks_test.cpp) in a few seconds, by every
// formulation, and the references they are compared with.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include <yoke/cases/andrews.hpp>
#include <yoke/cases/n_four_bar.hpp>
#include <yoke/cases/validation/andrews_reference.hpp>
#include <yoke/cases/validation/benchmark_problems.hpp>
#include <yoke/core/authoring/check.hpp>
#include <yoke/core/error.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/tests/messages.hpp>

using namespace yoke;
using namespace yoke::cases;

TEST_CASE("closed form of the pendulum: swinging, turning over, either way") {
  // Elliptic functions in 30 digits.
  const PendulumMotion swing(std::sqrt(9.81), 0.5 * pi, 0.0);
  CHECK_FALSE(swing.turns_over());
  CHECK(swing.period() == doctest::Approx(2.367841947576237449).epsilon(1e-15));
  CHECK(std::abs(swing.at(1.0).angle + 1.405027311524799146) < 1e-14);
  CHECK(std::abs(swing.at(3.0).rate + 4.394478842713599086) < 1e-13);
  CHECK(std::abs(swing.at(1000.0 * swing.period()).angle - 0.5 * pi) < 1e-11);

  const PendulumMotion over(std::sqrt(11.772), pi, -1.0);
  CHECK(over.turns_over());
  CHECK(over.period() == doctest::Approx(1.923711817338965852).epsilon(1e-14));
  CHECK(std::abs(over.at(7.0).angle - 0.5 * pi + 22.0574504239960661) < 1e-12);
  CHECK(std::abs(over.at(7.0).rate + 4.794176957786510609) < 1e-12);
  CHECK(std::abs(over.at(0.0).rate + 1.0) < 1e-14);  // at the top, where dn of Boost is not good
  for (const double t : {0.3, 2.0, 9.7})
    CHECK(std::abs(over.at(t).angle - 0.5 * pi - n_four_bar_angle(1, t)) < 1e-12);

  // Energy, for starts between the extremes and both senses.
  for (const double angle : {-2.0, 0.3, 3.0})
    for (const double rate : {-7.5, -1.0, 0.5, 9.0}) {
      const PendulumMotion motion(3.0, angle, rate);
      CHECK(std::abs(std::remainder(motion.at(0.0).angle - angle, 2.0 * pi)) < 1e-13);
      CHECK(std::abs(motion.at(0.0).rate - rate) < 1e-13);
      const double energy = 0.5 * rate * rate - 9.0 * std::cos(angle);
      for (const double t : {0.2, 1.9, 8.0}) {
        const auto p = motion.at(t);
        CHECK(std::abs(0.5 * p.rate * p.rate - 9.0 * std::cos(p.angle) - energy) < 1e-12);
        const double h = 1e-5;
        const double slope = (motion.at(t + h).angle - motion.at(t - h).angle) / (2.0 * h);
        CHECK(std::abs(slope - p.rate) < 1e-7);
      }
    }
}

TEST_CASE("Andrews' mechanism written in three ways is one mechanism") {
  // At the start, where the published problem says so to 30 digits.
  const State plain = assembled_state(andrews()), own = assembled_state(andrews_own_elements());
  CHECK(std::abs(plain.a[2] / 14222.4439199541138706 - 1.0) < 1e-12);
  CHECK(std::abs((plain.a[5] - plain.a[2]) / -10666.8329399655854029 - 1.0) < 1e-12);
  CHECK(std::abs(own.lambda[0] / 98.5668703962410896 - 1.0) < 1e-12);
  CHECK(std::abs(own.lambda[1] / -6.12268834425566265 - 1.0) < 1e-11);
  CHECK(own.lambda.segment(2, 4).cwiseAbs().maxCoeff() < 1e-10);
  CHECK((plain.a - own.a).cwiseAbs().maxCoeff() < 1e-8);

  // At the end against the published equations, which no part of the engine integrates.
  const AndrewsState reference = andrews_by_published_equations(0.03);
  const BenchmarkErrors published = andrews_difference(andrews_published(), reference);
  CHECK(published.position < 1e-9);
  CHECK(published.velocity < 1e-7);
  CHECK(published.acceleration < 3e-6);
  CHECK(published.reaction < 3e-6);
  for (const auto model : {andrews, andrews_own_elements}) {
    const Result run = simulate(model(), {.until = 0.03,
                                          .relative_tolerance = 1e-13,
                                          .formulation = "arkode-projection",
                                          .samples = 2});
    REQUIRE(run.summary.ok());
    const BenchmarkErrors d = andrews_difference(andrews_end(run), reference);
    CHECK(d.position < 2e-11);
    CHECK(d.velocity < 1e-9);
    CHECK(d.acceleration < 1e-9);
    CHECK(d.reaction < 1e-9);
  }
}

TEST_CASE("the elements written for Andrews' mechanism have exact derivatives") {
  const Model m = andrews_own_elements();
  const ElementCheck pin = check_element(*m.constraints().front(), m);
  const ElementCheck spring = check_element(*m.forces().front(), m, {.length = 0.1});
  CHECK_MESSAGE(pin.ok(), pin.message());
  CHECK_MESSAGE(spring.ok(), spring.message());
}

TEST_CASE("short benchmarks reach what is promised, by all formulations of higher order") {
  const std::vector<Benchmark> all = benchmarks();
  for (const char* name : {"double_pendulum", "andrews", "andrews_own_elements", "car_axis",
                           "slider_crank_driven", "slider_crank_sprung"})
    for (const FormulationNote& f : formulations()) {
      if (f.order <= 2) continue;
      const bool multistep = f.family != "Runge-Kutta";
      const Benchmark& b = find_benchmark(all, name);
      const BenchmarkRun r = run_benchmark(b, std::string(f.name), multistep ? 1e-13 : 1e-12);
      INFO(name, " ", f.name, ": ", r.trouble, " position ", r.errors.position, " reaction ",
           r.errors.reaction);
      CHECK(r.meets(b.bars));
      CHECK(r.position_drift < 1e-12);
      CHECK(r.energy < 1e-9);
    }
}

TEST_CASE("a second-order method gains a hundredfold by ten times the steps") {
  const std::vector<Benchmark> all = benchmarks();
  for (const char* name : {"double_pendulum", "andrews", "slider_crank_sprung"}) {
    const Benchmark& b = find_benchmark(all, name);
    const BenchmarkRun coarse = run_benchmark(b, "generalised-alpha", 1e-5);
    const BenchmarkRun fine = run_benchmark(b, "generalised-alpha", 1e-7);
    INFO(name);
    const double order =
        std::log(coarse.finer_error / fine.finer_error) /
        std::log(static_cast<double>(fine.steps) / static_cast<double>(coarse.steps));
    CHECK(order > 1.7);
    CHECK(order < 2.3);
  }
}

TEST_CASE("a benchmark that is cut or unknown says so") {
  std::vector<Benchmark> all = benchmarks();
  CHECK_THROWS_WITH_AS(find_benchmark(all, "double_pendulun"), doctest::Contains("double_pendulum"),
                       ModelError);
  all.front().budget = 1e-4;
  const BenchmarkRun r = run_benchmark(all.front(), "arkode-projection", 1e-13);
  CHECK(tests::contains(r.trouble, "cut after"));
  CHECK(r.reached < all.front().until);
  CHECK_FALSE(r.meets(all.front().bars));
}

TEST_CASE("a run that finds its tolerance out of reach goes on with less, and says so") {
  for (const int loops : {38, 40, 45}) {
    CAPTURE(loops);
    const Model m = n_four_bar({.loops = loops});
    const Result run =
        simulate(m, {.until = 1.0, .relative_tolerance = 1e-12, .formulation = "cvode-projection"});
    REQUIRE_MESSAGE(run.summary.ok(), run.summary.reason);
    // Near the singular position, which the run still knows to be one when it begins anew beside it; how often the
    // tolerance is raised is a matter of rounding.
    CHECK(run.summary.tolerance_kept > 1e-12);
    CHECK(run.summary.tolerance_kept < 1.01e-10);
    CHECK(run.summary.singular_positions.size() == 1);
    CHECK(std::ranges::any_of(run.summary.notes, [](const std::string& note) {
      return note.find("the tolerance was out of reach; from there it was") != std::string::npos;
    }));
    const Result looser = simulate(
        m, {.until = 1.0, .relative_tolerance = 1e-11, .formulation = "arkode-projection"});
    CHECK((run.final.q - looser.final.q).cwiseAbs().maxCoeff() < 1e-7);
  }
}
