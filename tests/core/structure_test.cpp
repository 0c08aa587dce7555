// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Who may include whom, and what else holds of the source tree as a whole. Reads it and fails on what is
// wrong.
#include <doctest/doctest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <yoke/tests/files.hpp>

namespace {

namespace fs = std::filesystem;

const std::map<std::string, std::vector<std::string>> allowed_folders = {
    {"core", {"core"}},
    {"joints", {"joints", "core"}},
    {"contact", {"contact", "core"}},
    {"integrators", {"integrators", "core"}},
    {"cases", {"cases", "core", "joints", "contact", "integrators"}},
};

// The rooms of each folder from the bottom up: a file sees its own room and those before it. The
// first room of core and integrators is their surface: its headers are seen by all rooms, its
// sources see all rooms.
const std::map<std::string, std::vector<std::string>> room_order = {
    {"core",
     {"core", "core/equations/linear", "core/equations", "core/equations/grips", "core/authoring",
      "core/control", "core/curves/pieces", "core/curves", "core/drawing", "core/output"}},
    {"joints", {"joints/rows", "joints/drivers", "joints/forces", "joints/friction", "joints"}},
    {"contact",
     {"contact/laws", "contact/laws/forms", "contact/laws/elastic", "contact/laws/dissipative",
      "contact/laws/friction", "contact/laws/catalog", "contact/geometry", "contact/details",
      "contact"}},
    {"integrators",
     {"integrators", "integrators/sundials", "integrators/formulations/equations",
      "integrators/formulations/explicit", "integrators/formulations", "integrators/run",
      "integrators/run/rows", "integrators/run/singular", "integrators/run/start",
      "integrators/analyses/reduction", "integrators/analyses/details", "integrators/engine",
      "integrators/analyses", "integrators/studies/details", "integrators/studies",
      "integrators/studies/maps/details", "integrators/studies/maps",
      "integrators/studies/linearised", "integrators/studies/orbits"}},
    {"cases",
     {"cases/choices",
      "cases/checks",
      "cases",
      "cases/clearance",
      "cases/impacts",
      "cases/friction",
      "cases/slots",
      "cases/terminal",
      "cases/results",
      "cases/report",
      "cases/jobs",
      "cases/sweep",
      "cases/maps",
      "cases/orbits",
      "cases/fmu",
      "cases/validation",
      "cases/paper/figures",
      "cases/paper",
      "cases/program/help",
      "cases/program",
      "cases/program/orbits",
      "cases/program/reports",
      "cases/program/texts",
      "cases/program/maps",
      "cases/program/studies"}},
};
constexpr std::size_t largest_room = 24;  // headers and sources: a list that is read at a glance

// Inner headers serve one room alone and may see what it publishes.
const std::map<std::string, std::string> inner_rooms = {
    {"integrators/analyses/details", "integrators/analyses"},
    {"integrators/studies/details", "integrators/studies"},
    {"integrators/studies/maps/details", "integrators/studies/maps"},
    {"contact/details", "contact"},
    {"core/curves/pieces", "core/curves"}};

std::string room_of(const std::string& path) { return path.substr(0, path.rfind('/')); }

bool sees_room(const std::string& path, const std::string& target) {
  const std::string room = room_of(path), folder = path.substr(0, path.find('/'));
  const std::vector<std::string>& order = room_order.at(folder);
  const auto place = [&](const std::string& r) { return std::ranges::find(order, r); };
  if (target == room || place(target) == order.end()) return target == room;
  const auto inner = inner_rooms.find(room);
  if (inner != inner_rooms.end() && inner->second == target) return true;
  const bool surface = order.front() == folder;  // its sources end what its headers promise
  if (surface && room == folder) return path.ends_with(".cpp");
  return place(target) < place(room);
}

struct File {
  std::string path;  // relative to the root
  std::string folder;
  bool header;
};

// Third-party headers, by the beginning of their name, and the files that may see them.
struct Restriction {
  std::vector<std::string> headers;
  bool (*allows)(const File&);
  std::string rule;
};

const std::vector<Restriction> restrictions = {
    {{"arkode/", "cvode/", "cvodes/", "ida/", "idas/", "kinsol/", "nvector/", "sundials/",
      "sunlinsol/", "sunmatrix/", "sunnonlinsol/"},
     [](const File& f) {
       return f.folder == "integrators" &&
              (!f.header || f.path.starts_with("integrators/sundials/"));
     },
     "SUNDIALS belongs in integrators/sundials/ and integrators/*.cpp"},
    {{"suitesparse/", "klu.h"},
     [](const File& f) { return f.folder == "core" && !f.header; },
     "KLU belongs in core/*.cpp"},
    {{"CLI/"},
     [](const File& f) { return f.folder == "cases"; },
     "the command line belongs in cases/"},
    {{"nlohmann/"},
     [](const File& f) { return f.folder == "cases" || !f.header; },
     "headers of the library must not need JSON"},
    {{"boost/"},
     [](const File& f) { return f.folder != "contact" || !f.header; },
     "headers of contact/ must not need Boost"},
};

bool contains(const std::vector<std::string>& list, const std::string& entry) {
  return std::find(list.begin(), list.end(), entry) != list.end();
}

// What an #include line names, with its < or " in front; empty for another line.
std::string included(const std::string& line) {
  std::istringstream words(line);
  char hash = 0;
  std::string directive;
  words >> hash >> std::ws;
  if (hash != '#') return {};
  while (std::isalpha(words.peek()) != 0) directive += static_cast<char>(words.get());
  if (directive != "include") return {};
  std::string name;
  words >> std::ws;
  std::getline(words, name);
  return name.substr(0, name.find_first_of(">\"", 1));
}

// The wrong includes of one file of the library or the cases; `path` is relative to the root.
std::vector<std::string> wrong_includes(const std::string& path, const std::string& text) {
  const File file = {path, path.substr(0, path.find('/')), path.ends_with(".hpp")};
  std::vector<std::string> wrong;
  std::istringstream lines(text);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    const std::string name = included(line);
    if (name.empty()) continue;
    const std::string header = name.substr(1);
    const auto report = [&](const std::string& rule) {
      wrong.push_back(path + ":" + std::to_string(number) + ": " + header + ": " + rule);
    };
    if (name[0] == '"') {
      report("headers are included as <yoke/folder/name.hpp>");
    } else if (header.starts_with("yoke/")) {
      const std::string target = header.substr(5, header.find('/', 5) - 5);
      if (!contains(allowed_folders.at(file.folder), target)) {
        report(file.folder + " must not see " + target);
      } else if (target == file.folder && !sees_room(path, room_of(header.substr(5)))) {
        report(room_of(path) + " must not see " + room_of(header.substr(5)));
      }
    }
    for (const Restriction& r : restrictions) {
      const bool named = std::any_of(r.headers.begin(), r.headers.end(),
                                     [&](const std::string& h) { return header.starts_with(h); });
      if (named && !r.allows(file)) report(r.rule);
    }
  }
  return wrong;
}

