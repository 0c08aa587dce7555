// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/program/request.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <ranges>
#include <thread>
#include <utility>

#include <yoke/cases/program/verb.hpp>
#include <yoke/core/equations/linear/linear_solver.hpp>
#include <yoke/core/error.hpp>
#include <yoke/core/result.hpp>
#include <yoke/integrators/formulations/explicit/explicit_pairs.hpp>
#include <yoke/integrators/run/checkpoint_schedule.hpp>
#include <yoke/integrators/simulate.hpp>

namespace yoke::cases {

namespace {

std::string checked_formulation(const std::string& name) {
  std::vector<std::string> known;
  for (const FormulationNote& note : formulations()) known.emplace_back(note.name);
  known.emplace_back("automatic");
  if (name.empty()) return known.back();
  if (std::ranges::find(known, name) == known.end())
    throw ModelError(fmt::format("unknown formulation '{}'{}", name, suggestion(name, known)));
  return name;
}

long checked_events(long n) {
  if (n < 1) throw ModelError(fmt::format("--checkpoint-events {}: must be at least 1", n));
  return n;
}

double checked_interval(const std::string& text) {
  if (text.empty()) return 0.0;
  const double every = parse_quantity("--checkpoint", Quantity::time, text);
  if (!(every > 0.0))
    throw ModelError(fmt::format("--checkpoint {}: must be greater than 0 s", text));
  return every;
}

/// Refused where it would do nothing.
int checked_order(const RequestOptions& o) {
  if (o.order == 0) return 0;
  const auto order = static_cast<int>(o.order);
  if (std::ranges::count(explicit_pairs(), order, &ExplicitPair::order) == 0)
    throw ModelError(fmt::format(
        "--order {}: accepted are {}", o.order,
        fmt::join(explicit_pairs() | std::views::transform(&ExplicitPair::order), ", ")));
  if (!o.formulation.empty() && !o.formulation.starts_with("arkode"))
    throw ModelError(fmt::format(
        "--order {}: formulation '{}' has none; it belongs to --formulation arkode-projection and "
        "arkode-baumgarte",
        o.order, o.formulation));
  return order;
}

/// Refused where it would do nothing.
std::optional<double> checked_spectral_radius(const RequestOptions& o) {
  if (o.spectral_radius.empty()) return std::nullopt;
  const double radius = parse_quantity("--spectral-radius", Quantity::number, o.spectral_radius);
  if (!(radius >= 0.0 && radius <= 0.999))
    throw ModelError(
        fmt::format("--spectral-radius {}: accepted is 0 to 0.999", o.spectral_radius));
  constexpr const char* only = "generalised-alpha";
  if (o.formulation != only)
    throw ModelError(fmt::format(
        "--spectral-radius {}: formulation '{}' has none; it belongs to --formulation {}",
        o.spectral_radius, o.formulation.empty() ? "automatic" : o.formulation, only));
  return radius;
}

OutputChoice checked_choice(const RequestOptions& o) {
  check_output_format(o.format);
  if (o.every < 1) throw ModelError(fmt::format("--every {}: must be at least 1", o.every));
  OutputChoice choice{.format = o.format,
                      .columns = o.columns,
                      .every = static_cast<std::size_t>(o.every),
                      .events_only = o.events_only};
  if (!o.from.empty()) choice.from = parse_quantity("--from", Quantity::time, o.from);
  return choice;
}

std::vector<Sheet> sheets_for(const std::string& paper) {
  std::vector<Sheet> sheets{on_screen};
  if (paper.empty()) return sheets;
  if (paper != "single" && paper != "double" && paper != "both")
    throw ModelError(fmt::format("--paper {}: accepted are single, double, both", paper));
  if (paper != "double") sheets.push_back(single_column);
  if (paper != "single") sheets.push_back(double_column);
  return sheets;
}

void print_law_help(const Case& c) {
  if (c.contact.laws.empty()) return;
  fmt::print("\nLaws (--law NAME)\n");
  for (const NamedLaw& law : c.contact.laws) fmt::print("  {:<28} {}\n", law.name, law.description);
  std::vector<std::string> walls;
  for (const Wall& wall : c.contact.walls(Parameters(c.parameters))) walls.push_back(wall.name);
  if (walls.empty()) {
    fmt::print(
        "  or any law of 'yoke law list', elastic+dissipative with arguments:\n"
        "  --law hertz+flores:e=0.8; with the parameters' defaults there is no contact\n");
    return;
  }
  fmt::print(
      "  or any law of 'yoke law list', elastic+dissipative with arguments, also wall by wall\n"
      "  ({}): --law johnson+flores:e=0.8, --law hertz, --law johnson,{}=power:K=1e8,n=1.5;\n"
      "  with friction: --friction brown-mcphee:mu=0.1,mu_static=0.12\n",
      fmt::join(walls, ", "), walls.back());
}

void print_case_help(const Case& c) {
  fmt::print("\n{}: {}\n\nParameters (--set name=value)\n", c.name, c.description);
  for (const CaseParameter& p : c.parameters) {
    fmt::print("  {:<16} {}\n", p.name, p.description);
    fmt::print("  {:<16} default {}; {}{}\n", "", p.default_text, p.range_text(),
               p.numeric() && p.quantity != Quantity::number
                   ? fmt::format("; units {}", accepted_units(p.quantity))
                   : "");
  }
  print_law_help(c);
  fmt::print("\nFormulations (--formulation NAME; default: automatic, chosen from the model)\n");
  for (const FormulationNote& f : formulations())
    fmt::print("  {:<22} {}\n", f.name, f.description);
}

}  // namespace

void add_case_options(CLI::App& verb, RequestOptions& o) {
  verb.set_help_flag();  // our own, because CASE changes what it prints
  verb.add_flag("-h,--help", o.help, "Print this help; with CASE also its parameters and laws");
  verb.add_option("CASE", o.case_name, "Name of the case; see 'yoke list'");
  verb.add_option("--set", o.settings, "Set a parameter: --set crank_length=50mm; repeatable")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  verb.add_option("--rtol", o.relative_tolerance, "Relative tolerance, 1e-13 to 1e-2")
      ->type_name("X")
      ->capture_default_str();
  verb.add_option("--formulation", o.formulation,
                  "Formulation and integrator; see below or 'yoke list'")
      ->type_name("NAME");
  verb.add_option("--jobs", o.jobs, "Runs at a time; default: one per processor")->type_name("N");
}

void add_output_options(CLI::App& verb, RequestOptions& o) {
  verb.add_option("-o,--output", o.output, "Folder for the results")->type_name("DIR");
  verb.add_option(
          "--law", o.laws,
          "Contact law: a name of the case, or laws of 'yoke law list' with arguments; repeatable")
      ->type_name("LAW")
      ->allow_extra_args(false);
  verb.add_option("--friction", o.friction,
                  "Friction in every contact, a friction law of 'yoke law list' with arguments: "
                  "brown-mcphee:mu=0.1,mu_static=0.12; also wall by wall: SPEC,WALL=SPEC")
      ->type_name("FRICTION");
  verb.add_option("--samples", o.samples, "Rows of each table, uniform in time, both ends included")
      ->type_name("N")
      ->capture_default_str();
  verb.add_option(
          "--format", o.format,
          "csv: a file for each table; hdf5: results.h5, readable while the run goes on; mat: "
          "results.mat for MATLAB and Octave")
      ->type_name("FORMAT")
      ->capture_default_str();
  verb.add_option(
          "--columns", o.columns,
          "Write these columns alone, by name with * and ?: --columns 'crank.*,*_J'; repeatable")
      ->type_name("PATTERNS")
      ->delimiter(',')
      ->allow_extra_args(false);
  verb.add_option("--every", o.every, "Write every N-th row")
      ->type_name("N")
      ->capture_default_str();
  verb.add_option("--from", o.from, "Write rows and events from this time on, for instance 0.5s")
      ->type_name("TIME");
  verb.add_flag("--events-only", o.events_only,
                "Write events, impacts and the summary; no tables over time, no plots, no report");
  verb.add_flag("--no-plots", o.no_plots, "Do not draw plots");
  verb.add_option(
          "--paper", o.paper,
          "Figures for print too, PNG, SVG and PDF with text of 8 points: single (84 mm wide), "
          "double (174 mm; also without a word) or both; and animations as MP4 and WebM "
          "where ffmpeg is installed")
      ->type_name("[COLUMNS]")
      ->expected(0, 1)
      ->default_str("double");
  verb.add_flag("--no-report", o.no_report, "Do not write report.html");
  verb.add_flag("-q,--quiet", o.quiet, "No progress, no summary: print what goes wrong alone");
  verb.add_flag("--verify", o.verify,
                "Run again with another formulation at a tighter tolerance and print how many "
                "digits of each quantity agree");
  verb.add_option("--checkpoint", o.checkpoint,
                  "Write a checkpoint at this interval of simulated time, for instance 0.01s; "
                  "'yoke resume DIR' continues from it")
      ->type_name("TIME");
  verb.add_option_function<long>(
          "--checkpoint-events", [&o](long n) { o.checkpoint_events = checked_events(n); },
          "Write a checkpoint every N contact events")
      ->type_name("N");
  verb.add_option("--spectral-radius", o.spectral_radius,
                  "Of generalised-alpha at infinite frequency, 0 (damps most) to 0.999; default "
                  "0.8")
      ->type_name("X");
  verb.add_option(
          "--order", o.order,
          "Of the steps of arkode-projection and arkode-baumgarte, 5 or 7; default: the run "
          "takes what costs less")
      ->type_name("N");
  verb.add_option("--linear-solver", o.linear_solver,
                  "What solves for accelerations and multipliers: blocks (along the graph of the "
                  "joints), range-klu, klu (the saddle matrix); default automatic")
      ->type_name("NAME");
}

void settle_paper(RequestOptions& o) {
  if (!o.case_name.empty() || o.paper.empty() || o.paper == "single" || o.paper == "double" ||
      o.paper == "both")
    return;
  o.case_name = std::exchange(o.paper, "double");
}

namespace {

const char* const options_file = "run.json";

/// The fields that decide what a run computes and writes.
template <class Options, class Visit>
void visit_options(Options& o, Visit&& visit) {
  visit("case", o.case_name);
  visit("set", o.settings);
  visit("laws", o.laws);
  visit("friction", o.friction);
  visit("samples", o.samples);
  visit("relative_tolerance", o.relative_tolerance);
  visit("formulation", o.formulation);
  visit("no_plots", o.no_plots);
  visit("no_report", o.no_report);
  visit("paper", o.paper);
  visit("verify", o.verify);
  visit("checkpoint", o.checkpoint);
  visit("checkpoint_events", o.checkpoint_events);
  visit("spectral_radius", o.spectral_radius);
  visit("order", o.order);
  visit("linear_solver", o.linear_solver);
  visit("format", o.format);
  visit("columns", o.columns);
  visit("every", o.every);
  visit("from", o.from);
  visit("events_only", o.events_only);
}

/// Options that came after run.json was first written: a file without them is an older one, of a
/// run with their defaults.
bool added_later(std::string_view option) {
  constexpr std::string_view later[] = {
      "friction", "spectral_radius", "order", "linear_solver", "no_report",  "paper",
      "format",   "columns",         "every", "from",          "events_only"};
  return std::ranges::find(later, option) != std::end(later);
}

}  // namespace

nlohmann::ordered_json to_json(const RequestOptions& options) {
  nlohmann::ordered_json json;
  visit_options(options, [&](const char* name, const auto& value) { json[name] = value; });
  return json;
}

void save_options(const RequestOptions& options, const std::filesystem::path& folder) {
  make_output_folder(folder);
  write_text(folder / options_file, to_json(options).dump(2));
}

RequestOptions load_options(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / options_file;
  std::ifstream file(path);
  if (!file)
    throw ModelError(fmt::format("there is no '{}': 'yoke run ... -o {}' did not write here",
                                 path.string(), folder.string()));
  RequestOptions options;
  try {
    const nlohmann::json json = nlohmann::json::parse(file);
    visit_options(options, [&](const char* name, auto& value) {
      if (!added_later(name) || json.contains(name)) json.at(name).get_to(value);
    });
  } catch (const nlohmann::json::exception& error) {
    throw ModelError(fmt::format("'{}' is damaged: {}", path.string(), error.what()));
  }
  options.output = folder.string();
  return options;
}

/// As a shell takes it.
std::string quoted(const std::string& word) {
  const auto plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string_view("_-+.,:=/%").find(c) != std::string_view::npos;
  };
  if (!word.empty() && std::ranges::all_of(word, plain)) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

namespace {

/// What computes the same again; where it goes and what is drawn is left to the user.
std::string command_of(const RequestOptions& o) {
  const RequestOptions defaults;
  std::string text = "yoke run " + quoted(o.case_name);
  for (const std::string& setting : o.settings) text += " --set " + quoted(setting);
  for (const std::string& law : o.laws) text += " --law " + quoted(law);
  if (!o.friction.empty()) text += " --friction " + quoted(o.friction);
  if (o.relative_tolerance != defaults.relative_tolerance)
    text += fmt::format(" --rtol {}", o.relative_tolerance);
  if (!o.formulation.empty()) text += " --formulation " + quoted(o.formulation);
  if (!o.spectral_radius.empty()) text += " --spectral-radius " + quoted(o.spectral_radius);
  if (o.order != 0) text += fmt::format(" --order {}", o.order);
  if (o.linear_solver != defaults.linear_solver)
    text += " --linear-solver " + quoted(o.linear_solver);
  if (o.samples != defaults.samples) text += fmt::format(" --samples {}", o.samples);
  return text;
}

}  // namespace

RunRequest make_request(const Case& c, const RequestOptions& o) {
  if (o.samples < 2)
    throw ModelError(fmt::format("--samples {}: at least 2 are needed, the two ends", o.samples));
  if (!(o.relative_tolerance >= 1e-13 && o.relative_tolerance <= 1e-2))
    throw ModelError(fmt::format("--rtol {:g}: accepted is 1e-13 to 1e-2", o.relative_tolerance));
  linear_solver_named(o.linear_solver);
  if (o.jobs < 0) throw ModelError(fmt::format("--jobs {}: must be at least 1", o.jobs));
  const Parameters parameters(c.parameters, o.settings);
  const std::vector<std::string> laws = choose_laws(c, parameters, o.laws, o.friction);
  for (const std::string& law : laws) make_laws(c.contact, parameters, law);  // says what is wrong
  check_checkpoint_interval(checked_interval(o.checkpoint), c.duration(parameters));
  const int processors = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  return {.parameters = parameters,
          .laws = laws,
          .output = o.output.empty() ? c.default_output : std::filesystem::path(o.output),
          .samples = o.samples,
          .choice = checked_choice(o),
          .relative_tolerance = o.relative_tolerance,
          .formulation = checked_formulation(o.formulation),
          .plots = !o.no_plots && !o.events_only,
          .sheets = sheets_for(o.paper),
          .films = !o.paper.empty(),
          .report = !o.no_report && !o.events_only,
          .command = command_of(o),
          .jobs = o.jobs > 0 ? o.jobs : processors,
          .quiet = o.quiet,
          .verify = o.verify,
          .spectral_radius = checked_spectral_radius(o),
          .order = checked_order(o),
          .linear_solver = o.linear_solver,
          .checkpoint_every = checked_interval(o.checkpoint),
          .checkpoint_events = o.checkpoint_events};
}

int print_help(const CLI::App& verb, const RequestOptions& options) {
  fmt::print("{}", verb.help("yoke"));
  if (!options.case_name.empty()) {
    print_case_help(find_case(options.case_name));
    return exit_ok;
  }
  fmt::print("\nCases\n");
  for (const Case& c : case_registry()) fmt::print("  {:<16} {}\n", c.name, c.description);
  fmt::print("\n'yoke {} CASE --help' lists the parameters and laws of a case.\n", verb.get_name());
  return exit_ok;
}

int exit_code(RunStatus status) {
  switch (status) {
    case RunStatus::completed:
      return exit_ok;
    case RunStatus::interrupted:
      return exit_interrupted;
    case RunStatus::failed:
      break;
  }
  return exit_failed;
}

}  // namespace yoke::cases
