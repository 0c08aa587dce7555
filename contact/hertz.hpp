// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Hertz' law of a point contact as Lankarani and Nikravesh use it for pins in holes:
//   F = K d^1.5,  K = 4/3 E* sqrt(R) [N/m^1.5],  R = R_pin R_wall/(R_wall +- R_pin), + external.
// The length of the pin does not enter: it is a law of spheres. The column "Lankarani" of the
// paper's Table 11 is not this K but pi/10 of it (see table11.hpp).
#pragma once

#include <yoke/contact/material.hpp>
#include <yoke/contact/power_law.hpp>

namespace yoke {

/// `modulus` [Pa] composite E*, `relative_radius` [m] R. Throws ModelError.
PowerLaw hertz(double modulus, double relative_radius);
PowerLaw hertz(const RoundPair& pair);

}  // namespace yoke
