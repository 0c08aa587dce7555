// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// yoke new NAME: a project of one's own that builds against the installed library.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include <yoke/cases/program/verb.hpp>
#include <yoke/core/error.hpp>
#include <yoke/core/result.hpp>

namespace yoke::cases {

namespace {

namespace fs = std::filesystem;

constexpr const char* project_cmake = R"(cmake_minimum_required(VERSION 3.25)
project(@NAME@ LANGUAGES CXX)

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()
find_package(yoke CONFIG REQUIRED)
add_executable(@NAME@ main.cpp)
target_link_libraries(@NAME@ PRIVATE yoke::yoke)
)";

constexpr const char* project_main =
    R"(// A crank drives a slider through a pin in a slot, with clearance: change it into your mechanism.
#include <cstdio>

@YOKE@
using namespace yoke;
using namespace yoke::literals;

int main() {
  Model m;  // in global coordinates, as the mechanism stands at t = 0
  const BodyId crank = m.add({.name = "crank", .mass = 0.105_kg, .inertia = 77_kg_mm2});
  const BodyId slider = m.add({.name = "slider", .mass = 2.353_kg, .inertia = 3496_kg_mm2});
  m.add(Revolute{.name = "pivot", .a = ground, .b = crank, .at = {0, 0}});
  m.add(AngleDriver{.name = "motor", .body = crank, .angle = constant_speed(0_rad, 720_rpm)});
  m.add(Prismatic{.name = "guide", .a = ground, .b = slider, .along = {1, 0}});
  // Centre and radius of the arc, its direction and angle, half-width of the slot.
  const Slot slot = arc_slot({{105_mm, 0}, 60_mm, 180_deg, 120_deg, 8_mm});
  const Pin pin{.body = crank, .at = {45_mm, 0}, .radius = 7.9_mm};
  const ContactLaw steel{per_mm(4.907e4, 1.10), HuntCrossley{.alpha = 0.32_s_per_m}};
  m.add(PinInSlot{.name = "pin", .pin = pin, .slot = {slider, slot}, .law = steel});

  const Result run = simulate(m, {.until = 166.7_ms, .relative_tolerance = 1e-8, .contact_rows = 40});
  run.write("results");  // motion.csv, reactions.csv, contacts.csv, ..., summary.json
  std::printf("%s: %g s, largest contact force %.1f N, energy off by %.1e J\n",
              run.summary.reason.c_str(), run.summary.t_end,
              run.contact_samples["pin.normal_force_N"].maxCoeff(), run.summary.energy_balance);
  return run.summary.ok() ? 0 : 1;
}
)";

constexpr const char* project_readme = R"(# @NAME@

A mechanism simulated with Yoke.

    cmake -B build
    cmake --build build
    ./build/@NAME@

writes `results/`: motion, reactions, contacts, energies and events as CSV, and `summary.json`. If CMake does not find
Yoke, say where it is installed: `cmake -B build -DCMAKE_PREFIX_PATH=/where/yoke/is`.

`main.cpp` has bodies, joints, a driver and a contact, in SI units or with literals such as `45_mm`.
)";

std::string filled_in(std::string text, std::string_view mark, std::string_view value) {
  for (std::size_t at = 0; (at = text.find(mark, at)) != text.npos; at += value.size())
    text.replace(at, mark.size(), value);
  return text;
}

/// What CMake must be told to find the Yoke that this program belongs to. It looks itself in /usr and
/// beside the folders of PATH.
std::string where_yoke_is() {
  std::error_code unknown;
  const fs::path bin = fs::read_symlink("/proc/self/exe", unknown).parent_path();
  const char* listed = std::getenv("PATH");
  const std::string path = fmt::format(":{}:", listed != nullptr ? listed : "");
  if (bin.filename() != "bin" || path.find(fmt::format(":{}:", bin.string())) != path.npos)
    return {};
  return fmt::format(" -DCMAKE_PREFIX_PATH={}", bin.parent_path().string());
}

int make_project(const std::string& path) {
  const fs::path folder = fs::path(path).lexically_normal();
  const std::string name = folder.filename().string();
  const auto plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-';
  };
  if (name.empty() || std::isalpha(static_cast<unsigned char>(name[0])) == 0 ||
      !std::ranges::all_of(name, plain))
    throw ModelError(fmt::format(
        "new '{}': a name begins with a letter and has letters, digits, '_' and '-' alone", name));
  if (name == "test" || name == "all" || name == "install" || name == "yoke")
    throw ModelError(fmt::format("new '{}': CMake needs this name itself; take another", name));
  if (fs::exists(folder))
    throw ModelError(fmt::format("new '{}': there is such a file or folder already", path));
  make_output_folder(folder);
  for (const auto& [file, text] : {std::pair{"CMakeLists.txt", project_cmake},
                                   {"main.cpp", project_main},
                                   {"README.md", project_readme}}) {
    std::string content = filled_in(text, "@NAME@", name);
    content = filled_in(content, "@YOKE@", "#include <yoke/yoke.hpp>");
    content.pop_back();  // the end of the last line comes with writing
    write_text(folder / file, content);
  }
  fmt::print(
      "{0}: CMakeLists.txt, main.cpp, README.md\n"
      "next: cd {0} && cmake -B build{2} && cmake --build build && ./build/{1}\n",
      folder.string(), name, where_yoke_is());
  return exit_ok;
}

}  // namespace

void add_new_verb(CLI::App& app, Action& action) {
  CLI::App* verb =
      app.add_subcommand("new", "Write a project of your own that uses the installed library");
  auto name = std::make_shared<std::string>();
  verb->add_option("NAME", *name, "Of the project, and of the folder made for it")->required();
  verb->callback([name, &action] { action = [name] { return make_project(*name); }; });
}

}  // namespace yoke::cases
