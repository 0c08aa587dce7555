// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Hertz' law of a point contact as Lankarani and Nikravesh use it for pins in holes:
//   F = K d^1.5,  K = 4/3 E* sqrt(R) [N/m^1.5],  R = R_pin R_wall/(R_wall +- R_pin), + external.
// The length of the pin does not enter: it is a law of spheres.
//   consistent, printed   the above
//   tabulated             K = 4/3 pi E* sqrt(R) for a pin of 10 mm, in proportion to the length: the
//                         column of Table 11 is this for 1 mm, pi/10 of the right K
// H. M. Lankarani, P. E. Nikravesh, J. Mech. Des. 112, 1990; Machines 2022, 10, 966, Table 1.
#pragma once

#include <yoke/contact/laws/elastic/power_law.hpp>
#include <yoke/contact/laws/material.hpp>
#include <yoke/contact/laws/reading.hpp>

namespace yoke {

/// `modulus` [Pa] composite E*, `relative_radius` [m] R. Throws ModelError.
PowerLaw hertz(double modulus, double relative_radius);
PowerLaw hertz(const RoundPair& pair);

/// `length` [m] is needed by the tabulated reading only. Throws ModelError.
PowerLaw lankarani_nikravesh(const RoundPair& pair, double length = 0.0,
                             Reading reading = Reading::consistent);

}  // namespace yoke
