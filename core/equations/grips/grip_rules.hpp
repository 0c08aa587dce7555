// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What an element whose friction may hold (ForceElement::may_hold) does with its grip at its own events;
// which grips hold is settled for all together afterwards (grips.hpp).
#pragma once

#include <cmath>

#include <yoke/core/force.hpp>

namespace yoke {

/// [m/s] How fast surfaces slide, and what is not told from rest there.
struct Sliding {
  double speed, slowest;
};

/// +1 or -1 of friction that slides, else 0.
inline double direction_of(Grip grip) {
  return grip == Grip::forward ? 1.0 : grip == Grip::backward ? -1.0 : 0.0;
}

/// [N] or [m/s] positive where the hold has broken, or sliding has come back through zero: by a margin,
/// so that a sliding that begins is seen to go the wrong way. `sliding()` gives a Sliding.
template <class F>
double calc_grip_event(const ForceElement& element, const ForceInput& in, F&& sliding) {
  const Grip grip = in.contact->grip;
  if (grip == Grip::held || grip == Grip::carried)
    return in.hold != nullptr ? std::abs(*in.hold) - element.holding_force(in) : -1.0;
  if (grip == Grip::none || grip == Grip::undecided) return -1.0;
  const auto [speed, slowest] = sliding();
  if (grip == Grip::guided) return std::abs(speed) - slowest;
  return -direction_of(grip) * speed - slowest;
}

/// The grip behind such an event.
template <class F>
Grip grip_after_event(const ForceInput& in, F&& sliding) {
  const Grip grip = in.contact->grip;
  if (!rests(grip)) return Grip::undecided;
  const double way = grip == Grip::guided ? sliding().speed : in.hold != nullptr ? *in.hold : 0.0;
  return way < 0.0 ? Grip::backward : Grip::forward;
}

/// The grip of surfaces that come into contact, or pass to another law, sliding so fast [m/s].
inline Grip grip_at_onset(Grip before, double speed) {
  if (rests(before) || speed == 0.0) return Grip::undecided;
  return speed > 0.0 ? Grip::forward : Grip::backward;
}

}  // namespace yoke
