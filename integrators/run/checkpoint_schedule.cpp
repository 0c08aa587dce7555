// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/run/checkpoint_schedule.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <yoke/core/error.hpp>

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
  c.contact_rows = options_.contact_rows;
  c.chosen_columns = options_.columns;
  c.every = options_.checkpoints.every;
  c.every_events = options_.checkpoints.every_events;
  c.baumgarte_rate = options_.baumgarte_rate;
  c.spectral_radius = options_.spectral_radius;
  c.order = options_.order;
  c.linear_solver = options_.linear_solver;
  c.next_time = next_time_;
  c.events_since = events_since_;
  writer_->write(c, result);
}

namespace {

constexpr double most_checkpoints = 1e6;
constexpr double worth_a_word = 30.0;  // [s] of writing
constexpr double sensible_count = 100.0;

/// The next of 1, 2, 5, 10 ... times a power of ten.
double rounded_up(double x) {
  const double decade = std::pow(10.0, std::floor(std::log10(x)));
  for (const double digit : {1.0, 2.0, 5.0})
    if (digit * decade >= x * (1.0 - 1e-9)) return digit * decade;
  return 10.0 * decade;
}

double count_of(double every, double duration) {
  return std::floor(duration / every * (1.0 + 1e-12));
}

std::string proposal(double duration) {
  const double every = rounded_up(duration / sensible_count);
  return fmt::format("every {:g} s would be {:.0f}", every, count_of(every, duration));
}

std::string wall_time(double seconds) {
  if (seconds < 120.0) return fmt::format("{:.0f} s", seconds);
  if (seconds < 7200.0) return fmt::format("{:.0f} min", seconds / 60.0);
  if (seconds < 172800.0) return fmt::format("{:.1f} h", seconds / 3600.0);
  return fmt::format("{:.0f} days", seconds / 86400.0);
}

}  // namespace

void check_checkpoint_interval(double every, double duration) {
  if (!(every > 0.0) || count_of(every, duration) <= most_checkpoints) return;
  throw ModelError(fmt::format(
      "checkpoints every {:g} s would be {:.3g} of them in {:g} s; accepted are up to {:g}, at "
      "least {:g} s apart; {}",
      every, duration / every, duration, most_checkpoints, duration / most_checkpoints,
      proposal(duration)));
}

std::string checkpoint_cost(double every, double duration, double seconds) {
  if (!(every > 0.0)) return {};
  const double count = count_of(every, duration), total = count * seconds;
  if (total < worth_a_word) return {};
  return fmt::format(
      "{:.0f} checkpoints, one every {:g} s, will take about {} to write, {:.2g} ms each; {}",
      count, every, wall_time(total), 1e3 * seconds, proposal(duration));
}

SimulationOptions options_of(const Checkpoint& c, const std::filesystem::path& folder) {
  return {.until = c.until,
          .relative_tolerance = c.relative_tolerance,
          .formulation = c.formulation,
          .samples = c.samples,
          .contact_rows = c.contact_rows,
          .columns = c.chosen_columns,
          .length_scale = c.scales.length,
          .time_scale = c.scales.time,
          .baumgarte_rate = c.baumgarte_rate,
          .spectral_radius = c.spectral_radius,
          .order = c.order,
          .linear_solver = c.linear_solver,
          .checkpoints = {.folder = folder, .every = c.every, .every_events = c.every_events}};
}

}  // namespace yoke
