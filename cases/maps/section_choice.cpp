// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/maps/section_choice.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include <yoke/core/error.hpp>

namespace yoke::cases {

namespace {

constexpr const char* accepted =
    "accepted are every:TIME, every:PARAMETER, phase:DRIVER=ANGLE, event:ELEMENT.KIND, "
    "plane:COLUMN=VALUE, the last with :rising, :falling or :both behind it, phase too";

[[noreturn]] void refuse(std::string_view text, std::string_view why) {
  throw ModelError(fmt::format("--at {}: {}; {}", text, why, accepted));
}

std::string owner_of(std::string_view text) { return fmt::format("--at {}", text); }

/// "A=B" in two.
std::pair<std::string, std::string> around(std::string_view text, std::string_view piece,
                                           char sign) {
  const std::size_t at = piece.rfind(sign);
  if (at == std::string_view::npos || at == 0 || at + 1 == piece.size())
    refuse(text, fmt::format("'{}' has no '{}' between two words", piece, sign));
  return {std::string(piece.substr(0, at)), std::string(piece.substr(at + 1))};
}

/// Takes the direction from the end.
Crossing take_crossing(std::string_view& piece) {
  constexpr std::array<std::pair<std::string_view, Crossing>, 3> words{
      {{":rising", Crossing::upwards},
       {":falling", Crossing::downwards},
       {":both", Crossing::both}}};
  for (const auto& [word, crossing] : words)
    if (piece.ends_with(word)) {
      piece.remove_suffix(word.size());
      return crossing;
    }
  return Crossing::upwards;
}

const CaseParameter* parameter_named(const std::vector<CaseParameter>& all, std::string_view name) {
  const auto found = std::ranges::find(all, name, &CaseParameter::name);
  return found == all.end() ? nullptr : &*found;
}

/// A time, or a parameter: a time itself, or a plain number, a frequency in Hz.
double period_of_text(std::string_view text, const std::string& word, const Case& c,
                      const Parameters& p) {
  if (const CaseParameter* parameter = parameter_named(c.parameters, word)) {
    const double value = p.number(word);
    if (parameter->quantity == Quantity::time) return value;
    if (parameter->quantity == Quantity::number && value > 0.0) return 1.0 / value;
    refuse(text, fmt::format("parameter '{}' is neither a time nor a frequency > 0", word));
  }
  return parse_quantity(owner_of(text), Quantity::time, word);
}

/// every:0.1s, every:frequency+0.25
Section parse_every(std::string_view text, std::string_view piece, const Case& c,
                    const Parameters& p) {
  double part = 0.0;
  if (const std::size_t plus = piece.find('+'); plus != std::string_view::npos) {
    part = parse_quantity(owner_of(text), Quantity::number, piece.substr(plus + 1));
    require_range(owner_of(text), "part of the period", part, 0.0, 1.0);
    piece = piece.substr(0, plus);
  }
  if (piece.empty()) refuse(text, "no period");
  const double period = period_of_text(text, std::string(piece), c, p);
  require_positive(owner_of(text), "period", period, "s");
  return Section::every(period, part * period);
}

}  // namespace

Section parse_section(std::string_view text, const Case& c, const Parameters& parameters) {
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos) refuse(text, "no kind of section");
  const std::string_view kind = text.substr(0, colon);
  std::string_view piece = text.substr(colon + 1);
  if (kind == "every") return parse_every(text, piece, c, parameters);
  if (kind == "event") {
    auto [element, event] = around(text, piece, '.');
    return Section::at_event(std::move(element), std::move(event));
  }
  if (kind != "phase" && kind != "plane") refuse(text, fmt::format("unknown kind '{}'", kind));
  const Crossing crossing = take_crossing(piece);
  auto [name, value] = around(text, piece, '=');
  if (kind == "phase")
    return Section::phase(std::move(name), parse_quantity(owner_of(text), Quantity::angle, value),
                          crossing);
  const double number = parse_quantity(owner_of(text), Quantity::number, value);
  return Section::plane({{std::move(name)}}, number, crossing);
}

SectionedModel sectioned_model(const Case& c, const MapRequest& request,
                               const std::vector<std::string>& settings) {
  std::vector<std::string> all = request.settings;
  all.insert(all.end(), settings.begin(), settings.end());
  const Parameters parameters(c.parameters, all);
  if (request.at.empty()) throw ModelError(fmt::format("--at: which section? {}", accepted));
  std::vector<std::string> laws;
  if (!request.law.empty()) laws.push_back(request.law);
  if (laws.empty() && c.contact.walls && !c.contact.walls(parameters).empty())
    laws.push_back(base_law_name(c.contact));
  laws = choose_laws(c, parameters, laws, request.friction);
  SectionedModel made{.model = make_model(c, parameters, laws.empty() ? "" : laws.front()),
                      .start = {},
                      .section = parse_section(request.at, c, parameters)};
  made.model.add(made.section);
  made.start = made.model.start_state();
  return made;
}

PoincareOptions map_options(const Case& c, const MapRequest& request, const SectionedModel& at) {
  PoincareOptions options{.columns = request.columns,
                          .discard = request.discard,
                          .points = request.points,
                          .duration = request.duration};
  if (options.columns.empty()) options.columns = free_coordinates(at.model);
  const auto own = [&](const std::string& name) {  // columns that the map has besides
    return name.empty() || name == "t_s" ||
           (at.section.kind == SectionKind::event &&
            (name == "speed_m_per_s" || name == "penetration_m"));
  };
  for (const std::string* name : {&request.x, &request.y})
    if (!own(*name) && std::ranges::find(options.columns, *name) == options.columns.end())
      options.columns.push_back(*name);
  if (options.duration == 0.0 && at.section.kind != SectionKind::period)
    options.duration = static_cast<double>(request.discard + request.points) *
                       c.duration(Parameters(c.parameters, request.settings));
  options.run.samples = 0;
  options.run.relative_tolerance = request.relative_tolerance;
  options.run.formulation = request.formulation;
  return options;
}

std::string axis_label(const std::string& column) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 7> units{
      {{"_rad_per_s2", "rad/s^2"},
       {"_m_per_s2", "m/s^2"},
       {"_rad_per_s", "rad/s"},
       {"_m_per_s", "m/s"},
       {"_rad", "rad"},
       {"_m", "m"},
       {"_N", "N"}}};
  for (const auto& [ending, unit] : units)
    if (column.ends_with(ending))
      return fmt::format("{} [{}]", column.substr(0, column.size() - ending.size()), unit);
  return column;
}

}  // namespace yoke::cases
