// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The yoke program started from a test.
#pragma once

#include <doctest/doctest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <yoke/tests/files.hpp>

extern char** environ;

namespace yoke::tests {

inline std::vector<std::string> lines(const std::filesystem::path& path) {
  std::vector<std::string> all;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) all.push_back(line);
  return all;
}

inline std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> all;
  std::stringstream text(line);
  for (std::string cell; std::getline(text, cell, ',');) all.push_back(cell);
  return all;
}

struct ProgramOutcome {
  int code = -1;
  std::string out;  // both streams
};

inline pid_t start(const std::string& command) {
  std::string shell = "sh", flag = "-c", text = command;
  char* arguments[] = {shell.data(), flag.data(), text.data(), nullptr};
  pid_t child = 0;
  REQUIRE(posix_spawnp(&child, "sh", nullptr, nullptr, arguments, environ) == 0);
  return child;
}

inline int wait_for(pid_t child) {
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

inline const std::string program = "exec '" YOKE_BINARY_DIR "/yoke'";

/// Runs the program in a folder; `before` is shell code.
inline ProgramOutcome run_yoke(const TemporaryFolder& scratch, const std::string& arguments,
                               const std::string& before = "") {
  const std::filesystem::path log = scratch / "log";
  const int code = wait_for(start("cd '" + scratch.path().string() + "'; " + before + program +
                                  " " + arguments + " >'" + log.string() + "' 2>&1"));
  return {code, content(log)};
}

/// Whole rows only, as many cells in each as in the header. Returns the number of rows.
inline std::size_t check_rows(const std::filesystem::path& path) {
  const std::string text = content(path);
  REQUIRE(!text.empty());
  CHECK(text.back() == '\n');
  const std::vector<std::string> all = lines(path);
  const std::size_t columns = cells(all.front()).size();
  for (const std::string& line : all) CHECK(cells(line).size() == columns);
  return all.size() - 1;
}

}  // namespace yoke::tests
