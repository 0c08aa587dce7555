// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// All dissipative laws by name, with formula, source, intended range of restitution and delivered
// restitution.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <yoke/contact/laws/forms/tensile_phase.hpp>
#include <yoke/contact/laws/law.hpp>

namespace yoke {

/// Arguments of dissipative laws; each law uses those its note lists and ignores the others.
struct DissipativeArguments {
  double restitution = 1.0;        // e, for laws that have it as a parameter
  std::optional<double> alpha{};   // [s/m] hunt-crossley with constant alpha, in place of e
  double slowest_approach = 1e-3;  // [m/s] floor on v_i, > 0
  double q = 3.0;                  // lee-wang-2: steepness of the transition, 2 to 4 as meant
  double epsilon = 0.1;            // lee-wang-2: its end, as a share of v_i sqrt(m_r/K)
  bool empirical = false;          // herbert-mcwhannell: e = 1 - 0.026 (v_i [mm/s])^(1/3)
  TensilePhase tensile = TensilePhase::keep;  // kelvin-voigt, lee-wang-2, tsuji, exact-restitution
};

/// Description of a law.
struct DissipativeNote {
  std::string name;                  // kebab-case, as make_dissipative() takes it
  std::string title;                 // authors and year
  std::string formula;               // in the letters of its source
  std::string source;                // where it was published
  std::string meant_for;             // range of e
  std::string delivers;              // restitution of a free central impact
  std::string separation;            // where the contact ends, with or without tension
  std::string persistent;            // behaviour in a contact that lasts
  std::vector<std::string> caveats;  // a sentence each
  std::vector<std::pair<std::string, std::string>> parameters;  // name; unit and range
  bool linear_only = false;                                     // needs F_e = K d
};

/// Every law, in the order of the literature.
const std::vector<DissipativeNote>& dissipative_catalog();

/// Throws ModelError that lists the names.
const DissipativeNote& find_dissipative(std::string_view name);

/// The law of that name. Throws ModelError for an unknown name or an argument out of range.
DissipativeLaw make_dissipative(std::string_view name, const DissipativeArguments& arguments);

/// Restitution delivered in a free central impact by the law's own closed form, with the elastic
/// law K d^n (most hold for any elastic law) and the approach velocity in m/s. Nothing if there is
/// none: lee-wang-2 always, kelvin-voigt unless n = 1.
std::optional<double> closed_form_restitution(std::string_view name,
                                              const DissipativeArguments& arguments, double n,
                                              double approach_velocity);

}  // namespace yoke
