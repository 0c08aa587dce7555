// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The code printed in the documents is code that is compiled here, word for word, and runs.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <yoke/cases/jobs/job.hpp>
#include <yoke/cases/program/request.hpp>
#include <yoke/core/authoring/check.hpp>
#include <yoke/tests/docs/adding_a_law_example.hpp>
#include <yoke/tests/docs/authoring_example.hpp>
#include <yoke/tests/docs/embedding_example.hpp>
#include <yoke/tests/documentation.hpp>

// The README's program is a main of its own.
#define main readme_main
#include <yoke/tests/docs/readme_example.hpp>
#undef main

namespace {

using namespace yoke::tests;
namespace fs = std::filesystem;

/// Works in a folder of its own, removed at the end.
class Elsewhere {
 public:
  Elsewhere() : before_(fs::current_path()) { fs::current_path(folder_.path()); }
  ~Elsewhere() {
    std::error_code ignored;
    fs::current_path(before_, ignored);
  }

 private:
  TemporaryFolder folder_;
  fs::path before_;
};

}  // namespace

TEST_CASE("the program in README.md is the one compiled here, and runs") {
  const std::string compiled = source("tests/docs/readme_example.hpp");
  const std::vector<std::string> printed = code_blocks("README.md", "cpp");
  REQUIRE(printed.size() == 1);
  CHECK(printed[0] == compiled.substr(compiled.find("#include")));

  const Elsewhere folder;
  CHECK(readme_main() == 0);
  for (const char* name : {"motion.csv", "events.csv", "summary.json"})
    CHECK(fs::file_size(fs::path("results/first") / name) > 100);
}

TEST_CASE("the code in docs/authoring.md is compiled here") {
  check_blocks("docs/authoring.md", "cpp", 10, {"tests/docs/authoring_example.hpp"});
}

TEST_CASE("the code in docs/embedding.md is compiled here or in the consumers") {
  check_blocks("docs/embedding.md", "cpp", 5,
               {"tests/docs/embedding_example.hpp", "tests/install/main.cpp",
                "tests/subdirectory/main.cpp"});
  check_blocks("docs/embedding.md", "cmake", 2,
               {"tests/install/CMakeLists.txt", "tests/subdirectory/CMakeLists.txt"});
}

TEST_CASE("docs/authoring.md: the pendulum and its follower") {
  using namespace pendulum_follower;
  const yoke::Result result = run(mechanism({}, steel_walls()));
  CHECK(result.summary.ok());
  CHECK(result["slot.normal_force_N"].maxCoeff() > 10.0);
  CHECK(result["dissipated_J"].tail(1)[0] > 0.0);
  CHECK(result.summary.energy_balance < 1e-5 * result.summary.energy_exchanged);
  const auto on = [&](const char* region) {
    return std::ranges::count(result.events, region, &yoke::EventRecord::region);
  };
  CHECK(on("inner") > 0);
  CHECK(on("outer") > 0);
}

TEST_CASE("docs/authoring.md: the case runs as the program would run it") {
  using namespace yoke;
  const Elsewhere folder;
  const cases::Case c = pendulum_follower::pendulum_follower_case();
  cases::RequestOptions options;
  options.settings = {"start_angle=12deg", "duration=0.2s"};
  options.relative_tolerance = 1e-7;
  options.no_plots = true;
  const cases::RunRequest request = cases::make_request(c, options);
  CHECK(cases::run_case(c, request) == cases::RunStatus::completed);
  CHECK(fs::exists("results/pendulum_follower/johnson/motion.csv"));
  CHECK(cases::make_model(c, request.parameters).body_count() == 2);
}

TEST_CASE("docs/authoring.md: own elements have right derivatives") {
  CHECK(own::own_elements_are_right());
  CHECK(own::own_contact_is_right());
  own::Bench bench;
  bench.model.add(own::Level{.name = "level", .body = bench.a, .at = {0.11, 0.3}});
  const yoke::ElementCheck check = check_element(*bench.model.constraints()[0], bench.model);
  INFO(check.message());
  CHECK(check.ok());
}

