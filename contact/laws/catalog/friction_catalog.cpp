// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/contact/laws/catalog/friction_catalog.hpp>

#include <fmt/format.h>

#include <algorithm>

#include <yoke/contact/laws/friction/ambrosio.hpp>
#include <yoke/contact/laws/friction/bengisu_akay.hpp>
#include <yoke/contact/laws/friction/brown_mcphee.hpp>
#include <yoke/contact/laws/friction/coulomb.hpp>
#include <yoke/contact/laws/friction/dahl.hpp>
#include <yoke/contact/laws/friction/lugre.hpp>
#include <yoke/contact/laws/friction/regularised_coulomb.hpp>
#include <yoke/contact/laws/friction/stribeck.hpp>
#include <yoke/contact/laws/friction/threlfall.hpp>

namespace yoke {

namespace {

using FrictionValues = std::vector<std::pair<std::string, double>>;

struct FrictionEntry {
  FrictionNote note;
  FrictionLaw (*make)(const FrictionValues&);
};

template <class Law>
FrictionLaw friction_from(const FrictionValues& values) {
  Law law;
  bool has_static = false;
  for (const auto& [name, value] : values)
    for (const FrictionField<Law>& field : Law::fields)
      if (name == field.name) {
        law.*field.value = value;
        has_static = has_static || name == "mu_static";
      }
  if constexpr (requires { law.mu_static; })
    if (!has_static) law.mu_static = law.mu;
  return law;
}

bool must_be_given(std::string_view parameter) { return parameter == "mu"; }

template <class Law>
FrictionEntry friction_entry(std::string title, std::string formula, std::string source,
                             std::string caveat) {
  const Law law;
  FrictionNote note{law.name(),        std::move(title),  std::move(formula),
                    std::move(source), std::move(caveat), {}};
  for (const FrictionField<Law>& field : Law::fields) {
    std::string usual = fmt::format("{:g}", law.*field.value);
    if (must_be_given(field.name)) usual.clear();
    if (std::string_view(field.name) == "mu_static") usual = "mu";
    note.parameters.push_back({field.name, field.unit, std::move(usual)});
  }
  return {std::move(note), friction_from<Law>};
}

constexpr const char* creeps = "what should stick creeps";

const std::vector<FrictionEntry>& friction_entries() {
  static const std::vector<FrictionEntry> table = {
      friction_entry<Coulomb>(
          "Coulomb 1785",
          "T = mu N against the sliding; at rest what is needed to stay there, up to mu_static N",
          "Coulomb, C.A. Theorie des machines simples, 1785",
          "at rest it is a constraint, not a force: nothing creeps"),
      friction_entry<RegularisedCoulomb>("Coulomb, rounded off", "T = mu N tanh(v/threshold)",
                                         "Andersson, S. et al. Tribol. Int. 2007, 40, 580-587",
                                         creeps),
      friction_entry<Threlfall>("Threlfall 1978",
                                "T = mu N (1 - exp(-3 |v|/threshold)) sgn v, constant above it",
                                "Threlfall, D.C. Mech. Mach. Theory 1978, 13, 475-483",
                                "what should stick creeps; the greatest friction is 0.95 mu N"),
      friction_entry<Ambrosio>("Ambrosio 2003",
                               "T = c mu N sgn v, c = (|v| - dead)/(threshold - dead) from 0 to 1",
                               "Ambrosio, J. Virtual Nonlinear Multibody Systems, 2003, 57-81",
                               "no force at all below `dead`: what should stick drifts"),
      friction_entry<Stribeck>(
          "Stribeck's curve",
          "T = N (mu + (mu_s - mu) exp(-(|v|/v_s)^exponent)) tanh(v/threshold) + viscous v",
          "Bo, L.C.; Pavelescu, D. Wear 1982, 82, 277-289", creeps),
      friction_entry<BengisuAkay>("Bengisu and Akay 1994",
                                  "T = mu_s N (1 - (|v|/v_0 - 1)^2) sgn v below the threshold v_0; "
                                  "N (mu + (mu_s - mu) exp(-decay (|v| - v_0))) sgn v above",
                                  "Bengisu, M.T.; Akay, A. J. Sound Vib. 1994, 171, 557-570",
                                  creeps),
      friction_entry<BrownMcPhee>(
          "Brown and McPhee 2016",
          "T = N (mu tanh 4x + (mu_s - mu) x/(x^2/4 + 3/4)^2) + viscous v, x = v/threshold",
          "Brown, P.; McPhee, J. J. Comput. Nonlinear Dyn. 2016, 11, 054502", creeps),
      friction_entry<Dahl>("Dahl 1968", "z' = v - k |v| z/(mu N), T = k z, k the stiffness",
                           "Dahl, P.R. Aerospace Corporation, TOR-0158(3107-18)-1, 1968",
                           "drifts a little under loads that change"),
      friction_entry<LuGre>(
          "LuGre: Canudas de Wit, Olsson, Astrom, Lischinsky 1995",
          "z' = v - k |v| z/(N g), T = k z + c z' + viscous v, "
          "g = mu + (mu_s - mu) exp(-(v/v_s)^2), k the stiffness, c the damping",
          "Canudas de Wit, C. et al. IEEE Trans. Autom. Control 1995, 40, 419-425",
          "the damping fades while it slides, so that no energy is made; drifts a little under loads "
          "that change"),
  };
  return table;
}

const FrictionEntry& find_friction_entry(std::string_view name) {
  for (const FrictionEntry& each : friction_entries())
    if (each.note.name == name) return each;
  std::string known;
  for (const FrictionEntry& each : friction_entries())
    known += (known.empty() ? "" : ", ") + each.note.name;
  throw ModelError(fmt::format("friction law '{}' is unknown; known are {}", name, known));
}

}  // namespace

const std::vector<FrictionNote>& friction_catalog() {
  static const std::vector<FrictionNote> notes = [] {
    std::vector<FrictionNote> all;
    for (const FrictionEntry& each : friction_entries()) all.push_back(each.note);
    return all;
  }();
  return notes;
}

const FrictionNote& find_friction(std::string_view name) { return find_friction_entry(name).note; }

FrictionLaw make_friction(std::string_view name, const FrictionValues& parameters) {
  const FrictionEntry& entry = find_friction_entry(name);
  const auto& known = entry.note.parameters;
  for (const auto& [given, value] : parameters)
    if (std::ranges::find(known, given, &FrictionParameter::name) == known.end()) {
      std::string names;
      for (const FrictionParameter& p : known) names += (names.empty() ? "" : ", ") + p.name;
      throw ModelError(
          fmt::format("friction '{}': unknown parameter '{}'; it takes {}", name, given, names));
    }
  for (const FrictionParameter& p : known)
    if (must_be_given(p.name) &&
        std::ranges::find(parameters, p.name, &std::pair<std::string, double>::first) ==
            parameters.end())
      throw ModelError(fmt::format("friction '{}': {} is missing", name, p.name));
  return entry.make(parameters);
}

}  // namespace yoke
