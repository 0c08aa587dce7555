// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Checkpoints of a run.
#include <yoke/integrators/engine/run.hpp>

#include <chrono>

#include <yoke/integrators/run/failure_messages.hpp>

namespace yoke {

// At a step's end that is not an event; false if the run cannot go on.
bool Run::reach_checkpoint(double t) {
  formulation_->interpolate(t, state_);
  if (!dynamics_.project(state_)) return fail(not_projected("at the checkpoint ", t));
  stale_ = false;
  write_checkpoint();
  return true;
}

// Whoever goes on from here, this run or one that is taken up, starts from the same.
void Run::write_checkpoint() {
  standstill_.restart(state_.t);
  summarise();
  cost_.close(dynamics_, result_.summary);
  checkpoints_.write({.formulation = std::string(entry_.name),
                      .scales = dynamics_.system().scales(),
                      .state = state_,
                      .dropped_rows = dynamics_.system().left_out_rows(),
                      .next_sample = samples_->next(),
                      .ledger = samples_->ledger(),
                      .summary = result_.summary,
                      .window_start = standstill_.window().start,
                      .window_events = standstill_.window().events,
                      .largest_independence = largest_independence_},
                     result_);
  start_anew();
}

// It tells what the others will cost.
void Run::write_first_checkpoint() {
  const auto begin = std::chrono::steady_clock::now();
  write_checkpoint();
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
  const std::string cost =
      checkpoint_cost(options_.checkpoints.every, options_.until - t_start_, taken.count());
  if (options_.warning && !cost.empty()) options_.warning(cost);
}

}  // namespace yoke
