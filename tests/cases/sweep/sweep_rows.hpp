// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The rows of sweep.csv, some of whose texts have commas or are empty.
#pragma once

#include <doctest/doctest.h>

#include <filesystem>
#include <string>

#include <yoke/tests/files.hpp>

namespace yoke::tests {

/// Whole rows only, as many cells in each as in the header. Returns the number of rows.
inline std::size_t rows_of_sweep(const std::filesystem::path& path) {
  const std::string text = content(path);
  REQUIRE(!text.empty());
  CHECK(text.back() == '\n');
  std::size_t rows = 0, commas = 0, of_header = 0;
  bool quoted = false;
  for (const char c : text) {
    if (c == '"') quoted = !quoted;
    if (c == ',' && !quoted) ++commas;
    if (c != '\n' || quoted) continue;
    if (rows++ == 0) of_header = commas;
    CHECK(commas == of_header);
    commas = 0;
  }
  return rows - 1;
}

}  // namespace yoke::tests