bool has_licence(const std::string& text) {
  std::istringstream lines(text);
  std::string line;
  for (int i = 0; i < 3 && std::getline(lines, line); ++i) {
    if (line.find("SPDX-License-Identifier: BSD-3-Clause") != std::string::npos) return true;
  }
  return false;
}

// Files of the folder that we wrote and that carry a licence line.
std::vector<std::string> sources(const fs::path& root, const std::string& folder) {
  static const std::vector<std::string> endings = {".cpp", ".hpp", ".sh",  ".cmake",
                                                   ".in",  ".py",  ".txt", ".gp"};
  std::vector<std::string> found;
  if (!fs::is_directory(root / folder)) return found;
  for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
    const fs::path& path = entry.path();
    if (path.extension() == ".txt" && path.filename() != "CMakeLists.txt") continue;
    if (entry.is_regular_file() && contains(endings, path.extension().string())) {
      found.push_back(fs::relative(path, root).generic_string());
    }
  }
  return found;
}

// Names of the types that a file defines at namespace scope, unnamed namespaces left out. Relies on
// the layout that clang-format gives: what stands there begins in the first column.
std::vector<std::string> types_of(const std::string& text) {
  static const std::vector<std::string> keywords = {"struct", "class", "union", "enum"};
  std::vector<std::string> scopes, types;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string keyword, name;
    words >> keyword >> name;
    if (line.starts_with("namespace ") && line.ends_with("{")) {
      scopes.push_back(name);
    } else if (line.starts_with("}  // namespace") && !scopes.empty()) {
      scopes.pop_back();
    } else if (contains(keywords, keyword) && line.starts_with(keyword)) {
      if (name == "class") words >> name;  // enum class
      const bool defines = line.find('{') != std::string::npos && name.find("::") == name.npos;
      if (!defines || contains(scopes, "{")) continue;
      std::string path;
      for (const std::string& scope : scopes) path += scope + "::";
      types.push_back(path + name.substr(0, name.find_first_of(":{")));
    }
  }
  return types;
}

TEST_CASE("structure: folders include only what they may") {
  const fs::path root = YOKE_SOURCE_DIR;
  std::size_t files = 0;
  for (const auto& [folder, allowed] : allowed_folders) {
    for (const std::string& path : sources(root, folder)) {
      if (!path.ends_with(".cpp") && !path.ends_with(".hpp")) continue;
      ++files;
      for (const std::string& wrong : wrong_includes(path, yoke::tests::source(path))) {
        FAIL_CHECK(wrong);
      }
    }
  }
  CHECK(files > 0);
}

TEST_CASE("structure: every room has its place, and is small enough to be read") {
  const fs::path root = YOKE_SOURCE_DIR;
  for (const auto& [folder, order] : room_order) {
    std::map<std::string, std::size_t> sizes;
    for (const std::string& path : sources(root, folder))
      if (path.ends_with(".cpp") || path.ends_with(".hpp")) ++sizes[room_of(path)];
    for (const auto& [room, size] : sizes) {
      CHECK_MESSAGE(contains(order, room), room << " is not in room_order");
      CHECK_MESSAGE(size <= largest_room, room << " has " << size << " files");
    }
    for (const std::string& room : order) CHECK_MESSAGE(sizes.count(room) == 1, room);
  }
}

