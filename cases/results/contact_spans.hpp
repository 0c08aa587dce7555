// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What each contact of a run did: one line of the report's table of contacts.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include <yoke/core/result.hpp>

namespace yoke::cases {

struct ContactSpan {
  std::string element, region;
  double onset = 0.0;       // [s]
  double release = 0.0;     // [s]; of one that lasts, the end of the run
  double speed = 0.0;       // [m/s] of approach
  double peak_force = 0.0;  // [N] of the rows
  double deepest = 0.0;     // [m] of the rows
  double restitution = std::numeric_limits<double>::quiet_NaN();  // none while it lasts
  std::size_t first = 0, last = 0;                                // rows within, last excluded
  std::size_t peak = 0;                                           // row of the peak force
};

/// From an onset to the release that follows, by time of onset.
std::vector<ContactSpan> contact_spans(const Table& samples,
                                       const std::vector<EventRecord>& events);

}  // namespace yoke::cases
