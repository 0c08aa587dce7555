// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Results as others read them: with numpy, pandas, h5py and Octave, each skipped with a message where it
// is missing; and docs/results.md against what is written.
#include <doctest/doctest.h>
#include <signal.h>

#include <bit>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <thread>

#include <yoke/cases/jobs/law_run.hpp>
#include <yoke/cases/results/byte_planes.hpp>
#include <yoke/cases/results/hdf5_file.hpp>
#include <yoke/cases/results/mat_file.hpp>
#include <yoke/cases/results/run_output.hpp>
#include <yoke/core/error.hpp>
#include <yoke/core/output/pattern.hpp>
#include <yoke/tests/cases/program/program_run.hpp>
#include <yoke/tests/messages.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;
using namespace yoke::cases;
namespace fs = std::filesystem;

// Of a Python that has them: Debian's if another comes first.
std::string python_with(const std::string& modules) {
  for (const char* python : {"python3", "/usr/bin/python3"})
    if (std::system(
            (std::string(python) + " -c 'import " + modules + "' >/dev/null 2>&1").c_str()) == 0)
      return python;
  MESSAGE("skipped: no python3 with " << modules);
  return {};
}

bool has_octave() {
  const bool there = std::system("command -v octave-cli >/dev/null") == 0;
  if (!there) MESSAGE("skipped: no octave-cli");
  return there;
}

std::vector<std::string> split_at(const std::string& line, char separator) {
  std::vector<std::string> all;
  std::stringstream text(line);
  for (std::string cell; std::getline(text, cell, separator);) all.push_back(cell);
  return all;
}

/// What a loader has seen: of each column its unit, rows and three values.
struct Loaded {
  std::map<std::pair<std::string, std::string>, std::vector<std::string>> columns{};
  std::string summary{};
};

Loaded load(const std::string& loader, const std::string& how, const fs::path& folder) {
  const TemporaryFolder scratch;
  const std::string command = loader + " " + how + " '" + folder.string() + "' >'" +
                              (scratch / "out").string() + "' 2>'" + (scratch / "errors").string() +
                              "'";
  REQUIRE_MESSAGE(std::system(command.c_str()) == 0, content(scratch / "errors"));
  Loaded loaded;
  for (const std::string& line : lines(scratch / "out")) {
    std::vector<std::string> words = split_at(line, '\t');
    if (words[0] == "summary") {
      loaded.summary = words.at(1);
      continue;
    }
    REQUIRE_MESSAGE(words.size() == 7, line);
    loaded.columns[{words[0], words[1]}] = {words.begin() + 2, words.end()};
  }
  return loaded;
}

Loaded with_python(const std::string& python, const std::string& how, const fs::path& folder) {
  return load(python + " '" YOKE_SOURCE_DIR "/tests/cases/results/load.py'", how, folder);
}

Loaded with_octave(const std::string& how, const fs::path& folder) {
  return load("octave-cli -q '" YOKE_SOURCE_DIR "/tests/cases/results/load.m'", how, folder);
}

std::string hexadecimal(double x) {
  return fmt::format("{:016x}", std::bit_cast<std::uint64_t>(x));
}

/// The run whose files are loaded.
const char* const case_run =
    "run slider_crank_clearance --law hertz-flores --set turns=1 --samples 41 ";

LawRun same_run() {
  const Case& c = find_case("slider_crank_clearance");
  const RunRequest request{.parameters = Parameters(c.parameters, {"turns=1"}),
                           .laws = {"hertz-flores"},
                           .output = {},
                           .samples = 41};
  return run_law(c, request, "hertz-flores", {});
}

/// Names as a loader has them: all, or as fields of a struct.
enum class Names { kept, fields };

