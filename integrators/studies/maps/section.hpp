// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A section through the motion: it says when a point of a map is taken. At a phase of a period, when a
// driven body passes an angle, at an event of an element, or where a combination of coordinates passes a
// value.
//
//   const Section section = Section::phase("motor", 0.0);
//   model.add(section);  // as any element: what locates its points
//   const Poincare map = poincare(model, section, {.discard = 100, .points = 400, .duration = 20.0});
//
// Angles and planes are located as events are, from the dense output of the run's steps to its last place;
// multiples of a period are times, which need not be located. A section exerts no force.
#pragma once

#include <string>
#include <vector>

#include <yoke/core/control/event_function.hpp>
#include <yoke/core/model.hpp>

namespace yoke {

/// What says when a point is taken.
enum class SectionKind { period, phase, event, plane };

/// A column of the motion, "crank.angle_rad", times a factor.
struct PlaneTerm {
  std::string column;   // BODY.x_m, .y_m, .angle_rad, .vx_m_per_s, .vy_m_per_s, .omega_rad_per_s
  double factor = 1.0;  // in the unit that makes the terms of a plane alike
};

/// A value. Made by one of the functions; the members are for who looks.
struct Section {
  SectionKind kind = SectionKind::period;  // which of the members count
  std::string name = "section";            // of the element that locates points
  double period = 0.0;                     // [s] of `period`
  double offset = 0.0;       // [s] of `period`: points are taken at offset + k period, k whole
  std::string element{};     // of `phase` a driver or a body, of `event` an element
  std::string event_kind{};  // of `event`: "onset", "release", "event" ...
  std::vector<PlaneTerm> terms{};         // of `plane`: their sum passes `value`
  double value = 0.0;                     // of `phase` [rad], of `plane` in the unit of the terms
  Crossing crossing = Crossing::upwards;  // of `phase` and `plane`

  /// Once a period [s] > 0, at offset + k period [s].
  static Section every(double period, double offset = 0.0);
  /// Once a turn: where the angle of a driven body passes `angle` [rad] up to whole turns. `of` is an angle
  /// driver, whose angle counts relative to where it is fixed, or a body.
  static Section phase(std::string of, double angle, Crossing crossing = Crossing::upwards);
  /// At each event of an element by its kind, a contact's "onset" or "release", an EventFunction's "event".
  /// The point is what the motion is behind the event.
  static Section at_event(std::string element, std::string event_kind);
  /// Where the sum of the terms passes `value`.
  static Section plane(std::vector<PlaneTerm> terms, double value,
                       Crossing crossing = Crossing::upwards);

  /// Throws ModelError for a period that is not positive, an unknown driver, body, element or column, a
  /// plane without terms.
  void check(const Model& model) const;
  /// What locates its points: an EventFunction, or nothing. Model::add calls it. Throws ModelError.
  Elements elements(const Model& model) const;
  /// "every 0.1 s", "motor = 0.5 rad", for people.
  std::string text() const;
};

/// Whether a name is that of a column that a plane may have.
bool is_motion_column(const Model& model, const std::string& column);

/// The columns of positions and velocities of the bodies whose motion no driver prescribes alone; of all if
/// there are no others.
std::vector<std::string> free_coordinates(const Model& model);

}  // namespace yoke
