// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Errors that a user can correct. A modelling mistake throws ModelError before the run starts; a
// run that fails reports it in the Summary of its Result and does not throw.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>

namespace yoke {

/// A mistake in a model or in the options of a run. The message names the element, the parameter,
/// the value given and the range accepted.
class ModelError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Results could not be written (folder not writable, disk full). The message names the path.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws ModelError unless `value` is finite. `owner` is for instance "body 'crank'".
inline void require_finite(std::string_view owner, std::string_view parameter, double value) {
  if (!std::isfinite(value))
    throw ModelError(fmt::format("{}: {} = {} must be a finite number", owner, parameter, value));
}

/// A number and its unit; a plain number if `unit` is empty.
inline std::string in_unit(double value, std::string_view unit) {
  return fmt::format("{:g}{}{}", value, unit.empty() ? "" : " ", unit);
}

/// Throws ModelError unless `value` is finite and > 0; `unit` is printed after the value.
inline void require_positive(std::string_view owner, std::string_view parameter, double value,
                             std::string_view unit) {
  if (!(std::isfinite(value) && value > 0.0))
    throw ModelError(fmt::format("{}: {} = {} must be finite and greater than {}", owner, parameter,
                                 in_unit(value, unit), in_unit(0.0, unit)));
}

/// Throws ModelError unless `value` is finite and >= 0.
inline void require_not_negative(std::string_view owner, std::string_view parameter, double value,
                                 std::string_view unit) {
  if (!(std::isfinite(value) && value >= 0.0))
    throw ModelError(fmt::format("{}: {} = {} must be finite and at least {}", owner, parameter,
                                 in_unit(value, unit), in_unit(0.0, unit)));
}

/// Throws ModelError unless low <= value <= high.
inline void require_range(std::string_view owner, std::string_view parameter, double value,
                          double low, double high, std::string_view unit = "") {
  if (!(value >= low && value <= high))
    throw ModelError(fmt::format("{}: {} = {} is outside the accepted range {:g} to {}", owner,
                                 parameter, in_unit(value, unit), low, in_unit(high, unit)));
}

}  // namespace yoke
