// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/jobs/law_run.hpp>

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include <yoke/cases/jobs/progress.hpp>
#include <yoke/cases/report/replay.hpp>

namespace yoke::cases {

namespace {

// Rows within each contact besides, see SimulationOptions.
constexpr int rows_of_contact = 40;

bool has_channel(const ForceElement& element, std::string_view name) {
  const std::vector<Channel> channels = element.channels();
  return std::ranges::find(channels, name, &Channel::name) != channels.end();
}

/// The elements that report a contact: force and penetration.
std::vector<std::string> contact_names(const Model& model) {
  std::vector<std::string> names;
  for (const auto& force : model.forces())
    if (force->contacts() > 0 && has_channel(*force, "normal_force") &&
        has_channel(*force, "penetration"))
      names.push_back(force->name());
  return names;
}

std::vector<ContactRecord> contact_records(const std::vector<std::string>& names,
                                           const LawRun& run) {
  std::vector<ContactRecord> records;
  for (const std::string& name : names) {
    ContactRecord r{.element = name};
    if (run.all().rows() > 0) {
      r.peak_force = run.all()[name + ".normal_force_N"].maxCoeff();
      r.largest_penetration = std::max(0.0, run.all()[name + ".penetration_m"].maxCoeff());
    }
    r.onsets = std::ranges::count_if(
        run.events, [&](const EventRecord& e) { return e.element == name && e.kind == "onset"; });
    records.push_back(r);
  }
  return records;
}

constexpr std::size_t stretches = 60;  // of a run, in ForcePeak::history

/// Of columns fx and fy, or of one that is a force by itself (`y` the same as `x`).
ForcePeak peak_of(const Table& rows, const std::string& element, std::size_t x, std::size_t y) {
  ForcePeak peak{.element = element, .history = std::vector<double>(stretches, 0.0)};
  const double begin = rows.value(0, 0), end = rows.value(rows.rows() - 1, 0);
  for (std::size_t i = 0; i < rows.rows(); ++i) {
    const double t = rows.value(i, 0);
    const double force = x == y ? rows.value(i, x) : std::hypot(rows.value(i, x), rows.value(i, y));
    const double part = end > begin ? (t - begin) / (end - begin) : 0.0;
    double& most =
        peak.history[std::min(stretches - 1, static_cast<std::size_t>(part * stretches))];
    most = std::max(most, force);
    if (!(force > peak.force)) continue;
    peak.force = force;
    peak.t = t;
    if (x == y)
      peak.place = Vec2(rows.value(i, rows.index(element + ".contact_point_x_m")),
                        rows.value(i, rows.index(element + ".contact_point_y_m")));
  }
  return peak;
}

ForcePeak largest_force(const Table& rows, const std::vector<std::string>& contacts) {
  ForcePeak largest;
  if (rows.rows() == 0) return largest;
  const auto take = [&](ForcePeak peak) {
    if (peak.force > largest.force) largest = std::move(peak);
  };
  for (const std::string& c : contacts) {
    const std::size_t force = rows.index(c + ".normal_force_N");
    if (rows.has(c + ".contact_point_x_m")) take(peak_of(rows, c, force, force));
  }
  if (!contacts.empty()) return largest;
  for (std::size_t j = 0; j + 1 < rows.names().size(); ++j)
    if (rows.part(j) == "reactions" && rows.names()[j].ends_with(".fx_N"))
      take(peak_of(rows, rows.names()[j].substr(0, rows.names()[j].size() - 5), j, j + 1));
  return largest;
}

/// Rows under the names of the case.
Table renamed(const Table& samples, const std::vector<MotionColumn>& columns) {
  Table table;
  std::vector<std::size_t> sources;
  for (const MotionColumn& c : columns) {
    sources.push_back(samples.index(c.source));
    table.add_column(c.name, c.unit, samples.labels(sources.back()));
  }
  table.reserve(samples.rows());
  for (std::size_t i = 0; i < samples.rows(); ++i) {
    double* row = table.append();
    for (std::size_t j = 0; j < sources.size(); ++j)
      row[j] = samples.value(i, sources[j]) + columns[j].shift;
  }
  return table;
}

bool of_element(const EventRecord& event, std::string_view element) {
  return element.empty() || event.element == element;
}

/// Patterns of the columns that the run keeps; empty: all. Throws ModelError where all are too many and
/// some are not enough.
std::vector<std::string> columns_to_keep(const RunRequest& request, const Model& model) {
  const double columns = 9.0 * static_cast<double>(model.bodies().size() - 1) +
                         3.0 * static_cast<double>(model.constraints().size());
  const double gibibytes =
      columns * request.samples * static_cast<double>(sizeof(double)) / (1024.0 * 1024.0 * 1024.0);
  if (gibibytes <= request.most_gibibytes) return {};
  if (request.choice.columns.empty() || request.plots || request.report)
    throw ModelError(fmt::format(
        "{} rows of {:.3g} columns would take {:.0f} GiB: ask for fewer rows (--samples), or for some "
        "columns without pictures and checks (--columns PATTERN --no-plots --no-report)",
        request.samples, columns, gibibytes));
  return request.choice.columns;
}

/// What the case says of its run.
void judge(const Case& c, const RunRequest& request, const Model& model, const Result& result,
           LawRun& run) {
  run.checks = run_checks(c, request.parameters, run.law, model, result);
  if ((request.plots || request.report) && c.portraits && result.summary.ok() &&
      result.samples.rows() >= 2)
    run.portraits = c.portraits(request.parameters, model, result);
}

void keep(Result result, LawRun& run) {
  if (result.contact_samples.rows() > 0) run.dense = result.samples.merged(result.contact_samples);
  run.samples = std::move(result.samples);
  run.events = std::move(result.events);
  run.summary = std::move(result.summary);
}

}  // namespace

double LawRun::peak_force() const {
  double most = 0.0;
  for (const ContactRecord& c : contacts) most = std::max(most, c.peak_force);
  return most;
}

double LawRun::largest_penetration() const {
  double most = 0.0;
  for (const ContactRecord& c : contacts) most = std::max(most, c.largest_penetration);
  return most;
}

long LawRun::onsets() const {
  long sum = 0;
  for (const ContactRecord& c : contacts) sum += c.onsets;
  return sum;
}

LawRun run_law(const Case& c, const RunRequest& request, const std::string& law,
               std::function<bool(const Progress&)> observer, RunOutput* output) {
  const Model model = make_model(c, request.parameters, law);
  const std::vector<std::string> kept = columns_to_keep(request, model);
  const bool all = kept.empty();
  const std::vector<std::string> contacts = all ? contact_names(model) : std::vector<std::string>{};
  LawRun run{.law = law, .done = true};
  SimulationOptions options =
      simulation_options(request, c.duration(request.parameters), request.samples, request.output);
  if (!contacts.empty() && request.samples > 0) options.contact_rows = rows_of_contact;
  options.columns = kept;
  const std::vector<MotionColumn> own =
      c.columns && all ? c.columns(request.parameters, model) : std::vector<MotionColumn>{};
  if (output != nullptr) {
    output->begin(model, own, static_cast<std::size_t>(request.samples), kept);
    options.observer = [output, observe = std::move(observer)](const Progress& progress) {
      output->watch(*progress.so_far);
      return !observe || observe(progress);
    };
  } else {
    options.observer = std::move(observer);
  }
  options.warning = [&law](const std::string& text) {
    fmt::print(stderr, "{}{}{}{}\n", isatty(STDERR_FILENO) != 0 ? "\r\033[K" : "", law,
               law.empty() ? "" : ": ", text);
  };
  Result result = simulate(model, options);
  if (request.verify && result.summary.ok()) {
    options.observer = [](const Progress&) { return !interrupted(); };
    options.contact_rows = 0;
    run.verification = verify(model, options, result);
  }
  if (all) judge(c, request, model, result, run);
  keep(std::move(result), run);
  run.contacts = contact_records(contacts, run);
  if (all) run.peak = largest_force(run.all(), contacts);
  if (!own.empty()) run.history = renamed(run.samples, own);
  if (!own.empty() && run.dense.rows() > 0) run.dense_history = renamed(run.dense, own);
  if (request.report && run.samples.rows() > 0)
    run.replay = to_json(Replay{.c = c,
                                .parameters = request.parameters,
                                .law = law,
                                .command = request.command,
                                .model = model,
                                .samples = run.all(),
                                .events = run.events,
                                .summary = run.summary,
                                .checks = run.checks,
                                .portraits = run.portraits,
                                .share = std::max<std::size_t>(1, request.laws.size())});
  return run;
}

std::vector<ContactSpell> contact_spells(const LawRun& run, const Table& rows, double from,
                                         double to, std::string_view element) {
  std::vector<ContactSpell> spells;
  const Eigen::VectorXd t = rows["t_s"];
  const auto row_after = [&](double time) {
    return static_cast<std::size_t>(std::lower_bound(t.begin(), t.end(), time) - t.begin());
  };
  const EventRecord* onset = nullptr;
  std::string region;  // of the contact before
  for (const EventRecord& e : run.events) {
    if (!of_element(e, element)) continue;
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

std::vector<Flight> flights(const LawRun& run, std::string_view element) {
  std::vector<Flight> all;
  const EventRecord* release = nullptr;
  for (const EventRecord& e : run.events) {
    if (!of_element(e, element)) continue;
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

}  // namespace yoke::cases
