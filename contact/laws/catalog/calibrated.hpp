// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A law made to deliver the restitution asked for. Most published laws return something else than
// the e they are given; here the e they are given is solved for, with their own closed form, so
// that a free central impact returns what was asked. The damping of all laws F = F_e (1 + X d'/v_i)
// then is the same; laws with a clamped tensile phase get a larger damping ratio.
#pragma once

#include <string_view>

#include <yoke/contact/laws/catalog/dissipative_catalog.hpp>
#include <yoke/contact/laws/dissipative/hunt_crossley.hpp>

namespace yoke {

/// `arguments` with the restitution that makes the law deliver `e`. Holds for approach velocities
/// not below slowest_approach. Throws ModelError, with what the law can deliver, if none does, and
/// if the law has no closed form or no restitution to solve for.
DissipativeArguments calibrated_arguments(std::string_view name, double e,
                                          DissipativeArguments arguments = {});

/// The law of that name delivering `e`.
DissipativeLaw calibrated(std::string_view name, double e, const DissipativeArguments& others = {});

/// Hunt and Crossley's law with the constant alpha that delivers `e` at one approach velocity
/// [m/s].
HuntCrossley calibrated_alpha(double e, double approach_velocity);

}  // namespace yoke
