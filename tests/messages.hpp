// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What the library tells people.
#pragma once

#include <string>
#include <string_view>

#include <yoke/core/error.hpp>

namespace yoke::tests {

inline bool contains(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

/// The message of the error that `action` throws; "no error" if it throws none.
template <class Error = ModelError, class Action>
std::string message_of(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace yoke::tests