void compare(const Loaded& loaded, const std::vector<OutputTable>& tables, bool with_units,
             Names names = Names::kept) {
  std::size_t compared = 0;
  for (const OutputTable& table : tables) {
    const std::vector<std::string> fields = field_names(table);
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      const OutputColumn& c = table.columns[i];
      const std::string name = names == Names::kept ? c.name : fields[i];
      CAPTURE(table.name);
      CAPTURE(name);
      const auto found = loaded.columns.find({table.name, name});
      REQUIRE(found != loaded.columns.end());
      const std::vector<std::string>& seen = found->second;
      if (with_units) CHECK(seen[0] == c.unit);
      CHECK(seen[1] == std::to_string(table.rows));
      const std::size_t rows[] = {0, std::min<std::size_t>(7, table.rows - 1), table.rows - 1};
      for (std::size_t k = 0; k < 3; ++k)
        CHECK(seen[2 + k] ==
              (c.text ? std::string(c.text(rows[k])) : hexadecimal(c.number(rows[k]))));
      ++compared;
    }
  }
  CHECK(compared == loaded.columns.size());
  CHECK(compared > 60);
}

}  // namespace

TEST_CASE("results of every format come back with every name, unit and bit") {
  const LawRun run = same_run();
  const Case& c = find_case("slider_crank_clearance");
  const Table header =
      sample_header(make_model(c, Parameters(c.parameters, {"turns=1"}), "hertz-flores"));
  const SampleColumns columns(header, {}, {});
  const std::vector<ContactSpan> impacts = contact_spans(run.all(), run.events);
  std::vector<OutputTable> tables = columns.tables(run.samples);
  tables.push_back(event_table(run.events, -1.0));
  tables.push_back(impact_table(impacts, -1.0));
  REQUIRE(tables.size() == 6);

  const TemporaryFolder scratch;
  const auto folder = [&](const std::string& format) {
    const ProgramOutcome outcome = run_yoke(
        scratch, case_run + ("--no-plots --no-report --format " + format + " -o " + format));
    CHECK_MESSAGE(outcome.code == 0, outcome.out);
    return scratch / format / "hertz-flores";
  };
  SUBCASE("CSV, numpy") {
    if (const std::string python = python_with("numpy"); !python.empty())
      compare(with_python(python, "numpy", folder("csv")), tables, false);
  }
  SUBCASE("CSV, pandas") {
    if (const std::string python = python_with("pandas"); !python.empty())
      compare(with_python(python, "pandas", folder("csv")), tables, false);
  }
  SUBCASE("CSV, Octave") {
    if (has_octave()) compare(with_octave("csv", folder("csv")), tables, false);
  }
  SUBCASE("HDF5, h5py") {
    const std::string python = python_with("h5py");
    if (!has_hdf5 || python.empty()) return;
    const fs::path there = folder("hdf5");
    const Loaded loaded = with_python(python, "h5py", there);
    compare(loaded, tables, true);
    CHECK(nlohmann::json::parse(loaded.summary) ==
          nlohmann::json::parse(content(there / "summary.json")));
  }
  SUBCASE("HDF5, Octave") {
    if (has_hdf5 && has_octave())
      compare(with_octave("hdf5", folder("hdf5")), tables, false, Names::fields);
  }
  SUBCASE("MAT, Octave") {
    if (!has_matio || !has_octave()) return;
    const fs::path there = folder("mat");
    const Loaded loaded = with_octave("mat", there);
    compare(loaded, tables, true);
    CHECK(nlohmann::json::parse(loaded.summary) ==
          nlohmann::json::parse(content(there / "summary.json")));
  }
}

TEST_CASE("results.h5 of a run that was killed has what the run had two seconds before") {
  const std::string python = python_with("h5py");
  if (!has_hdf5 || python.empty()) return;
  const TemporaryFolder scratch;
  const std::string run =
      "run scotch_yoke --law johnson --set revolutions=2000 --samples 200001 --no-plots --no-report "
      "--format hdf5 -o ";
  for (const int milliseconds : {3300, 4100}) {
    const std::string out = "cut" + std::to_string(milliseconds);
    const pid_t child =
        start("cd '" + scratch.path().string() + "'; " + program + " " + run + out + " >log 2>&1");
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
    kill(child, SIGKILL);
    wait_for(child);
    const Loaded loaded = with_python(python, "h5py", scratch / out / "johnson");
    CHECK(loaded.summary.empty());
    const std::vector<std::string>& time = loaded.columns.at({"motion", "t_s"});
    const double end = 2000.0 / 12.0, apart = end / 200000.0;
    const long rows = std::stol(time[1]);
    CHECK(rows > 100);
    CHECK(time[2] == hexadecimal(0.0));
    // The time itself, to rounding: every column has as many rows, and the last is not a fill value.
    const double last = std::bit_cast<double>(std::stoull(time[4], nullptr, 16));
    CHECK(std::abs(last - static_cast<double>(rows - 1) * apart) < 1e-9);
    for (const auto& [name, seen] : loaded.columns)
      if (name.first != "events") CHECK(seen[1] == time[1]);
    CHECK(loaded.columns.at({"events", "kind"})[2] == "onset");
    CHECK(loaded.columns.at({"energies", "kinetic_J"})[4] != hexadecimal(0.0));
  }
}

