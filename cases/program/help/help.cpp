// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/program/help/help.hpp>

#include <fmt/format.h>

#include <algorithm>

#include <yoke/cases/choices/quantity.hpp>

namespace yoke::cases {

namespace {

struct Examples {
  const char* verb;
  const char* lines;
};
constexpr Examples examples[] = {
    {"run",
     "  yoke run scotch_yoke\n"
     "  yoke run scotch_yoke --set crank_length=50mm --law johnson --law hertz+flores:e=0.8 -o results/mine\n"
     "  yoke run slider_crank --format hdf5 --columns 'crank.*' --every 4 -o results/short\n"},
    {"sweep",
     "  yoke sweep slider_crank_clearance --vary clearance=0.01mm:0.5mm:50:log --vary speed=1000:5000:5\n"
     "  yoke sweep scotch_yoke --vary law=johnson,hertz+flores:e=0.8 --measure slider_a_m_per_s2:rms\n"
     "  yoke sweep bouncing_ball --law 'hertz+flores:e={e}' --vary e=0.1:0.9 --sobol 64 -o results/e\n"},
    {"poincare",
     "  yoke poincare slider_crank_clearance --at phase:motor=0deg --x slider.x_m --y slider.vx_m_per_s\n"
     "  yoke poincare impact_oscillator --at every:frequency --points 2000\n"
     "  yoke poincare table_ball --at event:top.onset --y speed_m_per_s\n"},
    {"bifurcation",
     "  yoke bifurcation impact_oscillator --vary force=0.2:0.6:200 --both --at every:frequency --y mass.x_m\n"
     "  yoke bifurcation table_ball --vary amplitude=1.5mm:3.1mm:81 --at event:top.release --y ball.vy_m_per_s\n"},
    {"basins",
     "  yoke basins impact_oscillator --grid start=-400mm:100mm:60 --grid start_speed=-1:1:60 --at every:frequency\n"},
    {"orbit",
     "  yoke orbit impact_pair --set start=centre --settle 1s --period 50ms\n"
     "  yoke orbit slider_crank_clearance --set clearance=0.5mm --turns 1 --settle 0.12s\n"
     "  yoke orbit double_pendulum --autonomous --period 2s -o results/swing\n"},
    {"lyapunov",
     "  yoke lyapunov double_pendulum --until 60s --exponents 4\n"
     "  yoke lyapunov slider_crank_clearance --until 1s --transient 0.1s\n"},
    {"resume",
     "  yoke run scotch_yoke --checkpoint 0.01s -o results/long\n"
     "  yoke resume results/long\n"},
    {"view", "  yoke view geneva\n"},
    {"report", "  yoke report results/mine\n"},
    {"compare", "  yoke compare results/scotch_yoke results/mine -o results/both\n"},
    {"check", "  yoke check parallelogram\n"},
    {"kinematics", "  yoke kinematics quick_return --duration 1s --samples 361\n"},
    {"inverse-dynamics", "  yoke inverse-dynamics slider_crank --duration 0.5s\n"},
    {"equilibrium", "  yoke equilibrium hanging_chain\n"},
    {"modes", "  yoke modes hanging_chain\n"},
    {"law", "  yoke law list\n  yoke law show johnson\n"},
    {"impact", "  yoke impact --help\n"},
    {"list", "  yoke list\n"},
    {"fmu",
     "  yoke fmu slider_crank\n"
     "  yoke fmu slider_crank --set crank=100mm -o engine.fmu\n"},
    {"new", "  yoke new my_mechanism\n"},
    {"completion",
     "  mkdir -p ~/.local/share/bash-completion/completions ~/.local/share/zsh/site-functions\n"
     "  yoke completion bash > ~/.local/share/bash-completion/completions/yoke\n"
     "  yoke completion zsh > ~/.local/share/zsh/site-functions/_yoke\n"},
    {"man", "  yoke man > yoke.1 && man ./yoke.1\n"},
    {"study", "  yoke study scotch_yoke\n"},
    {"validate", "  yoke validate --help\n"},
    {"reproduce", "  yoke reproduce --help\n"},
};

constexpr const char* exit_codes =
    "Exit codes:\n"
    "  0    everything asked for was done\n"
    "  1    a run failed, or something asked for cannot be done\n"
    "  2    the command line was not understood\n"
    "  130  interrupted by Ctrl-C or SIGTERM; what was computed is there\n"
    "\n"
    "Environment:\n"
    "  NO_COLOR  set to anything: no colours\n";

std::vector<const CLI::App*> verbs_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

std::vector<std::string> names_of(const std::vector<const CLI::App*>& verbs) {
  std::vector<std::string> names;
  for (const CLI::App* verb : verbs) names.push_back(verb->get_name());
  return names;
}

}  // namespace

void add_help_texts(CLI::App& app) {
  app.footer(exit_codes);
  for (CLI::App* verb : app.get_subcommands([](CLI::App*) { return true; }))
    for (const Examples& e : examples)
      if (verb->get_name() == e.verb) verb->footer(std::string("Examples:\n") + e.lines);
}

std::string nearest_meant(const CLI::App& app, const std::vector<std::string>& arguments) {
  const std::vector<const CLI::App*> verbs = verbs_of(app);
  const auto question = [](const std::string& word, const std::vector<std::string>& known) {
    const std::string nearest = nearest_word(word, known);
    return nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest);
  };
  if (arguments.empty()) return {};
  const CLI::App* verb = &app;
  const auto named = std::ranges::find(verbs, arguments.front(), &CLI::App::get_name);
  if (named != verbs.end())
    verb = *named;
  else if (!arguments.front().starts_with('-'))
    return question(arguments.front(), names_of(verbs));
  std::vector<std::string> known;
  for (const CLI::Option* option : verb->get_options())
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  for (const std::string& argument : arguments) {
    const std::string option = argument.substr(0, argument.find('='));
    if (option.starts_with("--") && std::ranges::find(known, option) == known.end())
      return question(option, known);
  }
  return {};
}

}  // namespace yoke::cases
