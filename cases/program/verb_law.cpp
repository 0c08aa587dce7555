// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// yoke law list|show|eval|fit: the contact laws by name, what they give, and the power law nearest
// to one.
#include <fmt/ranges.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include <yoke/cases/choices/quantity.hpp>
#include <yoke/cases/program/law_options.hpp>
#include <yoke/cases/program/verb.hpp>
#include <yoke/contact/laws/catalog/dissipative_catalog.hpp>
#include <yoke/contact/laws/catalog/elastic_catalog.hpp>
#include <yoke/contact/laws/catalog/friction_catalog.hpp>
#include <yoke/contact/laws/catalog/power_fit.hpp>
#include <yoke/core/error.hpp>

namespace yoke::cases {

namespace {

// The tables of the paper: a wall of 100 mm, forces per millimetre of length.
constexpr const char* paper_wall_radius = "100mm";
constexpr const char* paper_length = "1mm";

int list_laws() {
  fmt::print("Elastic laws (--elastic NAME)\n");
  for (const ElasticNote& note : elastic_catalog()) {
    std::vector<std::string> readings;
    for (const Reading r : note.readings) readings.emplace_back(name_of(r));
    fmt::print("  {:<26} {}{}\n", note.name, note.title,
               readings.size() > 1 ? fmt::format(" [{}]", fmt::join(readings, ", ")) : "");
  }
  fmt::print("\nDissipative laws (--dissipation NAME)\n");
  for (const DissipativeNote& note : dissipative_catalog())
    fmt::print("  {:<26} {}\n", note.name, note.title);
  fmt::print("\nFriction laws (--friction NAME)\n");
  for (const FrictionNote& note : friction_catalog())
    fmt::print("  {:<26} {}\n", note.name, note.title);
  fmt::print("\n'yoke law show NAME' tells more about one.\n");
  return exit_ok;
}

void print_field(const char* name, const std::string& text) {
  if (!text.empty()) fmt::print("  {:<12} {}\n", name, text);
}

void print_caveats(const std::vector<std::string>& caveats) {
  const char* name = "caveats";
  for (const std::string& caveat : caveats) {
    fmt::print("  {:<12} {}\n", name, caveat);
    name = "";
  }
}

void show(const ElasticNote& note) {
  fmt::print("{} (elastic): {}\n", note.name, note.title);
  print_field("formula", note.formula);
  print_field("validity", note.validity);
  print_field("source", note.source);
  std::vector<std::string> readings;
  for (const Reading r : note.readings) readings.emplace_back(name_of(r));
  print_field("readings", fmt::format("{}", fmt::join(readings, ", ")));
  print_caveats(note.caveats);
  for (const Reading r : note.readings)
    if (const std::string warning = elastic_warning(note.name, r); !warning.empty())
      print_field(std::string(name_of(r)).c_str(), warning);
  fmt::print("  parameters\n");
  for (const LawParameter& p : note.parameters)
    fmt::print("    {:<14} {:<8} {}\n", p.name, p.unit, p.range);
}

void show(const DissipativeNote& note) {
  fmt::print("{} (dissipative): {}\n", note.name, note.title);
  print_field("formula", note.formula);
  print_field("source", note.source);
  print_field("meant for", note.meant_for);
  print_field("delivers", note.delivers);
  print_field("separation", note.separation);
  print_field("persistent", note.persistent);
  if (note.linear_only) print_field("elastic law", "F_e = K d only");
  print_caveats(note.caveats);
  if (note.parameters.empty()) return;
  fmt::print("  parameters\n");
  for (const auto& [name, range] : note.parameters) fmt::print("    {:<14} {}\n", name, range);
}

void show(const FrictionNote& note) {
  fmt::print("{} (friction): {}\n", note.name, note.title);
  print_field("formula", note.formula);
  print_field("source", note.source);
  print_field("caveats", note.caveat);
  fmt::print("  parameters\n");
  for (const FrictionParameter& p : note.parameters)
    fmt::print("    {:<18} {:<8} {}\n", p.name, p.unit,
               p.default_text.empty() ? "must be given" : "default " + p.default_text);
}

// A name may be that of an elastic and of a dissipative law: both are shown.
int show(const std::string& name) {
  std::vector<std::string> known;
  bool found = false;
  for (const ElasticNote& note : elastic_catalog()) {
    known.push_back(note.name);
    if (note.name != name) continue;
    show(note);
    found = true;
  }
  for (const DissipativeNote& note : dissipative_catalog()) {
    known.push_back(note.name);
    if (note.name != name) continue;
    if (found) fmt::print("\n");
    show(note);
    found = true;
  }
  for (const FrictionNote& note : friction_catalog()) {
    known.push_back(note.name);
    if (note.name != name) continue;
    show(note);
    found = true;
  }
  if (!found) throw ModelError(fmt::format("unknown law '{}'{}", name, suggestion(name, known)));
  return exit_ok;
}

struct EvalOptions {
  ElasticOptions law;
  std::vector<std::string> penetrations;
  std::string format = "csv";
};

int eval(const EvalOptions& o) {
  check_format(o.format, {"csv", "json"});
  std::vector<double> penetrations;
  for (const std::string& text : o.penetrations)
    penetrations.push_back(parse_metres("--penetration", text));
  if (penetrations.empty()) throw ModelError("--penetration is missing: one or more, 1e-6,1e-5");
  const ElasticLaw law = elastic_law(o.law);
  for (const double d : penetrations)
    if (!(d >= 0.0 && d <= law.limit()))
      throw ModelError(fmt::format("--penetration {:g} m: '{}' is valid from 0 to {:g} m", d,
                                   law.name(), law.limit()));
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  if (o.format == "csv") fmt::print("penetration_m,force_N,stiffness_N_per_m,energy_J\n");
  for (const double d : penetrations) {
    const ElasticResponse r = law.response(d);
    if (o.format == "csv")
      fmt::print("{},{},{},{}\n", exactly(d), exactly(r.force), exactly(r.stiffness),
                 exactly(r.energy));
    else
      rows.push_back({{"penetration_m", d},
                      {"force_N", r.force},
                      {"stiffness_N_per_m", r.stiffness},
                      {"energy_J", r.energy}});
  }
  if (o.format == "json") fmt::print("{}\n", rows.dump(2));
  return exit_ok;
}

struct FitOptions {
  ElasticOptions law;
  std::string max_load, min_load;
  int samples = 10001;
  std::string format = "text";
};

int fit(FitOptions o) {
  check_format(o.format, {"text", "csv", "json"});
  if (o.max_load.empty()) throw ModelError("--max-load is missing: the largest load [N] to fit to");
  const double max_load = parse_in("--max-load", o.max_load, "N");
  ElasticOptions& law_options = o.law;
  std::vector<std::string> assumed;
  if (!law_options.clearance.empty() && law_options.pin_radius.empty() &&
      law_options.wall_radius.empty()) {
    law_options.wall_radius = paper_wall_radius;
    assumed.push_back(fmt::format("--wall-radius {}", paper_wall_radius));
  }
  if (law_options.length.empty()) {
    law_options.length = paper_length;
    assumed.push_back(fmt::format("--length {}", paper_length));
  }
  const ElasticLaw law = elastic_law(law_options);
  const double min_load = o.min_load.empty() ? 0.0 : parse_in("--min-load", o.min_load, "N");
  const PowerFit f = fit_power_law(law, max_load, o.samples, min_load);
  const double K_mm = f.K * std::pow(1000.0, -f.n);
  if (o.format == "csv") {
    fmt::print(
        "K_N_per_m_n,n,K_N_per_mm_n,max_relative_error,rms_relative_error,relative_error_at_small_"
        "load,max_load_N,samples,min_load_N\n");
    fmt::print("{},{},{},{},{},{},{},{},{}\n", exactly(f.K), exactly(f.n), exactly(K_mm),
               exactly(f.max_error), exactly(f.rms_error), exactly(f.error_at_small_load),
               exactly(f.max_load), f.samples, exactly(f.min_load));
  } else if (o.format == "json") {
    const nlohmann::ordered_json json = {{"elastic", law.name()},
                                         {"reading", law_options.reading},
                                         {"K_N_per_m_n", f.K},
                                         {"n", f.n},
                                         {"K_N_per_mm_n", K_mm},
                                         {"max_relative_error", f.max_error},
                                         {"rms_relative_error", f.rms_error},
                                         {"relative_error_at_small_load", f.error_at_small_load},
                                         {"min_load_N", f.min_load},
                                         {"max_load_N", f.max_load},
                                         {"samples", f.samples},
                                         {"assumed", assumed}};
    fmt::print("{}\n", json.dump(2));
  } else {
    fmt::print("{} ({}), loads {:g} to {:g} N, {} samples\n", law.name(), law_options.reading,
               f.min_load, f.max_load, f.samples);
    if (!assumed.empty())
      fmt::print("  assumed    {}, as in the paper's tables\n", fmt::join(assumed, " "));
    fmt::print("  K          {:.9g} N/m^n  ({:.9g} N/mm^n)\n", f.K, K_mm);
    fmt::print("  n          {:.9g}\n", f.n);
    fmt::print("  error of the force at the same penetration, relative\n");
    fmt::print("    largest  {:.3g} %\n", 100.0 * f.max_error);
    fmt::print("    rms      {:.3g} %\n", 100.0 * f.rms_error);
    fmt::print("    at {:g} N  {:+.3g} %\n", 1e-3 * f.max_load, 100.0 * f.error_at_small_load);
  }
  return exit_ok;
}

}  // namespace

void add_law_verb(CLI::App& app, Action& action) {
  CLI::App* verb = app.add_subcommand("law", "Contact laws: list, show, evaluate, fit");
  verb->require_subcommand(1);
  verb->add_subcommand("list", "Every elastic and dissipative law")->callback([&action] {
    action = list_laws;
  });

  CLI::App* show_verb =
      verb->add_subcommand("show", "Formula, parameters, range, source and caveats of a law");
  auto name = std::make_shared<std::string>();
  show_verb->add_option("NAME", *name, "Name of the law; see 'yoke law list'")->required();
  show_verb->callback([name, &action] { action = [name] { return show(*name); }; });

  CLI::App* eval_verb =
      verb->add_subcommand("eval", "Force, stiffness and energy of an elastic law");
  auto eval_options = std::make_shared<EvalOptions>();
  add_elastic_options(*eval_verb, eval_options->law);
  eval_verb
      ->add_option("--penetration", eval_options->penetrations,
                   "One or more: 1e-6,1e-5 [m] or 1um,10um")
      ->delimiter(',')
      ->type_name("LENGTH,...");
  eval_verb->add_option("--format", eval_options->format, "csv or json")
      ->type_name("NAME")
      ->capture_default_str();
  eval_verb->callback(
      [eval_options, &action] { action = [eval_options] { return eval(*eval_options); }; });

  CLI::App* fit_verb = verb->add_subcommand("fit", "The power law K d^n nearest to an elastic law");
  auto fit_options = std::make_shared<FitOptions>();
  add_elastic_options(*fit_verb, fit_options->law);
  fit_verb->add_option("--max-load", fit_options->max_load, "Largest load [N]")->type_name("FORCE");
  fit_verb->add_option("--min-load", fit_options->min_load, "Smallest load [N]; default 0")
      ->type_name("FORCE");
  fit_verb->add_option("--samples", fit_options->samples, "Loads, uniform over the range")
      ->type_name("N")
      ->capture_default_str();
  fit_verb->add_option("--format", fit_options->format, "text, csv or json")
      ->type_name("NAME")
      ->capture_default_str();
  fit_verb->callback(
      [fit_options, &action] { action = [fit_options] { return fit(*fit_options); }; });
}

}  // namespace yoke::cases
