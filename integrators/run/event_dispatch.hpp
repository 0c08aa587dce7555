// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Brings events to the elements that own them, and what the elements do about them into the state
// and the results of a run.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <yoke/core/equations/dynamics.hpp>
#include <yoke/core/result.hpp>

namespace yoke {

class ElementEvents {
 public:
  using StopRun = std::function<void(Stop why, std::string reason)>;
  /// Elements change `state`, append to the events and add to the notes of `result`; `stop` is
  /// called if one fails or ends the run.
  ElementEvents(Dynamics& dynamics, State& state, Result& result, StopRun stop);
  /// Lets every contact find out whether it touches at the start.
  void initialise_contacts();
  /// Event slots that fired at the state, which is projected and has its accelerations.
  void handle(const std::vector<int>& fired);
  /// Whether the last handle() changed a contact's memory or a parameter.
  bool changed() const;
  bool parameters_changed() const { return parameters_changed_; }

 private:
  EventContext context_of(const ForceSlot& slot);
  void settle_grips();
  void add_note(const std::string& note);
  void handle_one(const ForceSlot& slot, int event);

  Dynamics& dynamics_;
  State& state_;
  Result& result_;
  StopRun stop_;
  std::vector<double> local_acceleration_;
  std::vector<ContactMemory> contacts_before_;
  bool parameters_changed_ = false;
};

}  // namespace yoke
