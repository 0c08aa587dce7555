// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Laws calibrated to deliver a given restitution. Most published laws deliver another restitution
// than their parameter e. Here e is solved for with the closed form of the law, so that a free
// central impact delivers the requested value. All laws F = F_e (1 + X d'/v_i) then have the same
// damping; laws with a clamped tensile phase get a larger damping ratio.
#pragma once

#include <string_view>

#include <yoke/contact/laws/catalog/dissipative_catalog.hpp>
#include <yoke/contact/laws/dissipative/hunt_crossley.hpp>

namespace yoke {

/// `arguments` with the restitution that makes the law deliver `e`. Holds for approach velocities
/// not below slowest_approach. Throws ModelError, with the range the law can deliver, if none does,
/// and if the law has no closed form or no restitution to solve for.
DissipativeArguments calibrated_arguments(std::string_view name, double e,
                                          DissipativeArguments arguments = {});

/// The law of that name delivering `e`.
DissipativeLaw calibrated(std::string_view name, double e, const DissipativeArguments& others = {});

/// Hunt and Crossley's law with the constant alpha that delivers `e` at one approach velocity
/// [m/s].
HuntCrossley calibrated_alpha(double e, double approach_velocity);

}  // namespace yoke
