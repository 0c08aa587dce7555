// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/program/law_options.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <optional>

#include <yoke/cases/choices/material.hpp>
#include <yoke/cases/choices/quantity.hpp>
#include <yoke/core/error.hpp>

namespace yoke::cases {

namespace {

std::optional<double> length_of(std::string_view owner, const std::string& text) {
  if (text.empty()) return std::nullopt;
  const double value = parse_quantity(owner, Quantity::length, text);
  require_positive("command line", owner, value, "m");
  return value;
}

}  // namespace

void add_elastic_options(CLI::App& verb, ElasticOptions& o) {
  verb.add_option("--elastic", o.elastic,
                  "Elastic law: a name of 'yoke law list', or power:K=1e8,n=1.5 (N/m^n)")
      ->type_name("NAME");
  verb.add_option("--reading", o.reading, "consistent, printed or tabulated")
      ->type_name("NAME")
      ->capture_default_str();
  verb.add_option("--material", o.material, "steel, aluminium or E=207GPa,nu=0.3; default steel")
      ->type_name("NAME");
  verb.add_option("--pin-material", o.pin_material, "Of the pin, if another")->type_name("NAME");
  verb.add_option("--wall-material", o.wall_material, "Of the wall, if another")->type_name("NAME");
  verb.add_option("--pin-radius", o.pin_radius, "For instance 7.9mm")->type_name("LENGTH");
  verb.add_option("--wall-radius", o.wall_radius, "For instance 8mm")->type_name("LENGTH");
  verb.add_option("--clearance", o.clearance,
                  "Wall radius less pin radius, in place of one of them; internal only")
      ->type_name("LENGTH");
  verb.add_option("--length", o.length, "Of the line of contact")->type_name("LENGTH");
  CLI::Option* internal = verb.add_flag("--internal", o.internal, "Pin in a bore (default)");
  verb.add_flag("--external", o.external, "Pin on a convex wall")->excludes(internal);
}

ElasticArguments elastic_arguments(const ElasticOptions& o) {
  ElasticArguments a;
  a.reading = reading_named(o.reading);
  if (!o.material.empty()) a.pin = a.wall = parse_material(o.material);
  if (!o.pin_material.empty()) a.pin = parse_material(o.pin_material);
  if (!o.wall_material.empty()) a.wall = parse_material(o.wall_material);
  a.conformity = o.external ? Conformity::external : Conformity::internal;
  const auto pin = length_of("--pin-radius", o.pin_radius);
  const auto wall = length_of("--wall-radius", o.wall_radius);
  const auto clearance = length_of("--clearance", o.clearance);
  a.pin_radius = pin.value_or(0.0);
  a.wall_radius = wall.value_or(0.0);
  a.length = length_of("--length", o.length).value_or(0.0);
  if (clearance) {
    if (o.external) throw ModelError("--clearance: only an internal contact has one");
    if (pin && wall)
      throw ModelError("--clearance: follows from --pin-radius and --wall-radius; give two");
    if (!pin && !wall) throw ModelError("--clearance: give --pin-radius or --wall-radius too");
    if (pin) a.wall_radius = *pin + *clearance;
    if (wall) a.pin_radius = *wall - *clearance;
    if (!(a.pin_radius > 0.0))
      throw ModelError(fmt::format("--clearance {}: leaves no pin in a wall of radius {}",
                                   o.clearance, o.wall_radius));
  }
  return a;
}

ElasticLaw elastic_law(const ElasticOptions& o) {
  if (o.elastic.empty())
    throw ModelError("--elastic is missing: a name of 'yoke law list', or power:K=1e8,n=1.5");
  const std::string_view name = std::string_view(o.elastic).substr(0, o.elastic.find(':'));
  const ElasticNote& note = find_elastic(name);
  const ElasticArguments arguments = elastic_arguments(o);
  const struct {
    const char *parameter, *option;
    double value;
  } lengths[] = {{"pin_radius", "--pin-radius", arguments.pin_radius},
                 {"wall_radius", "--wall-radius", arguments.wall_radius},
                 {"length", "--length", arguments.length}};
  for (const auto& [parameter, option, value] : lengths)
    if (value == 0.0 && std::ranges::count(note.parameters, parameter, &LawParameter::name) > 0)
      throw ModelError(fmt::format("{} is missing: law '{}' is made from it; for instance {} 8mm",
                                   option, name, option));
  const std::string warning = elastic_warning(name, arguments.reading);
  if (!warning.empty())
    std::fprintf(stderr, "yoke: warning: %s (%s): %s\n", std::string(name).c_str(),
                 o.reading.c_str(), warning.c_str());
  return make_elastic(o.elastic, arguments);
}

void check_format(const std::string& format, const std::vector<std::string>& known) {
  if (std::ranges::find(known, format) == known.end())
    throw ModelError(fmt::format("--format '{}'{}", format, suggestion(format, known)));
}

}  // namespace yoke::cases
