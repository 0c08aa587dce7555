// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Mechanisms of the multibody literature that have known answers, written as a user would.
#pragma once

#include <yoke/core/model.hpp>

namespace yoke::cases {

/// A01 of the IFToMM library of multibody benchmarks: a point mass of 1 kg on a massless rod of
/// 1 m, released at rest to the right of the pivot; g = 9.81. Body "mass", joint "rod".
Model point_pendulum();

/// A uniform rod of 1 m and 1 kg, released horizontal. Body "rod", joint "pivot".
Model rod_pendulum();

/// Two such rods in a row. Bodies "a", "b", joints "pivot", "elbow".
Model double_pendulum();

/// Crank, rod and slider without gaps. Bodies "crank", "rod", "slider"; joints "pivot",
/// "crank pin", "slider pin", "guide". Data of P. Flores (2010): the crank starts with 150 rad/s
/// and is left alone, with gravity.
Model free_slider_crank();
/// The same with the crank driven at 5000 rpm by "motor", no gravity.
Model driven_slider_crank();

/// The example idasSlCrank_dns of SUNDIALS (R. Serban): a spring and damper between the middles of
/// crank and rod, a constant force on the rod. Its J2 and m2 are those of a rod whose centre of
/// mass is the slider's pin. Bodies "crank" (angle q), "rod" (place x, angle p).
Model sprung_slider_crank();

/// Car axis of the test set for IVP solvers (F. Mazzia, C. Magherini), problem II-9: two masses on
/// a rod, each on a spring to the axle, which a bump moves and turns. Bodies "left", "right", and
/// "road", which turns as the bump tells it to.
Model car_axis();

}  // namespace yoke::cases
