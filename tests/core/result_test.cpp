// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <doctest/doctest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <yoke/core/error.hpp>
#include <yoke/core/result.hpp>
#include <yoke/tests/files.hpp>
#include <yoke/tests/messages.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;
namespace fs = std::filesystem;

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::stringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

/// No file may grow beyond this many bytes: what a full disk looks like to the program.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) {
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{.rlim_cur = bytes, .rlim_max = before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int);
};

}  // namespace

TEST_CASE("merged tables rise in time, of rows at one time the first table's alone") {
  const auto table = [](std::initializer_list<std::array<double, 2>> rows) {
    Table t;
    t.add_column("t", "s");
    t.add_column("x", "m");
    for (const auto& row : rows) std::ranges::copy(row, t.append());
    return t;
  };
  const Table a = table({{0.0, 1.0}, {1.0, 2.0}, {2.0, 3.0}});
  const Table b = table({{0.5, 10.0}, {1.0, 20.0}, {1.0, 21.0}, {1.5, 30.0}, {2.5, 40.0}});
  const Table both = a.merged(b);
  CHECK(both.names() == a.names());
  CHECK(both.data() == std::vector{0.0, 1.0, 0.5, 10.0, 1.0, 2.0, 1.5, 30.0, 2.0, 3.0, 2.5, 40.0});
  CHECK(both.rows() == 6);
  CHECK(a.merged(table({})).data() == a.data());
  CHECK(table({}).merged(b).rows() == 5);
}

TEST_CASE("column names carry units as identifiers") {
  Table table;
  table.add_column("t", "s");
  table.add_column("crank.alpha", "rad/s^2");
  table.add_column("pivot.moment", "N m");
  table.add_column("slot.region", "", {"apart", "inner"});
  table.add_column("share", "1");
  CHECK(table.names() == std::vector<std::string>{"t_s", "crank.alpha_rad_per_s2",
                                                  "pivot.moment_N_m", "slot.region", "share"});
}

TEST_CASE("a table comes back from its file with every bit") {
  const double numbers[] = {0.1,
                            -1.0 / 3.0,
                            6.02214076e23,
                            std::numeric_limits<double>::denorm_min(),
                            std::numeric_limits<double>::max(),
                            std::numeric_limits<double>::epsilon(),
                            -0.0,
                            0.30000000000000004};
  Table table;
  table.add_column("a", "m");
  table.add_column("region", "", {"apart", "inner", "outer"});
  table.add_column("b", "N");
  for (std::size_t i = 0; i < std::size(numbers); ++i) {
    double* row = table.append();
    row[0] = numbers[i];
    row[1] = static_cast<double>(i % 3);
    row[2] = -numbers[i];
  }
  const TemporaryFolder scratch;
  table.write_csv(scratch / "t.csv");
  const auto lines = split(content(scratch / "t.csv"), '\n');
  REQUIRE(lines.size() == 1 + std::size(numbers));
  CHECK(lines[0] == "a_m,region,b_N");
  for (std::size_t i = 0; i < std::size(numbers); ++i) {
    const auto cells = split(lines[i + 1], ',');
    REQUIRE(cells.size() == 3);
    const double read = std::strtod(cells[0].c_str(), nullptr);
    CHECK(std::memcmp(&read, &numbers[i], sizeof read) == 0);
    CHECK(cells[1] == std::vector<std::string>{"apart", "inner", "outer"}[i % 3]);
    CHECK(std::strtod(cells[2].c_str(), nullptr) == -numbers[i]);
  }
  CHECK(table["b_N"](1) == 1.0 / 3.0);
  CHECK(table.text(4, 1) == "inner");
}

TEST_CASE("a column that is not there is refused with the ones that begin like it") {
  Table table;
  for (const char* name : {"crank.x", "crank.y", "slider.x"}) table.add_column(name, "m");
  CHECK(message_of<ModelError>([&] { table["crank.z_m"]; }) ==
        "unknown column 'crank.z_m'; there are 'crank.x_m', 'crank.y_m'");
  CHECK(message_of<ModelError>([&] { table["rod.x_m"]; }) ==
        "unknown column 'rod.x_m'; no column starts like it");
  CHECK(table.has("slider.x_m"));
  CHECK_FALSE(table.has("slider.x"));
}

TEST_CASE("appending within the reserved rows moves nothing") {
  Table table;
  table.add_column("a", "m");
  table.add_column("b", "m");
  table.reserve(100);
  const double* first = table.append();
  for (int i = 1; i < 100; ++i) table.append();
  CHECK(table.rows() == 100);
  CHECK(table.append() != nullptr);
  CHECK(first != nullptr);
}

