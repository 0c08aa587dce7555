// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The code printed in the documents is code that is compiled in a test, word for word.
#pragma once

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include <yoke/tests/files.hpp>
#include <yoke/tests/messages.hpp>

namespace yoke::tests {

/// What stands between ```language and ``` in a Markdown file.
inline std::vector<std::string> code_blocks(const std::filesystem::path& document,
                                            const std::string& language) {
  std::vector<std::string> found;
  std::istringstream lines(source(document));
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line == "```" + language) {
      inside = true;
      found.emplace_back();
    } else if (line == "```") {
      inside = false;
    } else if (inside) {
      found.back() += line + "\n";
    }
  }
  return found;
}

/// Every block of the document stands in one of the files. Paths are from the root of the sources.
inline void check_blocks(const std::filesystem::path& document, const std::string& language,
                         std::size_t at_least, const std::vector<std::filesystem::path>& files) {
  const std::vector<std::string> printed = code_blocks(document, language);
  CHECK(printed.size() >= at_least);
  for (const std::string& block : printed) {
    INFO(document.string() << ", not compiled anywhere:\n" << block);
    CHECK(std::ranges::any_of(files, [&](const auto& f) { return contains(source(f), block); }));
  }
}

}  // namespace yoke::tests
