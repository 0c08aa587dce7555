// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// yoke check CASE: what a mechanism is before it moves: degrees of freedom, redundant equations,
// conditioning, and how far the start pose was from an assembled one.
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include <yoke/cases/program/request.hpp>
#include <yoke/cases/program/verb.hpp>
#include <yoke/core/equations/dynamics.hpp>
#include <yoke/integrators/run/constraint_summary.hpp>

namespace yoke::cases {

namespace {

/// Largest residual of one joint, rows in m and in rad apart.
struct JointResidual {
  std::string joint;
  double length = 0.0, angle = 0.0;            // [m], [rad]
  double length_rate = 0.0, angle_rate = 0.0;  // [m/s], [rad/s]
};

std::vector<JointResidual> residuals(Dynamics& dynamics, const State& state) {
  System& system = dynamics.system();
  const auto rows = static_cast<std::size_t>(system.rows());
  std::vector<double> phi(rows), rate(rows);
  system.bind(state);
  system.set_motion(state.t, state.q.data(), state.v.data());
  system.calc_position_level(phi.data());
  system.calc_velocity_residual(rate.data());
  std::vector<JointResidual> list;
  for (const ConstraintSlot& c : system.joints()) {
    JointResidual r{.joint = c.element->name()};
    for (int row = c.row; row < c.row + c.rows; ++row) {
      const bool length = system.measure(row) == Measure::length;
      const auto raise = [&](double& to, double value) { to = std::max(to, std::abs(value)); };
      raise(length ? r.length : r.angle, phi[static_cast<std::size_t>(row)]);
      raise(length ? r.length_rate : r.angle_rate, rate[static_cast<std::size_t>(row)]);
    }
    list.push_back(r);
  }
  return list;
}

struct Findings {
  int bodies = 0, equations = 0, degrees_of_freedom = 0, events = 0, states = 0;
  bool singular = false;
  double independence = 0.0;
  std::vector<std::string> redundant{}, not_unique{};
  std::vector<JointResidual> before{}, after{};
  std::string refusal{};
};

Findings look_at(const Model& model) {
  Dynamics dynamics(model);
  const System& system = dynamics.system();
  State state = model.start_state();
  Findings f{.bodies = model.body_count(),
             .equations = system.rows(),
             .events = system.events(),
             .states = system.states()};
  f.before = residuals(dynamics, state);
  const Outcome outcome = dynamics.assemble(state);
  const Redundancy& redundancy = dynamics.redundancy();
  f.degrees_of_freedom = degrees_of_freedom(dynamics);
  f.singular = redundancy.singular_here;
  for (const int row : redundancy.redundant) f.redundant.push_back(system.equation_name(row));
  f.not_unique = column_names(system, redundancy.doubts);
  f.refusal = outcome.why;
  f.after = residuals(dynamics, state);
  if (outcome) f.independence = dynamics.independence(state.t, state.q.data(), 50);
  return f;
}

nlohmann::ordered_json to_json(const std::vector<JointResidual>& list) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const JointResidual& r : list)
    json[r.joint] = {{"position_m", r.length},
                     {"position_rad", r.angle},
                     {"velocity_m_per_s", r.length_rate},
                     {"velocity_rad_per_s", r.angle_rate}};
  return json;
}

void print_json(const Findings& f) {
  const nlohmann::ordered_json json = {{"bodies", f.bodies},
                                       {"equations", f.equations},
                                       {"degrees_of_freedom", f.degrees_of_freedom},
                                       {"redundant_equations", f.redundant},
                                       {"not_unique_reactions", f.not_unique},
                                       {"singular_start", f.singular},
                                       {"independence", f.independence},
                                       {"event_functions", f.events},
                                       {"element_states", f.states},
                                       {"residuals_before_assembly", to_json(f.before)},
                                       {"residuals_after_assembly", to_json(f.after)},
                                       {"refused", f.refusal}};
  fmt::print("{}\n", json.dump(2));
}

void print_text(const Findings& f) {
  const auto list = [](const std::vector<std::string>& names) {
    return names.empty() ? std::string("none") : fmt::format("{}", fmt::join(names, ", "));
  };
  fmt::print("bodies                 {}\n", f.bodies);
  fmt::print("equations              {}\n", f.equations);
  fmt::print("degrees of freedom     {}\n", f.degrees_of_freedom);
  fmt::print("redundant equations    {}\n", list(f.redundant));
  fmt::print("reactions not unique   {}\n", list(f.not_unique));
  fmt::print("conditioning           {:.2g}  smallest eigenvalue of the scaled G M^-1 G^T{}\n",
             f.independence, f.singular ? "; the start is a singular position" : "");
  fmt::print("event functions        {}\n", f.events);
  fmt::print("element states         {}\n", f.states);
  fmt::print("\nlargest residual of each joint, before and after assembly\n");
  fmt::print("{:<20} {:>20} {:>20} {:>20} {:>20}\n", "joint", "m", "rad", "m/s", "rad/s");
  for (std::size_t i = 0; i < f.before.size(); ++i) {
    const JointResidual &b = f.before[i], &a = f.after[i];
    const auto pair = [](double before, double after) {
      return fmt::format("{:.1e} {:.1e}", before, after);
    };
    fmt::print("{:<20} {:>20} {:>20} {:>20} {:>20}\n", b.joint, pair(b.length, a.length),
               pair(b.angle, a.angle), pair(b.length_rate, a.length_rate),
               pair(b.angle_rate, a.angle_rate));
  }
}

}  // namespace

void add_check_verb(CLI::App& app, Action& action) {
  CLI::App* verb = app.add_subcommand(
      "check", "Degrees of freedom, redundant equations, conditioning and residuals of a case");
  auto options = std::make_shared<RequestOptions>();
  auto format = std::make_shared<std::string>("text");
  add_case_options(*verb, *options);
  verb->add_option("--law", options->laws, "Contact law of the model")->type_name("NAME");
  verb->add_option("--format", *format, "text or json")
      ->check(CLI::IsMember({"text", "json"}))
      ->capture_default_str();
  verb->callback([verb, options, format, &action] {
    action = [verb, options, format]() -> int {
      if (options->help) return print_help(*verb, *options);
      const Case& c = find_case(options->case_name);
      const RunRequest request = make_request(c, *options);
      const Findings f = look_at(
          make_model(c, request.parameters, options->laws.empty() ? "" : request.laws.front()));
      if (*format == "json")
        print_json(f);
      else
        print_text(f);
      if (f.refusal.empty()) return exit_ok;
      fmt::print(stderr, "yoke: {}\n", f.refusal);
      return exit_failed;
    };
  });
}

}  // namespace yoke::cases
