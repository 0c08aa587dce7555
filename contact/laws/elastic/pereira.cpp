// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/contact/laws/elastic/pereira.hpp>

#include <cmath>

#include <yoke/core/error.hpp>

namespace yoke {

namespace {

/// DR [mm] of an internal contact, within the range of the laws.
double internal_difference(const std::string& owner, const RoundPair& pair) {
  const double DR = pair.radius_difference() * 1e3;
  // A clearance of 5 um given by two radii may come out a rounding below it.
  require_range(owner, "radius_difference", DR, 0.005 * (1.0 - 1e-9), 10.0 * (1.0 + 1e-9), "mm");
  return DR;
}

/// What both laws check; the difference of the radii is checked by the laws.
void check(const std::string& owner, const char* name, const RoundPair& pair, double length,
           Reading reading) {
  pair.check(name);
  require_positive(owner, "length", length, "m");
  if (reading == Reading::tabulated) throw_no_reading(name, reading, "consistent, printed");
}

PowerLaw law(const RoundPair& pair, double length, double DR, double a, double b, double n,
             const char* name) {
  return per_mm((a * DR + b) * length * 1e3 * pair.modulus() * 1e-6 / DR, n, name);
}

}  // namespace

PowerLaw pereira_2011(const RoundPair& pair, double length, Reading reading) {
  constexpr const char* name = "pereira-2011";
  const std::string owner = fmt::format("law '{}'", name);
  check(owner, name, pair, length, reading);
  if (pair.conformity == Conformity::external)
    throw ModelError(
        fmt::format("{}: conformity = external must be internal; pereira-2015 has both", owner));
  const double DR = internal_difference(owner, pair);
  const double Y = DR < 0.75 ? 1.56 * std::pow(std::log(1000.0 * DR), -0.192)
                             : 0.0028 * DR + (reading == Reading::printed ? 1.1083 : 1.083);
  return law(pair, length, DR, 0.49, 0.10, Y * std::pow(DR, -0.005), name);
}

PowerLaw pereira_2015(const RoundPair& pair, double length, Reading reading) {
  constexpr const char* name = "pereira-2015";
  const std::string owner = fmt::format("law '{}'", name);
  check(owner, name, pair, length, reading);
  if (pair.conformity == Conformity::external)
    return law(pair, length, pair.radius_difference() * 1e3, 0.39, 0.85, 1.094, name);
  const double DR = internal_difference(owner, pair);
  const double Y =
      DR < 0.34954 ? 1.51 * std::pow(std::log(1000.0 * DR), -0.151) : 0.0151 * DR + 1.151;
  return law(pair, length, DR, 0.965, 0.0965, Y * std::pow(DR, -0.005), name);
}

}  // namespace yoke
