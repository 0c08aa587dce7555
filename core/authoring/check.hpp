// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Checks of an element against itself: every derivative against central differences of the quantity
// it belongs to, and the energies against the work of the forces. For authors of elements:
//
//   const ElementCheck check = check_element(*model.constraints().back(), model);
//   INFO(check.message());
//   CHECK(check.ok());
//
// Joint:  G, phi_t against Phi;  H, gamma against G v + Phi_t;  K against G^T lambda; G and H are
//         zero outside the declared pattern; Phi_t is zero unless rheonomic().
// Force:  dQ_*, dz_* against Q and z_dot; zero where dependence() says so; along the motion
//         Q . v = -d(potential + stored)/dt - dissipated_power + supplied_power.
// Both:   a block requested alone equals the block requested with all others; every number is
//         finite;
//         an element of which only zeros are seen has not been checked and fails.
#pragma once

#include <string>
#include <vector>

#include <yoke/core/model.hpp>

namespace yoke {

/// At which states an element is checked, and over which sizes it is smooth.
struct CheckOptions {
  int states = 5;       // how many ugly states are tried, where none is given
  unsigned seed = 1;    // of those states and of the multipliers for K
  double length = 1.0;  // [m] over which the element is smooth; for a contact its penetration
  double angle = 1.0;   // [rad] likewise
  double rate = 1.0;    // [m/s], [rad/s] likewise
  double time = 1.0;    // [s] likewise
  double state = 1.0;   // for the element's own z likewise
};

/// The worst entry found, relative to the size of its row.
struct ElementCheck {
  std::string element;                   // its name
  double worst_error = 0.0;              // relative to the size of its row
  std::string block = "none";            // "G", "dQ_dv", "power", ...
  int row = 0, column = 0;               // where in the block
  double analytic = 0.0, numeric = 0.0;  // the entry, and what differences say
  std::string problem;                   // what else is wrong; empty: nothing
  int entries = 0;                       // how many were compared

  /// Nothing is wrong, and all entries are within the tolerance.
  bool ok(double tolerance = 1e-7) const { return problem.empty() && worst_error <= tolerance; }
  /// The worst entry or the problem, as a sentence.
  std::string message() const;
};

/// Checks an element at the given state. If the element belongs to the model its states z,
/// parameters and contact memory are read there; otherwise they are its defaults.
ElementCheck check_element(const Constraint& element, const Model& model, const State& state,
                           const CheckOptions& options = {});
ElementCheck check_element(const ForceElement& element, const Model& model, const State& state,
                           const CheckOptions& options = {});

/// Checks an element at ugly states.
ElementCheck check_element(const Constraint& element, const Model& model,
                           const CheckOptions& options = {});
ElementCheck check_element(const ForceElement& element, const Model& model,
                           const CheckOptions& options = {});

/// Checks all elements of a model at ugly states.
std::vector<ElementCheck> check_elements(const Model& model, const CheckOptions& options = {});

/// The start state with everything but parameters and contact memory moved at random by its own
/// size, so that no number in it is zero, one or equal to another, and no constraint is met.
State ugly_state(const Model& model, unsigned seed);

}  // namespace yoke