TEST_CASE("docs/authoring.md: own elements run") {
  using namespace yoke;
  own::Bench bench;
  bench.model.add(own::Level{.name = "level", .body = bench.a, .at = {0.11, 0.3}});
  bench.model.add(own::AirDrag("drag", bench.b, 0.8));
  bench.model.add(Gravity{});
  for (const FormulationNote& f : formulations()) {
    if (f.name == "arkode-baumgarte") continue;
    const Result result =
        simulate(bench.model, {.until = 0.7, .formulation = std::string(f.name), .samples = 11});
    INFO(f.name << ": " << result.summary.reason);
    CHECK(result.summary.ok());
    CHECK(result.summary.energy_balance < 1e-6 * result.summary.energy_exchanged);
  }
}

TEST_CASE("docs/embedding.md: sweeps, results, pieces, outcomes") {
  using namespace yoke;
  const Elsewhere folder;
  const Model model = embedding::flap();
  const std::vector<double> angles = embedding::lowest_angles(model, {3.0, 4.0, 5.0});
  CHECK(std::ranges::is_sorted(angles));  // a stiffer spring lets it fall less
  CHECK(angles == embedding::lowest_angles(model, {3.0, 4.0, 5.0}));

  const Result whole = simulate(model, {.until = 0.5});
  embedding::read(whole);
  CHECK(embedding::angle_after_two_pieces(model) ==
        doctest::Approx(whole["flap.angle_rad"].tail(1)[0]).epsilon(1e-6));

  CHECK(embedding::run_for(model, 0.1, std::chrono::hours(1)).summary.ok());
  const Result cut = embedding::run_for(model, 100.0, std::chrono::seconds(0));
  CHECK(cut.summary.stop == Stop::interrupted);

  CHECK(embedding::outcome(model, {.until = 0.1}) == "completed");
  CHECK(embedding::outcome(model, {.until = -1.0}).starts_with("the model or the options"));
  std::ofstream("blocked");
  fs::remove_all("results");
  fs::create_symlink("blocked", "results");
  CHECK(embedding::outcome(model, {.until = 0.1}).starts_with("results were not written"));
}

TEST_CASE("the code in docs/adding_a_law.md is compiled here, its entries fit the catalogs") {
  const fs::path example = "tests/docs/adding_a_law_example.hpp";
  check_blocks("docs/adding_a_law.md", "cpp", 8, {example});
  for (const auto& [catalog, entry] :
       {std::pair{"contact/laws/catalog/elastic_catalog.cpp", "struct ElasticEntry {"},
        {"contact/laws/catalog/dissipative_catalog.cpp", "struct DissipativeEntry {"}}) {
    const std::string text = source(catalog);
    const std::size_t begin = text.find(entry);
    REQUIRE(begin != std::string::npos);
    INFO(catalog);
    CHECK(contains(source(example), text.substr(begin, text.find("};", begin) - begin)));
  }
}

TEST_CASE("docs/adding_a_law.md: laws from outside the library") {
  using namespace adding_a_law;
  const yoke::ElasticLaw elastic = Palmgren{.length = 0.01};
  // 3.84e-5 F^0.9/L^0.8 at 1000 N, 10 mm, in mm.
  CHECK(elastic.penetration_at(1000.0) ==
        doctest::Approx(3.84e-8 * std::pow(1000.0, 0.9) / std::pow(10.0, 0.8)).epsilon(1e-12));
  CHECK(elastic.response(0.0).force == 0.0);
  CHECK(departure(elastic, ZhiyingQishao{.e = 0.8}) < 1e-6);
  CHECK_THROWS_AS(yoke::ElasticLaw(Palmgren{.length = -1.0}), yoke::ModelError);
  CHECK_THROWS_AS(yoke::DissipativeLaw(ZhiyingQishao{.e = 1.2}), yoke::ModelError);

  const double X = ZhiyingQishao{.e = 0.8}.damping();
  CHECK(yoke::restitution_of_damping(X) == doctest::Approx(0.786).epsilon(1e-3));
  CHECK(example() == doctest::Approx(yoke::restitution_of_damping(X)).epsilon(1e-5));

  CHECK(elastic_shape::entries()[0].make({}, 0.01, yoke::Reading::consistent).name() == "palmgren");
  const dissipative_shape::DissipativeEntry entry = dissipative_shape::entries()[0];
  CHECK(entry.make({.restitution = 0.8}).name() == "zhiying-qishao");
  CHECK(entry.delivers({.restitution = 0.9}, 1.5, 0.3).value() ==
        doctest::Approx(0.896).epsilon(2e-3));
  CHECK(entry.delivers({.restitution = 0.5}, 1.5, 0.3).value() ==
        doctest::Approx(0.483).epsilon(2e-3));
}
