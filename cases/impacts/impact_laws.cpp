// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/impacts/impact_laws.hpp>

#include <utility>

#include <yoke/contact/laws/catalog/calibrated.hpp>
#include <yoke/contact/laws/dissipative/exact_restitution.hpp>
#include <yoke/contact/laws/elastic/power_law.hpp>
#include <yoke/core/units.hpp>

namespace yoke::cases {

using namespace yoke::literals;

std::vector<CaseParameter> impact_parameters(const char* stiffness, const char* restitution) {
  return {{.name = "stiffness",
           .quantity = Quantity::number,
           .default_text = stiffness,
           .low = 1e3,
           .high = 1e14,
           .description = "K of F = K d^n, in N/m^n"},
          {.name = "exponent",
           .quantity = Quantity::number,
           .default_text = "1.5",
           .low = 1.0,
           .high = 5.0,
           .description = "n of F = K d^n"},
          {.name = "restitution",
           .quantity = Quantity::number,
           .default_text = restitution,
           .low = 0.05,
           .high = 1.0,
           .description = "that a free impact delivers"}};
}

namespace {

PowerLaw power_law_of(const Parameters& p) { return {p.number("stiffness"), p.number("exponent")}; }

}  // namespace

// Flores' law is of Hunt and Crossley's form, with a factor that reaches every restitution; theirs
// delivers no less than 0.488.
ContactChoice impact_laws(std::function<std::vector<Wall>(const Parameters&)> walls) {
  return {
      .walls = std::move(walls),
      .laws = {{"restitution", "K d^n and the damper that delivers exactly the restitution",
                [](const Parameters& p, const Wall&) {
                  const double e = p.number("restitution");
                  return e == 1.0 ? ContactLaw{power_law_of(p)}
                                  : ContactLaw{power_law_of(p), ExactRestitution{e}};
                }},
               {"hunt-crossley", "K d^n (1 + X d'), X set so that the restitution is delivered",
                [](const Parameters& p, const Wall&) {
                  return ContactLaw{power_law_of(p), calibrated("flores", p.number("restitution"))};
                }},
               {"elastic", "K d^n without loss, whatever the restitution",
                [](const Parameters& p, const Wall&) { return ContactLaw{power_law_of(p)}; }}},
      .base = "restitution"};
}

Wall flat_wall(const std::string& name, double disc_radius) {
  return {
      .name = name, .pair = {.pin_radius = disc_radius, .wall_radius = 1000.0}, .length = 10.0_mm};
}

std::vector<Impact> impacts_of(const Result& run, std::string_view contact) {
  std::vector<Impact> impacts;
  const EventRecord* onset = nullptr;
  for (const EventRecord& e : run.events) {
    if (e.element != contact) continue;
    if (e.kind == "onset") onset = &e;
    if (e.kind != "release" || onset == nullptr) continue;
    impacts.push_back({.start = onset->t,
                       .end = e.t,
                       .approach = onset->speed,
                       .rebound = -e.speed,
                       .left_at = e.penetration});
    onset = nullptr;
  }
  return impacts;
}

CaseParameter mass_parameter(const char* name, const char* kilograms, const char* description) {
  return {.name = name,
          .quantity = Quantity::number,
          .default_text = kilograms,
          .low = 1e-6,
          .high = 1e6,
          .description = description};
}

}  // namespace yoke::cases
