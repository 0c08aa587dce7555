// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Accelerations, reactions and energies from positions and velocities: at a stored State, or at any
// time between the stored rows of a run.
#pragma once

#include <string_view>

#include <yoke/core/model.hpp>
#include <yoke/core/result.hpp>

namespace yoke {

struct Recovery {
  State state;  // with accelerations and multipliers
  Table row;    // one row under the names of simulate()'s samples; `balance_J` counts from the
                // start of the model, or from the first of the rows given

  /// A number by its column: recovery["pivot.fx_N"]. Throws ModelError.
  double operator[](std::string_view column) const { return row.value(0, row.index(column)); }
};

/// At `state`: t, q, v, z, contacts, energies and parameters are taken as they are, everything
/// else follows from them. States are found in Result::final, in checkpoints, and are made by
/// assemble(), equilibrium() and stored_state(). Throws ModelError if the state is not of this
/// model, or violates its joints by more than 1e-8 of its size.
Recovery recover(const Model& model, const State& state);

/// The state at time t [s] of a run whose samples are given: a row if t is one, else between two
/// rows by the polynomial of degree 5 that has their positions, velocities and accelerations
/// (error ~ h^6), projected on the joints; z and energies on a straight line. Parameters are
/// those of the model. Throws ModelError if t is outside the rows, if the columns are not those of
/// the model, and for a contact, whose memory rows do not hold: run up to that time and take
/// Result::final.
State stored_state(const Model& model, const Table& samples, double t);

/// recover() at stored_state().
Recovery recover(const Model& model, const Table& samples, double t);

}  // namespace yoke
