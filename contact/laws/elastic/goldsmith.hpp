// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Goldsmith's law of two parallel cylinders, a logarithmic law (logarithmic_law.hpp):
//   d = W H [ln(L^m/(F R H)) + 1],   W = F/L,   R = R_i R_j/DR,   H = h_i + h_j;
//   a = H/L,   B = e L^m/(R H),   limit a B/e = L^(m - 1)/R.
//   consistent   m = 3, the only exponent that makes the logarithm a number, and h = (1 - nu^2)/
//                (pi E), H = 1/(pi E*), as two-dimensional elasticity requires (esdu_78035.hpp)
//   printed      m = 1 and h = (1 - nu^2)/E, in newton and millimetre: the logarithm depends on the
//                units. Its limit, 1 mm^2/R, is met at a few newton
//   tabulated    H = 1/(pi E*) outside; inside the logarithm 1e8 mm^2 pi E* L/(F R), as m = 3 with
//                a length of 10 m there (Tables 6, 7 and 11)
// The consistent limit, L^2/R, may be longer than the radii: what ends the law earlier is the
// half-width of contact (johnson.hpp).
// W. Goldsmith, Impact, 1960; Machines 2022, 10, 966, Table 1.
#pragma once

#include <yoke/contact/laws/elastic/logarithmic_law.hpp>
#include <yoke/contact/laws/material.hpp>
#include <yoke/contact/laws/reading.hpp>

namespace yoke {

/// `length` [m] of the line of contact. Throws ModelError.
LogarithmicLaw goldsmith(const RoundPair& pair, double length,
                         Reading reading = Reading::consistent);

}  // namespace yoke
