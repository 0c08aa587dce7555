// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// yoke orbit and yoke lyapunov: files, exit codes, what is refused.
#include <doctest/doctest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include <yoke/cases/jobs/progress.hpp>
#include <yoke/cases/orbits/orbit_job.hpp>
#include <yoke/cases/program/request.hpp>
#include <yoke/tests/cases/program/program_run.hpp>
#include <yoke/tests/messages.hpp>

namespace {

using namespace yoke::tests;

nlohmann::json json_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  return nlohmann::json::parse(file);
}

}  // namespace

TEST_CASE("yoke orbit writes the orbit, its multipliers and their pictures") {
  const TemporaryFolder scratch;
  const auto run =
      run_yoke(scratch,
               "orbit double_pendulum --autonomous --period 2s --samples 51 --rtol 1e-9 "
               "-o out");
  INFO(run.out);
  const nlohmann::json summary = json_of(scratch / "out/summary.json");
  CHECK(run.code == 0);
  CHECK(summary.at("found") == true);
  CHECK(summary.at("degrees_of_freedom") == 2);
  CHECK(summary.at("residuals").size() >= 1);
  CHECK(summary.at("monodromy").size() == 4);
  CHECK(lines(scratch / "out/orbit.csv").size() == 52);
  CHECK(lines(scratch / "out/multipliers.csv").size() == 5);
  CHECK(lines(scratch / "out/multipliers.csv").front() == "re,im,modulus,trivial");
  CHECK(std::filesystem::exists(scratch / "out/orbit.gp"));
  CHECK(std::filesystem::exists(scratch / "out/multipliers.gp"));
  CHECK(contains(run.out, "multiplier: real part"));
}

TEST_CASE("yoke lyapunov writes exponents as they settle") {
  const TemporaryFolder scratch;
  const auto run = run_yoke(scratch,
                            "lyapunov double_pendulum --until 4s --transient 0.5s --exponents 0 "
                            "--rtol 1e-8 --no-plots -o out");
  INFO(run.out);
  CHECK(run.code == 0);
  const nlohmann::json summary = json_of(scratch / "out/summary.json");
  CHECK(summary.at("complete") == true);
  REQUIRE(summary.at("exponents_per_s").size() == 4);
  double sum = 0.0;
  for (const double x : summary.at("exponents_per_s")) sum += x;
  CHECK(std::abs(sum) < 1e-4);
  CHECK(lines(scratch / "out/exponents.csv").front() ==
        "t_s,exponent_1_1_per_s,exponent_2_1_per_s,exponent_3_1_per_s,exponent_4_1_per_s");
  CHECK_FALSE(std::filesystem::exists(scratch / "out/exponents.gp"));
}

TEST_CASE("what cannot be sought is refused in words of the command line, and nothing is written") {
  const TemporaryFolder scratch;
  const auto refusal = [&](const std::string& arguments) {
    const auto run = run_yoke(scratch, arguments + " -o out");
    CHECK(run.code == 1);
    CHECK_FALSE(std::filesystem::exists(scratch / "out"));
    return run.out;
  };
  CHECK(contains(refusal("orbit double_pendulum"), "give --period TIME or --turns N"));
  CHECK(contains(refusal("orbit double_pendulum --period 1s --turns 1"), "not both"));
  CHECK(contains(refusal("orbit double_pendulum --turns 1"), "no driver turns a body"));
  CHECK(contains(refusal("orbit slider_crank --turns -1"), "--turns -1: must be at least 1"));
  CHECK(contains(refusal("orbit double_pendulum --period 0s"), "period = 0 s"));
  CHECK(contains(refusal("orbit slider_crank --turns 1"), "no motion of its own"));
  CHECK(contains(refusal("lyapunov double_pendulum --until 1s --exponents 5"),
                 "columns = 5 must be at most 4"));
  CHECK(contains(refusal("lyapunov double_pendulum --until 1s --transient 2s"),
                 "transient = 2 s is outside"));
}

TEST_CASE("interrupted, both verbs write what there is and say so") {
  using namespace yoke::cases;
  const TemporaryFolder scratch;
  const Case& c = find_case("double_pendulum");
  RequestOptions options;
  options.case_name = c.name;
  RunRequest request = make_request(c, options);
  request.plots = false;
  request.quiet = true;
  const yoke::Model model = make_model(c, request.parameters);
  set_interrupted(true);
  request.output = scratch / "orbit";
  const RunStatus orbit = run_orbit(c.name, model, request, {.period = 1.0}, "");
  request.output = scratch / "exponents";
  const RunStatus exponents = run_lyapunov(c.name, model, request, {.until = 1.0});
  set_interrupted(false);
  CHECK(orbit == RunStatus::interrupted);
  CHECK(exponents == RunStatus::interrupted);
  CHECK(contains(std::string(json_of(scratch / "orbit/summary.json").at("reason")), "interrupted"));
  CHECK(json_of(scratch / "exponents/summary.json").at("complete") == false);
}
