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
  /// [s] When the next sample of a controller is due, from the state on; infinity: never.
  double next_sample() const;
  /// Takes the samples that are due until `t` [s], at the state, which is as for handle().
  void take_samples(double t);
  /// Changes parameters of drivers, at the state, which is as for handle(): `values` are all parameters.
  /// A new speed is a blow. Throws ModelError if joints cannot follow.
  void drive(const std::vector<double>& values);
  /// The events that blows of drive() have led to.
  void handle_consequences();
  /// Settles which friction holds, after a change from outside at the state, which is as for handle().
  void settle();
  /// Whether the last handle() or take_samples() changed a contact's memory, a velocity or a
  /// parameter that others read.
  bool changed() const;
  /// And whether that may have changed how stiff the model is.
  bool stiffness_changed() const { return stiffness_changed_; }
  /// Or only loads: nothing else has happened at this time.
  bool loads_only() const { return loads_only_; }

 private:
  struct Driver {
    const ConstraintSlot* slot;
    std::size_t first, count;  // of its parameters
  };
  EventContext context_of(const ForceSlot& slot);
  void settle_grips();
  void add_note(const std::string& note);
  void handle_one(const ForceSlot& slot, int event);
  void begin();
  void strike(BodyId body, const Vec2& impulse, double angular);
  void follow_blow();
  void book_parameters(const ForceSlot& by);
  void handle_fired(std::size_t known);
  void note_drivers();
  bool withhold_drivers();
  void drive_on();
  void drive_on(const Driver& driver);

  Dynamics& dynamics_;
  State& state_;
  Result& result_;
  StopRun stop_;
  std::vector<double> local_acceleration_;
  std::vector<ContactMemory> contacts_before_;
  std::vector<Parameter> parameters_;        // of all elements
  std::vector<double> parameters_before_;    // of a sample
  std::vector<const ForceSlot*> sampled_;    // have samples
  std::vector<std::size_t> own_parameters_;  // how many each element has
  std::vector<Driver> drivers_;              // that have parameters
  std::vector<double> drivers_raw_;          // all parameters, before somebody may set drivers,
  std::vector<double> drivers_then_;         // in their form of that time,
  std::vector<double> drivers_wanted_;       // and as they were set
  std::vector<double> g_, g_before_;         // event functions around a blow
  std::vector<int> fired_;                   // with those that blows have added
  bool parameters_changed_ = false, stiffness_changed_ = false, loads_only_ = false;
  bool struck_ = false, velocities_changed_ = false;
};

}  // namespace yoke
