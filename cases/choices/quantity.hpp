// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Numbers with units as people type them: "45mm", "-31deg", "0.32s/m", "0s", "2". The value is SI.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace yoke::cases {

enum class Quantity { number, length, angle, time, time_per_length };

/// The SI value of `text`. Throws ModelError that says what is wrong and which units are accepted;
/// `owner` opens the message, for instance "crank_length". Only a `number` has no unit.
double parse_quantity(std::string_view owner, Quantity quantity, std::string_view text);

/// The SI value in the unit people draw in: "45 mm", "-31 deg".
std::string format_quantity(Quantity quantity, double value);

/// A finite number and what follows it, as typed: "207GPa" is 207 and "GPa".
struct TypedNumber {
  double value;
  std::string_view unit;  // a view into the text
};
/// Throws ModelError if `text` does not start with a finite number.
TypedNumber parse_number(std::string_view owner, std::string_view text);

/// A number with or without its unit, SI: "0.37" or "0.37m/s". Throws ModelError.
double parse_in(std::string_view owner, std::string_view text, std::string_view unit);

/// A length with its unit, or a plain number of metres. Throws ModelError.
double parse_metres(std::string_view owner, std::string_view text);

/// A number with 17 significant digits: reading it gives the same number.
std::string exactly(double value);

/// The unit of the SI value, "" of a number.
std::string_view si_unit_name(Quantity quantity);

/// "mm, cm, m, um", or "a plain number".
std::string accepted_units(Quantity quantity);

/// The known word nearest to `word` in spelling, or "" if none is near.
std::string nearest_word(std::string_view word, const std::vector<std::string>& known);

/// "; did you mean 'x'? Known: 'x', 'y'", to end a message about an unknown word.
std::string suggestion(std::string_view word, const std::vector<std::string>& known);

}  // namespace yoke::cases
