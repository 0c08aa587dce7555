// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// yoke sweep: which points it makes of what is typed, what it asks of each run, and that its folder is as the
// documents say whatever happens meanwhile.
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <signal.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include <yoke/cases/results/hdf5_file.hpp>
#include <yoke/cases/sweep/sweep.hpp>
#include <yoke/tests/cases/program/program_run.hpp>
#include <yoke/tests/cases/sweep/sweep_rows.hpp>
#include <yoke/tests/files.hpp>
#include <yoke/tests/messages.hpp>

namespace {

using namespace yoke;
using namespace yoke::cases;
using namespace yoke::tests;
namespace fs = std::filesystem;
using Texts = std::vector<std::string>;

SweepPoints points_of(const char* case_name, const Texts& vary, SweepChoice choice = {}) {
  choice.vary = vary;
  return {find_case(case_name), choice};
}

std::string refusal(const char* case_name, const Texts& vary, const SweepChoice& choice = {}) {
  return message_of([&] { points_of(case_name, vary, choice); });
}

/// What would be typed for each point.
Texts parameters_of(const SweepPoints& points) {
  Texts all;
  for (std::size_t i = 0; i < points.points().size(); ++i)
    for (const std::string& text : points.setting(i).parameters) all.push_back(text);
  return all;
}

const std::string small =
    "sweep slider_crank --samples 11 --vary crank=20mm:60mm:5 --vary speed=100,200 ";

/// The cell of a row under a name.
std::string cell(const fs::path& table, std::size_t row, const std::string& name) {
  const Texts all = lines(table), header = cells(all[0]);
  const auto at = std::ranges::find(header, name);
  REQUIRE_MESSAGE(at != header.end(), name);
  return cells(all[row + 1])[static_cast<std::size_t>(at - header.begin())];
}

}  // namespace

