// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Laws with a damper parallel to the spring become tensile at the end of an impact: the force
// vanishes before the penetration does. What to do about it is a choice:
//   keep    the contact lasts until the penetration is zero; the restitution is the law's own
//   clamp   the contact ends as soon as the force would become tensile; more speed is returned
#pragma once

#include <yoke/contact/laws/law.hpp>

namespace yoke {

enum class TensilePhase { keep, clamp };

/// Where a contact ends under it.
inline Release release_of(TensilePhase policy) {
  return policy == TensilePhase::keep ? Release::at_zero_penetration : Release::at_zero_force;
}

}  // namespace yoke
