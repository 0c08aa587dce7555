// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// `yoke law` and `yoke impact` as a script meets them: names, columns, digits, messages.
#include <doctest/doctest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include <yoke/tests/files.hpp>
#include <yoke/tests/messages.hpp>

extern char** environ;

namespace {

using namespace yoke::tests;

constexpr double pi = 3.14159265358979323846;

struct Outcome {
  int code = -1;
  std::string out, err;
};

Outcome run_yoke(const std::string& arguments) {
  const TemporaryFolder folder;
  std::string shell = "sh", flag = "-c";
  std::string text = "cd '" + folder.path().string() + "' && exec '" YOKE_BINARY_DIR "/yoke' " +
                     arguments + " >out 2>err";
  char* words[] = {shell.data(), flag.data(), text.data(), nullptr};
  pid_t child = 0;
  REQUIRE(posix_spawnp(&child, "sh", nullptr, nullptr, words, environ) == 0);
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  return {.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1,
          .out = content(folder / "out"),
          .err = content(folder / "err")};
}

struct Csv {
  std::string header;
  std::vector<std::vector<double>> rows;
  std::vector<std::vector<std::string>> cells;
};

Csv csv(const std::string& arguments) {
  const Outcome run = run_yoke(arguments);
  REQUIRE_MESSAGE(run.code == 0, run.err);
  Csv table;
  std::stringstream text(run.out);
  std::getline(text, table.header);
  for (std::string line; std::getline(text, line);) {
    table.rows.emplace_back();
    table.cells.emplace_back();
    std::stringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) {
      table.cells.back().push_back(cell);
      table.rows.back().push_back(cell.empty() ? std::nan("") : std::stod(cell));
    }
  }
  return table;
}

nlohmann::json json(const std::string& arguments) {
  const Outcome run = run_yoke(arguments + " --format json");
  REQUIRE_MESSAGE(run.code == 0, run.err);
  return nlohmann::json::parse(run.out);
}

double off(double value, double reference) { return std::abs(value / reference - 1.0); }

// 17 significant digits, no more and no fewer than %.17g prints.
bool is_exact(const std::string& cell) {
  char text[64];
  std::snprintf(text, sizeof text, "%.17g", std::stod(cell));
  return cell == text;
}

const std::string round_pair =
    " --pin-radius 7.9mm --wall-radius 8mm --length 10mm --penetration 1e-6,1e-5 --format csv";
const std::string columns = "penetration_m,force_N,stiffness_N_per_m,energy_J";
const std::string spring = " --elastic power:K=1e8,n=1.5";

}  // namespace

