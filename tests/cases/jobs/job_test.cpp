// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The job that runs any case, on a case with two contacts: marbles in two bowls.
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include <yoke/cases/jobs/job.hpp>
#include <yoke/contact/geometry/arc_slot.hpp>
#include <yoke/contact/laws/elastic/power_law.hpp>
#include <yoke/contact/pin_in_slot.hpp>
#include <yoke/core/units.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/tests/files.hpp>
#include <yoke/tests/messages.hpp>

namespace {

using namespace yoke;
using namespace yoke::cases;
using namespace yoke::literals;
namespace fs = std::filesystem;

constexpr double radius = 60e-3, gap = 1e-3, mass = 0.2, K = 1e6;

/// A marble falls the gap from the middle of an upright slot, onto its lower wall.
void add_marble(Model& m, const std::string& name, double x, const ContactLaw& law) {
  const Vec2 bottom{x, -radius};
  const BodyId marble =
      m.add({.name = name + " marble", .mass = mass, .inertia = 1e-5, .pose = {bottom, 0.0}});
  const Slot slot = arc_slot({.center = {x, 0.0},
                              .radius = radius,
                              .direction = -90.0_deg,
                              .angle = 60.0_deg,
                              .half_width = 5e-3 + gap});
  m.add(PinInSlot{.name = name, .pin = {marble, bottom, 5e-3}, .slot = {ground, slot}, .law = law});
}

Case marbles() {
  return {.name = "marbles",
          .description = "two marbles",
          .parameters = {{.name = "duration",
                          .quantity = Quantity::time,
                          .default_text = "20ms",
                          .low = 1e-3,
                          .high = 1.0,
                          .description = "of the run"}},
          .contact = {.walls =
                          [](const Parameters&) {
                            return std::vector<Wall>{{.name = "left"}, {.name = "right"}};
                          },
                      .laws = {{"linear", "K d",
                                [](const Parameters&, const Wall&) {
                                  return ContactLaw{PowerLaw{K, 1.0}};
                                }}}},
          .default_output = "results/marbles",
          .model =
              [](const Parameters&, const WallLaws& laws) {
                Model m;
                m.add(Gravity{});
                add_marble(m, "a", -0.2, laws["left"]);
                add_marble(m, "b", 0.2, laws["right"]);
                return m;
              },
          .duration = [](const Parameters& p) { return p.number("duration"); }};
}

RunRequest request_for(const Case& c, const fs::path& output, std::vector<std::string> laws) {
  return {.parameters = Parameters(c.parameters),
          .laws = choose_laws(c, Parameters(c.parameters), laws),
          .output = output,
          .samples = 101,
          .plots = false};
}

TEST_SUITE("job") {
  // Energy: K d^2/2 = m g (gap + d).
  TEST_CASE("each law gets a folder, each contact its peak in summary and comparison") {
    const yoke::tests::TemporaryFolder scratch;
    const Case c = marbles();
    const fs::path out = scratch / "out";
    REQUIRE(run_case(c, request_for(c, out, {"linear", "right=power:K=4e6,n=1+none"})) ==
            RunStatus::completed);
    const auto summary = nlohmann::json::parse(
        yoke::tests::content(out / "right=power_K=4e6,n=1+none/summary.json"));
    CHECK(summary["case"] == "marbles");
    CHECK(summary["law"] == "right=power:K=4e6,n=1+none");
    CHECK(summary["parameters"]["duration"] == "0.02 s");
    CHECK(summary["contacts"] == 2);
    CHECK(summary["samples"] == 101);
    const auto depth = [](double k) {
      const double weight = mass * 9.81;
      return (weight + std::sqrt(weight * weight + 2.0 * k * weight * gap)) / k;
    };
    const auto& elements = summary["contact_elements"];
    CHECK(elements["a"]["largest_penetration_m"].get<double>() ==
          doctest::Approx(depth(K)).epsilon(1e-5));
    CHECK(elements["b"]["peak_force_N"].get<double>() ==
          doctest::Approx(4.0 * K * depth(4.0 * K)).epsilon(1e-5));
    CHECK(summary["peak_force_N"] == elements["b"]["peak_force_N"]);
    CHECK(fs::exists(out / "linear/motion.csv"));
    CHECK(fs::exists(out / "linear/events.csv"));
    const std::string comparison = yoke::tests::content(out / "comparison.csv");
    CHECK(yoke::tests::contains(comparison, "\n\"right=power:K=4e6,n=1+none\",completed,0.02,"));
    CHECK(yoke::tests::contains(comparison, "a.peak_force_N"));
  }

  TEST_CASE("of a model too large for all of its columns those asked for are kept") {
    const Case& c = find_case("hanging_chain");
    RunRequest request{.parameters = Parameters(c.parameters, {"links=20"}),
                       .laws = {},
                       .output = {},
                       .samples = 101,
                       .most_gibibytes = 1e-5,
                       .plots = false};
    CHECK_THROWS_WITH_AS(run_law(c, request, "", {}), doctest::Contains("ask for fewer rows"),
                         ModelError);
    request.choice.columns = {"link 7.*", "*_J"};
    const LawRun run = run_law(c, request, "", {});
    REQUIRE(run.summary.ok());
    CHECK(run.samples.has("link 7.angle_rad"));
    CHECK(run.samples.has("balance_J"));
    CHECK_FALSE(run.samples.has("link 8.angle_rad"));
    request.most_gibibytes = 1.0;
    const LawRun whole = run_law(c, request, "", {});
    for (const std::string& name : run.samples.names())
      CHECK((run.samples[name].array() == whole.samples[name].array()).all());
    CHECK(whole.samples.has("link 8.angle_rad"));
  }

  TEST_CASE("the hardest contact is drawn whole, however few rows a run has") {
    const yoke::tests::TemporaryFolder scratch;
    const Case c = marbles();
    RunRequest request = request_for(c, scratch / "out", {});
    request.samples = 21;
    request.plots = true;
    REQUIRE(run_case(c, request) == RunStatus::completed);
    std::ifstream file(scratch / "out/plots/hardest-linear.csv");
    int lines = 0;
    for (std::string line; std::getline(file, line);) ++lines;
    CHECK(lines > 30);
  }

  TEST_CASE("plots of any case: their data, a script a figure") {
    const yoke::tests::TemporaryFolder scratch;
    const Case c = marbles();
    RunRequest request = request_for(c, scratch / "out", {});
    request.plots = true;
    REQUIRE(run_case(c, request) == RunStatus::completed);
    const fs::path plots = scratch / "out/plots";
    for (const char* name :
         {"motion", "velocities", "energy", "contact_force", "penetration", "hysteresis"}) {
      CHECK_MESSAGE(fs::exists(plots / (std::string(name) + ".gp")), name);
      CHECK_MESSAGE(!fs::exists(plots / (std::string(name) + ".log")), name);
    }
    std::ifstream data(plots / "contact-linear.csv");
    std::string header;
    std::getline(data, header);
    CHECK(header == "t_s,a.normal_force_N,a.penetration_um,b.normal_force_N,b.penetration_um");
  }

  TEST_CASE("a check outside its tolerance is written as such, the run completes all the same") {
    const yoke::tests::TemporaryFolder scratch;
    Case c = marbles();
    c.checks = [](const Parameters& p, const Model& m, const Result& run) {
      return std::vector<Check>{
          {.what = "end",
           .value = run["t_s"].tail(1)[0],
           .expected = 2.0 * p.number("duration"),
           .unit = "s",
           .tolerance = 1e-3,
           .remark = "too long"},
          {.what = "bodies", .value = static_cast<double>(m.body_count()), .expected = 2.0}};
    };
    RunRequest request = request_for(c, scratch / "out", {});
    REQUIRE(run_case(c, request) == RunStatus::completed);
    const auto checks =
        nlohmann::json::parse(yoke::tests::content(scratch / "out/linear/summary.json"))["checks"];
    REQUIRE(checks.size() == 2);
    CHECK(checks[0]["within"] == false);
    CHECK(checks[0]["value"] == 0.02);
    CHECK(checks[0]["expected"] == 0.04);
    CHECK(checks[0]["tolerance"] == 1e-3);
    CHECK(checks[0]["remark"] == "too long");
    CHECK(checks[1]["within"] == true);
    // Without rows there is nothing to look at.
    request.samples = 0;
    request.output = scratch / "none";
    REQUIRE(run_case(c, request) == RunStatus::completed);
    CHECK_FALSE(nlohmann::json::parse(yoke::tests::content(scratch / "none/linear/summary.json"))
                    .contains("checks"));
  }

  TEST_CASE("paths that a case names are drawn, y over x on one scale") {
    const yoke::tests::TemporaryFolder scratch;
    Case c = marbles();
    c.paths = {"b marble"};
    RunRequest request = request_for(c, scratch / "out", {});
    request.plots = true;
    REQUIRE(run_case(c, request) == RunStatus::completed);
    const fs::path plots = scratch / "out/plots";
    CHECK(!fs::exists(plots / "path.log"));
    CHECK(yoke::tests::contains(yoke::tests::content(plots / "path.gp"), "set size ratio -1"));
    std::ifstream data(plots / "path-linear.csv");
    std::string header, first;
    std::getline(data, header);
    std::getline(data, first);
    CHECK(header == "t_s,b marble.x_m,b marble.y_m");
    CHECK(first == "0,0.2,-0.06");
  }

  TEST_CASE("reactions that grow without bound at singular positions do not hide the others") {
    const yoke::tests::TemporaryFolder scratch;
    for (const char* name : {"parallelogram", "n_four_bar"}) {
      const Case& c = find_case(name);
      RunRequest request = request_for(c, scratch / name, {});
      request.samples = 4001;
      request.plots = true;
      REQUIRE(run_case(c, request) == RunStatus::completed);
      const std::string script = yoke::tests::content(scratch / name / "plots/reactions.gp");
      // Redundant cranks share the load in many ways; the four-bar's reactions are unique.
      const bool cut = c.name == "parallelogram";
      CHECK(yoke::tests::contains(script, "peaks cut") == cut);
      CHECK(yoke::tests::contains(script, "set yrange [0:") == cut);
    }
  }

  TEST_CASE("a case without contacts runs into its folder") {
    const yoke::tests::TemporaryFolder scratch;
    const Case& c = find_case("point_pendulum");
    RunRequest request = request_for(c, scratch / "out", {});
    request.parameters.set("duration", "0.1");
    REQUIRE(run_case(c, request) == RunStatus::completed);
    const auto summary = nlohmann::json::parse(yoke::tests::content(scratch / "out/summary.json"));
    CHECK(summary["case"] == "point_pendulum");
    CHECK(!summary.contains("law"));
    CHECK(!summary.contains("contacts"));
    CHECK(fs::exists(scratch / "out/motion.csv"));
    CHECK(!fs::exists(scratch / "out/comparison.csv"));
  }
}

}  // namespace
