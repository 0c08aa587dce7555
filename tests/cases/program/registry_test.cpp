// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What is registered is what the program and the documents list, and what the folders hold.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <yoke/cases/case.hpp>
#include <yoke/cases/program/verb.hpp>
#include <yoke/contact/laws/catalog/dissipative_catalog.hpp>
#include <yoke/contact/laws/catalog/elastic_catalog.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/tests/files.hpp>
#include <yoke/tests/messages.hpp>

namespace {

using namespace yoke;
using yoke::tests::contains;
using yoke::tests::source;
namespace fs = std::filesystem;
using Names = std::set<std::string>;

/// What the program prints.
std::string printed(const std::string& arguments) {
  const std::string command = "'" YOKE_BINARY_DIR "/yoke' " + arguments + " 2>&1";
  FILE* pipe = popen(command.c_str(), "r");
  REQUIRE(pipe != nullptr);
  std::string text;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) text += static_cast<char>(c);
  CHECK(pclose(pipe) == 0);
  return text;
}

/// The first words of the indented lines under a heading, until an empty line.
Names listed(const std::string& text, const std::string& heading) {
  std::istringstream lines(text);
  Names names;
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(heading)) {
      inside = true;
    } else if (line.empty()) {
      inside = false;
    } else if (inside && line.starts_with("  ") && line[2] != ' ') {
      names.insert(line.substr(2, line.find(' ', 2) - 2));
    }
  }
  return names;
}

template <class Entries, class NameOf>
Names names_of(const Entries& entries, const NameOf& name_of) {
  Names names;
  for (const auto& entry : entries) names.insert(std::string(name_of(entry)));
  CHECK(names.size() == entries.size());  // none twice
  return names;
}

Names formulation_names() {
  return names_of(formulations(), [](const FormulationNote& f) { return f.name; });
}

