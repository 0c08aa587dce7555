// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Counts every call of malloc, calloc and realloc of this program, those of SUNDIALS and KLU too.
// Sanitizers bring their own malloc, so there the test has nothing to count.
#include <doctest/doctest.h>

#include <cstdlib>

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__)

#include <atomic>
#include <string>

#include <yoke/tests/integrators/mechanisms.hpp>
#include <yoke/tests/integrators/relaxing_spring.hpp>

namespace {
std::atomic<long> allocations{0};
}

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  ++allocations;
  return __libc_calloc(count, size);
}
void* realloc(void* old, std::size_t size) {
  ++allocations;
  return __libc_realloc(old, size);
}
}

namespace {

using namespace yoke;
using namespace yoke::tests;

struct Count {
  long steps = 0;
  long allocations = 0;  // between the first accepted step and the last
  long fresh = 0;
};

Count count(const Model& model, SimulationOptions options) {
  long first = -1, last = 0;
  options.observer = [&](const Progress&) {
    last = allocations.load();
    if (first < 0) first = last;
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

TEST_CASE("a pendulum that turns through all poses allocates only for fresh factors") {
  for (const std::string formulation : {"arkode-projection", "ida-ggl", "generalised-alpha"}) {
    INFO(formulation);
    const Count c = count(double_pendulum(), {.until = 5.0, .formulation = formulation});
    CHECK(c.steps > 400);
    // KLU allocates about a dozen blocks for a factor with new pivots.
    CHECK(c.allocations <= 16 * c.fresh);
    CHECK(c.fresh < 40);
  }
}

#endif
