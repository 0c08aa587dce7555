// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/run/checkpoint_schedule.hpp>

#include <algorithm>

namespace yoke {

RunCheckpoints::RunCheckpoints(const SimulationOptions& options, double t_start)
    : options_(options), t_start_(t_start) {}

void RunCheckpoints::begin(std::uint64_t model) {
  model_ = model;
  writer_ = std::make_unique<CheckpointWriter>(options_.checkpoints.folder, nullptr);
}

void RunCheckpoints::resume(const Checkpoint& existing) {
  model_ = existing.model;
  next_time_ = existing.next_time;
  events_since_ = existing.events_since;
  writer_ = std::make_unique<CheckpointWriter>(options_.checkpoints.folder, &existing);
}

double RunCheckpoints::next_stop() const {
  if (!wanted() || !(options_.checkpoints.every > 0.0)) return options_.until;
  return std::min(options_.until,
                  t_start_ + static_cast<double>(next_time_) * options_.checkpoints.every);
}

bool RunCheckpoints::due(double t) const {
  if (!wanted() || t >= options_.until) return false;
  const long every_events = options_.checkpoints.every_events;
  return t >= next_stop() || (every_events > 0 && events_since_ >= every_events);
}

void RunCheckpoints::write(Checkpoint c, const Result& result) {
  while (next_stop() <= c.state.t && next_stop() < options_.until) ++next_time_;
  events_since_ = 0;
  c.model = model_;
  c.until = options_.until;
  c.relative_tolerance = options_.relative_tolerance;
  c.samples = options_.samples;
  c.every = options_.checkpoints.every;
  c.every_events = options_.checkpoints.every_events;
  c.baumgarte_rate = options_.baumgarte_rate;
  c.spectral_radius = options_.spectral_radius;
  c.next_time = next_time_;
  c.events_since = events_since_;
  writer_->write(c, result);
}

SimulationOptions options_of(const Checkpoint& c, const std::filesystem::path& folder) {
  return {.until = c.until,
          .relative_tolerance = c.relative_tolerance,
          .formulation = c.formulation,
          .samples = c.samples,
          .length_scale = c.scales.length,
          .time_scale = c.scales.time,
          .baumgarte_rate = c.baumgarte_rate,
          .spectral_radius = c.spectral_radius,
          .checkpoints = {.folder = folder, .every = c.every, .every_events = c.every_events}};
}

}  // namespace yoke
