// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The named choices of a case: what they are called, their unit, default and range, and the values
// given by the user with --set name=value.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include <yoke/cases/choices/quantity.hpp>

namespace yoke::cases {

/// A parameter of a case. It takes one of `words`, or a number from `low` to `high`, or either.
struct CaseParameter {
  std::string name;
  Quantity quantity = Quantity::number;
  std::string default_text;  // as a user would write it: "45mm"
  double low = 0.0;          // SI; low > high: words only
  double high = -1.0;
  bool whole = false;  // the number counts something
  std::vector<std::string> words{};
  std::string description;

  bool numeric() const { return low <= high; }
  /// "30 mm to 51.9 mm", "a whole number, 1 to 400", "fixed or rolling".
  std::string range_text() const;
};

/// A value for each parameter of a case.
class Parameters {
 public:
  /// The defaults, then the `settings` "name=value" in turn. Throws ModelError for an unknown name,
  /// a wrong unit, a value out of range.
  explicit Parameters(std::vector<CaseParameter> parameters,
                      const std::vector<std::string>& settings = {});

  void set(std::string_view name, std::string_view value);

  double number(std::string_view name) const;            ///< SI
  int whole(std::string_view name) const;                ///< of a parameter that counts something
  const std::string& word(std::string_view name) const;  ///< "" if it is a number
  bool is_word(std::string_view name) const { return !word(name).empty(); }
  std::string text(std::string_view name) const;  ///< "45 mm", "fixed"
  /// {"crank_length": "45 mm", ...}
  nlohmann::ordered_json to_json() const;

 private:
  struct Value {
    double number = 0.0;
    std::string word;
  };
  const CaseParameter& find(std::string_view name) const;
  const Value& value(std::string_view name) const;

  std::vector<CaseParameter> parameters_;
  std::map<std::string, Value, std::less<>> values_;
};

}  // namespace yoke::cases