TEST_SUITE("law verb") {
  TEST_CASE("every name of the contract is listed and shown") {
    const Outcome list = run_yoke("law list");
    CHECK(list.code == 0);
    for (const std::string name : {"hertz",
                                   "lankarani-nikravesh",
                                   "radzimovsky",
                                   "goldsmith",
                                   "dubowsky-freudenstein",
                                   "esdu-78035",
                                   "johnson",
                                   "pereira-2011",
                                   "pereira-2015",
                                   "power",
                                   "none",
                                   "kelvin-voigt",
                                   "hunt-crossley",
                                   "herbert-mcwhannell",
                                   "lee-wang-1",
                                   "lee-wang-2",
                                   "khulief-shabana",
                                   "lankarani-nikravesh-1994",
                                   "tsuji",
                                   "marhefka-orin",
                                   "marhefka-orin-simplified",
                                   "gonthier",
                                   "flores",
                                   "gharib-hurmuzlu",
                                   "gharib-hurmuzlu-2",
                                   "hu-guo"}) {
      CHECK_MESSAGE(contains(list.out, "  " + name + " "), name);
      const Outcome show = run_yoke("law show " + name);
      CHECK_MESSAGE(show.code == 0, name);
      CHECK_MESSAGE(show.out.starts_with(name + " ("), show.out);
      CHECK_MESSAGE(contains(show.out, "formula"), name);
    }
    // One name, two laws.
    const Outcome both = run_yoke("law show lankarani-nikravesh");
    CHECK(contains(both.out, "lankarani-nikravesh (elastic)"));
    CHECK(contains(both.out, "lankarani-nikravesh (dissipative)"));
  }

  TEST_CASE("a power law is evaluated to the last digits, in metres and in millimetres") {
    const std::string points = " --penetration 1e-6,0.25mm,3um,0";
    for (const std::string law :
         {"power:K=1e8,n=1.5", "power:K=3162.2776601683795,n=1.5,unit=mm"}) {
      const Csv table = csv("law eval --elastic " + law + points);
      CHECK(table.header == columns);
      REQUIRE(table.rows.size() == 4);
      const double d[] = {1e-6, 0.25e-3, 3e-6, 0.0};
      for (std::size_t i = 0; i < 4; ++i) {
        for (const std::string& cell : table.cells[i]) CHECK_MESSAGE(is_exact(cell), cell);
        CHECK(table.rows[i][0] == doctest::Approx(d[i]).epsilon(1e-15));
        if (i == 3) {
          CHECK(table.rows[i][1] == 0.0);
          continue;
        }
        CHECK(off(table.rows[i][1], 1e8 * d[i] * std::sqrt(d[i])) < 2e-15);
        CHECK(off(table.rows[i][2], 1.5e8 * std::sqrt(d[i])) < 2e-15);
        CHECK(off(table.rows[i][3], 0.4e8 * d[i] * d[i] * std::sqrt(d[i])) < 2e-15);
      }
    }
  }

  TEST_CASE("johnson satisfies its own equation, internal and external") {
    const double modulus = 207e9 / (2.0 * (1.0 - 0.3 * 0.3)), length = 10e-3;
    for (const std::string side : {"--internal", "--external"}) {
      const double difference = side == "--internal" ? 8e-3 - 7.9e-3 : 8e-3 + 7.9e-3;
      const double a = 1.0 / (pi * modulus * length);
      const Csv table = csv("law eval --elastic johnson --reading consistent --material steel " +
                            side + round_pair);
      CHECK(table.header == columns);
      REQUIRE(table.rows.size() == 2);
      for (const std::vector<double>& row : table.rows) {
        const double d = row[0], F = row[1];
        const double logarithm = std::log(4.0 * pi * modulus * difference * length / F);
        CHECK(off(a * F * (logarithm - 1.0), d) < 1e-12);
        CHECK(off(1.0 / (a * (logarithm - 2.0)), row[2]) < 1e-12);
        // U = F d - int_0^F d dF
        CHECK(off(F * d - a * F * F * (0.5 * (logarithm - 1.0) + 0.25), row[3]) < 1e-12);
      }
      const Csv same =
          csv("law eval --elastic johnson --material E=207GPa,nu=0.3 " + side + round_pair);
      CHECK(same.cells == table.cells);
      const Csv pascal =
          csv("law eval --elastic johnson --material E=207e9,nu=0.3 " + side + round_pair);
      CHECK(pascal.cells == table.cells);
    }
  }

  TEST_CASE("a tabulated reading warns on stderr and leaves the columns alone") {
    const Outcome odd = run_yoke("law eval --elastic goldsmith --reading tabulated" + round_pair);
    CHECK(odd.code == 0);
    CHECK(odd.out.starts_with(columns + "\n"));
    CHECK_MESSAGE(odd.err.starts_with("yoke: warning: goldsmith (tabulated): "), odd.err);
    const Outcome quiet = run_yoke("law eval --elastic goldsmith" + round_pair);
    CHECK(quiet.code == 0);
    CHECK(quiet.err.empty());
  }

  TEST_CASE("the fit of a power law is that power law; of johnson it says its error") {
    const nlohmann::json own = json("law fit --max-load 1000N" + spring);
    CHECK(off(own["K_N_per_m_n"], 1e8) < 1e-9);
    CHECK(off(own["n"], 1.5) < 1e-10);
    CHECK(own["max_relative_error"] < 1e-9);
    const nlohmann::json johnson =
        json("law fit --elastic johnson --material steel --clearance 0.5mm --max-load 1000");
    CHECK(johnson["n"] > 1.0);
    CHECK(johnson["n"] < 1.3);
    CHECK(johnson["max_load_N"] == 1000.0);
    CHECK(johnson["max_relative_error"] > 0.01);
    CHECK(johnson["rms_relative_error"] < johnson["max_relative_error"]);
    CHECK(johnson["assumed"].size() == 2);
    const Csv table = csv("law fit --format csv --max-load 1000" + spring);
    CHECK(table.header.starts_with("K_N_per_m_n,n,"));
    CHECK(off(table.rows.front()[0], 1e8) < 1e-9);
    // Range and number of the loads are options; away from zero the fit is better.
    const nlohmann::json upper = json(
        "law fit --elastic johnson --material steel --clearance 0.5mm --min-load 100 --max-load "
        "1000 --samples 901");
    CHECK(upper["min_load_N"] == 100.0);
    CHECK(upper["samples"] == 901);
    CHECK(upper["max_relative_error"] < 0.1 * double(johnson["max_relative_error"]));
    CHECK(upper["relative_error_at_small_load"] < -0.1);  // at 1 N, outside
    const Outcome text = run_yoke("law fit --max-load 1000" + spring);
    CHECK(contains(text.out, "N/m^n"));
  }

  TEST_CASE("an impact: restitution, largest penetration and force, duration, energy") {
    const double v = 0.37, m = 1.3, e = 0.7, K = 1e8, n = 1.5;
    const std::string impact = "impact --speed 0.37 --mass 1.3" + spring;
    for (const std::string formulation : {"arkode-projection", "ida-ggl"}) {
      for (const std::string setup : {"bodies", "wall", "slot", "pendulum"}) {
        const std::string how = " --formulation " + formulation + " --setup " + setup;
        const nlohmann::json flores =
            json(impact + " --dissipation flores --restitution 0.7" + how);
        const double X = 8.0 * (1.0 - e) / (5.0 * e);
        double low = 1e-3, high = 1.0 / X - 1e-9;  // of X (1 + y) = ln((1 + X)/(1 - X y)), y > 0
        for (int i = 0; i < 200; ++i) {
          const double y = 0.5 * (low + high);
          (X * (1.0 + y) - std::log((1.0 + X) / (1.0 - X * y)) > 0.0 ? low : high) = y;
        }
        CHECK(flores["restitution"]["asked"] == 0.7);
        CHECK(off(flores["restitution"]["closed_form"], low) < 1e-12);
        CHECK(off(flores["restitution"]["engine"], low) < 1e-9);
        const double deepest = m * v * v / (X * X) * (X - std::log1p(X));  // stored energy
        CHECK(off(flores["max_penetration_m"], std::pow((n + 1.0) * deepest / K, 1.0 / (n + 1.0))) <
              1e-9);
        CHECK(off(flores["dissipated_J"], 0.5 * m * v * v * (1.0 - low * low)) < 1e-9);

        const nlohmann::json elastic = json(impact + " --dissipation none" + how);
        const double depth = std::pow((n + 1.0) * 0.5 * m * v * v / K, 1.0 / (n + 1.0));
        const double shape =
            std::sqrt(pi) * std::tgamma(1.0 + 1.0 / (n + 1.0)) / std::tgamma(0.5 + 1.0 / (n + 1.0));
        CHECK(off(elastic["restitution"]["engine"], 1.0) < 1e-9);
        CHECK(off(elastic["max_penetration_m"], depth) < 1e-9);
        CHECK(off(elastic["max_force_N"], K * std::pow(depth, n)) < 1e-9);
        CHECK(off(elastic["duration_s"], 2.0 * depth / v * shape) < 1e-9);
        CHECK(elastic["dissipated_J"] == 0.0);
      }
    }
    const Csv table = csv(impact + " --dissipation flores --restitution 0.7 --format csv");
    CHECK(table.header.starts_with(
        "restitution_asked,restitution_closed_form,restitution_engine,max_penetration_m,"
        "max_force_N,duration_s,dissipated_J"));
    CHECK(table.rows.size() == 1);
    CHECK(
        contains(run_yoke(impact + " --restitution 0.7 --dissipation flores").out, "restitution"));
    // A law without a closed form says so.
    CHECK(json("impact --speed 0.37 --mass 1.3 --elastic power:K=1e8,n=1 --dissipation lee-wang-2 "
               "--restitution 0.5")["restitution"]["closed_form"]
              .is_null());
  }

  TEST_CASE("--plot draws the loop and leaves its data") {
    const std::string folder = YOKE_BINARY_DIR "/results/loop_test";
    std::filesystem::remove_all(folder);
    const Outcome drawn =
        run_yoke("impact --speed 0.37 --mass 1.3" + spring +
                 " --dissipation flores --restitution 0.7 --format json --plot -o " + folder);
    CHECK(drawn.code == 0);
    const nlohmann::json numbers = nlohmann::json::parse(drawn.out);
    std::ifstream file(folder + "/loop.csv");
    std::string line;
    std::getline(file, line);
    CHECK(line == "t_s,penetration_m,rate_m_per_s,force_N");
    double deepest = 0.0, strongest = 0.0;
    int rows = 0;
    while (std::getline(file, line)) {
      std::istringstream cells(line);
      double value[4] = {};
      char comma = 0;
      for (double& cell : value) cells >> cell >> comma;
      deepest = std::max(deepest, value[1]);
      strongest = std::max(strongest, value[3]);
      ++rows;
    }
    CHECK(rows > 1000);
    CHECK(off(deepest, numbers["max_penetration_m"]) < 1e-5);
    CHECK(off(strongest, numbers["max_force_N"]) < 1e-5);
    CHECK(std::filesystem::exists(folder + "/loop.gp"));
    if (!contains(drawn.err, "gnuplot is not installed"))
      CHECK(std::filesystem::file_size(folder + "/loop.png") > 3000);
  }

  TEST_CASE("mistakes are explained and end with a failure") {
    const auto message = [](const std::string& arguments) {
      const Outcome outcome = run_yoke(arguments);
      CHECK_MESSAGE(outcome.code != 0, arguments);
      CHECK_MESSAGE(outcome.out.empty(), outcome.out);
      CHECK_MESSAGE(outcome.err.starts_with("yoke: "), outcome.err);
      return outcome.err;
    };
    const std::string at = " --penetration 1e-6";
    CHECK(contains(message("law show jonson"), "did you mean 'johnson'?"));
    CHECK(contains(message("law eval --elastic johnsn" + at), "johnson"));
    CHECK(contains(message("law eval" + at), "--elastic is missing"));
    CHECK(contains(message("law eval --elastic johnson" + at), "--pin-radius is missing"));
    CHECK(contains(message("law eval" + spring), "--penetration is missing"));
    CHECK(contains(message("law eval --penetration 1kg" + spring), "accepted: mm, cm, m, um"));
    CHECK(contains(message("law eval --penetration nan" + spring), "finite number"));
    CHECK(contains(message("law eval --penetration=-1e-6" + spring), "valid from 0"));
    CHECK(contains(message("law eval --format xml" + at + spring), "--format 'xml'"));
    CHECK(
        contains(message("law eval --elastic johnson --reading tabled" + round_pair), "tabulated"));
    CHECK(contains(message("law eval --elastic johnson --material wood" + round_pair),
                   "steel, aluminium or E=207GPa,nu=0.3"));
    CHECK(contains(message("law eval --elastic johnson --material E=207GPa" + round_pair),
                   "nu is missing"));
    CHECK(contains(message("law eval --elastic johnson --pin-radius 7.9mm --wall-radius 8mm "
                           "--length 10mm --penetration 1mm"),
                   "is valid from 0 to"));
    CHECK(contains(message("law fit" + spring), "--max-load is missing"));
    const std::string hit = "impact --mass 1 --speed 1" + spring;
    CHECK(contains(message("impact --mass 1" + spring), "--speed is missing"));
    CHECK(contains(message("impact --speed 1" + spring), "--mass is missing"));
    CHECK(contains(message(hit + " --dissipation flores"), "--restitution is missing"));
    CHECK(contains(message(hit + " --dissipation flores --restitution 1.2"), "0 to 1"));
    CHECK(contains(message(hit + " --dissipation floris --restitution 0.5"), "flores"));
    CHECK(contains(message(hit + " --rtol 1"), "rtol"));
    CHECK(contains(message(hit + " --formulation ida"), "ida-ggl"));
    CHECK(contains(message(hit + " --setup walls"), "did you mean 'wall'?"));
    CHECK(contains(message("impact --mass 1 --speed=-1" + spring), "greater than 0"));
    CHECK(contains(message("impact --mass 10 --speed 30 --elastic johnson --pin-radius 7.9mm "
                           "--wall-radius 8mm --length 10mm"),
                   "where the law 'johnson"));
    CHECK(contains(message("law fit --max-load 10 --min-load 10" + spring), "min_load"));
    CHECK(contains(message("law fit --max-load 1e9 --elastic johnson --clearance 0.5mm"),
                   "beyond the range of the law"));
    CHECK(contains(message("law eval --elastic johnson --material E=3GPa,nu=0.7" + round_pair),
                   "nu must be greater than -1 and at most 0.5"));
    CHECK(contains(message("law eval --elastic pereira-2011 --pin-radius 8mm --wall-radius 20mm "
                           "--length 10mm" +
                           at),
                   "radius_difference = 12 mm is outside the accepted range 0.005 to 10 mm"));
  }
}