TEST_CASE("streams of planes are what zlib reads") {
  const std::string python = python_with("zlib");
  if (python.empty()) return;
  const TemporaryFolder scratch;
  std::mt19937 random(1);
  int written = 0;
  for (int i = 0; i < 400; ++i) {
    const std::size_t count = 1 + random() % 700;
    std::vector<unsigned char> planes(8 * count), stream;
    const std::size_t seldom = 1 + random() % 200;  // how often a byte changes
    unsigned char byte = 0;
    for (std::size_t k = 0; k < planes.size(); ++k) {
      const bool noise = k / count % 3 == 0;
      if (noise || random() % seldom == 0) byte = static_cast<unsigned char>(random());
      planes[k] = byte;
    }
    if (!compress_planes(planes, count, stream)) continue;
    CHECK(stream.size() < planes.size());
    const auto write = [&](const std::string& name, const std::vector<unsigned char>& bytes) {
      std::ofstream(scratch / name, std::ios::binary)
          .write(reinterpret_cast<const char*>(bytes.data()),
                 static_cast<std::streamsize>(bytes.size()));
    };
    write(std::to_string(i), planes);
    write(std::to_string(i) + ".z", stream);
    ++written;
  }
  CHECK(written > 100);
  const fs::path log = scratch / "log";
  CHECK(std::system((python + " '" YOKE_SOURCE_DIR "/tests/cases/results/load.py' planes '" +
                     scratch.path().string() + "' >'" + log.string() + "' 2>&1")
                        .c_str()) == 0);
  CHECK(content(log) == "same " + std::to_string(written) + "\n");

  std::vector<unsigned char> noise(4096), stream;
  for (unsigned char& x : noise) x = static_cast<unsigned char>(random());
  CHECK_FALSE(compress_planes(noise, 512, stream));
}

TEST_CASE("shuffled bytes are the first of each element, then the second") {
  const unsigned char bytes[] = {1, 2, 3, 4, 5, 6};
  std::vector<unsigned char> planes;
  shuffle_bytes(bytes, 3, planes);
  CHECK(planes == std::vector<unsigned char>{1, 4, 2, 5, 3, 6});
}

