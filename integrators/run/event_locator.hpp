// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// When the events of a step happen: at the root the formulation located, or earlier, where another
// function crossed zero unnoticed because it came back within the step.
//
// In contact the forces keep steps short. Functions of contacts that are apart, and of elements
// without contacts, as a user's are, are looked at within every accepted step: at `looks`, or at few of
// them while every gap is wide against what it changes by; and where a function is larger than at the
// looks beside, at its maximum. So an excursion above zero that lasts longer
// than `longest_gap` of the step is always found, a shorter one if the function rises to it and
// falls behind it in the eyes of the looks. What is above zero at once after an event has to be
// negative first, as in EventGuard.
#pragma once

#include <array>
#include <vector>

#include <yoke/integrators/formulations/formulation.hpp>

namespace yoke {

class EventLocator {
 public:
  static constexpr double longest_gap = 1.0 / 8.0;

  explicit EventLocator(Dynamics& dynamics);
  /// At a restart; `loads_only`: one at which nothing else has changed than loads.
  void start(const State& state, bool loads_only = false);
  /// [s] Instant of the first events of the step that `formulation` has just made from `from` [s],
  /// or its end; fired() are the slots. Overwrites `scratch` and leaves the system at its motion.
  double locate(Formulation& formulation, Step step, double from, State& scratch);
  const std::vector<int>& fired() const { return fired_; }

 private:
  // Parts of a step. Those beside the ends tell whether a function rises or falls there.
  static constexpr std::array<double, 11> looks = {0.0,       1.0 / 64.0,  1.0 / 8.0, 2.0 / 8.0,
                                                   3.0 / 8.0, 4.0 / 8.0,   5.0 / 8.0, 6.0 / 8.0,
                                                   7.0 / 8.0, 63.0 / 64.0, 1.0};
  /// Indices of those that tell, with the first, whether all contacts are far from touching: at unequal
  /// distances, so that nothing that comes and goes looks straight.
  static constexpr std::array<std::size_t, 3> few_looks = {4, 7, 10};
  struct Watched {
    int slot = 0;
    int first_contact = 0, last_contact = 0;  // of its element, behind the last one
    bool of_contact() const { return first_contact < last_contact; }
    bool active = true;
    bool armed = false;
    double negative = 0.0;  // what it must be below to be armed
    std::array<double, looks.size()> seen{};
  };

  void locate_passed(Formulation& formulation, double from, State& scratch);
  void add_simultaneous(Formulation& formulation, State& scratch);
  void look_inside(Formulation& formulation, Step step, double from, double to, State& scratch);
  double first_crossing(Formulation& formulation, const Watched& w, std::size_t last, double from,
                        double to, State& scratch);
  static bool is_far(const Watched& w);
  static bool is_largest(const Watched& w, std::size_t i);
  double find_above(Formulation& formulation, int slot, const std::array<double, 3>& t,
                    State& scratch);
  double locate_crossing(Formulation& formulation, int slot, double from, double to,
                         State& scratch);
  double value(Formulation& formulation, int slot, double t, State& scratch);
  void calc(const State& state);
  void calc_watched(const State& state);
  void note(double t, int slot);

  Dynamics& dynamics_;
  std::vector<double> values_;
  std::vector<Watched> watched_;
  std::vector<int> fired_;
  double t_fired_ = 0.0;
  bool looks_ = false;  // anything is active
};

}  // namespace yoke
