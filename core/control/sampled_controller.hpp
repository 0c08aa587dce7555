// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A controller as a computer runs it: at sample times, offset + k period, it reads the motion and sets
// changeable parameters of other elements, which hold until the next sample. A step of the integrator
// ends exactly at each sample time, and starts afresh if an output has changed.
//
//   model.add(AppliedForce{.name = "motor", .body = slider, .value = Vec2(0.0, 0.0)});
//   model.add(SampledController{
//       .name = "pid", .period = 1e-3, .outputs = {"motor.fx"}, .memory = {{"integral", "m s"}},
//       .update = [=](const ControllerSample& s) {
//         const double error = wanted - s.motion[slider].x;
//         s.memory(0) += error * s.period;
//         s.output(0) = kp * error + ki * s.memory(0) - kd * s.motion[slider].vx;
//       }});
//
// What a controller remembers is part of the State, as its outputs are: so runs in threads, restored
// and resumed runs need nothing else. Its parameters are "pid.samples", the number of samples taken,
// and "pid.integral". What a change of an output does to stored energy is counted as its work.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <yoke/core/force.hpp>
#include <yoke/core/model.hpp>

namespace yoke {

/// What a controller sees and sets at one sample.
struct ControllerSample {
  const Motion& motion;  // at motion.t, the sample time
  long number;           // of this sample, 0 the first
  double period;         // [s]
  /// Ends the run with Stop::by_event.
  const std::function<void()>& stop;

  /// Output i in the order of SampledController::outputs, as it was set last.
  double& output(std::size_t i) const { return parameters[outputs->at(i)]; }
  /// Number i in the order of SampledController::memory.
  double& memory(std::size_t i) const { return remembered[i]; }

  double* parameters;                       // State::parameters
  const std::vector<std::size_t>* outputs;  // their indices
  double* remembered;                       // behind memory()
};

struct SampledController {
  std::string name;
  double period = 0.0;                 // [s] > 0
  double offset = 0.0;                 // [s] of the first sample
  std::vector<std::string> outputs{};  // "element.name", elements added before it
  std::vector<Parameter> memory{};     // with their values at the start
  std::function<void(const ControllerSample&)> update{};  // must not allocate to stay fast

  /// Throws ModelError for a period that is not positive, an unknown output, a missing update.
  std::unique_ptr<ForceElement> build(const Model& model) const;
};

}  // namespace yoke