TEST_CASE("a choice of columns and rows is what is written") {
  const TemporaryFolder scratch;
  const std::string run = "run slider_crank --samples 21 --no-plots --no-report ";
  REQUIRE(run_yoke(scratch, run + "-o all").code == 0);
  const std::vector<std::string> all = lines(scratch / "all/motion.csv");
  REQUIRE(all.size() == 22);
  const double step = std::stod(cells(all[2])[0]);

  CHECK(run_yoke(scratch, run + "-o some --columns 'crank.?_m,*.fx_N' --every 4").code == 0);
  CHECK(lines(scratch / "some/motion.csv").front() == "t_s,crank.x_m,crank.y_m");
  CHECK(check_rows(scratch / "some/motion.csv") == 6);
  CHECK(cells(lines(scratch / "some/motion.csv")[2])[0] == cells(all[5])[0]);
  for (const std::string& name : cells(lines(scratch / "some/reactions.csv").front()))
    CHECK((name == "t_s" || name.ends_with(".fx_N")));
  CHECK(!fs::exists(scratch / "some/energies.csv"));

  CHECK(run_yoke(scratch, run + "-o late --from " + std::to_string(6.5 * step) + "s").code == 0);
  CHECK(check_rows(scratch / "late/motion.csv") == 14);
  CHECK(lines(scratch / "late/motion.csv")[1] == all[8]);
  // The same folder again: tables that are not asked for do not stay.
  CHECK(run_yoke(scratch, run + "-o late --events-only").code == 0);
  CHECK(fs::exists(scratch / "late/events.csv"));
  CHECK(fs::exists(scratch / "late/summary.json"));
  for (const char* name : {"motion.csv", "reactions.csv", "energies.csv"})
    CHECK_MESSAGE(!fs::exists(scratch / "late" / name), name);

  const auto refused = [&](const std::string& option, const std::string& message) {
    const ProgramOutcome outcome = run_yoke(scratch, run + "-o refused " + option);
    CHECK(outcome.code == 1);
    CHECK_MESSAGE(contains(outcome.out, message), outcome.out);
  };
  refused("--columns crnk.x_m", "--columns crnk.x_m: no column matches; did you mean 'crank.x_m'?");
  refused("--every 0", "--every 0: must be at least 1");
  refused("--from 3kg", "--from");
  refused("--format xls", "--format xls: accepted are csv, hdf5, mat");
}

TEST_CASE("events and impacts from a time on") {
  const TemporaryFolder scratch;
  REQUIRE(run_yoke(scratch, case_run + std::string("--events-only -o all")).code == 0);
  const std::vector<std::string> events = lines(scratch / "all/hertz-flores/events.csv"),
                                 impacts = lines(scratch / "all/hertz-flores/impacts.csv");
  REQUIRE(impacts.size() > 4);
  // Between the onset of the second impact and that of the third.
  const double from = 0.5 * (std::stod(cells(impacts[2])[0]) + std::stod(cells(impacts[3])[0]));
  REQUIRE(run_yoke(scratch, case_run + fmt::format("--events-only -o late --from {:.17g}s", from))
              .code == 0);
  const std::vector<std::string> late = lines(scratch / "late/hertz-flores/impacts.csv");
  CHECK(late.size() == impacts.size() - 2);
  CHECK(late[1] == impacts[3]);
  for (const std::string& line : lines(scratch / "late/hertz-flores/events.csv"))
    if (line[0] != 't') CHECK(std::stod(cells(line)[0]) >= from);
  CHECK(lines(scratch / "late/hertz-flores/events.csv").back() == events.back());
}

TEST_CASE("patterns of names") {
  CHECK(matches("crank.*", "crank.x_m"));
  CHECK(matches("*_m", "crank.x_m"));
  CHECK(matches("*.?_m", "crank.x_m"));
  CHECK(matches("*", ""));
  CHECK_FALSE(matches("*.?_m", "crank.vx_m_per_s"));
  CHECK_FALSE(matches("crank", "crank.x_m"));
  CHECK_FALSE(matches("", "crank.x_m"));
}

TEST_CASE("fields of MAT files are names that MATLAB takes, and differ") {
  OutputTable table{.name = "motion"};
  const std::string longest(70, 'a');
  for (const std::string& name :
       {std::string("a.x"), std::string("a x"), std::string("1"), longest, longest})
    table.columns.push_back({.name = name, .unit = ""});
  CHECK(field_names(table) == std::vector<std::string>{"a_x", "a_x_2", "x1", longest.substr(0, 63),
                                                       longest.substr(0, 61) + "_2"});
}

TEST_CASE("a full disk leaves no half of results.h5 or results.mat and is reported") {
  const TemporaryFolder scratch;
  for (const auto& [format, file, there] :
       {std::tuple{"hdf5", "results.h5", has_hdf5}, {"mat", "results.mat", has_matio}}) {
    if (!there) continue;
    const ProgramOutcome full = run_yoke(
        scratch,
        std::string("run scotch_yoke --law johnson --no-plots --no-report -o out --format ") +
            format,
        "ulimit -f 200; ");
    CHECK(full.code == 1);
    CHECK_MESSAGE(contains(full.out, std::string("cannot write 'out/johnson/") + file), full.out);
    CHECK(!fs::exists(scratch / "out/johnson" / file));
    CHECK(!fs::exists(scratch / "out/johnson" / (std::string(file) + ".part")));
  }
}

