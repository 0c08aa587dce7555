// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The summary with which one run ends on the terminal.
#include <fmt/format.h>

#include <algorithm>

#include <yoke/cases/jobs/report.hpp>
#include <yoke/cases/terminal/terminal.hpp>

namespace yoke::cases {

namespace {

void line(const char* what, const std::string& text) { fmt::print("  {:<12}{}\n", what, text); }

std::string place_of(const ForcePeak& peak) {
  std::string text =
      fmt::format("{:.5g} N in '{}' at t = {:.6g} s", peak.force, peak.element, peak.t);
  if (peak.place)
    text += fmt::format(", x = {:.4g} m, y = {:.4g} m", peak.place->x(), peak.place->y());
  return text;
}

std::string impacts_of(const LawRun& run) {
  double fastest = 0.0;
  for (const EventRecord& e : run.events)
    if (e.kind == "onset") fastest = std::max(fastest, e.speed);
  return fmt::format("{}, the fastest at {:.3g} m/s, the deepest {:.4g} um", run.onsets(), fastest,
                     1e6 * run.largest_penetration());
}

std::string files_in(const std::filesystem::path& folder, const OutputChoice& choice) {
  const char* data = choice.format == "hdf5"  ? "results.h5"
                     : choice.format == "mat" ? "results.mat"
                     : choice.events_only     ? "events.csv"
                                              : "motion.csv, events.csv, ...";
  return fmt::format("{}: {}, summary.json", folder.string(), data);
}

}  // namespace

void print_summary(const std::string& name, const LawRun& run, const std::filesystem::path& folder,
                   const OutputChoice& choice) {
  const Summary& s = run.summary;
  fmt::print("{}: {}\n", painted(name, Paint::bold, stdout),
             painted(s.reason, s.ok() ? Paint::good : Paint::bad, stdout));
  line("simulated", fmt::format("{:g} of {:g} s, {} degrees of freedom", s.t_end, s.t_asked,
                                s.degrees_of_freedom));
  line("method", fmt::format("{} at a relative tolerance of {:g}", s.formulation,
                             std::max(s.relative_tolerance, s.tolerance_kept)));
  line("energy",
       fmt::format("off by {:.2g} J of {:.3g} J exchanged", s.energy_balance, s.energy_exchanged));
  line("constraints",
       fmt::format("violated by at most {:.1e} m, {:.1e} rad, {:.1e} m/s, {:.1e} rad/s",
                   s.position_violation, s.angle_violation, s.velocity_violation,
                   s.angular_velocity_violation));
  if (!run.peak.element.empty()) line("peak force", place_of(run.peak));
  if (!run.peak.element.empty() && has_blocks(stdout)) line("", sparkline(run.peak.history));
  if (!run.contacts.empty()) line("impacts", impacts_of(run));
  line("cost", fmt::format("{:.2f} s, {} steps, {} rejected, {} evaluations", s.wall_time, s.steps,
                           s.rejected, s.evaluations));
  line("files", files_in(folder, choice));
}

}  // namespace yoke::cases
