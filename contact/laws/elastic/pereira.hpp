// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The two laws of Pereira, Ramalho and Ambrosio, power laws fitted to Johnson's with numbers in
// newton and millimetre (E* in N/mm^2, DR, L and d in mm):
//   F = (a DR + b) L E*/DR d^n
//   2011, internal   a = 0.49, b = 0.10, n = Y DR^-0.005,
//                    Y = 1.56 ln(1000 DR)^-0.192  for 0.005 <= DR < 0.75,
//                        0.0028 DR + 1.083        for 0.75 <= DR <= 10
//   2015, internal   a = 0.965, b = 0.0965, n = Y DR^-0.005,
//                    Y = 1.51 ln(1000 DR)^-0.151  for 0.005 <= DR < 0.34954,
//                        0.0151 DR + 1.151        for 0.34954 <= DR <= 10
//   2015, external   a = 0.39, b = 0.85, n = 1.094
//   consistent   the above
//   printed      2011 with + 1.1083 in Y: a misprint, with it Y jumps at DR = 0.75 (1.0852 to
//                1.1104) and the law is 14 to 25 % below Johnson's. 2015: the same
// There is no table of them. The years and numbers are those of Machines 2022, 10, 966, Table 1
// and its references 37 and 38.
#pragma once

#include <yoke/contact/laws/elastic/power_law.hpp>
#include <yoke/contact/laws/material.hpp>
#include <yoke/contact/laws/reading.hpp>

namespace yoke {

/// `length` [m] of the line of contact. Throws ModelError, also outside the range of DR.
PowerLaw pereira_2011(const RoundPair& pair, double length, Reading reading = Reading::consistent);
/// Their law of 2015 for a pin on a wall along `length` [m]. Throws ModelError.
PowerLaw pereira_2015(const RoundPair& pair, double length, Reading reading = Reading::consistent);

}  // namespace yoke