namespace {

/// Columns of docs/results.md by the heading above, "ANY.x_m" as ".x_m", with their units.
std::map<std::string, std::map<std::string, std::string>> documented() {
  std::map<std::string, std::map<std::string, std::string>> found;
  std::string heading;
  for (const std::string& line : lines(fs::path(YOKE_SOURCE_DIR) / "docs/results.md")) {
    if (line.starts_with("#")) heading = line.substr(line.find(' ') + 1);
    if (!line.starts_with("| `")) continue;
    const std::vector<std::string> parts = split_at(line, '|');
    std::string name = parts[1].substr(2, parts[1].rfind('`') - 2);
    if (std::isupper(static_cast<unsigned char>(name[0])) != 0) name = name.substr(name.find('.'));
    const std::string unit = parts[2];
    found[heading][name] = unit.size() < 3 ? "" : unit.substr(1, unit.size() - 2);
  }
  return found;
}

std::string pattern_of(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  return dot == std::string::npos ? name : name.substr(dot);
}

}  // namespace

TEST_CASE("docs/results.md lists the columns that runs write, with their units") {
  auto lists = documented();
  std::map<std::string, std::map<std::string, std::string>> written;
  const auto take = [&](const std::string& heading, const OutputTable& table) {
    for (const OutputColumn& c : table.columns) written[heading][pattern_of(c.name)] = c.unit;
  };
  written["forces"]["t_s"] = "s";  // no element of a case has any
  const auto take_case = [&](const Case& c, const std::vector<std::string>& settings,
                             std::vector<std::string> laws, const std::string& friction) {
    const Parameters parameters(c.parameters, settings);
    laws = choose_laws(c, parameters, laws, friction);
    const Model model = make_model(c, parameters, laws.empty() ? "" : laws.front());
    const Table header = sample_header(model);
    const std::vector<MotionColumn> own =
        c.columns ? c.columns(parameters, model) : std::vector<MotionColumn>{};
    for (const OutputTable& table : SampleColumns(header, own, {}).tables(header))
      take(table.name == "motion" && !own.empty() ? "motion of " + c.name : table.name, table);
  };
  for (const Case& c : case_registry()) take_case(c, {}, {}, "");
  const Case& yoke_case = find_case("scotch_yoke");
  take_case(yoke_case, {"slot=ideal"}, {}, "");
  take_case(yoke_case, {"pin=rolling"}, {"johnson"}, "");
  take_case(yoke_case, {}, {"johnson"}, "lugre:mu=0.1");
  take("events", event_table({}, 0.0));
  take("impacts", impact_table({}, 0.0));
  for (const auto& table : written) {
    const std::string& heading = table.first;
    CAPTURE(heading);
    auto& list = lists[heading];
    for (const auto& column : table.second) {
      const std::string& name = column.first;
      CAPTURE(name);
      REQUIRE(list.count(name) == 1);
      CHECK(list[name] == column.second);
    }
    for (const auto& column : list) {
      const std::string& name = column.first;
      CHECK_MESSAGE(table.second.count(name) == 1, name << " is written by no run");
    }
  }
}

TEST_CASE("docs/results.md lists the fields of summary.json") {
  const TemporaryFolder scratch;
  REQUIRE(run_yoke(scratch, case_run + std::string("--verify --events-only -o out")).code == 0);
  const auto summary = nlohmann::json::parse(content(scratch / "out/hertz-flores/summary.json"));
  auto fields = documented()["summary.json"];
  for (const auto& item : summary.items()) {
    const std::string name = item.key();
    CHECK_MESSAGE(fields.erase(name) == 1, name << " is not in docs/results.md");
  }
  for (const auto& field : fields) FAIL_CHECK(field.first << " is in docs/results.md alone");
  CHECK(summary["schema"] == summary_schema);
  CHECK(summary["version"].is_string());
}
