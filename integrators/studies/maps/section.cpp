// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/studies/maps/section.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

namespace yoke {

namespace {

/// One number of one body.
struct MotionColumnOf {
  BodyId body;
  double BodyMotion::*member;
};

struct NamedMember {
  const char* name;
  double BodyMotion::*member;
};
constexpr std::array<NamedMember, 6> motion_members{{{"x_m", &BodyMotion::x},
                                                     {"y_m", &BodyMotion::y},
                                                     {"angle_rad", &BodyMotion::angle},
                                                     {"vx_m_per_s", &BodyMotion::vx},
                                                     {"vy_m_per_s", &BodyMotion::vy},
                                                     {"omega_rad_per_s", &BodyMotion::omega}}};

std::optional<BodyId> body_named(const Model& model, std::string_view name) {
  for (std::size_t i = 1; i < model.bodies().size(); ++i)
    if (model.bodies()[i].name == name) return BodyId{static_cast<int>(i)};
  return std::nullopt;
}

std::optional<MotionColumnOf> motion_column(const Model& model, const std::string& column) {
  const std::size_t dot = column.rfind('.');
  if (dot == std::string::npos) return std::nullopt;
  const std::optional<BodyId> body = body_named(model, std::string_view(column).substr(0, dot));
  const auto member = std::ranges::find_if(motion_members, [&](const NamedMember& m) {
    return std::string_view(column).substr(dot + 1) == m.name;
  });
  if (!body || member == motion_members.end()) return std::nullopt;
  return MotionColumnOf{*body, member->member};
}

/// The angle of `body` beside that of `beside`.
struct RelativeAngle {
  BodyId body, beside;
};

bool drives_angle(const Constraint& c) {
  return c.rheonomic() && c.rows() == 1 && c.equations().front().measure == Measure::angle;
}

std::optional<RelativeAngle> angle_of(const Model& model, const std::string& name) {
  for (const auto& c : model.constraints())
    if (c->name() == name && drives_angle(*c))
      return RelativeAngle{c->bodies().back(),
                           c->bodies().size() > 1 ? c->bodies().front() : ground};
  if (const std::optional<BodyId> body = body_named(model, name))
    return RelativeAngle{*body, ground};
  return std::nullopt;
}

std::vector<std::string> turning_names(const Model& model) {
  std::vector<std::string> names;
  for (const auto& c : model.constraints())
    if (drives_angle(*c)) names.push_back(c->name());
  for (std::size_t i = 1; i < model.bodies().size(); ++i) names.push_back(model.bodies()[i].name);
  return names;
}

bool has_element(const Model& model, const std::string& name) {
  return std::ranges::any_of(model.forces(), [&](const auto& f) { return f->name() == name; });
}

std::vector<std::string> names_with_events(const Model& model) {
  std::vector<std::string> names;
  for (const auto& f : model.forces())
    if (f->events() > 0) names.push_back(f->name());
  return names;
}

Elements located_by(EventFunction event, const Model& model) {
  Elements elements;
  elements.forces.push_back(event.build(model));
  return elements;
}

}  // namespace

Section Section::every(double period, double offset) {
  return {.kind = SectionKind::period, .period = period, .offset = offset};
}

Section Section::phase(std::string of, double angle, Crossing crossing) {
  return {
      .kind = SectionKind::phase, .element = std::move(of), .value = angle, .crossing = crossing};
}

Section Section::at_event(std::string element, std::string event_kind) {
  return {.kind = SectionKind::event,
          .element = std::move(element),
          .event_kind = std::move(event_kind)};
}

Section Section::plane(std::vector<PlaneTerm> terms, double value, Crossing crossing) {
  return {
      .kind = SectionKind::plane, .terms = std::move(terms), .value = value, .crossing = crossing};
}

void Section::check(const Model& model) const {
  const std::string owner = fmt::format("section '{}'", name);
  switch (kind) {
    case SectionKind::period:
      require_positive(owner, "period", period, "s");
      require_finite(owner, "offset", offset);
      return;
    case SectionKind::phase:
      require_finite(owner, "angle", value);
      if (!angle_of(model, element))
        throw ModelError(
            fmt::format("{}: '{}' is neither an angle driver nor a body; there are '{}'", owner,
                        element, fmt::join(turning_names(model), "', '")));
      return;
    case SectionKind::event:
      if (!has_element(model, element))
        throw ModelError(fmt::format("{}: no element '{}' has events; those that have: '{}'", owner,
                                     element, fmt::join(names_with_events(model), "', '")));
      if (event_kind.empty())
        throw ModelError(
            fmt::format("{}: which kind of event of '{}'? as onset, release", owner, element));
      return;
    case SectionKind::plane:
      if (terms.empty()) throw ModelError(fmt::format("{}: a plane needs a column", owner));
      require_finite(owner, "value", value);
      for (const PlaneTerm& term : terms) {
        require_finite(owner, "factor", term.factor);
        if (!is_motion_column(model, term.column))
          throw ModelError(
              fmt::format("{}: '{}' is no coordinate or velocity of a body; accepted are those of "
                          "motion.csv, as {}",
                          owner, term.column, fmt::join(free_coordinates(model), ", ")));
      }
      return;
  }
}

Elements Section::elements(const Model& model) const {
  check(model);
  if (kind == SectionKind::phase) {
    // Half the angle: the function has a zero where the angle passes, and none half a turn later.
    const RelativeAngle of = *angle_of(model, element);
    return located_by(
        {.name = name,
         .function =
             [of, angle = value](const Motion& at) {
               return std::sin(0.5 * (at[of.body].angle - at[of.beside].angle - angle));
             }},
        model);
  }
  if (kind != SectionKind::plane) return {};
  std::vector<std::pair<MotionColumnOf, double>> sum;
  for (const PlaneTerm& term : terms)
    sum.emplace_back(*motion_column(model, term.column), term.factor);
  return located_by({.name = name,
                     .function =
                         [sum, at_value = value](const Motion& at) {
                           double total = -at_value;
                           for (const auto& [of, factor] : sum)
                             total += factor * at[of.body].*of.member;
                           return total;
                         },
                     .crossing = crossing},
                    model);
}

std::string Section::text() const {
  switch (kind) {
    case SectionKind::period:
      return offset == 0.0 ? fmt::format("every {:.6g} s", period)
                           : fmt::format("every {:.6g} s, from {:.6g} s", period, offset);
    case SectionKind::phase:
      return fmt::format("{} = {:.6g} rad", element, value);
    case SectionKind::event:
      return fmt::format("{} of {}", event_kind, element);
    case SectionKind::plane:
      break;
  }
  std::string sum;
  for (const PlaneTerm& term : terms)
    sum += (sum.empty() ? "" : " + ") +
           (term.factor == 1.0 ? term.column : fmt::format("{:.6g} {}", term.factor, term.column));
  return fmt::format("{} = {:.6g}{}", sum, value,
                     crossing == Crossing::upwards     ? ", rising"
                     : crossing == Crossing::downwards ? ", falling"
                                                       : "");
}

bool is_motion_column(const Model& model, const std::string& column) {
  return motion_column(model, column).has_value();
}

std::vector<std::string> free_coordinates(const Model& model) {
  const auto driven = [&](const Body& body) {
    return std::ranges::any_of(model.constraints(), [&](const auto& c) {
      return c->rheonomic() && model.body(c->bodies().back()).name == body.name;
    });
  };
  std::vector<std::string> names;
  for (const bool all : {false, true}) {
    for (std::size_t i = 1; i < model.bodies().size(); ++i)
      for (const NamedMember& m : motion_members)
        if (all || !driven(model.bodies()[i]))
          names.push_back(model.bodies()[i].name + "." + m.name);
    if (!names.empty()) break;
  }
  return names;
}

}  // namespace yoke
