// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A bifurcation diagram: the points of a section over a parameter. From value to value the state is carried
// on, so the motion follows its attractor as long as there is one; both directions beside each other show
// hysteresis. Or every value begins at its own start, on several threads.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include <yoke/integrators/studies/maps/poincare.hpp>

namespace yoke {

/// What a map is made of at one value of its parameters.
struct SectionedModel {
  Model model;      // the section has been added
  State start;      // where it starts if nothing is carried over
  Section section;  // when its points are taken
};

/// Where a value of the parameter begins.
enum class Continuation {
  forward,   // at the last point of the value before; the first at its own start
  backward,  // the same from the last value to the first
  both,      // one after the other, each beginning at its own start
  afresh     // each at its own start
};

/// How a diagram is made.
struct BifurcationOptions {
  PoincareOptions map{};                              // of each value; its observer does not count
  Continuation continuation = Continuation::forward;  // where a value begins
  int jobs = 1;  // threads; a direction needs one, values afresh as many as there are
  std::function<void(std::size_t done, std::size_t total)> observer{};  // one call at a time
  std::function<bool()> stop{};  // true: no more points; what there is stays
};

/// What became of one value.
struct BifurcationRow {
  double value = 0.0;      // of the parameter
  bool backward = false;   // the direction in which it was reached
  std::size_t points = 0;  // that there are
  std::size_t period = 0;  // as in Poincare, by the range of all points of the diagram; 0: none
  std::string reason{};    // "": complete; else a sentence
};

/// The diagram.
struct Bifurcation {
  Table points;  // value, direction (a label), point (from 0), t_s, columns of the section
  std::vector<BifurcationRow> rows{};  // forward, then backward, each in the order of `values`
  bool complete = false;               // stopped by nobody; a value may have failed all the same
};

/// Makes the model at a value of the parameter. Called on several threads if there are several jobs.
using ModelOfParameter = std::function<SectionedModel(double value)>;

/// The points at each of `values`, in their order. A value whose run fails has the points until then, one whose
/// model cannot be made has none; the next begins at its own start. Throws ModelError for no values, and
/// what the first of all throws before its run.
///
/// What is carried over: positions, velocities and states of elements (carried_over()), brought onto the
/// constraints of the new model. The time is that of the same phase: with Section::every offset + k period
/// of the new section, else the one at which the drivers are where they were. What is lost: in a contact
/// that lasts the memory of its impact, which counts as begun there; work, dissipation, parameters that
/// events have changed.
Bifurcation bifurcation(const ModelOfParameter& model, const std::vector<double>& values,
                        const BifurcationOptions& options);

}  // namespace yoke
