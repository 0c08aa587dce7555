// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The law of Dubowsky and Freudenstein of a pin in a sleeve of length L = 2a, a logarithmic law
// (logarithmic_law.hpp):
//   d = pi H/L [ln(L^3/(pi H R F)) + 1] F,   R = R_i R_j/DR,   H = h_i + h_j;
//   a = pi H/L,   B = e L^3/(pi H R),   limit a B/e = L^2/R.
//   consistent   pi H = 1/(pi E*), the coefficient of two-dimensional elasticity
//                (esdu_78035.hpp): then it is Goldsmith's law with m = 3
//   printed      h = (1 - nu^2)/E of the Nomenclature, pi H = pi/E*, about pi^2 times too soft, and
//                the difference of the radii even where they lie on opposite sides
// There is no table of it. S. Dubowsky, F. Freudenstein, J. Eng. Ind. 93, 1971; Machines 2022, 10,
// 966, Table 1 and Eq. (8).
#pragma once

#include <yoke/contact/laws/elastic/logarithmic_law.hpp>
#include <yoke/contact/laws/material.hpp>
#include <yoke/contact/laws/reading.hpp>

namespace yoke {

/// `length` [m] of the line of contact. Throws ModelError.
LogarithmicLaw dubowsky_freudenstein(const RoundPair& pair, double length,
                                     Reading reading = Reading::consistent);

}  // namespace yoke
