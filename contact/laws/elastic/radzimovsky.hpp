// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Radzimovsky's law of two parallel cylinders, a logarithmic law (logarithmic_law.hpp):
//   d = F/(pi E* L) [2/3 + ln(4 R_i/b) + ln(4 R_j/b)],   b width of contact.
// With b^2 = 2 (1.60)^2 W R/E*, W = F/L, R = R_i R_j/DR the radii drop out but for DR:
//   16 R_i R_j/b^2 = 8 DR E*/(1.6^2 W),
//   a = 1/(pi E* L),   B = e^(2/3) 8 DR E* L/1.6^2,   limit a B/e = 8 e^(-1/3)/(1.6^2 pi) DR.
// 1.60 is the rounded 4/sqrt(2 pi) = 1.596 of Hertz' full width.
//   consistent, printed   the above: Table 1 does not say what b is, Section 4 prints the 8
//   tabulated             b = 1.60 sqrt(W R/E*), sqrt(2) too small: 16 for the 8 (Tables 2, 3, 11)
// E. I. Radzimovsky, University of Illinois, 1953; Machines 2022, 10, 966, Table 1 and Section 4.
#pragma once

#include <yoke/contact/laws/elastic/logarithmic_law.hpp>
#include <yoke/contact/laws/material.hpp>
#include <yoke/contact/laws/reading.hpp>

namespace yoke {

/// `length` [m] of the line of contact. Throws ModelError.
LogarithmicLaw radzimovsky(const RoundPair& pair, double length,
                           Reading reading = Reading::consistent);

}  // namespace yoke