TEST_SUITE("sweep") {
  TEST_CASE("ranges are typed with units, and points are typed as a person would") {
    const SweepPoints points = points_of("slider_crank", {"crank=10mm:50mm:5"});
    CHECK(parameters_of(points) ==
          Texts{"crank=10mm", "crank=20mm", "crank=30mm", "crank=40mm", "crank=50mm"});
    CHECK(points.points().coordinate(2, 0) == 0.03);
    CHECK(points.points().axes()[0].unit == "m");
    CHECK(points.unit(0) == "mm");
    CHECK(parameters_of(points_of("slider_crank", {"crank=1cm:0.1m:4"})) ==
          Texts{"crank=0.01m", "crank=0.04m", "crank=0.07m", "crank=0.1m"});
    CHECK(parameters_of(points_of("slider_crank", {"crank=1mm:100mm:3:log"})) ==
          Texts{"crank=1mm", "crank=10mm", "crank=100mm"});
    SweepChoice log;
    log.logarithmic = true;
    CHECK(parameters_of(points_of("slider_crank", {"crank=1mm:100mm:3", "speed=1:3:2:linear"}, log))
              .size() == 12);
    CHECK(points_of("slider_crank", {"crank=1mm:100mm:3"}, log).text(1, 0) == "10mm");
    CHECK(parameters_of(points_of("slider_crank_clearance", {"clearance=ideal,0.1mm"})) ==
          Texts{"clearance=ideal", "clearance=0.1mm"});
  }

  TEST_CASE("laws, friction, options of the run and words in braces may vary") {
    SweepChoice choice;
    choice.law = "hertz+flores:e={e}";
    choice.friction = "coulomb:mu={mu}";
    const SweepPoints braces =
        points_of("scotch_yoke", {"e=0.5,0.75", "mu=0:0.2:3", "rtol=1e-8,1e-9"}, choice);
    REQUIRE(braces.points().size() == 12);
    CHECK(braces.setting(11).law == "hertz+flores:e=0.75");
    CHECK(braces.setting(11).friction == "coulomb:mu=0.2");
    CHECK(braces.setting(10).rtol == "1e-08");
    const SweepPoints laws = points_of(
        "scotch_yoke", {"law=johnson,outer=power:K=1e8,n=1.5,hertz+flores:e=0.8,johnson-10mm"});
    REQUIRE(laws.points().size() == 3);
    CHECK(laws.setting(0).law == "johnson,outer=power:K=1e8,n=1.5");
    CHECK(laws.setting(1).law == "hertz+flores:e=0.8");
    CHECK(laws.setting(2).law == "johnson-10mm");
    CHECK(points_of("scotch_yoke", {"formulation=ida-ggl,arkode-projection"})
              .setting(0)
              .formulation == "ida-ggl");
    // A case with a parameter of that name.
    CHECK(points_of("cam_follower", {"contact-law=hertz"}).setting(0).law == "hertz");
    CHECK_FALSE(points_of("cam_follower", {"law=cycloidal"}).setting(0).parameters.empty());
  }

  TEST_CASE("samples of the box: the points have no need of numbers, but may have them") {
    SweepChoice random;
    random.random = 50;
    const SweepPoints a = points_of("slider_crank", {"crank=10mm:50mm", "speed=100,200"}, random);
    const SweepPoints b = points_of("slider_crank", {"crank=10mm:50mm:7", "speed=100,200"}, random);
    REQUIRE(a.points().size() == 50);
    for (std::size_t i = 0; i < 50; ++i) {
      CHECK(a.text(i, 0) == b.text(i, 0));
      // What is typed gives the same bits.
      const Parameters p(find_case("slider_crank").parameters, a.setting(i).parameters);
      CHECK(p.number("crank") == a.points().coordinate(i, 0));
    }
    SweepChoice sobol;
    sobol.sobol = 3;
    CHECK(parameters_of(points_of("slider_crank", {"crank=10mm:50mm"}, sobol)) ==
          Texts{"crank=30mm", "crank=40mm", "crank=20mm"});
    sobol.sobol = 64;
    const SweepPoints links = points_of("hanging_chain", {"links=3:5"}, sobol);
    for (const std::string& text : parameters_of(links))
      CHECK((text == "links=3" || text == "links=4" || text == "links=5"));
  }

  TEST_CASE("lists: as typed, or as sweep.csv has them") {
    const TemporaryFolder scratch;
    SweepChoice choice;
    choice.list = scratch / "points.csv";
    std::ofstream(choice.list) << "crank,rod_m,speed\r\n20mm,0.1,100\n 3cm,\"0.12\",200\n\n";
    const SweepPoints points = points_of("slider_crank", {}, choice);
    CHECK(parameters_of(points) ==
          Texts{"crank=0.02m", "rod=0.1m", "speed=100", "crank=0.03m", "rod=0.12m", "speed=200"});
    const auto refused = [&](const std::string& text) {
      std::ofstream(choice.list) << text;
      return refusal("slider_crank", {}, choice);
    };
    CHECK(contains(refused("crank\n"), "there are no points"));
    CHECK(contains(refused("crank,rod\n1mm\n"), "line 2: 1 cells; the first line has 2"));
    CHECK(contains(refused("crnk\n1mm\n"), "did you mean 'crank'"));
    CHECK(contains(refused("crank\n1kg\n"), "accepted: mm, cm, m, um"));
    CHECK(contains(refused("crank\n9000mm\n"), "is out of range"));
    std::ofstream(choice.list) << "crank\n1mm\n";
    CHECK(contains(refusal("slider_crank", {"speed=1,2"}, choice), "does not go with --vary"));
    choice.list = scratch / "none.csv";
    CHECK(contains(refusal("slider_crank", {}, choice), "cannot read it"));
  }

  TEST_CASE("what cannot be meant is refused by name, value and range") {
    CHECK(contains(refusal("slider_crank", {}), "what shall vary?"));
    CHECK(contains(refusal("slider_crank", {"crank"}), "--vary crank: expected NAME="));
    CHECK(contains(refusal("slider_crank", {"crnk=1mm,2mm"}),
                   "--vary crnk=1mm,2mm: nothing of 'slider_crank' is called 'crnk'; did you mean "
                   "'crank'"));
    CHECK(contains(refusal("slider_crank", {"crank=10mm:50mm"}), "accepted are LOW:HIGH:N"));
    CHECK(contains(refusal("slider_crank", {"crank=10mm:50mm:1"}), "cannot be both 10 and 50"));
    CHECK(
        contains(refusal("slider_crank", {"crank=10mm:50mm:x"}), "'x' is not a number of points"));
    CHECK(contains(refusal("slider_crank", {"crank=10:50mm:3"}), "has no unit"));
    CHECK(contains(refusal("slider_crank", {"crank=10mm:5000mm:3"}), "out of range; accepted"));
    CHECK(contains(refusal("slider_crank", {"speed=0:9:3:log"}), "low, on a logarithmic axis,"));
    CHECK(contains(refusal("slider_crank", {"speed=1,2", "speed=3,4"}), "'speed' is given twice"));
    CHECK(contains(refusal("hanging_chain", {"links=3:6:3"}), "4.5 is not a whole number"));
    CHECK(contains(refusal("scotch_yoke", {"pin=fixed,rolls"}), "'rolls' is not one of"));
    SweepChoice two;
    two.random = two.sobol = 4;
    CHECK(contains(refusal("slider_crank", {"speed=1:2"}, two), "one of them at a time"));
  }

  TEST_CASE("measures of a column") {
    Table rows;
    rows.add_column("t", "s");
    rows.add_column("x", "m");
    const double t[] = {0.0, 0.5, 2.0, 3.0}, x[] = {3.0, -4.0, 2.0, 2.0};
    for (int i = 0; i < 4; ++i) {
      double* row = rows.append();
      row[0] = t[i], row[1] = x[i];
    }
    const auto of = [&](const char* how, double at = 0.0, double from = 0.0) {
      return measure(rows, "x_m", how, at, from);
    };
    CHECK(of("max") == 3.0);
    CHECK(of("min") == -4.0);
    CHECK(of("range") == 7.0);
    CHECK(of("final") == 2.0);
    CHECK(of("mean") == doctest::Approx((-0.25 - 1.5 + 2.0) / 3.0));
    CHECK(of("rms") == doctest::Approx(std::sqrt((0.25 * 25.0 + 0.75 * 20.0 + 4.0) / 3.0)));
    CHECK(of("at", 1.25) == doctest::Approx(-1.0));
    CHECK(of("at", 2.0) == 2.0);
    CHECK(std::isnan(of("at", 3.1)));
    CHECK(of("max", 0.0, 0.4) == 2.0);
    CHECK(std::isnan(of("max", 0.0, 4.0)));
    CHECK(std::isnan(measure(rows, "y_m", "max", 0.0, 0.0)));
  }

  TEST_CASE("the numbers of a point are those of the run that its command makes") {
    const TemporaryFolder scratch;
    const auto sweep =
        run_yoke(scratch,
                 "sweep scotch_yoke --set revolutions=0.25 --vary law=johnson,johnson-10mm "
                 "--vary alpha=0.1s/m,0.32s/m --rtol 1e-8 -o out --keep-runs "
                 "--measure slider_v_m_per_s:max --measure normal_force_N:max");
    INFO(sweep.out);
    REQUIRE(sweep.code == 0);
    const fs::path table = scratch / "out/sweep.csv";
    CHECK(rows_of_sweep(table) == 4);
    const auto replay = nlohmann::json::parse(content(scratch / "out/runs/000002/replay.json"));
    const std::string command = replay["command"];
    CHECK(
        command ==
        "yoke run scotch_yoke --set revolutions=0.25 --set alpha=0.1s/m --law johnson-10mm --rtol "
        "1e-08");
    CHECK(run_yoke(scratch, command.substr(5) + " -o alone --no-plots").code == 0);
    const auto alone = nlohmann::json::parse(content(scratch / "alone/johnson-10mm/summary.json"));
    CHECK(std::stod(cell(table, 2, "peak_force_N")) == alone["peak_force_N"]);
    CHECK(std::stod(cell(table, 2, "impacts")) == alone["contacts"]);
    CHECK(std::stod(cell(table, 2, "turns")) == doctest::Approx(0.25).epsilon(1e-9));
    CHECK(std::stod(cell(table, 2, "impacts_per_turn")) ==
          doctest::Approx(4.0 * double(alone["contacts"])).epsilon(1e-9));
    CHECK(std::stod(cell(table, 2, "steps")) == alone["steps"]);
    CHECK(std::stod(cell(table, 2, "max.normal_force_N")) <= alone["peak_force_N"]);
    CHECK(std::stod(cell(table, 2, "energy_lost_J")) > 0.0);
    CHECK(fs::exists(scratch / "out/runs/000003/report.html"));
    CHECK(contains(content(scratch / "out/report.html"), "runs/000003/report.html"));
    const auto summary = nlohmann::json::parse(content(scratch / "out/summary.json"));
    CHECK(summary["schema"] == "yoke-sweep-1");
    CHECK(summary["complete"] == true);
    CHECK(summary["quantities"]["peak_force"]["largest"]["value"] >= alone["peak_force_N"]);
    CHECK(fs::exists(scratch / "out/sweep.h5") == has_hdf5);
  }

  TEST_CASE("the table has the same bytes for any number of jobs") {
    const TemporaryFolder scratch;
    for (const int jobs : {1, 2, 5})
      REQUIRE(run_yoke(scratch, small + fmt::format("-q -o {0} --jobs {0}", jobs)).code == 0);
    CHECK(rows_of_sweep(scratch / "1/sweep.csv") == 10);
    CHECK(content(scratch / "1/sweep.csv") == content(scratch / "2/sweep.csv"));
    CHECK(content(scratch / "1/sweep.csv") == content(scratch / "5/sweep.csv"));
  }

  TEST_CASE("a point that fails is a row with its reason; the others are there") {
    const TemporaryFolder scratch;
    const auto sweep = run_yoke(scratch,
                                "sweep slider_crank --samples 11 --vary crank=20mm,60mm,200mm "
                                "--set rod=100mm -o out");
    INFO(sweep.out);
    CHECK(sweep.code == 0);
    CHECK(contains(sweep.out, "1 of 3 points failed:\n  1 times: "));
    CHECK(cell(scratch / "out/sweep.csv", 1, "state") == "completed");
    CHECK(cell(scratch / "out/sweep.csv", 2, "state") == "failed");
    CHECK(cell(scratch / "out/sweep.csv", 2, "peak_force_N") == "nan");
    const std::string last = lines(scratch / "out/sweep.csv").back();
    CHECK(last.size() > last.find("failed,") + 20);
    CHECK(
        run_yoke(scratch, "sweep slider_crank --set rod=100mm --vary crank=150mm,200mm -q -o none")
            .code == 1);
  }

  TEST_CASE("killed at any time, the same command goes on and ends with the same bytes") {
    const TemporaryFolder scratch;
    const std::string sweep =
        "sweep slider_crank --samples 11 --vary crank=20mm:60mm:40 "
        "--vary speed=100:200:5 -q ";
    REQUIRE(run_yoke(scratch, sweep + "-o whole --jobs 1").code == 0);
    int kills = 0;
    for (int milliseconds = 30; milliseconds < 60000; milliseconds += milliseconds / 3) {
      const pid_t child = start("cd '" + scratch.path().string() + "'; " + program + " " + sweep +
                                "-o killed --jobs 2");
      std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
      kill(child, SIGKILL);
      if (wait_for(child) == 0) break;
      ++kills;
      if (fs::exists(scratch / "killed/sweep.csv")) rows_of_sweep(scratch / "killed/sweep.csv");
    }
    CHECK(kills > 1);
    CHECK(content(scratch / "killed/sweep.csv") == content(scratch / "whole/sweep.csv"));
  }

  TEST_CASE("interrupted, the sweep ends in order with what it has, and goes on later") {
    const TemporaryFolder scratch;
    const std::string sweep =
        "sweep bouncing_ball --vary restitution=0.1:0.9:60 --rtol 1e-9 -o out --jobs 2 ";
    const pid_t child =
        start("cd '" + scratch.path().string() + "'; " + program + " " + sweep + ">log 2>&1");
    const fs::path journal = scratch / "out/journal.tsv";
    for (int i = 0; i < 3000 && !(fs::exists(journal) && lines(journal).size() > 3); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    kill(child, SIGINT);
    CHECK(wait_for(child) == 130);
    CHECK(contains(content(scratch / "log"), "interrupted; the same command goes on"));
    const std::size_t rows = rows_of_sweep(scratch / "out/sweep.csv");
    CHECK(rows >= 3);
    CHECK(rows < 60);
    CHECK(nlohmann::json::parse(content(scratch / "out/summary.json"))["complete"] == false);
    const auto again = run_yoke(scratch, sweep);
    CHECK(again.code == 0);
    CHECK(contains(again.out, fmt::format("60 done ({} from before)", rows)));
    CHECK(rows_of_sweep(scratch / "out/sweep.csv") == 60);
  }

  TEST_CASE("other options in the same folder are refused by name") {
    const TemporaryFolder scratch;
    REQUIRE(run_yoke(scratch, small + "-q -o out").code == 0);
    const auto refused = [&](const std::string& more) {
      const auto run = run_yoke(scratch, small + more + " -o out");
      CHECK(run.code == 1);
      return run.out;
    };
    CHECK(contains(refused("--rtol 1e-9"), "--rtol is 1e-10 there and 1e-09 here"));
    CHECK(contains(refused("--vary rod=100mm,120mm"), "'out' holds another sweep: --vary is"));
    CHECK(run_yoke(scratch, small + "-o out --jobs 1 --quiet --no-report").code == 0);
  }

  TEST_CASE("measures and words that no run has are refused before the first") {
    const TemporaryFolder scratch;
    const auto said = [&](const std::string& more) {
      const auto run = run_yoke(scratch, small + more + " -o out");
      CHECK(run.code == 1);
      return run.out;
    };
    CHECK(
        contains(said("--measure crnk.x_m:max"), "no column 'crnk.x_m'; did you mean 'crank.x_m'"));
    CHECK(contains(said("--measure crank.x_m:most"), "expected COLUMN:max"));
    CHECK(contains(said("--measure crank.x_m:at=2"), "has no unit"));
    CHECK(contains(said("--turn crank.x_m"), "not a column of an angle"));
    CHECK(contains(said("--law hertz"), "no contact laws"));
    CHECK(contains(said("--random 0"), "--random 0: accepted are 1 to"));
    CHECK_FALSE(fs::exists(scratch / "out"));
  }
}
