// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Bearings as they are seen in a run: where the journal is in its bore, computed from the poses of the
// bodies alone, so that it checks what the contact reports.
#pragma once

#include <string>
#include <vector>

#include <yoke/cases/case.hpp>

namespace yoke::cases {

/// A journal on body b in a bore of body a, as BearingClearance makes it.
struct Bearing {
  std::string joint;
  std::string a, b;     // bodies; "" is the ground
  Vec2 at{0.0, 0.0};    // [m] global, in the start pose
  double radial = 0.0;  // [m]
};

/// [m] Where a point of a body, global in the start pose, is in each row; `body` "" is the ground.
std::vector<Vec2> point_path(const Model& model, const Result& run, const std::string& body,
                             const Vec2& at);
/// [m] From the centre of the bore to that of the journal, in axes that turn with a.
std::vector<Vec2> journal_path(const Model& model, const Result& run, const Bearing& bearing);

/// The journal's distance from the centre of its bore is the clearance and the reported penetration.
Check journal_check(const Model& model, const Result& run, const Bearing& bearing);
/// [m] The most by which the two may be apart: the clearance and the deepest penetration.
double play_of(const Result& run, const Bearing& bearing);

/// The paths of journals in their bores, each beside the circle of its clearance [um].
Portrait orbit_portrait(const Model& model, const Result& run,
                        const std::vector<Bearing>& bearings);

}  // namespace yoke::cases
