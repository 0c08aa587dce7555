// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/run/stall_detector.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace yoke {

namespace {

constexpr int max_stalled_steps = 100;

}  // namespace

void Standstill::start(double t, Window window) {
  restart(t);
  window_ = window;
}

void Standstill::restart(double t) {
  t_last_ = t;
  stalled_steps_ = 0;
}

bool Standstill::stalls(double t) {
  const double resolvable = 4.0 * std::numeric_limits<double>::epsilon() * std::abs(t);
  stalled_steps_ = t - t_last_ > resolvable ? 0 : stalled_steps_ + 1;
  t_last_ = t;
  return stalled_steps_ > max_stalled_steps;
}

bool Standstill::chatters(double t, double duration) {
  if (t - window_.start > event_window * duration) window_ = {.start = t, .events = 0};
  return ++window_.events > max_events_in_window;
}

void Standstill::note_step(double step) {
  std::rotate(last_steps_.begin(), last_steps_.begin() + 1, last_steps_.end());
  last_steps_.back() = step;
}

}  // namespace yoke
