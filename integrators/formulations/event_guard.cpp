// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/formulations/event_guard.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace yoke {

namespace {

/// What stands for a function that must not fire: negative and of its own size, so that a root
/// finder which remembers it from the step before knows nothing of units.
double hidden(double value) {
  return -std::max(std::abs(value), std::numeric_limits<double>::min());
}

}  // namespace

bool touches(const State& state) {
  return std::ranges::any_of(state.contacts,
                             [](const ContactMemory& c) { return c.phase != ContactPhase::apart; });
}

EventGuard::EventGuard(Dynamics& dynamics) : dynamics_(dynamics) {
  const auto count = static_cast<std::size_t>(dynamics.system().events());
  last_.assign(count, -1.0);
  seen_ = last_;
  armed_.assign(count, 0);
  negative_.assign(count, 0.0);
  fired_.reserve(count);
  passed_.reserve(count);
}

// What cannot be computed is not finite, and evaluate() says so.
void EventGuard::calc(double t, const double* q, const double* v, const double* z, double* g) {
  if (!dynamics_.calc_events({.t = t, .q = q, .v = v, .z = z}, g))
    std::fill_n(g, last_.size(), std::numeric_limits<double>::quiet_NaN());
}

void EventGuard::start(double t, const double* q, const double* v, const double* z) {
  calc(t, q, v, z, last_.data());
  std::ranges::fill(negative_, 0.0);
  for (std::size_t i = 0; i < last_.size(); ++i) armed_[i] = last_[i] < 0.0 ? 1 : 0;
}

void EventGuard::start(const State& state) {
  start(state.t, state.q.data(), state.v.data(), state.z.data());
  settle(state, state.t);
}

void EventGuard::settle(const State& state, double t) {
  if (state.handled_at != t) return;
  for (const int slot : state.handled) {
    const auto i = static_cast<std::size_t>(slot);
    armed_[i] = 0;
    negative_[i] = below_zero(last_[i]);
  }
}

bool EventGuard::evaluate(double t, const double* q, const double* v, const double* z, double* g) {
  calc(t, q, v, z, seen_.data());
  t_seen_ = t;
  for (std::size_t i = 0; i < last_.size(); ++i) {
    if (!std::isfinite(seen_[i])) {
      dynamics_.system().blame_event(static_cast<int>(i));
      return false;
    }
    g[i] = armed_[i] == 0 ? hidden(seen_[i]) : seen_[i];
  }
  return true;
}

void EventGuard::accept(double t, const double* q, const double* v, const double* z) {
  if (last_.empty()) return;
  if (t == t_seen_) {  // the root finder has just looked there
    last_ = seen_;
  } else {
    calc(t, q, v, z, last_.data());
  }
  for (std::size_t i = 0; i < last_.size(); ++i)
    if (last_[i] < negative_[i]) armed_[i] = 1;
}

void EventGuard::collect(double t, const double* q, const double* v, const double* z,
                         const std::vector<int>& found) {
  std::vector<double>& now = last_;
  calc(t, q, v, z, now.data());
  fired_.clear();
  passed_.clear();
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (armed_[i] == 0) continue;
    if (found[i] > 0) {
      fired_.push_back(static_cast<int>(i));
    } else if (now[i] >= 0.0) {
      passed_.push_back(static_cast<int>(i));
    }
  }
  // Without a restart these stay disarmed until they have been negative.
  for (const int i : fired_) armed_[static_cast<std::size_t>(i)] = 0;
  for (const int i : passed_) armed_[static_cast<std::size_t>(i)] = 0;
}

}  // namespace yoke
