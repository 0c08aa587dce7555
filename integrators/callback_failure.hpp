// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Why a step failed, as its callbacks know it. SUNDIALS is C: an exception of a user's function
// must not pass through it, and its own messages must not be printed.
#pragma once

#include <exception>
#include <string>

namespace yoke {

struct CallbackFailure {
  std::string text;
  bool thrown = false;

  /// Runs a callback; an exception becomes an unrecoverable failure with its message.
  template <class F>
  int guard(F&& callback) noexcept {
    try {
      return callback();
    } catch (const std::exception& error) {
      text = error.what();
      thrown = true;
      return -1;
    }
  }
  /// A message of SUNDIALS; warnings (code >= 0) are dropped, and the first cause is kept.
  void report(int code, const char* message) {
    if (code < 0 && text.empty()) text = message;
  }
};

}  // namespace yoke
