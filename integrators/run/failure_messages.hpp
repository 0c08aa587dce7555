// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What a run that fails tells the user: what happened, when, who is to blame and what to try. Texts
// follow "at t = ... s" or begin with it; all times in s.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <yoke/core/equations/dynamics.hpp>
#include <yoke/core/result.hpp>

namespace yoke {

/// `place` says which state could not be projected: "at the event ", or nothing for a sample.
std::string not_projected(std::string_view place, double t);
/// The same, with the equation that was violated most in the projection just tried.
std::string not_projected_equation(const Dynamics& dynamics, double t);
/// `dynamics` has just measured the violation of positions.
std::string drifted(const Dynamics& dynamics, double t, double tolerance);
/// More than `most` events within `window` seconds.
std::string chattering(long most, double window, double t, const std::vector<EventRecord>& events);

/// The element that gave a value that is not finite, if that is why a step failed; else empty.
std::string blame_element(const System& system);
/// If no element is to blame there: friction that wedges shortly after `there`, the last good state;
/// else whether the tolerance is too tight (a looser one has been tried and gets on from there), the
/// last event, the last steps [s], and what moves most violently at `there`, whose accelerations are
/// solved for. `dynamics` is bound to `there` afterwards.
std::string blame_surroundings(Dynamics& dynamics, State& there,
                               const std::vector<EventRecord>& events,
                               std::span<const double, 3> last_steps, bool too_tight);

}  // namespace yoke
