// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The commands printed in the documents are run here, one after the other, in a folder of their own; and
// what a how-to prints as their answer is their answer.
#include <doctest/doctest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <yoke/tests/documentation.hpp>

namespace {

using namespace yoke::tests;
namespace fs = std::filesystem;

struct Answer {
  int code = 0;
  std::string text;
};

/// A command line in `folder`, which is the home too; both streams of its output. "yoke" is the one
/// built.
Answer run(const fs::path& folder, const std::string& line) {
  const std::string command = "export HOME='" + folder.string() +
                              "' PATH=\"" YOKE_BINARY_DIR ":$PATH\"; cd && { " + line + "; } 2>&1";
  Answer answer;
  FILE* pipe = popen(command.c_str(), "r");
  REQUIRE(pipe != nullptr);
  char buffer[4096];
  while (const std::size_t n = std::fread(buffer, 1, sizeof buffer, pipe))
    answer.text.append(buffer, n);
  const int status = pclose(pipe);
  answer.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return answer;
}

/// "./dev run ..." and "./dev yoke ..." as what they call.
std::string without_dev(const std::string& line) {
  if (line.starts_with("./dev run ")) return "yoke " + line.substr(6);
  if (line.starts_with("./dev yoke ")) return line.substr(6);
  return line;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// Whether `text` has the pieces between "..." of `printed` in their order.
bool has_in_order(const std::string& text, const std::string& printed) {
  std::size_t at = 0;
  for (std::size_t begin = 0; begin <= printed.size();) {
    const std::size_t end = std::min(printed.find("...", begin), printed.size());
    const std::string piece = printed.substr(begin, end - begin);
    const std::size_t found = text.find(piece, at);
    if (found == std::string::npos) return false;
    at = found + piece.size();
    begin = end + 3;
  }
  return true;
}

/// Runs the commands of a page that begin with "yoke", and the folders they write into.
int run_commands(const fs::path& document, const fs::path& folder) {
  int commands = 0;
  for (const std::string& block : code_blocks(document, "sh"))
    for (const std::string& printed : lines_of(block)) {
      const std::string line = without_dev(printed);
      if (!line.starts_with("yoke ") && !line.starts_with("mkdir ")) continue;
      const Answer answer = run(folder, line.substr(0, line.find(" #")));
      INFO(document.string() << ": " << line << "\n" << answer.text);
      CHECK(answer.code == 0);
      ++commands;
    }
  return commands;
}

}  // namespace

TEST_CASE("docs/start.md, docs/howto/: every command runs, and answers what the page says") {
  int commands = 0, answers = 0;
  for (const char* page :
       {"start", "howto/choose", "howto/failures", "howto/compare_laws", "howto/export"}) {
    const fs::path document = std::string("docs/") + page + ".md";
    const TemporaryFolder folder;
    for (const std::string& block : code_blocks(document, "text")) {
      const std::vector<std::string> lines = lines_of(block);
      if (lines.empty() || !lines[0].starts_with("$ yoke ")) continue;
      const Answer answer = run(folder.path(), lines[0].substr(2));
      INFO(document.string() << ": " << lines[0] << "\n" << answer.text);
      CHECK(answer.code == 1);
      for (std::size_t i = 1; i < lines.size(); ++i) {
        INFO(lines[i]);
        CHECK(has_in_order(answer.text, lines[i]));
      }
      ++answers;
    }
    commands += run_commands(document, folder.path());
  }
  CHECK(commands >= 20);
  CHECK(answers >= 3);
}

TEST_CASE(
    "docs/fmu.md, friction.md, numerics.md, program.md, README.md with report.md: every command runs") {
  const auto commands = [](const std::vector<const char*>& pages, const TemporaryFolder& folder) {
    int count = 0;
    for (const char* page : pages) count += run_commands(page, folder.path());
    return count;
  };
  const TemporaryFolder fmu, friction, numerics, program, report;
  CHECK(commands({"docs/fmu.md"}, fmu) == 2);
  for (const char* file : {"slider_crank.fmu", "engine.fmu"})
    CHECK(fs::file_size(fmu.path() / file) > 1000);
  CHECK(commands({"docs/friction.md"}, friction) >= 5);
  CHECK(commands({"docs/numerics.md"}, numerics) >= 3);
  CHECK(commands({"docs/program.md"}, program) >= 4);
  for (const char* file : {"bash-completion/completions/yoke", "zsh/site-functions/_yoke"})
    CHECK(fs::file_size(program.path() / ".local/share" / file) > 1000);
  CHECK(commands({"README.md", "docs/report.md"}, report) >=
        6);  // one works on what the other has written
}
