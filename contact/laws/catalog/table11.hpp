// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Table 11 of Autiero et al., Machines 2022, 10, 966, as printed: F = K d^n, K in N/mm^n, for the
// steel pin (radius 7.9 mm) on the inner wall (52 mm), the outer wall (68 mm) and the end caps (8
// mm) of the scotch-yoke's slot. Caveats:
//   - The two labels of Delta R are swapped: inner wall 59.9 mm (external contact), outer wall
//     60.1 mm (internal contact).
//   - The K are fits of the force per millimetre of pin, though printed as N/mm^n. Here they are
//     taken as constants of the total force; `scale` multiplies them (10 for the pin's 10 mm).
//   - The fits were made for 0 to 1000 N per millimetre and are too soft below that: Johnson's for
//     the walls by 5 % at 10 N and by 12 % at 1 N.
//   - The whole row of the inner wall was computed with a pin of 7.5 mm, and ESDU's K there with
//     R_i - R_p (44.5 mm) although the contact is external.
//   - Lankarani and Nikravesh: K = pi/10 of 4/3 E* sqrt(R).
//   - Radzimovsky: the width of contact is a factor sqrt(2) too small.
//   - Goldsmith: a factor 1e8 in the logarithm that no consistent set of units gives.
//   - ESDU: about pi times too soft. So "Goldsmith is the softest" is not a property of the laws.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <yoke/contact/laws/elastic/power_law.hpp>

namespace yoke {

/// One column of the table: a power law for each region of the slot.
struct Table11 {
  PowerLaw inner, outer, cap;  // of the walls of the paper's slot, and of its round ends
};

/// table11-lankarani-nikravesh, table11-radzimovsky, table11-johnson, table11-goldsmith and
/// table11-esdu-78035, in the order of the table.
const std::vector<std::string>& table11_names();

/// The column of that name, every K times `scale`. Throws ModelError that lists the names.
Table11 table11(std::string_view name, double scale = 1.0);

}  // namespace yoke
