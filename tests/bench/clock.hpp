// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What benchmarks measure time with.
#pragma once

#include <time.h>

namespace yoke::bench {

/// Processor time of this thread: other programs on the machine leave no trace but in the caches.
struct Clock {
  using time_point = double;  // [s]
  static time_point now() {
    timespec t{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  }
};

inline double seconds_since(Clock::time_point begin) { return Clock::now() - begin; }

/// [s] Processor time of one call.
template <class Run>
double seconds_of(Run&& run) {
  const Clock::time_point begin = Clock::now();
  run();
  return seconds_since(begin);
}

}  // namespace yoke::bench
