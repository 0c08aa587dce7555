// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Car axis of the test set for IVP solvers (F. Mazzia, C. Magherini), problem II-9: two masses on a
// rod, each on a spring to the axle, which a bump moves and turns.
#pragma once

#include <yoke/core/model.hpp>

namespace yoke::cases {

/// Bodies "left", "right", and "road", whose angle the bump prescribes.
Model car_axis();

}  // namespace yoke::cases
