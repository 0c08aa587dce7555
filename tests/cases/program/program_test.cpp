// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The yoke program as a user meets it: what it writes, what it says, how it ends.
#include <doctest/doctest.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include <yoke/core/result.hpp>
#include <yoke/tests/cases/program/program_run.hpp>
#include <yoke/tests/files.hpp>
#include <yoke/tests/messages.hpp>

namespace {

using namespace yoke::tests;
using Outcome = ProgramOutcome;
namespace fs = std::filesystem;

TEST_SUITE("program") {
  TEST_CASE("a short run writes the files and columns that scripts rely on") {
    const TemporaryFolder scratch;
    const Outcome run = run_yoke(scratch,
                                 "run scotch_yoke -o out --samples 101 --law johnson --no-plots "
                                 "--law table11-goldsmith --set revolutions=0.25");
    CHECK(run.code == 0);
    CHECK(contains(run.out, "out/LAW/{motion.csv,events.csv,summary.json}"));
    for (const char* law : {"johnson", "table11-goldsmith"}) {
      const fs::path folder = scratch / "out" / law;
      CHECK(check_rows(folder / "motion.csv") == 101);
      const std::vector<std::string> header = cells(lines(folder / "motion.csv").front());
      for (const char* column :
           {"t_s", "crank_angle_rad", "slider_x_m", "slider_v_m_per_s", "slider_a_m_per_s2",
            "penetration_m", "penetration_rate_m_per_s", "normal_force_N", "region", "pivot_fx_N",
            "guide_fy_N", "motor_torque_N_m", "kinetic_J", "stored_J", "dissipated_J", "work_J"})
        CHECK_MESSAGE(std::ranges::find(header, column) != header.end(), column);
      const std::vector<std::string> last = cells(lines(folder / "motion.csv").back());
      CHECK(std::stod(last[0]) == 0.25 / 12.0);

      CHECK(lines(folder / "events.csv").front().starts_with("t_s,kind,region,speed_m_per_s"));
      CHECK(check_rows(folder / "events.csv") > 3);
      CHECK(cells(lines(folder / "events.csv")[1])[1] == "onset");

      const auto summary = nlohmann::json::parse(content(folder / "summary.json"));
      CHECK(summary["law"] == law);
      CHECK(summary["parameters"]["revolutions"] == "0.25");
      CHECK(summary["stop"] == "completed");
      CHECK(summary["samples"] == 101);
      for (const char* key : {"steps", "evaluations", "factorisations", "events", "peak_force_N",
                              "worst_constraint_violation_m", "worst_constraint_violation_rad",
                              "position_violation_m", "angle_violation_rad",
                              "position_violation_m_or_rad", "energy_balance_J", "wall_time_s"})
        CHECK_MESSAGE(summary[key].is_number(), key);
      CHECK(summary["worst_constraint_violation_m"] < 1e-10);
    }
  }

  TEST_CASE("a run writes its report unless told not to; pages are made again of what it stored") {
    const TemporaryFolder scratch;
    const auto runs_in = [&](const fs::path& page) {
      const std::string text = content(page), mark = "class=\"run\">";
      std::size_t count = 0;
      for (std::size_t at = 0; (at = text.find(mark, at)) != std::string::npos; ++at) ++count;
      return count;
    };
    const std::string run = "run scotch_yoke --samples 101 --no-plots --set revolutions=0.25 ";
    CHECK(contains(run_yoke(scratch, run + "-o out --law johnson --law table11-goldsmith").out,
                   "report: out/report.html"));
    const fs::path page = scratch / "out/report.html";
    CHECK(runs_in(page) == 2);
    const auto replay = nlohmann::json::parse(content(scratch / "out/johnson/replay.json"));
    CHECK(replay["command"] ==
          "yoke run scotch_yoke --set revolutions=0.25 --law johnson --law table11-goldsmith "
          "--samples 101");
    CHECK(replay["impacts"].size() > 3);
    CHECK(replay["views"].size() == 8);

    const std::string before = content(page);
    fs::remove(page);
    CHECK(run_yoke(scratch, "report out").code == 0);
    CHECK((content(page) == before));  // not printed if it is not

    CHECK(run_yoke(scratch, run + "-o other --law johnson --set crank_length=40mm").code == 0);
    const Outcome both = run_yoke(scratch, "compare out other -o both");
    CHECK(both.code == 0);
    CHECK(contains(both.out, "  table11-goldsmith\n"));
    CHECK(contains(both.out, "out: johnson\n"));
    CHECK(contains(both.out, "other: johnson\n"));
    CHECK(runs_in(scratch / "both/comparison.html") == 3);
    const Outcome alone = run_yoke(scratch, "compare other");
    CHECK(alone.code != 0);
    CHECK(contains(alone.out, "one run alone"));

    CHECK(run_yoke(scratch, run + "-o none --law johnson --no-report").code == 0);
    CHECK(!fs::exists(scratch / "none/report.html"));
    CHECK(!fs::exists(scratch / "none/johnson/replay.json"));
    const Outcome nothing = run_yoke(scratch, "report none");
    CHECK(nothing.code != 0);
    CHECK(contains(nothing.out, "'none'"));

    CHECK(run_yoke(scratch, "view geneva -o drawn").code == 0);
    CHECK(runs_in(scratch / "drawn/view.html") == 1);
    CHECK(!fs::exists(scratch / "drawn/motion.csv"));
  }

  TEST_CASE("a run ends with its checks, law by law where there are laws") {
    const TemporaryFolder scratch;
    const Outcome pendulum =
        run_yoke(scratch, "run point_pendulum -o out --no-plots --set duration=6 --rtol 1e-9");
    CHECK(pendulum.code == 0);
    CHECK(contains(pendulum.out, "\ncheck: period 2.3678419"));
    CHECK(contains(pendulum.out, ", expected 2.36784195 s within"));
    CHECK(contains(pendulum.out, "\ncheck: imbalance of the energy "));
    CHECK_FALSE(contains(pendulum.out, "OUTSIDE"));
    const auto checks = nlohmann::json::parse(content(scratch / "out/summary.json"))["checks"];
    REQUIRE(checks.size() == 2);
    CHECK(checks[1]["what"] == "period");
    CHECK(checks[1]["unit"] == "s");
    CHECK(checks[1]["within"] == true);
    CHECK(std::abs(checks[1]["value"].get<double>() - checks[1]["expected"].get<double>()) <
          checks[1]["tolerance"].get<double>());

    const Outcome laws = run_yoke(scratch,
                                  "run scotch_yoke -o laws --no-plots --samples 201 --law "
                                  "johnson --law johnson-10mm --set revolutions=0.1");
    CHECK(contains(laws.out, "\ncheck: johnson: slider farther from"));
    CHECK(contains(laws.out, "\ncheck: johnson-10mm: imbalance of the energy"));
  }

  TEST_CASE("the same run gives the same bytes, on one thread or two") {
    const TemporaryFolder scratch;
    const std::string run = "run scotch_yoke --samples 201 --set revolutions=0.3 --no-plots -o ";
    CHECK(run_yoke(scratch, run + "one --jobs 1").code == 0);
    CHECK(run_yoke(scratch, run + "two --jobs 2").code == 0);
    for (const char* law : {"table11-lankarani-nikravesh", "johnson-10mm"})
      for (const char* file : {"motion.csv", "events.csv"})
        CHECK(content(scratch / "one" / law / file) == content(scratch / "two" / law / file));
  }

  TEST_CASE("plots are drawn, or their absence is explained") {
    const TemporaryFolder scratch;
    const std::string run = "run scotch_yoke -o out --set revolutions=1 --law table11-johnson";
    const bool gnuplot = std::system("command -v gnuplot >/dev/null") == 0;
    if (gnuplot) {
      const Outcome drawn = run_yoke(scratch, run);
      CHECK_MESSAGE(drawn.code == 0, drawn.out);
      for (const char* name :
           {"figure11", "figure12", "figure13", "figure14", "figure15", "figure16", "mechanism"})
        for (const char* kind : {".png", ".svg", ".gp"})
          CHECK_MESSAGE(fs::file_size(scratch / "out/plots" / (std::string(name) + kind)) > 500,
                        name);
      CHECK(!contains(drawn.out, "failed"));
    }
    const Outcome without = run_yoke(scratch, run, "PATH=/nowhere; ");
    CHECK(without.code == 0);
    CHECK(contains(without.out, "gnuplot is not installed"));
    CHECK(contains(without.out, "apt-get install gnuplot-nox"));
  }

  TEST_CASE("help, list and version") {
    const TemporaryFolder scratch;
    const Outcome help = run_yoke(scratch, "run scotch_yoke --help");
    CHECK(help.code == 0);
    for (const char* text : {"crank_length", "default 45mm; 1 mm to 51.9 mm; units mm, cm, m, um",
                             "slider_start", "table11-esdu-78035", "arkode-projection", "--rtol"})
      CHECK_MESSAGE(contains(help.out, text), text);
    const Outcome verb = run_yoke(scratch, "run --help");
    CHECK(verb.code == 0);
    CHECK(contains(verb.out, "scotch_yoke"));
    const Outcome list = run_yoke(scratch, "list");
    CHECK(list.code == 0);
    CHECK(contains(list.out, "table11-johnson-10mm"));
    CHECK(run_yoke(scratch, "--version").out.starts_with("yoke 0."));
  }

  TEST_CASE("mistakes on the command line are explained and end with a failure") {
    const TemporaryFolder scratch;
    const auto message = [&](const std::string& arguments) {
      const Outcome outcome = run_yoke(scratch, arguments);
      CHECK_MESSAGE(outcome.code != 0, arguments);
      CHECK_MESSAGE(outcome.out.starts_with("yoke: "), outcome.out);
      return outcome.out;
    };
    CHECK(contains(message("run"), "which case? There are 'scotch_yoke'"));
    CHECK(contains(message("run scotch"), "did you mean 'scotch_yoke'?"));
    CHECK(contains(message("run scotch_yoke --set crank_length=45"), "has no unit"));
    CHECK(contains(message("run scotch_yoke --law herz"),
                   "unknown law 'herz'; did you mean 'hertz'?"));
    CHECK(contains(message("run scotch_yoke --formulation ida"), "did you mean 'ida-ggl'?"));
    CHECK(contains(message("run scotch_yoke --rtol 1"), "accepted is 1e-13 to 1e-2"));
    CHECK(contains(message("run scotch_yoke --rtol nan"), "accepted is 1e-13 to 1e-2"));
    CHECK(contains(message("run scotch_yoke --samples 1"), "at least 2 are needed"));
    CHECK(contains(message("run scotch_yoke --wrong"), "--wrong"));
    CHECK(contains(message("runn"), "yoke --help"));
  }

  TEST_CASE("what would be passed over in silence is refused by name, value and range") {
    const TemporaryFolder scratch;
    const auto refused = [&](const std::string& arguments, const std::string& why) {
      const Outcome outcome = run_yoke(scratch, arguments);
      CHECK_MESSAGE(outcome.code == 1, arguments);
      CHECK_MESSAGE(contains(outcome.out, why), outcome.out);
    };
    refused("run hanging_chain --set links=2.5",
            "links: 2.5 is not a whole number; accepted: a whole number, 1 to 1000000");
    refused("modes hanging_chain --lowest=-1", "lowest = -1 must be at least 0");
    refused("run n_four_bar --set N=1.7", "N: 1.7 is not a whole number");
    refused("run parallelogram --set cranks=3.1", "cranks: 3.1 is not a whole number");
    refused("run hanging_chain --law hertz",
            "--law hertz: case 'hanging_chain' has no contact laws to choose from");
    refused("run hanging_chain --checkpoint 0s", "--checkpoint 0s: must be greater than 0 s");
    refused("run hanging_chain --checkpoint=-1s", "--checkpoint -1s: must be greater than 0 s");
    refused("run hanging_chain --checkpoint-events 0", "--checkpoint-events 0: must be at least 1");
    refused("run hanging_chain --spectral-radius 0.5",
            "--spectral-radius 0.5: formulation 'automatic' has none; it belongs to --formulation "
            "generalised-alpha");
    refused("run hanging_chain --formulation ida-ggl --spectral-radius 0.5",
            "formulation 'ida-ggl' has none");
    refused("run hanging_chain --formulation generalised-alpha --spectral-radius 1",
            "--spectral-radius 1: accepted is 0 to 0.999");
    refused("run hanging_chain --order 6", "--order 6: accepted are 5, 7");
    refused("run hanging_chain --formulation ida-ggl --order 7",
            "--order 7: formulation 'ida-ggl' has none");
    refused("run hanging_chain --linear-solver lu",
            "unknown linear solver 'lu': automatic, klu, range-klu or blocks");
    CHECK(!fs::exists(scratch / "results"));
  }

  TEST_CASE(
      "--linear-solver is used, kept in the summary and by a resumed run, and agrees with the others") {
    const TemporaryFolder scratch;
    const std::string run = "run hanging_chain --rtol 1e-9 --no-plots --no-report --samples 11 ";
    std::vector<double> angles;
    for (const std::string solver : {"klu", "range-klu", "blocks", "automatic"}) {
      CHECK(run_yoke(scratch, run + "--checkpoint 1s --linear-solver " + solver + " -o " + solver)
                .code == 0);
      CHECK(run_yoke(scratch, "resume " + solver).code == 0);
      const auto summary = nlohmann::json::parse(content(scratch / solver / "summary.json"));
      CHECK(summary.at("linear_solver") == (solver == "automatic" ? "blocks" : solver));
      angles.push_back(std::stod(cells(lines(scratch / solver / "motion.csv").back()).at(3)));
      CHECK(angles.back() == doctest::Approx(angles.front()).epsilon(1e-7));
    }
    CHECK(angles[3] == angles[2]);
  }

  TEST_CASE("--spectral-radius reaches generalised-alpha, also in a resumed run") {
    const TemporaryFolder scratch;
    const std::string run =
        "run hanging_chain --formulation generalised-alpha --rtol 1e-5 --no-plots --samples 11 ";
    CHECK(run_yoke(scratch, run + "-o default").code == 0);
    CHECK(run_yoke(scratch, run + "--spectral-radius 0.8 -o same").code == 0);
    CHECK(run_yoke(scratch, run + "--spectral-radius 0.3 --checkpoint 1s -o damped").code == 0);
    const auto steps = [&](const char* folder) {
      return nlohmann::json::parse(content(scratch / folder / "summary.json")).at("steps");
    };
    CHECK(content(scratch / "default/motion.csv") == content(scratch / "same/motion.csv"));
    CHECK(steps("damped") != steps("default"));
    CHECK(run_yoke(scratch, "resume damped").code == 0);
    CHECK(nlohmann::json::parse(content(scratch / "damped/run.json"))["spectral_radius"] == "0.3");
  }

  TEST_CASE("an impact that is not resolved or beyond every law is refused in words") {
    const TemporaryFolder scratch;
    const std::string law = "impact --elastic power:K=1e8,n=1.5 ";
    const auto refused = [&](const std::string& arguments, const std::string& why) {
      const Outcome outcome = run_yoke(scratch, arguments);
      CHECK_MESSAGE(outcome.code == 1, arguments);
      CHECK_MESSAGE(contains(outcome.out, why), outcome.out);
    };
    for (const char* fast : {"1e300", "1e20"})
      refused(law + "--mass 1 --speed " + fast,
              "m/s is outside the accepted range 0 to 2.99792e+08 m/s");
    refused(law + "--mass 1e30 --speed 1",
            "speed = 1 m/s with mass = 1e+30 kg would press at least 1000 m into the elastic law; "
            "accepted is a depth of 1e-09 to 1000 m: choose a smaller speed or mass");
    refused(law + "--mass 1 --speed 1e-9", "would press only 4.353e-11 m into the elastic law");
    const Outcome slow = run_yoke(scratch, law + "--mass 1 --speed 1e-7 --format json");
    CHECK(slow.code == 0);
    CHECK(nlohmann::json::parse(slow.out)["restitution"]["engine"].get<double>() ==
          doctest::Approx(1.0).epsilon(1e-4));
    const Outcome range = run_yoke(scratch, law + "--mass 1 --speed 1 --restitution 2");
    CHECK(range.out ==
          "yoke: command line: --restitution = 2 is outside the accepted range 0 to 1\n");
  }

  TEST_CASE("a folder that cannot be written is named before anything runs") {
    const TemporaryFolder scratch;
    const Outcome file = run_yoke(scratch, "run scotch_yoke -o taken/out", "touch taken; ");
    CHECK(file.code == 1);
    CHECK(contains(file.out, "cannot make the output folder 'taken/out'"));
    if (geteuid() != 0) {
      const Outcome locked =
          run_yoke(scratch, "run scotch_yoke -o locked", "mkdir locked; chmod a-w locked; ");
      CHECK(locked.code == 1);
      CHECK(contains(locked.out, "cannot write into the output folder 'locked'"));
    }
  }

  TEST_CASE("Ctrl-C leaves what was computed, readable") {
    const TemporaryFolder scratch;
    const fs::path log = scratch / "log";
    const pid_t child = start("cd '" + scratch.path().string() + "'; " + program +
                              " run scotch_yoke -o out --set revolutions=2000 --samples 20001 "
                              "--law table11-johnson --law johnson >'" +
                              log.string() + "' 2>&1");
    std::this_thread::sleep_for(std::chrono::milliseconds(700));
    kill(child, SIGINT);
    CHECK(wait_for(child) == 130);
    CHECK(contains(content(log), "interrupted at t = "));
    const fs::path folder = scratch / "out" / "table11-johnson";
    const auto summary = nlohmann::json::parse(content(folder / "summary.json"));
    CHECK(summary["stop"] == "interrupted");
    const std::size_t rows = check_rows(folder / "motion.csv");
    CHECK(rows > 1);
    CHECK(rows < 20001);
    CHECK(summary["samples"] == rows);
    CHECK(check_rows(folder / "events.csv") > 3);
  }

  // A limit on the size of files acts as a full disk does.
  TEST_CASE("a killed run goes on from its checkpoint and ends with the same bytes") {
    const TemporaryFolder scratch;
    const std::string run =
        "run scotch_yoke --law table11-johnson --samples 201 --set revolutions=1 --no-plots "
        "--checkpoint 0.01s -o ";
    CHECK(run_yoke(scratch, run + "whole").code == 0);
    const pid_t child =
        start("cd '" + scratch.path().string() + "'; " + program + " " + run + "cut >log 2>&1");
    const fs::path checkpoint = scratch / "cut/table11-johnson/checkpoint/checkpoint.bin";
    for (int i = 0; i < 2000 && !fs::exists(checkpoint); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    kill(child, SIGKILL);
    wait_for(child);
    CHECK(run_yoke(scratch, "resume cut").code == 0);
    for (const char* file : {"motion.csv", "events.csv"})
      CHECK(content(scratch / "cut/table11-johnson" / file) ==
            content(scratch / "whole/table11-johnson" / file));
    const Outcome nothing = run_yoke(scratch, "resume nowhere");
    CHECK(nothing.code == 1);
    CHECK(contains(nothing.out, "there is no 'nowhere/run.json'"));
  }

  TEST_CASE("every case verifies and writes checkpoints") {
    const TemporaryFolder scratch;
    CHECK(
        run_yoke(scratch, "run point_pendulum --verify --checkpoint 0.5s --no-plots -o out").code ==
        0);
    const auto summary = nlohmann::json::parse(content(scratch / "out/summary.json"));
    CHECK(summary.at("verification").at("digits").size() > 10);
    CHECK(fs::exists(scratch / "out/checkpoint/checkpoint.bin"));
    CHECK(run_yoke(scratch, "resume out").code == 0);
  }

  TEST_CASE("--verify writes how many digits of each quantity agree") {
    const TemporaryFolder scratch;
    const Outcome outcome = run_yoke(
        scratch,
        "run scotch_yoke --law table11-johnson --samples 101 --set revolutions=0.3 --no-plots "
        "--verify -o out");
    CHECK(outcome.code == 0);
    CHECK(contains(outcome.out, "digits that agree with ida-ggl at a tolerance of 1e-12"));
    const auto summary =
        nlohmann::json::parse(content(scratch / "out/table11-johnson/summary.json"));
    CHECK(summary.at("formulation") == "arkode-projection");
    CHECK(summary.at("verification").at("formulation") == "ida-ggl");
    CHECK(summary["verification"]["same_events"] == true);
    CHECK(summary["verification"]["digits"]["slider.x_m"] > 6.0);
    CHECK(summary["verification"]["worst"]["digits"] > 3.0);
  }

  TEST_CASE("a full disk leaves no half of a file and is reported") {
    const TemporaryFolder scratch;
    const Outcome full =
        run_yoke(scratch, "run scotch_yoke -o out --law johnson --no-plots", "ulimit -f 200; ");
    CHECK(full.code == 1);
    CHECK(contains(full.out, "cannot write 'out/johnson/motion.csv': "));
    const fs::path folder = scratch / "out" / "johnson";
    CHECK(nlohmann::json::parse(content(folder / "summary.json"))["stop"] == "completed");
    CHECK(!fs::exists(folder / "motion.csv"));
    CHECK(!fs::exists(folder / "motion.csv.part"));
    // Nothing at all can be written: no file of zero bytes is left.
    const Outcome none =
        run_yoke(scratch, "run point_pendulum -o none --no-plots", "ulimit -f 0; ");
    CHECK(none.code == 1);
    CHECK(!fs::exists(scratch / "none/summary.json"));
    CHECK(!fs::exists(scratch / "none/run.json"));
  }

  TEST_CASE("checkpoints too close to each other are refused, or warned of, before the run") {
    const TemporaryFolder scratch;
    const Outcome refused =
        run_yoke(scratch, "run point_pendulum --checkpoint 1e-9s --no-plots -o refused");
    CHECK(refused.code == 1);
    CHECK(contains(refused.out,
                   "checkpoints every 1e-09 s would be 1e+10 of them in 10 s; "
                   "accepted are up to 1e+06, at least 1e-05 s apart; every 0.1 s "
                   "would be 100"));
  }

  TEST_CASE("a run.json of before there was a spectral radius is a whole one") {
    const TemporaryFolder scratch;
    CHECK(run_yoke(scratch, "run point_pendulum --checkpoint 5s --no-plots -o out").code == 0);
    const std::string motion = content(scratch / "out/motion.csv");
    auto options = nlohmann::json::parse(content(scratch / "out/run.json"));
    CHECK(options.erase("spectral_radius") == 1);
    yoke::write_text(scratch / "out/run.json", options.dump());
    const Outcome resumed = run_yoke(scratch, "resume out");
    CHECK_MESSAGE(resumed.code == 0, resumed.out);
    CHECK(content(scratch / "out/motion.csv") == motion);
    CHECK(options.erase("samples") == 1);  // always there: this one is damaged
    yoke::write_text(scratch / "out/run.json", options.dump());
    CHECK(contains(run_yoke(scratch, "resume out").out, "is damaged"));
  }
}

}  // namespace
