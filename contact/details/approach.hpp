// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The impact that leads to where a contact is found: for contacts that begin within the wall.
#pragma once

#include <yoke/contact/laws/law.hpp>

namespace yoke {

/// [m/s] The approach velocity of the free central impact of `memory.effective_mass` under the law
/// that passes through `penetration` [m] > 0 with `rate` [m/s], > 0 still approaching. Its damping
/// may depend on that velocity, so it is found by running the impact backwards to the touch. Where
/// no impact leads there, as of a law that pulls harder than the rate allows, what the energies
/// give: v^2 = rate^2 + 2 U(penetration)/m.
double approach_velocity_to(const ContactLaw& law, ContactMemory memory, double penetration,
                            double rate);

}  // namespace yoke
