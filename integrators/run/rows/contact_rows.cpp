// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/run/rows/contact_rows.hpp>

#include <algorithm>

namespace yoke {

namespace {

std::ptrdiff_t touching(const std::vector<ContactMemory>& contacts) {
  return std::ranges::count_if(
      contacts, [](const ContactMemory& c) { return c.phase != ContactPhase::apart; });
}

}  // namespace

ContactRows::ContactRows(const Dynamics& dynamics, int wanted)
    : wanted_(wanted), peaks_(dynamics.system()) {}

void ContactRows::start(const State& state) {
  touching_ = touching(state.contacts);
  steps_ = 0;
  if (wanted()) peaks_.start(state);
}

bool ContactRows::begins(const State& state) {
  if (!wanted()) return false;
  peaks_.restart(state);
  const std::ptrdiff_t before = touching_;
  touching_ = touching(state.contacts);
  if (touching_ <= before) return false;
  steps_ = 0;
  return true;
}

bool ContactRows::is_due() {
  ++steps_;
  long every = 1;
  for (long dense = wanted_; steps_ > dense; dense *= 2) every *= 2;
  return steps_ % every == 0;
}

const std::vector<double>& ContactRows::due_in(const StepSpan& step, System& system,
                                               Formulation& formulation, State& scratch) {
  times_.clear();
  if (!counts()) return times_;
  peaks_.find(step.from, step.to, system, formulation, scratch, times_);
  std::ranges::sort(times_);
  times_.erase(std::unique(times_.begin(), times_.end()), times_.end());
  if (is_due() || step.at_event) times_.push_back(step.end);
  return times_;
}

}  // namespace yoke
