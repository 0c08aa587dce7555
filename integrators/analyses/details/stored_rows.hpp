// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// States out of the rows of a run.
#pragma once

#include <yoke/core/equations/dynamics.hpp>
#include <yoke/core/result.hpp>

namespace yoke {

class StoredRows {
 public:
  /// Throws ModelError unless the columns of `samples` begin with those of the model, and for a
  /// model with contacts. Both must outlive this.
  StoredRows(Dynamics& dynamics, const Table& samples);

  std::size_t count() const { return samples_.rows(); }
  double time(std::size_t row) const { return samples_.value(row, 0); }
  /// t, q, v, a, z and energies of a row, as they stand there.
  void read(std::size_t row, State& state) const;
  /// At any time in between, not projected. Throws ModelError outside.
  void interpolate(double t, State& state) const;

 private:
  const System& system_;
  const Table& samples_;
  std::vector<std::size_t> z_columns_;
  std::size_t energy_column_ = 0;
};

/// Assembles the model as simulate() does, from its start pose or else from `fallback`, so that the
/// same redundant equations are left out as in the run that wrote the rows. Throws ModelError.
void prepare_for_rows(Dynamics& dynamics, const State& fallback);

}  // namespace yoke
