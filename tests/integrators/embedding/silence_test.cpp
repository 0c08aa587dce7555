// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The library writes nothing to the terminal of the program it is part of, not even where it fails or
// SUNDIALS has something to say.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <string>

#include <yoke/core/error.hpp>
#include <yoke/integrators/analyses/verify.hpp>
#include <yoke/integrators/simulation.hpp>
#include <yoke/joints/forces/applied_force.hpp>
#include <yoke/tests/files.hpp>
#include <yoke/tests/integrators/mechanisms.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;

/// What is written to standard output and error until finish(), by whatever means.
class Captured {
 public:
  explicit Captured(const std::filesystem::path& file) : path_(file) {
    std::fflush(nullptr);
    out_ = ::dup(STDOUT_FILENO);
    error_ = ::dup(STDERR_FILENO);
    const int target = ::open(path_.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600);
    ::dup2(target, STDOUT_FILENO);
    ::dup2(target, STDERR_FILENO);
    ::close(target);
  }
  std::string finish() {
    std::fflush(nullptr);
    ::dup2(out_, STDOUT_FILENO);
    ::dup2(error_, STDERR_FILENO);
    ::close(out_);
    ::close(error_);
    return content(path_);
  }

 private:
  std::filesystem::path path_;
  int out_, error_;
};

}  // namespace

TEST_CASE("runs print nothing, whether they complete, fail or are refused") {
  const TemporaryFolder scratch;
  Captured control(scratch / "control");
  std::fputs("heard", stderr);
  CHECK(control.finish() == "heard");

  int failed = 0, refused = 0;
  Captured captured(scratch / "captured");
  for (const FormulationNote& f : formulations()) {
    const std::string name(f.name);
    const Model yoke = scotch_yoke();
    const Result run = simulate(yoke, {.until = 0.01, .formulation = name, .samples = 11});
    if (!run.summary.ok()) continue;
    verify(yoke, {.until = 0.01, .formulation = name, .samples = 11}, run);
    // A force that is not a number from a time on.
    Model broken = double_pendulum();
    broken.add(AppliedForce{.name = "broken", .body = broken.find_body("b"), .force = [](double t) {
                              return Vec2(std::sqrt(0.1 - t), 0.0);
                            }});
    failed += simulate(broken, {.until = 1.0, .formulation = name}).summary.ok() ? 0 : 1;
    try {
      simulate(yoke, {.until = -1.0, .formulation = name});
    } catch (const ModelError&) {
      ++refused;
    }
  }
  const std::string printed = captured.finish();
  CHECK(printed.empty());
  CHECK(failed == static_cast<int>(formulations().size()));
  CHECK(refused == failed);
}
