// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Why a step failed, as its callbacks know it. SUNDIALS is C: an exception of a user's function
// must not pass through it, and its own messages must not be printed.
#pragma once

#include <fmt/format.h>

#include <exception>
#include <string>
#include <string_view>

namespace yoke {

/// Begins the text of a failure that was an exception.
inline constexpr std::string_view threw = "a function of the model threw: ";

struct CallbackFailure {
  std::string text;
  bool thrown = false;

  /// Runs a callback; an exception becomes an unrecoverable failure with its message.
  template <class F>
  int guard(F&& callback) noexcept {
    try {
      return callback();
    } catch (const std::exception& error) {
      text = threw;
      text += error.what();
      thrown = true;
      return -1;
    }
  }
  /// A message of SUNDIALS; warnings (code >= 0) are dropped, and the first cause is kept.
  void report(int code, const char* message) {
    if (code < 0 && text.empty()) text = message;
  }
};

/// Why a step after time t [s] failed, for a user: where a function of the model threw, what it
/// said and nothing else, for there is nothing to guess; else `diagnosis`, and the failure in
/// brackets.
inline std::string explained(const std::string& failure, double t, const std::string& diagnosis) {
  if (!failure.starts_with(threw)) return fmt::format("{} ({})", diagnosis, failure);
  return fmt::format("after t = {:.9g} s: {}", t, failure.substr(threw.size()));
}

}  // namespace yoke