TEST_SUITE("registries") {
  TEST_CASE("yoke list prints the cases, their laws and the formulations that are registered") {
    const std::string text = printed("list");
    CHECK(listed(text, "Cases") ==
          names_of(cases::case_registry(), [](const cases::Case& c) { return c.name; }));
    CHECK(listed(text, "Formulations") == formulation_names());
    for (const cases::Case& c : cases::case_registry()) {
      if (c.contact.laws.empty()) continue;
      CHECK(listed(text, "Laws of " + c.name) ==
            names_of(c.contact.laws, [](const cases::NamedLaw& law) { return law.name; }));
    }
  }

  TEST_CASE("yoke list prints the cases by group, each group once") {
    const std::string text = printed("list");
    const std::vector<cases::CaseGroup> groups = cases::case_groups();
    CHECK(groups.size() >= 4);
    std::size_t count = 0;
    for (const cases::CaseGroup& g : groups) {
      CHECK(!g.name.empty());
      const std::size_t at = text.find("\n " + g.name + "\n");
      REQUIRE_MESSAGE(at != std::string::npos, g.name);
      CHECK(text.find("\n " + g.name + "\n", at + 1) == std::string::npos);
      std::size_t place = at;
      for (const cases::Case* c : g.cases) {
        CHECK_MESSAGE(text.find("\n  " + c->name + " ", place) != std::string::npos, c->name);
        place = text.find("\n  " + c->name + " ", place);
        ++count;
      }
    }
    CHECK(count == cases::case_registry().size());
  }

  TEST_CASE("every case has its page in docs/cases/, and the index leads there") {
    const std::string index = source("docs/cases/README.md");
    Names pages{"README.md"};
    for (const cases::Case& c : cases::case_registry()) {
      INFO(c.name);
      pages.insert(c.name + ".md");
      CHECK(contains(index, "[" + c.name + "](" + c.name + ".md)"));
      CHECK(contains(index, c.description));
      const std::string page = source("docs/cases/" + c.name + ".md");
      CHECK(contains(page, "yoke run " + c.name));
      const cases::Parameters defaults(c.parameters);
      for (const cases::CaseParameter& p : c.parameters) {
        const std::string row = "| " + p.name + " | " + defaults.text(p.name) + " |";
        CHECK_MESSAGE(contains(page, row), row);
      }
    }
    for (const cases::CaseGroup& g : cases::case_groups())
      CHECK_MESSAGE(contains(index, "## " + g.name), g.name);
    for (const auto& entry : fs::directory_iterator(fs::path(YOKE_SOURCE_DIR) / "docs/cases"))
      CHECK_MESSAGE(pages.count(entry.path().filename().string()) == 1, entry.path().string());
  }

  TEST_CASE("yoke law list prints the catalogues") {
    const std::string text = printed("law list");
    CHECK(listed(text, "Elastic laws") ==
          names_of(elastic_catalog(), [](const ElasticNote& n) { return n.name; }));
    CHECK(listed(text, "Dissipative laws") ==
          names_of(dissipative_catalog(), [](const DissipativeNote& n) { return n.name; }));
  }

  TEST_CASE("yoke run CASE --help lists parameters and laws of each case") {
    for (const cases::Case& c : cases::case_registry()) {
      const std::string text = printed("run " + c.name + " --help");
      for (const cases::CaseParameter& p : c.parameters) CHECK(contains(text, "\n  " + p.name));
      for (const cases::NamedLaw& law : c.contact.laws) CHECK(contains(text, "\n  " + law.name));
    }
  }

  TEST_CASE("every verb has a file, and yoke --help lists it") {
    const std::string text = printed("--help");
    for (const char* folder : {"cases/program", "cases/program/reports", "cases/program/texts",
                               "cases/program/maps", "cases/program/studies"})
      for (const auto& entry : fs::directory_iterator(fs::path(YOKE_SOURCE_DIR) / folder)) {
        std::string name = entry.path().stem().string();
        if (!name.starts_with("verb_")) continue;
        name.erase(0, 5);
        for (char& c : name)
          if (c == '_') c = '-';
        CHECK_MESSAGE(contains(text, "\n  " + name + " "), name);
      }
    for (const cases::StudyVerb& verb : cases::study_verbs)
      CHECK(contains(text, std::string("\n  ") + verb.name + " "));
  }

  TEST_CASE("the documents name what is registered") {
    const std::string numerics = source("docs/numerics.md"), readme = source("README.md");
    for (const std::string& name : formulation_names())
      CHECK_MESSAGE(contains(numerics, "`" + name + "`"), name);
    CHECK(formulation_names().size() == 7);
    CHECK(contains(readme, "**Seven formulations**"));
    CHECK(dissipative_catalog().size() == 20);  // with "none"
    CHECK(contains(readme, "nineteen dissipative laws"));
    CHECK(elastic_catalog().size() == 10);  // with "power"
    CHECK(contains(readme, "Nine elastic laws of cylinders"));
    const std::string architecture = source("docs/architecture.md");
    for (const char* registry :
         {"cases/registry.cpp", "integrators/formulations/registry.cpp", "contact/laws/catalog/"})
      CHECK_MESSAGE(contains(architecture, registry), registry);
  }

  TEST_CASE("docs/architecture.md describes every room") {
    const std::string text = source("docs/architecture.md");
    for (const char* folder : {"core", "joints", "contact", "integrators", "cases"})
      for (const auto& entry :
           fs::recursive_directory_iterator(fs::path(YOKE_SOURCE_DIR) / folder)) {
        if (!entry.is_directory() || entry.path().filename() == "cmake") continue;
        const std::string room = fs::relative(entry.path(), YOKE_SOURCE_DIR).generic_string();
        CHECK_MESSAGE(contains(text, "`" + room + "/`"), room);
      }
  }

  TEST_CASE("a case with walls has a law to complete half a specification with") {
    for (const cases::Case& c : cases::case_registry()) {
      INFO(c.name);
      CHECK(static_cast<bool>(c.contact.walls) == !c.contact.laws.empty());
      CHECK(c.model);
      CHECK(c.duration);
      const cases::Parameters defaults(c.parameters);
      CHECK(c.duration(defaults) > 0.0);
      CHECK(make_model(c, defaults).body_count() > 0);
    }
  }
}

}  // namespace
