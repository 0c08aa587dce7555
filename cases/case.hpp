// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A case: a mechanism with named parameters and, where it has contacts, a choice of contact laws.
// The jobs (cases/jobs/) run any case; a case only says what it is. A new case is one file with a
// function that returns its Case, and two lines in registry.cpp.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <yoke/cases/checks/check.hpp>
#include <yoke/cases/choices/contact_choice.hpp>
#include <yoke/cases/choices/parameters.hpp>
#include <yoke/core/model.hpp>
#include <yoke/core/result.hpp>

namespace yoke::cases {

/// A column of motion.csv, made from a column of the engine's samples: value + shift.
struct MotionColumn {
  std::string name;    // "slider_x"; the column is called slider_x_m
  std::string unit;    // "m/s^2", or "" for none
  std::string source;  // "slider.x_m"
  double shift = 0.0;  // in the unit of the column
};

/// A picture of one quantity over another that a case computes from a run: an orbit, a section.
struct PortraitLine {
  std::string name;
  std::vector<Vec2> points;  // in the units of the labels
  bool dots = false;         // points alone, without lines between them
};
struct Portrait {
  std::string name;   // of the file: "orbit"
  std::string title;  // "path of the journal in its bearing"
  std::string x_label, y_label;
  std::vector<PortraitLine> lines;
  bool equal_scales = false;  // both axes show the same lengths alike
};

/// A stretch of a run that its report offers by name.
struct ReportView {
  std::string title;                   // "contact force over the last revolution"
  double from = 0.0, to = 0.0;         // [s]
  std::vector<std::string> columns{};  // of the engine, without units: "slot.normal_force"
  bool over_penetration = false;       // the force over the penetration instead of over time
};

struct Case {
  std::string name;
  std::string group{};      // "linkages": `yoke list` prints cases by group
  std::string description;  // one line
  std::vector<CaseParameter> parameters{};
  ContactChoice contact{};  // empty: no contact, or laws that cannot be chosen
  std::filesystem::path default_output{};

  /// The mechanism. `laws` holds one law for each wall of `contact`. Throws ModelError.
  std::function<Model(const Parameters&, const WallLaws& laws)> model{};
  /// [s] How long a run lasts. Throws ModelError for parameters that contradict each other.
  std::function<double(const Parameters&)> duration{};

  /// Optional: the columns of motion.csv under the case's own names, in place of all columns of the
  /// engine.
  std::function<std::vector<MotionColumn>(const Parameters&, const Model&)> columns{};
  /// Optional: numbers of a run beside what they should be. Called for runs that completed, with at
  /// least two rows of samples.
  std::function<std::vector<Check>(const Parameters&, const Model&, const Result&)> checks{};
  /// Whether `checks` and `law_checks` hold with friction too. If not, a run with friction is checked for
  /// its energy alone.
  bool checks_hold_with_friction = false;
  /// Optional: those of them that depend on the laws of the walls. Called under the same conditions.
  std::function<std::vector<Check>(const Parameters&, const WallLaws& laws, const Result&)>
      law_checks{};
  /// Optional: pictures of its own, under the same conditions.
  std::function<std::vector<Portrait>(const Parameters&, const Model&, const Result&)> portraits{};
  /// Optional: what its report offers to look at.
  std::function<std::vector<ReportView>(const Parameters&)> views{};
  /// Optional: bodies whose path is drawn, y over x.
  std::vector<std::string> paths{};
};

/// All cases. Adding one is two lines in registry.cpp.
const std::vector<Case>& case_registry();

/// Throws ModelError that lists the cases.
const Case& find_case(std::string_view name);

/// The laws of a case to run: `laws` in the order of the case, those of the catalogue after them,
/// none twice; all named laws of the case if `laws` is empty. None if the case has no walls with
/// these parameters. Throws ModelError for a law that neither the case nor the catalogue knows, and
/// for one that is not needed.
std::vector<std::string> choose_laws(const Case& c, const Parameters& parameters,
                                     const std::vector<std::string>& laws);

/// The same laws, each with friction (contact_choice.hpp) if that is not "". Throws ModelError, also if
/// there is no contact for it.
std::vector<std::string> choose_laws(const Case& c, const Parameters& parameters,
                                     const std::vector<std::string>& laws,
                                     const std::string& friction);

/// The mechanism under one law: a name or specification (see contact_choice.hpp), "" for the base
/// law of the case. Throws ModelError.
Model make_model(const Case& c, const Parameters& parameters, std::string_view law = "");

/// All checks of a run of that mechanism, none if it did not complete or recorded less than two
/// rows. Throws ModelError as make_model.
std::vector<Check> run_checks(const Case& c, const Parameters& parameters, std::string_view law,
                              const Model& model, const Result& run);

/// The cases by group, groups and cases in the order of the registry.
struct CaseGroup {
  std::string name;
  std::vector<const Case*> cases;
};
std::vector<CaseGroup> case_groups();

/// A case whose only parameter is the duration of the run, in seconds; its check is the energy.
Case case_without_choices(std::string group, std::string name, std::string description,
                          Model (*model)(), std::string duration);

}  // namespace yoke::cases
