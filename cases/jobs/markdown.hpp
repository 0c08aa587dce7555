// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A Markdown document that is written while the numbers come in, with its verdicts collected in a
// table at the beginning.
#pragma once

#include <fmt/ranges.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace yoke::cases {

using Texts = std::vector<std::string>;

class Document {
 public:
  template <class... X>
  void print(fmt::format_string<X...> format, X&&... values) {
    text_ += fmt::format(format, std::forward<X>(values)...);
  }
  void heading(std::string_view text) { print("\n## {}\n\n", text); }
  void row(const Texts& cells) { print("| {} |\n", fmt::join(cells, " | ")); }
  void head(const Texts& cells) {
    row(cells);
    print("|{}\n", fmt::join(Texts(cells.size(), "--|"), ""));
  }
  /// `outcome` is a word or two, `text` the sentences below the numbers.
  void verdict(std::string statement, std::string outcome, std::string_view text) {
    print("\n**{}.** {}\n", outcome, text);
    verdicts_.push_back({std::move(statement), std::move(outcome)});
  }
  /// The document as it is, without a table of verdicts.
  const std::string& plain() const { return text_; }
  /// The document, with the verdicts after its front matter.
  std::string text(const std::string& front) {
    const std::string body = std::exchange(text_, "");
    head({"statement", "verdict"});
    for (const Texts& v : verdicts_) row(v);
    return front + "\n" + text_ + body;
  }

 private:
  std::string text_;
  std::vector<Texts> verdicts_;
};

}  // namespace yoke::cases
