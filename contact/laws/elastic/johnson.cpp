// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/contact/laws/elastic/johnson.hpp>

#include <numbers>

#include <yoke/core/error.hpp>
#include <yoke/core/types.hpp>

namespace yoke {

namespace {
double positive(const char* parameter, double value, const char* unit) {
  require_positive("law 'johnson'", parameter, value, unit);
  return value;
}
}  // namespace

Johnson::Johnson(double composite_modulus, double difference, double contact_length)
    : modulus(positive("modulus", composite_modulus, "Pa")),
      radius_difference(positive("radius_difference", difference, "m")),
      length(positive("length", contact_length, "m")),
      law(1.0 / (pi * modulus * length),
          4.0 * radius_difference / (std::numbers::e * std::numbers::e), "johnson") {}

Johnson johnson(const RoundPair& pair, double length) {
  pair.check("johnson");
  return {pair.modulus(), pair.radius_difference(), length};
}

}  // namespace yoke
