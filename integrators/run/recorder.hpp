// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Turns states into rows of a Table: motion, reactions, what elements report, and the energy ledger
//   kinetic + potential + stored + dissipated = initial + work,
// every term computed by itself.
#pragma once

#include <yoke/core/equations/dynamics.hpp>
#include <yoke/core/result.hpp>

namespace yoke {

class Recorder {
 public:
  /// Adds the columns of the model to `result`, all or those that fit one of the patterns, with room
  /// for `rows` rows. Throws ModelError for a pattern that fits none.
  Recorder(Dynamics& dynamics, Result& result, std::size_t rows,
           const std::vector<std::string>& patterns = {});
  /// Takes `state` (projected, with its accelerations) as the zero of the energy ledger.
  void start(const State& state);
  /// The zero of the ledger, to be kept when a run is taken up again.
  struct Ledger {
    double initial = 0.0;  // [J]
    EnergyTerms start;
  };
  const Ledger& ledger() const { return ledger_; }
  void resume(const Ledger& ledger) { ledger_ = ledger; }
  /// Appends one row and updates the worst figures of the summary.
  void record(const State& state) { record(state, result_.samples); }
  /// The same in a table with the columns of the samples.
  void record(const State& state, Table& table);
  /// The same without a row: at events.
  void check(const State& state);

 private:
  void add_columns(Table& table);
  void fill(const State& state, double* row);
  double* record_bodies(const State& state, double* row) const;
  double* record_reactions(double* row) const;
  double* record_channels(double* row) const;
  void record_energy(const State& state, double* row);

  Dynamics& dynamics_;
  Result& result_;
  std::vector<std::size_t> channels_;  // of each force element
  std::vector<bool> is_work_;          // of each quadrature: work done, else dissipated
  std::vector<std::size_t> chosen_;    // columns that are kept; empty: all
  std::vector<double> row_;            // of all columns, where not all are kept
  Ledger ledger_;
};

}  // namespace yoke
