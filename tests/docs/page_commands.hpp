// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The commands that a page shows, run as printed.
#pragma once

#include <doctest/doctest.h>

#include <cstddef>
#include <sstream>
#include <string>

#include <yoke/tests/cases/program/program_run.hpp>
#include <yoke/tests/documentation.hpp>
#include <yoke/tests/files.hpp>

namespace yoke::tests {

/// Runs every line of the page's blocks of `sh`, each a `yoke ...` that must end well, in a folder. Returns
/// how many there are.
inline std::size_t run_commands_of(const std::string& page, const TemporaryFolder& folder) {
  std::size_t commands = 0;
  for (const std::string& block : code_blocks(page, "sh")) {
    std::istringstream all(block);
    for (std::string line; std::getline(all, line); ++commands) {
      REQUIRE(line.starts_with("yoke "));
      const auto run = run_yoke(folder, line.substr(5));
      INFO(line << "\n" << run.out);
      CHECK(run.code == 0);
    }
  }
  return commands;
}

}  // namespace yoke::tests
