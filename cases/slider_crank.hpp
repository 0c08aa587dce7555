// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Slider-cranks, without clearance unless one is given: bodies "crank", "rod", "slider"; joints "pivot", "crank pin",
// "slider pin", "guide".
#pragma once

#include <optional>

#include <yoke/core/clearance.hpp>
#include <yoke/core/model.hpp>

namespace yoke::cases {

/// Data of P. Flores (2010): the crank starts with 150 rad/s and is left alone, with gravity. With
/// clearance in the guide the slider may start turning [rad/s].
Model free_slider_crank(const std::optional<Clearance>& guide = {}, double spin = 0.0);

/// A crank, 50 mm long unless it is given [m], driven by "motor" at a constant speed [rad/s], no
/// gravity; all links along x at the start.
Model driven_slider_crank(double crank = 0.05, double rod = 0.12, double omega = 5000.0 * pi / 30.0,
                          const std::optional<Clearance>& slider_pin = {});

/// The example idasSlCrank_dns of SUNDIALS (R. Serban): a spring and damper between the middles of
/// crank and rod, a constant force on the rod. Its J2 and m2 are those of a rod whose centre of
/// mass is the slider's pin. Bodies "crank" (angle q), "rod" (place x, angle p).
Model sprung_slider_crank();

}  // namespace yoke::cases
