// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Slider-cranks without clearance: bodies "crank", "rod", "slider"; joints "pivot", "crank pin",
// "slider pin", "guide".
#pragma once

#include <yoke/core/model.hpp>

namespace yoke::cases {

/// Data of P. Flores (2010): the crank starts with 150 rad/s and is left alone, with gravity.
Model free_slider_crank();

/// Crank 50 mm, rod 120 mm, driven at 5000 rpm by "motor", no gravity.
Model driven_slider_crank();

/// The example idasSlCrank_dns of SUNDIALS (R. Serban): a spring and damper between the middles of
/// crank and rod, a constant force on the rod. Its J2 and m2 are those of a rod whose centre of
/// mass is the slider's pin. Bodies "crank" (angle q), "rod" (place x, angle p).
Model sprung_slider_crank();

}  // namespace yoke::cases
