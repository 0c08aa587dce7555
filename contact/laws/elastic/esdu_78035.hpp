// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The law of ESDU 78035 of two parallel cylinders, a logarithmic law (logarithmic_law.hpp):
//   d = W H [ln(4 L DR/(F H)) + 1],   W = F/L,   H = h_i + h_j;
//   a = H/L,   B = e 4 L DR/H,   limit a B/e = 4 DR.
//   consistent   h = (1 - nu^2)/(pi E), so H = 1/(pi E*): two-dimensional elasticity fixes the
//                coefficient of W ln(1/W) as 1/(pi E*), because each body adds (1 - nu^2)/(pi E)
//                2 ln(1/b) and b^2 goes as W. It is then Johnson's law plus 2 W/(pi E*).
//   printed      h = (1 - nu^2)/E of the Nomenclature, H = 1/E*, about pi times too soft, and the
//                difference of the radii even where they lie on opposite sides
//   tabulated    the same (Tables 8, 9 and 11)
// ESDU 78035, 1978; Machines 2022, 10, 966, Table 1. Whether the sheet itself has the pi could not
// be looked up.
#pragma once

#include <yoke/contact/laws/elastic/logarithmic_law.hpp>
#include <yoke/contact/laws/material.hpp>
#include <yoke/contact/laws/reading.hpp>

namespace yoke {

/// `length` [m] of the line of contact. Throws ModelError.
LogarithmicLaw esdu_78035(const RoundPair& pair, double length,
                          Reading reading = Reading::consistent);

}  // namespace yoke