TEST_CASE("on a disk that fills up a file keeps what it held, or is not made, and is named") {
  Table table;
  table.add_column("t", "s");
  table.add_column("x", "m");
  for (int i = 0; i < 20000; ++i) {
    double* row = table.append();
    row[0] = i / 7.0;
    row[1] = -i / 3.0;
  }
  Result result;
  result.samples = table;
  result.summary.reason = std::string(100000, 'x');
  result.events.resize(20000);
  const std::string long_text(100000, 'x');
  const std::vector<std::pair<std::string, std::function<void(const fs::path&)>>> writers = {
      {"motion.csv", [&](const fs::path& path) { table.write_csv(path); }},
      {"events.csv", [&](const fs::path& path) { write_events(result.events, path); }},
      {"summary.json", [&](const fs::path& path) { write_text(path, to_json(result.summary)); }},
      {"text.md", [&](const fs::path& path) { write_text(path, long_text); }}};
  // Within the first block that is written, later, and before anything is.
  for (const rlim_t room : {rlim_t{20001}, rlim_t{60000}, rlim_t{0}}) {
    for (const auto& writer : writers) {
      const std::string& name = writer.first;
      CAPTURE(room);
      CAPTURE(name);
      const TemporaryFolder scratch;
      const fs::path old = scratch / name, fresh = scratch / ("new_" + name);
      write_text(old, "what was there before");
      for (const fs::path& path : {old, fresh}) {
        std::string message;
        {
          const FullDisk full(room);
          message = message_of<OutputError>([&] { writer.second(path); });
        }
        CHECK(message == "cannot write '" + path.string() + "': File too large");
      }
      CHECK(content(old) == "what was there before\n");
      CHECK(!fs::exists(fresh));
      CHECK(std::distance(fs::directory_iterator(scratch.path()), fs::directory_iterator()) == 1);
      writer.second(old);  // with room again
      CHECK(fs::file_size(old) > 90000);
    }
  }
}

TEST_CASE("a file is written through a link, and what is no file is written to as it is") {
  const TemporaryFolder scratch;
  write_text(scratch / "target", "before");
  fs::create_symlink("target", scratch / "link");
  write_text(scratch / "link", "after");
  CHECK(fs::is_symlink(scratch / "link"));
  CHECK(content(scratch / "target") == "after\n");
  write_text("/dev/null", "nothing");
  CHECK(fs::is_character_file("/dev/null"));
  if (fs::exists("/dev/full"))
    CHECK(message_of<OutputError>([&] { write_text("/dev/full", "no room"); }) ==
          "cannot write '/dev/full': No space left on device");
}

TEST_CASE("folders that cannot be made or written are named with the reason") {
  const TemporaryFolder scratch;
  write_text(scratch / "file", "not a folder");
  const fs::path below = scratch / "file/results";
  CHECK(message_of<OutputError>([&] { make_output_folder(below); }) ==
        "cannot make the output folder '" + below.string() + "': Not a directory");
  CHECK(message_of<OutputError>([&] { Result().write(below); }) ==
        "cannot make the output folder '" + below.string() + "': Not a directory");
  const fs::path missing = scratch / "missing/motion.csv";
  CHECK(message_of<OutputError>([&] { Table().write_csv(missing); }) ==
        "cannot write '" + missing.string() + "': No such file or directory");
  if (::geteuid() != 0) {  // root may write everywhere
    const fs::path locked = scratch / "locked";
    make_output_folder(locked);
    fs::permissions(locked, fs::perms::owner_read | fs::perms::owner_exec);
    CHECK(message_of<OutputError>([&] { make_output_folder(locked); }) ==
          "cannot write into the output folder '" + locked.string() + "': Permission denied");
    fs::permissions(locked, fs::perms::owner_all);
  }
}

TEST_CASE("a result is written as a table, events and a summary that parse") {
  Result result;
  result.samples.add_column("t", "s");
  *result.samples.append() = 0.25;
  result.events.push_back({.t = 1.0 / 3.0,
                           .element = "slot",
                           .kind = "onset",
                           .region = "outer",
                           .speed = 0.19,
                           .penetration = -1e-17});
  Summary& s = result.summary;
  s.stop = Stop::interrupted;
  s.reason = "stopped by \"Ctrl-C\"\n, line 2: d\u00e9j\u00e0";
  s.formulation = "ida-ggl";
  s.relative_tolerance = 1e-9;
  s.t_end = 1.0 / 3.0;
  s.steps = 12;
  s.refactorisations = 30;
  s.fresh_factorisations = 2;
  s.energy_balance = std::numeric_limits<double>::quiet_NaN();
  const TemporaryFolder scratch;
  result.write(scratch / "a/b");

  CHECK(content(scratch / "a/b/motion.csv") == "t_s\n0.25\n");
  const auto lines = split(content(scratch / "a/b/events.csv"), '\n');
  REQUIRE(lines.size() == 2);
  CHECK(lines[0] == "t_s,kind,region,speed_m_per_s,penetration_m,element");
  const auto cells = split(lines[1], ',');
  REQUIRE(cells.size() == 6);
  CHECK(std::stod(cells[0]) == 1.0 / 3.0);
  CHECK(cells[1] == "onset");
  CHECK(cells[2] == "outer");
  CHECK(std::stod(cells[3]) == 0.19);
  CHECK(std::stod(cells[4]) == -1e-17);
  CHECK(cells[5] == "slot");

  const auto json = nlohmann::json::parse(content(scratch / "a/b/summary.json"));
  CHECK(json["stop"] == "interrupted");
  CHECK(json["reason"] == s.reason);
  CHECK(json["formulation"] == "ida-ggl");
  CHECK(json["t_end_s"] == 1.0 / 3.0);
  CHECK(json["steps"] == 12);
  CHECK(json["factorisations"] == 32);
  CHECK(json["energy_balance_J"].is_null());
}
