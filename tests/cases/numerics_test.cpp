// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The code printed in docs/numerics.md is compiled here, and does what the page says.
#include <doctest/doctest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <yoke/tests/cases/numerics_example.hpp>

namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& path) {
  std::ifstream file(fs::path(YOKE_SOURCE_DIR) / path);
  REQUIRE_MESSAGE(file.good(), path.string());
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

TEST_CASE("the code in docs/numerics.md is compiled here") {
  const std::string document = content("docs/numerics.md");
  const std::string compiled = content("tests/cases/numerics_example.hpp");
  int blocks = 0;
  const std::string fence = "```cpp\n";
  for (std::size_t at = document.find(fence); at != std::string::npos;
       at = document.find(fence, at), ++blocks) {
    at += fence.size();
    const std::string block = document.substr(at, document.find("```", at) - at);
    INFO(block);
    CHECK(compiled.find(block) != std::string::npos);
  }
  CHECK(blocks == 4);
}

TEST_CASE("docs/numerics.md lists every formulation") {
  const std::string document = content("docs/numerics.md");
  for (const yoke::FormulationNote& f : yoke::formulations())
    CHECK_MESSAGE(document.find(fmt::format("`{}`", f.name)) != std::string::npos, f.name);
}

TEST_CASE("docs/numerics.md: choice, second opinion, events and checkpoints") {
  using namespace numerics;
  CHECK(which_and_why(bench()).starts_with("arkode-projection: no force is stiff"));
  CHECK(digits_of_the_angle(bench()) > 6.0);

  const Result run = with_events(bench());
  CHECK(run.summary.stop == Stop::by_event);
  CHECK(run.summary.reason.starts_with("event 'turning point' at t = "));
  CHECK(run.events.front().element == "upright");
  CHECK(run.summary.energy_balance < 1e-6 * run.summary.energy_exchanged);

  std::string name = (fs::temp_directory_path() / "yoke-docs-XXXXXX").string();
  REQUIRE(mkdtemp(name.data()) != nullptr);
  const Result whole = long_run(bench(), name);
  const Result resumed = after_a_kill(bench(), name);
  CHECK(whole.samples.data() == resumed.samples.data());
  fs::remove_all(name);
}
