// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include <yoke/cases/case.hpp>
#include <yoke/core/error.hpp>

namespace yoke::cases {

// One function per case, defined in the file of the mechanism.
Case scotch_yoke_case();
Case n_four_bar_case();
Case parallelogram_case();
Case slider_crank_case();
Case quick_return_case();
Case jansen_leg_case();
Case scott_russell_platform_case();
Case bouncing_ball_case();
Case newtons_cradle_case();
Case impact_pair_case();
Case pendulum_stop_case();
Case slender_bar_case();
Case slider_crank_clearance_case();
Case slider_guide_clearance_case();
Case four_bar_clearance_case();
Case ratchet_case();
Case impact_oscillator_case();
Case table_ball_case();
Case cpva_case();
Case geneva_case();
Case gear_selector_case();
Case cam_follower_case();
Case block_on_incline_case();
Case belt_oscillator_case();
Case rolling_disc_case();
Case slot_roller_case();
Case leaning_rod_case();
Case painleve_rod_case();
Case hanging_chain_case();
Case point_pendulum_case();
Case double_pendulum_case();
Case andrews_case();
Case car_axis_case();
Case truss_case();

const std::vector<Case>& case_registry() {
  static const std::vector<Case> cases = {
      // joints with clearance
      scotch_yoke_case(),
      slider_crank_clearance_case(),
      slider_guide_clearance_case(),
      four_bar_clearance_case(),
      // linkages
      slider_crank_case(),
      quick_return_case(),
      jansen_leg_case(),
      parallelogram_case(),
      scott_russell_platform_case(),
      truss_case(),
      // impacts
      bouncing_ball_case(),
      newtons_cradle_case(),
      impact_pair_case(),
      pendulum_stop_case(),
      slender_bar_case(),
      ratchet_case(),
      impact_oscillator_case(),
      table_ball_case(),
      // slots and cams
      cpva_case(),
      geneva_case(),
      gear_selector_case(),
      cam_follower_case(),
      // friction
      block_on_incline_case(),
      belt_oscillator_case(),
      rolling_disc_case(),
      slot_roller_case(),
      leaning_rod_case(),
      painleve_rod_case(),
      // pendulums and chains
      hanging_chain_case(),
      double_pendulum_case(),
      // benchmarks
      point_pendulum_case(),
      n_four_bar_case(),
      andrews_case(),
      car_axis_case(),
  };
  return cases;
}

std::vector<CaseGroup> case_groups() {
  std::vector<CaseGroup> groups;
  for (const Case& c : case_registry()) {
    auto group = std::ranges::find(groups, c.group, &CaseGroup::name);
    if (group == groups.end()) group = groups.insert(groups.end(), {c.group, {}});
    group->cases.push_back(&c);
  }
  return groups;
}

const Case& find_case(std::string_view name) {
  std::vector<std::string> known;
  for (const Case& c : case_registry()) {
    if (c.name == name) return c;
    known.push_back(c.name);
  }
  if (name.empty())
    throw ModelError(fmt::format("which case? There are '{}'", fmt::join(known, "', '")));
  throw ModelError(fmt::format("unknown case '{}'{}", name, suggestion(name, known)));
}

std::vector<std::string> choose_laws(const Case& c, const Parameters& parameters,
                                     const std::vector<std::string>& laws) {
  if (c.contact.laws.empty() && !laws.empty())
    throw ModelError(fmt::format("--law {}: case '{}' has no contact laws to choose from",
                                 laws.front(), c.name));
  if (c.contact.walls && c.contact.walls(parameters).empty()) {
    if (!laws.empty())
      throw ModelError(fmt::format("--law {}: with these parameters case '{}' has no contacts",
                                   laws.front(), c.name));
    return {};
  }
  return choose_laws(c.contact, laws);
}

std::vector<std::string> choose_laws(const Case& c, const Parameters& parameters,
                                     const std::vector<std::string>& laws,
                                     const std::string& friction) {
  std::vector<std::string> chosen = choose_laws(c, parameters, laws);
  if (friction.empty()) return chosen;
  if (!c.contact.walls || c.contact.walls(parameters).empty())
    throw ModelError(fmt::format("--friction {}: with these parameters case '{}' has no contacts",
                                 friction, c.name));
  if (chosen.empty()) chosen.emplace_back();
  for (std::string& law : chosen) law = with_friction(c.contact, parameters, law, friction);
  return chosen;
}

Model make_model(const Case& c, const Parameters& parameters, std::string_view law) {
  return c.model(parameters, make_laws(c.contact, parameters, law));
}

std::vector<Check> run_checks(const Case& c, const Parameters& parameters, std::string_view law,
                              const Model& model, const Result& run) {
  if (!run.summary.ok() || run.samples.rows() < 2) return {};
  const WallLaws laws = make_laws(c.contact, parameters, law);
  if (laws.have_friction() && !c.checks_hold_with_friction) return {energy_check(run)};
  std::vector<Check> checks;
  if (c.checks) checks = c.checks(parameters, model, run);
  if (!c.law_checks) return checks;
  for (Check& check : c.law_checks(parameters, laws, run)) checks.push_back(std::move(check));
  return checks;
}

Case case_without_choices(std::string group, std::string name, std::string description,
                          Model (*model)(), std::string duration) {
  const std::string folder = "results/" + name;
  return {.name = std::move(name),
          .group = std::move(group),
          .description = std::move(description),
          .parameters = {{.name = "duration",
                          .quantity = Quantity::number,
                          .default_text = std::move(duration),
                          .low = 1e-3,
                          .high = 10000.0,
                          .description = "of the run, in seconds"}},
          .default_output = folder,
          .model = [model](const Parameters&, const WallLaws&) { return model(); },
          .duration = [](const Parameters& p) { return p.number("duration"); },
          .checks = [](const Parameters&, const Model&,
                       const Result& run) { return std::vector{energy_check(run)}; }};
}

}  // namespace yoke::cases