// Two types of one name break the rule of one definition: the linker keeps the functions of one of
// them for both, and no compiler warns.
TEST_CASE("structure: no two files define a type of the same name") {
  const fs::path root = YOKE_SOURCE_DIR;
  std::map<std::string, std::string> where;
  for (const char* folder : {"core", "joints", "contact", "integrators", "cases", "tests"}) {
    for (const std::string& path : sources(root, folder)) {
      if (!path.ends_with(".cpp") && !path.ends_with(".hpp")) continue;
      for (const std::string& type : types_of(yoke::tests::source(path))) {
        const auto [known, is_new] = where.emplace(type, path);
        CHECK_MESSAGE(is_new, type << " in " << known->second << " and in " << path);
      }
    }
  }
  CHECK(where.size() > 200);

  CHECK(types_of("namespace a {\nstruct B {};\nclass C : public B {\n};\n}  // namespace a\n") ==
        std::vector<std::string>{"a::B", "a::C"});
  CHECK(types_of("namespace {\nstruct B {};\n}  // namespace\nenum class D { one };\n") ==
        std::vector<std::string>{"D"});
  CHECK(types_of("struct A;\nstruct A::B {\n};\n").empty());
}

TEST_CASE("structure: every file has its licence line") {
  const fs::path root = YOKE_SOURCE_DIR;
  std::vector<std::string> files = {"CMakeLists.txt", "packages.txt", "dev", ".ci/run",
                                    ".clang-format"};
  for (const char* folder :
       {"core", "joints", "contact", "integrators", "cases", "tests", "docs"}) {
    const std::vector<std::string> more = sources(root, folder);
    files.insert(files.end(), more.begin(), more.end());
  }
  for (const std::string& path : files) CHECK_MESSAGE(has_licence(yoke::tests::source(path)), path);
}

TEST_CASE("structure: the check sees a wrong arrow") {
  const auto count = [](const std::string& path, const std::string& text) {
    return wrong_includes(path, text).size();
  };
  CHECK(count("joints/a.hpp", "#include <vector>\n#include <yoke/core/model.hpp>\n") == 0);
  CHECK(count("joints/a.hpp", "#include <yoke/contact/law.hpp>\n") == 1);
  CHECK(count("contact/a.cpp", "  #  include <yoke/integrators/ida.hpp>\n") == 1);
  CHECK(count("integrators/a.cpp", "#include <yoke/joints/weld.hpp>\n") == 1);
  CHECK(count("core/a.cpp", "#include <yoke/joints/weld.hpp>\n") == 1);
  CHECK(count("core/a.cpp", "#include <yoke/cases/scotch_yoke.hpp>\n") == 1);
  CHECK(count("core/a.cpp", "#include \"../joints/weld.hpp\"\n") == 1);
  CHECK(count("cases/a.cpp", "#include <yoke/joints/weld.hpp>\n#include <CLI/CLI.hpp>\n") == 0);

  CHECK(count("contact/laws/a.hpp", "#include <yoke/contact/laws/elastic/johnson.hpp>\n") == 1);
  CHECK(count("contact/laws/elastic/a.hpp", "#include <yoke/contact/laws/law.hpp>\n") == 0);
  CHECK(count("cases/a.cpp", "#include <yoke/cases/jobs/job.hpp>\n") == 1);
  CHECK(count("cases/jobs/a.cpp", "#include <yoke/cases/program/verb.hpp>\n") == 1);
  CHECK(count("integrators/a.cpp", "#include <yoke/integrators/run/cost.hpp>\n") == 0);
  CHECK(count("integrators/a.hpp", "#include <yoke/integrators/run/cost.hpp>\n") == 1);
  CHECK(count("integrators/sundials/a.cpp", "#include <yoke/integrators/run/cost.hpp>\n") == 1);

  CHECK(count("integrators/a.cpp", "#include <idas/idas.h>\n") == 0);
  CHECK(count("integrators/a.hpp", "#include <sundials/sundials_types.h>\n") == 1);
  CHECK(count("integrators/sundials/a.hpp", "#include <sundials/sundials_types.h>\n") == 0);
  CHECK(count("core/a.cpp", "#include <nvector/nvector_serial.h>\n") == 1);
  CHECK(count("core/a.cpp", "#include <suitesparse/klu.h>\n") == 0);
  CHECK(count("core/a.hpp", "#include <suitesparse/klu.h>\n") == 1);
  CHECK(count("integrators/a.cpp", "#include <klu.h>\n") == 1);
  CHECK(count("contact/a.cpp", "#include <boost/math/special_functions/lambert_w.hpp>\n") == 0);
  CHECK(count("contact/a.hpp", "#include <boost/math/special_functions/lambert_w.hpp>\n") == 1);

  CHECK(has_licence("#!/bin/sh\n# SPDX-License-Identifier: BSD-3-Clause\n"));
  CHECK_FALSE(has_licence("int main() {}\n"));
}

}  // namespace
