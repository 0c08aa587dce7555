// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// An event of the user: a function of the motion, located where it crosses zero, and an action
// there. It exerts no force. All formulations locate it in the same way as contacts.
//
//   model.add(EventFunction{.name = "quarter turn",
//                           .function = [crank](const Motion& at) { return at[crank].angle -
//                           half_pi; }, .set = {{"spring.stiffness", 200.0}}, .stop = true});
//
// Every crossing is recorded with kind "event" and its direction in the column of the region. A
// jump of potential or stored energy that a changed parameter makes, and of kinetic energy that a
// blow makes, is counted as work of the event, so the energy ledger remains balanced. An event that only records does not restart the
// integrator.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <yoke/core/force.hpp>
#include <yoke/core/model.hpp>

namespace yoke {

/// Which changes of sign of the function are events.
enum class Crossing { upwards, downwards, both };

/// A changeable parameter "element.name" and the value it gets [its SI unit].
struct ParameterChange {
  std::string parameter;  // "element.name"
  double value = 0.0;     // in its SI unit
};

/// What an action may do at the located state: read the motion, change parameters, strike, end the run.
struct EventAction {
  const Motion& motion;  // at the located event
  /// A changeable parameter "element.name", to be read or changed. Throws ModelError.
  std::function<double&(std::string_view name)> parameter;
  /// Ends the run with Stop::by_event.
  std::function<void()> stop;
  /// A blow: an impulse [N s] at the centre of a body and an angular impulse [N m s]. Velocities
  /// change at once, those of all bodies that joints connect; `motion` is still that before.
  std::function<void(BodyId body, const Vec2& impulse, double angular)> impulse;
};

struct EventFunction {
  std::string name;
  std::function<double(const Motion&)> function{};   // smooth; its size does not matter
  Crossing crossing = Crossing::both;                // which changes of sign
  std::vector<ParameterChange> set{};                // done first
  std::function<void(const EventAction&)> action{};  // then this
  bool stop = false;                                 // then the run ends

  /// Throws ModelError if there is no function, at the start of a run if a parameter is unknown or
  /// may not have the value. What `action` sets is checked when it has been done: the run fails.
  std::unique_ptr<ForceElement> build(const Model& model) const;
};

}  // namespace yoke
