// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// yoke run scotch_yoke: every law in turn, into DIR/LAW/, then the plots.
#include <yoke/cases/jobs/model_job.hpp>
#include <yoke/cases/paper/scotch_yoke_job.hpp>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include <yoke/cases/jobs/parallel.hpp>
#include <yoke/cases/jobs/progress.hpp>
#include <yoke/core/error.hpp>

namespace yoke::cases {

namespace {

// Rows recorded per revolution, whatever is written: 50 or more in the shortest impact. Long runs
// are recorded less densely, to bound the memory.
constexpr double recorded_per_revolution = 20000.0;
constexpr double recorded_at_most = 80000.0;

std::size_t choose_stride(int samples, double revolutions) {
  if (samples < 2) return 1;
  const double wanted = std::min(recorded_per_revolution * revolutions, recorded_at_most);
  return static_cast<std::size_t>(std::max(1.0, std::ceil(wanted / (samples - 1))));
}

/// A column of motion.csv and the column of the engine's samples it is made from.
struct MotionColumn {
  const char* name;
  const char* unit;
  const char* source;
};

std::vector<MotionColumn> motion_columns(const ScotchYoke& choices) {
  std::vector<MotionColumn> columns = {
      {"t", "s", "t_s"},
      {"crank_angle", "rad", "crank.angle_rad"},
      {"crank_angle_relative", "rad", "crank.angle_rad"},
      {"crank_speed", "rad_per_s", "crank.omega_rad_per_s"},
      {"slider_x", "m", "slider.x_m"},
      {"slider_v", "m_per_s", "slider.vx_m_per_s"},
      {"slider_a", "m_per_s2", "slider.ax_m_per_s2"},
      {"penetration", "m", "slot.penetration_m"},
      {"penetration_rate", "m_per_s", "slot.penetration_rate_m_per_s"},
      {"normal_force", "N", "slot.normal_force_N"},
      {"region", "", "slot.region"},
      {"pivot_fx", "N", "pivot.fx_N"},
      {"pivot_fy", "N", "pivot.fy_N"},
      {"guide_fy", "N", "guide.fy_N"},
      {"guide_moment", "N_m", "guide.moment_N_m"},
      {"motor_torque", "N_m", "motor.moment_N_m"},
  };
  if (choices.rolling)
    columns.insert(columns.end(), {{"pin_joint_fx", "N", "pin_joint.fx_N"},
                                   {"pin_joint_fy", "N", "pin_joint.fy_N"},
                                   {"pin_speed", "rad_per_s", "pin.omega_rad_per_s"}});
  for (const char* energy : {"kinetic", "stored", "dissipated", "work", "balance"})
    columns.push_back({energy, "J", nullptr});
  return columns;
}

std::vector<std::string> region_labels(const Model& model) {
  for (const auto& force : model.forces())
    for (const Channel& channel : force->channels())
      if (force->name() == "slot" && channel.name == "region") return channel.labels;
  return {};
}

Table empty_motion_table(const ScotchYoke& choices, const std::vector<std::string>& regions) {
  Table table;
  for (const MotionColumn& c : motion_columns(choices)) {
    const bool labelled = std::string_view(c.name) == "region";
    table.add_column(c.name, c.unit, labelled ? regions : std::vector<std::string>{});
  }
  return table;
}

/// The engine's samples under the names of motion.csv, with slider_x at the centre of the arc.
Table motion_table(const Table& samples, const Model& model, const ScotchYoke& choices,
                   const std::vector<std::string>& regions) {
  Table table = empty_motion_table(choices, regions);
  std::vector<std::size_t> sources;
  std::vector<double> shifts;
  for (const MotionColumn& c : motion_columns(choices)) {
    const std::string name = c.name;
    sources.push_back(samples.index(c.source ? c.source : name + "_J"));
    shifts.push_back(name == "slider_x"               ? arc_centre_offset(model, choices)
                     : name == "crank_angle_relative" ? -choices.start_angle
                                                      : 0.0);
  }
  table.reserve(samples.rows());
  for (std::size_t i = 0; i < samples.rows(); ++i) {
    double* row = table.append();
    for (std::size_t j = 0; j < sources.size(); ++j)
      row[j] = samples.value(i, sources[j]) + shifts[j];
  }
  return table;
}

}  // namespace

LawRun run_law(const RunRequest& request, const ScotchYoke& choices, const std::string& law,
               std::function<bool(const Progress&)> observer) {
  LawRun run{.law = law, .stride = choose_stride(request.samples, choices.revolutions)};
  const Model model = scotch_yoke(choices, scotch_yoke_laws(choices, law));
  const int samples =
      request.samples > 0 ? (request.samples - 1) * static_cast<int>(run.stride) + 1 : 0;
  SimulationOptions options =
      simulation_options(request, choices.end_time(), samples, request.output / law);
  options.observer = std::move(observer);
  Result result = simulate(model, options);
  if (request.verify && result.summary.ok()) {
    options.observer = [](const Progress&) { return !interrupted(); };
    run.verification = verify(model, options, result);
  }
  run.regions = region_labels(model);
  run.history = motion_table(result.samples, model, choices, run.regions);
  run.events = std::move(result.events);
  run.summary = result.summary;
  if (run.history.rows() > 0) {
    run.peak_force = run.history["normal_force_N"].maxCoeff();
    run.largest_penetration = std::max(0.0, run.history["penetration_m"].maxCoeff());
  }
  run.contacts = std::ranges::count(run.events, "onset", &EventRecord::kind);
  return run;
}

std::vector<ContactSpell> contact_spells(const LawRun& run, double from, double to) {
  std::vector<ContactSpell> spells;
  const Eigen::VectorXd t = run.history["t_s"];
  const auto row_after = [&](double time) {
    return static_cast<std::size_t>(std::lower_bound(t.begin(), t.end(), time) - t.begin());
  };
  const EventRecord* onset = nullptr;
  std::string region;  // of the contact before
  for (const EventRecord& e : run.events) {
    if (e.kind == "onset") onset = &e;
    if (e.kind != "release") continue;
    if (onset != nullptr && onset->t >= from && e.t <= to)
      spells.push_back({.first = row_after(onset->t),
                        .last = row_after(e.t),
                        .region = onset->region,
                        .crossed = !region.empty() && onset->region != region});
    onset = nullptr;
    region = e.region;
  }
  return spells;
}

std::vector<Flight> flights(const LawRun& run) {
  std::vector<Flight> all;
  const EventRecord* release = nullptr;
  for (const EventRecord& e : run.events) {
    if (e.kind == "release") release = &e;
    if (e.kind != "onset" || release == nullptr) continue;
    all.push_back({.from = release->t,
                   .to = e.t,
                   .landing_speed = e.speed,
                   .crosses = e.region != release->region});
    release = nullptr;
  }
  return all;
}

// ---- writing ----

namespace {

/// Every stride-th row of the history: the samples the user asked for.
Table thinned(const LawRun& run, const ScotchYoke& choices) {
  Table table = empty_motion_table(choices, run.regions);
  table.reserve(run.history.rows() / run.stride + 1);
  for (std::size_t i = 0; i < run.history.rows(); i += run.stride) {
    double* row = table.append();
    for (std::size_t j = 0; j < table.names().size(); ++j) row[j] = run.history.value(i, j);
  }
  return table;
}

std::string summary_json(const RunRequest& request, const LawRun& run) {
  nlohmann::ordered_json json = {
      {"case", "scotch_yoke"}, {"law", run.law}, {"parameters", request.parameters.to_json()}};
  json.update(nlohmann::ordered_json::parse(to_json(run.summary)));
  json["samples"] = (run.history.rows() + run.stride - 1) / run.stride;
  json["contacts"] = run.contacts;
  if (run.verification)
    json["verification"] = nlohmann::ordered_json::parse(to_json(*run.verification));
  json["peak_force_N"] = run.peak_force;
  json["largest_penetration_m"] = run.largest_penetration;
  json["worst_constraint_violation_m"] = run.summary.position_violation;
  json["worst_constraint_violation_m_per_s"] = run.summary.velocity_violation;
  return json.dump(2);
}

void write_run(const RunRequest& request, const ScotchYoke& choices, const LawRun& run) {
  const std::filesystem::path folder = request.output / run.law;
  make_output_folder(folder);
  // The small files first: on a full disk they say how far the large one should have got.
  write_text(folder / "summary.json", summary_json(request, run));
  write_events(run.events, folder / "events.csv");
  thinned(run, choices).write_csv(folder / "motion.csv");
}

void print_table(const std::vector<LawRun>& runs) {
  fmt::print("{:<28} {:>10} {:>12} {:>9} {:>8} {:>8} {:>10} {:>10} {:>7}\n", "law", "peak N",
             "deepest um", "contacts", "steps", "rejected", "energy J", "violation", "time s");
  for (const LawRun& run : runs) {
    if (run.law.empty()) continue;
    const Summary& s = run.summary;
    fmt::print("{:<28} {:>10.1f} {:>12.3f} {:>9} {:>8} {:>8} {:>10.1e} {:>10.1e} {:>7.2f}\n",
               run.law, run.peak_force, 1e6 * run.largest_penetration, run.contacts, s.steps,
               s.rejected, s.energy_balance, s.position_violation, s.wall_time);
  }
  for (const LawRun& run : runs)
    if (run.verification) print_verification(run.law, *run.verification);
  for (const LawRun& run : runs)
    if (!run.law.empty() && !run.summary.ok())
      fmt::print("{}: stopped at t = {:.6g} s of {:.6g} s: {}\n", run.law, run.summary.t_end,
                 run.summary.t_asked, run.summary.reason);
}

RunStatus worst_status(const std::vector<LawRun>& runs) {
  if (interrupted()) return RunStatus::interrupted;
  const bool ok = std::ranges::all_of(runs, [](const LawRun& run) { return run.summary.ok(); });
  return ok ? RunStatus::completed : RunStatus::failed;
}

}  // namespace

RunStatus run_scotch_yoke(const RunRequest& request) {
  const ScotchYoke choices(request.parameters);
  make_output_folder(request.output);
  std::vector<LawRun> runs(request.laws.size());
  {
    ProgressLine progress(request.laws);
    run_parallel(runs.size(), request.jobs, [&](std::size_t i) {
      if (interrupted()) return;
      runs[i] = run_law(request, choices, request.laws[i], progress.observer(i));
      write_run(request, choices, runs[i]);
      progress.report(i, 1.0);
    });
  }
  print_table(runs);
  fmt::print("\nresults: {}/LAW/{{motion.csv,events.csv,summary.json}}\n", request.output.string());
  const RunStatus status = worst_status(runs);
  if (status == RunStatus::interrupted) fmt::print("interrupted; what was computed is there\n");
  if (request.plots && status == RunStatus::completed) {
    fmt::print("{}\n", plot_scotch_yoke(choices, runs, request.output / "plots", request.jobs));
  }
  return status;
}

}  // namespace yoke::cases
