// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// All friction laws by name, with formula, source and parameters.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <yoke/core/friction_law.hpp>

namespace yoke {

/// A parameter of a friction law as the catalogue knows it.
struct FrictionParameter {
  std::string name;          // as make_friction() takes it
  std::string unit;          // "" for a number without one
  std::string default_text;  // "" if it must be given
};

/// Description of a law.
struct FrictionNote {
  std::string name;                           // kebab-case, as make_friction() takes it
  std::string title;                          // authors and year
  std::string formula;                        // of T, in the letters of docs/friction.md
  std::string source;                         // where it was published
  std::string caveat;                         // "" if none
  std::vector<FrictionParameter> parameters;  // with units and defaults
};

/// Every law, in the order of the literature.
const std::vector<FrictionNote>& friction_catalog();

/// Throws ModelError that lists the names.
const FrictionNote& find_friction(std::string_view name);

/// The law of that name with parameters in SI units; those not named have their defaults, and
/// mu_static is mu. Throws ModelError for an unknown law or parameter, a missing mu, a value out of
/// range.
FrictionLaw make_friction(std::string_view name,
                          const std::vector<std::pair<std::string, double>>& parameters);

}  // namespace yoke
