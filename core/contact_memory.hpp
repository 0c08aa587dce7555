// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What one contact remembers between events. Lives in the State, is written by events only.
#pragma once

#include <limits>

namespace yoke {

/// Apart, or in contact before or after the largest penetration.
enum class ContactPhase { apart, compressing, restituting };

/// Dry friction that can hold (FrictionLaw::holds), at one contact.
enum class Grip {
  none,       // no contact, or no such friction
  held,       // at rest: a row of the equations of motion holds it
  carried,    // at rest without a row of its own: those of others hold it too
  guided,     // at rest because joints and drivers leave it no motion; ends when they move it
  forward,    // slides with a positive sliding velocity, or begins to
  backward,   // with a negative one
  undecided,  // at rest at this instant: between an event and what becomes of it only
};

/// Whether the surfaces are at rest on one another.
inline bool rests(Grip grip) {
  return grip == Grip::held || grip == Grip::carried || grip == Grip::guided;
}

/// Discrete memory of one contact. Penetration > 0 in contact, rate > 0 while approaching.
struct ContactMemory {
  /// where it is in the state machine of contact/contact_element.hpp
  ContactPhase phase = ContactPhase::apart;
  int region = 0;                    // which part of the geometry is (or was last) touched
  double onset_time = 0.0;           // [s]
  double approach_velocity = 0.0;    // [m/s] rate at the located onset, or of what led to the start
  double effective_mass = 0.0;       // [kg] along the normal at onset, 1/(n^T J A J^T n)
  double largest_penetration = 0.0;  // [m] at the last end of compression
  double permanent_set = 0.0;        // [m] residual indentation left by this contact
  double release_penetration = 0.0;  // [m] of the next onset, see contact_element.hpp
  bool past_kink = false;            // of the dissipative law, if its formula has one
  Grip grip = Grip::none;            // of friction that holds, if the law has it
  friend bool operator==(const ContactMemory&, const ContactMemory&) = default;
};

}  // namespace yoke
