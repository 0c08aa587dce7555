// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/jobs/report.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include <yoke/cases/report/replay.hpp>

namespace yoke::cases {

namespace {

using Json = nlohmann::ordered_json;

Json check_json(const Check& c) {
  return {{"what", c.what},    {"value", c.value},         {"expected", c.expected},
          {"unit", c.unit},    {"tolerance", c.tolerance}, {"within", c.within()},
          {"remark", c.remark}};
}

std::string summary_json(const Case& c, const RunRequest& request, const LawRun& run) {
  Json json = {{"case", c.name}};
  if (!run.law.empty()) json["law"] = run.law;
  json["parameters"] = request.parameters.to_json();
  json.update(Json::parse(to_json(run.summary)));
  json["samples"] = run.samples.rows();
  if (!run.contacts.empty()) json["contacts"] = run.onsets();
  if (run.verification) json["verification"] = Json::parse(to_json(*run.verification));
  for (const Check& check : run.checks) json["checks"].push_back(check_json(check));
  if (!run.contacts.empty()) {
    json["peak_force_N"] = run.peak_force();
    json["largest_penetration_m"] = run.largest_penetration();
    Json& elements = json["contact_elements"];
    for (const ContactRecord& r : run.contacts)
      elements[r.element] = {{"contacts", r.onsets},
                             {"peak_force_N", r.peak_force},
                             {"largest_penetration_m", r.largest_penetration}};
  }
  json["worst_constraint_violation_m"] = run.summary.position_violation;
  json["worst_constraint_violation_rad"] = run.summary.angle_violation;
  json["worst_constraint_violation_m_per_s"] = run.summary.velocity_violation;
  json["worst_constraint_violation_rad_per_s"] = run.summary.angular_velocity_violation;
  return json.dump(2);
}

/// Of a field of summary.json; 0 if it is not there, nan if it was no number.
double number_in(const Json& summary, const char* field) {
  if (!summary.contains(field)) return 0.0;
  return summary[field].is_number() ? summary[field].get<double>()
                                    : std::numeric_limits<double>::quiet_NaN();
}

/// Of a run, by the summary.json in its folder.
std::string comparison_line(const std::filesystem::path& folder,
                            const std::vector<std::string>& elements) {
  const Json s = Json::parse(std::ifstream(folder / "summary.json"));
  const std::string stop = s.at("stop");
  std::string line =
      fmt::format("\"{}\",{}", s.value("law", ""), stop == "by_event" ? "completed" : stop);
  for (const char* field :
       {"t_end_s", "peak_force_N", "largest_penetration_m", "contacts", "steps", "rejected",
        "energy_balance_J", "position_violation_m", "angle_violation_rad"})
    line += fmt::format(",{}", number_in(s, field));
  line += fmt::format(",{:.3f}", number_in(s, "wall_time_s"));
  for (const std::string& e : elements) {
    const Json& element = s.at("contact_elements").at(e);
    for (const char* field : {"peak_force_N", "largest_penetration_m", "contacts"})
      line += fmt::format(",{}", number_in(element, field));
  }
  return line;
}

std::string label(const LawRun& run) { return run.law.empty() ? "run" : run.law; }

void print_verification(const std::string& name, const Verification& v) {
  fmt::print("\n{}: digits that agree with {} at a tolerance of {:g}\n", name, v.formulation,
             v.relative_tolerance);
  if (!v.summary.ok()) fmt::print("  it did not complete: {}\n", v.summary.reason);
  constexpr double as_good_as_equal = 12.0;
  long equal = 0;
  for (const Agreement& a : v.quantities) {
    if (a.digits > as_good_as_equal)
      ++equal;
    else
      fmt::print("  {:<32} {:>5.1f}   largest difference {:.1e} of {:.3g}\n", a.column, a.digits,
                 a.difference, a.peak);
  }
  fmt::print("  {:<32} {:>5.0f} or more\n", fmt::format("{} others", equal), as_good_as_equal);
  if (v.same_events)
    fmt::print("  {:<32} all {}, their times within {:.1e} s\n", "events", v.events,
               v.event_time_difference);
  else
    fmt::print("  {:<32} differ: {} and {}\n", "events", v.events, v.other_events);
}

void print_table(const std::vector<LawRun>& runs) {
  std::size_t width = 28;
  for (const LawRun& run : runs) width = std::max(width, label(run).size());
  fmt::print("{:<{}} {:>10} {:>12} {:>9} {:>8} {:>8} {:>10} {:>10} {:>10} {:>7}\n", "law", width,
             "peak N", "deepest um", "contacts", "steps", "rejected", "energy J", "off by m",
             "off by rad", "time s");
  for (const LawRun& run : runs) {
    if (!run.done) continue;
    const Summary& s = run.summary;
    fmt::print(
        "{:<{}} {:>10.1f} {:>12.3f} {:>9} {:>8} {:>8} {:>10.1e} {:>10.1e} {:>10.1e} {:>7.2f}\n",
        label(run), width, run.peak_force(), 1e6 * run.largest_penetration(), run.onsets(), s.steps,
        s.rejected, s.energy_balance, s.position_violation, s.angle_violation, s.wall_time);
  }
}

/// What every user should know of the mechanism; the same under every law but for the times.
void print_findings(const Summary& s, const std::string& who) {
  if (!s.redundant_equations.empty())
    fmt::print("{}redundant, left out: {}\n", who, fmt::join(s.redundant_equations, ", "));
  if (!s.not_unique_reactions.empty())
    fmt::print("{}not unique, one possibility of many: {}\n", who,
               fmt::join(s.not_unique_reactions, ", "));
  for (const SingularPosition& p : s.singular_positions)
    fmt::print("{}singular position at t = {:.9g} s ('{}'), energy changed by {:.1e} J\n", who, p.t,
               p.equation, p.energy_after - p.energy_before);
  for (const std::string& note : s.notes) fmt::print("{}note: {}\n", who, note);
}

}  // namespace

void write_run(const Case& c, const RunRequest& request, const LawRun& run,
               const std::filesystem::path& folder, RunOutput& output) {
  make_output_folder(folder);
  // The small file first: on a full disk it says what the large ones would have held.
  const std::string summary = summary_json(c, request, run);
  write_text(folder / "summary.json", summary);
  output.finish(run.samples, run.events, contact_spans(run.all(), run.events), summary);
  if (run.replay.empty())
    std::filesystem::remove(folder / replay_file);  // of an earlier run
  else
    write_text(folder / replay_file, run.replay);
}

void print_report(const std::string& case_name, const RunRequest& request,
                  const std::vector<LawRun>& runs) {
  const bool choice = runs.size() > 1 || !runs.front().law.empty();
  if (runs.size() > 1)
    print_table(runs);
  else if (runs.front().done)
    print_summary(choice ? case_name + ", " + runs.front().law : case_name, runs.front(),
                  request.output / runs.front().folder, request.choice);
  for (const LawRun& run : runs)
    if (run.done) print_findings(run.summary, choice ? label(run) + ": " : "");
  for (const LawRun& run : runs)
    if (run.verification) print_verification(label(run), *run.verification);
  if (!choice) return;
  for (const LawRun& run : runs)
    if (run.done && !run.summary.ok())
      fmt::print("{}: stopped at t = {:.6g} s of {:.6g} s: {}\n", run.law, run.summary.t_end,
                 run.summary.t_asked, run.summary.reason);
}

void print_checks(const std::vector<LawRun>& runs) {
  for (const LawRun& run : runs)
    for (const Check& check : run.checks)
      fmt::print("check: {}{}\n", run.law.empty() ? "" : run.law + ": ", text_of(check));
}

void write_comparison(const std::vector<LawRun>& runs, const std::filesystem::path& output) {
  std::string text =
      "law,stop,t_end_s,peak_force_N,largest_penetration_m,contacts,steps,rejected,"
      "energy_balance_J,position_violation,angle_violation,wall_time_s";
  std::vector<std::string> elements;
  for (const LawRun& run : runs)
    if (elements.empty())
      for (const ContactRecord& r : run.contacts) elements.push_back(r.element);
  if (elements.size() < 2) elements.clear();
  for (const std::string& e : elements)
    text += fmt::format(",{0}.peak_force_N,{0}.largest_penetration_m,{0}.contacts", e);
  for (const LawRun& run : runs)
    if (run.done) text += "\n" + comparison_line(output / run.folder, elements);
  write_text(output / "comparison.csv", text);
}

}  // namespace yoke::cases
