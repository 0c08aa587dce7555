// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/contact/laws/elastic/dubowsky_freudenstein.hpp>

#include <yoke/core/error.hpp>
#include <yoke/core/types.hpp>

namespace yoke {

LogarithmicLaw dubowsky_freudenstein(const RoundPair& pair, double length, Reading reading) {
  constexpr const char* name = "dubowsky-freudenstein";
  pair.check(name);
  require_positive(fmt::format("law '{}'", name), "length", length, "m");
  switch (reading) {
    case Reading::consistent:
      return {1.0 / (pi * pair.modulus() * length), length * length / pair.relative_radius(), name};
    case Reading::printed:
      return {pi / (pair.modulus() * length),
              length * length * pair.printed_radius_difference(name) /
                  (pair.pin_radius * pair.wall_radius),
              name};
    case Reading::tabulated:
      break;
  }
  throw_no_reading(name, reading, "consistent, printed");
}

}  // namespace yoke
