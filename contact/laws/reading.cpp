// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/contact/laws/reading.hpp>

#include <yoke/core/error.hpp>

namespace yoke {

std::string_view name_of(Reading reading) {
  switch (reading) {
    case Reading::consistent:
      return "consistent";
    case Reading::printed:
      return "printed";
    case Reading::tabulated:
      return "tabulated";
  }
  return "unknown";
}

Reading reading_named(std::string_view name) {
  for (const Reading reading : {Reading::consistent, Reading::printed, Reading::tabulated})
    if (name == name_of(reading)) return reading;
  throw ModelError(
      fmt::format("unknown reading '{}'; there are consistent, printed, tabulated", name));
}

void throw_no_reading(std::string_view law, Reading reading, std::string_view existing) {
  throw ModelError(fmt::format("law '{}': reading = {} does not exist; there is {}", law,
                               name_of(reading), existing));
}

}  // namespace yoke
