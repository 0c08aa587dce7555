// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// yoke impact: one central impact through the engine, and what the law's own closed form says.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include <yoke/cases/choices/quantity.hpp>
#include <yoke/cases/jobs/impact.hpp>
#include <yoke/cases/jobs/plot.hpp>
#include <yoke/cases/program/law_options.hpp>
#include <yoke/cases/program/verb.hpp>
#include <yoke/contact/laws/catalog/dissipative_catalog.hpp>
#include <yoke/core/error.hpp>
#include <yoke/core/result.hpp>

namespace yoke::cases {

namespace {

constexpr int loop_samples = 2001;

struct ImpactOptions {
  ElasticOptions elastic;
  std::string dissipation = "none";
  std::string restitution, alpha, slowest_approach, tensile = "keep";
  double q = 3.0, epsilon = 0.1;
  bool empirical = false;
  std::string speed, mass, setup = "bodies";
  double relative_tolerance = 1e-12;
  std::string formulation = "arkode-projection";
  std::string format = "text", output = "results/impact";
  bool plot = false;
};

DissipativeArguments dissipative_arguments(const ImpactOptions& o) {
  DissipativeArguments a;
  if (!o.restitution.empty()) {
    a.restitution = parse_in("--restitution", o.restitution, "");
    require_range("command line", "--restitution", a.restitution, 0.0, 1.0);
  }
  if (!o.alpha.empty()) a.alpha = parse_in("--alpha", o.alpha, "s/m");
  if (!o.slowest_approach.empty())
    a.slowest_approach = parse_in("--slowest-approach", o.slowest_approach, "m/s");
  a.q = o.q;
  a.epsilon = o.epsilon;
  a.empirical = o.empirical;
  if (o.tensile != "keep" && o.tensile != "clamp")
    throw ModelError(
        fmt::format("--tensile '{}'{}", o.tensile, suggestion(o.tensile, {"keep", "clamp"})));
  a.tensile = o.tensile == "keep" ? TensilePhase::keep : TensilePhase::clamp;
  return a;
}

/// What the impact was asked to return, if the arguments say so.
std::optional<double> restitution_asked(const ImpactOptions& o, const DissipativeArguments& a,
                                        double speed) {
  if (o.dissipation == "none") return 1.0;
  if (a.alpha) return 1.0 - *a.alpha * speed;
  if (!o.restitution.empty()) return a.restitution;
  if (a.empirical) return std::nullopt;
  throw ModelError(
      fmt::format("--restitution is missing: law '{}' is made from it; 0 to 1", o.dissipation));
}

struct Report {
  std::optional<double> asked, closed_form;
  ImpactOutcome outcome;
};

nlohmann::ordered_json optional(const std::optional<double>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

std::string cell(const std::optional<double>& value) { return value ? exactly(*value) : ""; }

void print_json(const ImpactOptions& o, const CentralImpact& impact, const Report& r) {
  const nlohmann::ordered_json json = {{"elastic", o.elastic.elastic},
                                       {"dissipation", o.dissipation},
                                       {"setup", o.setup},
                                       {"formulation", impact.formulation},
                                       {"rtol", impact.relative_tolerance},
                                       {"speed_m_per_s", impact.speed},
                                       {"mass_kg", impact.mass},
                                       {"restitution",
                                        {{"asked", optional(r.asked)},
                                         {"closed_form", optional(r.closed_form)},
                                         {"engine", r.outcome.restitution}}},
                                       {"max_penetration_m", r.outcome.max_penetration},
                                       {"max_force_N", r.outcome.max_force},
                                       {"duration_s", r.outcome.duration},
                                       {"dissipated_J", r.outcome.dissipated},
                                       {"kinetic_loss_J", r.outcome.kinetic_loss},
                                       {"permanent_set_m", r.outcome.permanent_set},
                                       {"steps", r.outcome.steps}};
  fmt::print("{}\n", json.dump(2));
}

void print_csv(const Report& r) {
  fmt::print(
      "restitution_asked,restitution_closed_form,restitution_engine,max_penetration_m,max_force_N,"
      "duration_s,dissipated_J,kinetic_loss_J,permanent_set_m\n");
  const ImpactOutcome& x = r.outcome;
  fmt::print("{},{},{},{},{},{},{},{},{}\n", cell(r.asked), cell(r.closed_form),
             exactly(x.restitution), exactly(x.max_penetration), exactly(x.max_force),
             exactly(x.duration), exactly(x.dissipated), exactly(x.kinetic_loss),
             exactly(x.permanent_set));
}

void print_text(const ImpactOptions& o, const CentralImpact& impact, const Report& r) {
  const auto value = [](const std::optional<double>& x) {
    return x ? fmt::format("{:.12g}", *x) : std::string("-");
  };
  const ImpactOutcome& x = r.outcome;
  fmt::print("{} with {}, {:g} kg at {:g} m/s ({}, rtol {:g})\n", o.elastic.elastic, o.dissipation,
             impact.mass, impact.speed, impact.formulation, impact.relative_tolerance);
  fmt::print("  restitution asked        {}\n", value(r.asked));
  fmt::print("  restitution closed form  {}\n", value(r.closed_form));
  fmt::print("  restitution engine       {:.12g}\n", x.restitution);
  fmt::print("  largest penetration      {:.12g} m\n", x.max_penetration);
  fmt::print("  largest force            {:.12g} N\n", x.max_force);
  fmt::print("  duration                 {:.12g} s\n", x.duration);
  fmt::print("  dissipated               {:.12g} J\n", x.dissipated);
  if (x.permanent_set > 0.0) fmt::print("  permanent set            {:.12g} m\n", x.permanent_set);
}

void plot_loop(const ImpactOptions& o, const std::vector<LoopPoint>& loop) {
  const std::filesystem::path folder = o.output;
  make_output_folder(folder);
  write_text(folder / "loop.csv", loop_csv(loop));
  const Figure figure{
      .name = "loop",
      .title = fmt::format("{} with {}: force over penetration", o.elastic.elastic, o.dissipation),
      .width = 900,
      .height = 650,
      .body =
          "set key off\nset grid\nset xlabel \"penetration [um]\"\nset ylabel \"force [N]\"\nplot "
          "\"loop.csv\" every ::1 using ($2*1e6):4 with lines linewidth 2\n"};
  std::fprintf(stderr, "yoke: %s\n", draw_figures({figure}, folder, 1).c_str());
}

int impact_verb(const ImpactOptions& o) {
  check_format(o.format, {"text", "csv", "json"});
  const CentralImpact::Setup setup = setup_named(o.setup);
  if (o.speed.empty()) throw ModelError("--speed is missing: of approach, for instance 0.37 [m/s]");
  if (o.mass.empty()) throw ModelError("--mass is missing: effective mass, for instance 1.3 [kg]");
  const double speed = parse_in("--speed", o.speed, "m/s");
  const double mass = parse_in("--mass", o.mass, "kg");
  const DissipativeArguments arguments = dissipative_arguments(o);
  find_dissipative(o.dissipation);
  Report report;
  report.asked = restitution_asked(o, arguments, speed);
  const ElasticLaw elastic = elastic_law(o.elastic);
  const DissipativeLaw dissipation = make_dissipative(o.dissipation, arguments);
  const CentralImpact impact{.law = {elastic, dissipation},
                             .speed = speed,
                             .mass = mass,
                             .setup = setup,
                             .relative_tolerance = o.relative_tolerance,
                             .formulation = o.formulation,
                             .samples = o.plot ? loop_samples : 0};
  report.outcome = simulate_impact(impact);
  report.closed_form = closed_form_restitution(
      o.dissipation, arguments,
      power_of(elastic).value_or(std::numeric_limits<double>::quiet_NaN()), speed);
  if (o.format == "json")
    print_json(o, impact, report);
  else if (o.format == "csv")
    print_csv(report);
  else
    print_text(o, impact, report);
  if (o.plot) plot_loop(o, report.outcome.loop);
  return exit_ok;
}

}  // namespace

void add_impact_verb(CLI::App& app, Action& action) {
  CLI::App* verb = app.add_subcommand(
      "impact", "Simulate one central impact and compare it with the closed form of the law");
  auto o = std::make_shared<ImpactOptions>();
  add_elastic_options(*verb, o->elastic);
  verb->add_option("--dissipation", o->dissipation, "Dissipative law: a name of 'yoke law list'")
      ->type_name("NAME")
      ->capture_default_str();
  verb->add_option("--restitution", o->restitution, "Asked for, 0 to 1")->type_name("E");
  verb->add_option("--alpha", o->alpha, "[s/m] hunt-crossley, in place of a restitution")
      ->type_name("X");
  verb->add_option("--slowest-approach", o->slowest_approach,
                   "[m/s] floor on the approach velocity; default 1e-3")
      ->type_name("X");
  verb->add_option("--tensile", o->tensile, "keep or clamp, for laws that pull at the end")
      ->type_name("NAME")
      ->capture_default_str();
  verb->add_option("--q", o->q, "lee-wang-2: steepness")->type_name("X")->capture_default_str();
  verb->add_option("--epsilon", o->epsilon, "lee-wang-2: end of the transition")
      ->type_name("X")
      ->capture_default_str();
  verb->add_flag("--empirical", o->empirical, "herbert-mcwhannell: restitution from the speed");
  verb->add_option("--speed", o->speed, "[m/s] of approach")->type_name("X");
  verb->add_option("--mass", o->mass, "[kg] effective mass")->type_name("X");
  verb->add_option("--setup", o->setup,
                   "bodies (two, free), wall (fixed), slot (a pin in one) or pendulum")
      ->type_name("NAME")
      ->capture_default_str();
  verb->add_option("--rtol", o->relative_tolerance, "Relative tolerance, 1e-13 to 1e-2")
      ->type_name("X")
      ->capture_default_str();
  verb->add_option("--formulation", o->formulation, "How to integrate; see 'yoke list'")
      ->type_name("NAME")
      ->capture_default_str();
  verb->add_option("--format", o->format, "text, csv or json")
      ->type_name("NAME")
      ->capture_default_str();
  verb->add_flag("--plot", o->plot, "Draw force over penetration into the folder of -o");
  verb->add_option("-o,--output", o->output, "Folder for the plot")
      ->type_name("DIR")
      ->capture_default_str();
  verb->callback([o, &action] { action = [o] { return impact_verb(*o); }; });
}

}  // namespace yoke::cases
