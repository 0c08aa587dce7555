// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#pragma once

#include <vector>

#include <yoke/core/result.hpp>
#include <yoke/integrators/run/recorder.hpp>

namespace yoke {

/// Rows of a Recorder with columns added behind.
class WideTable {
 public:
  WideTable(Dynamics& dynamics, Result& result)
      : result_(result), recorder_(dynamics, narrow_, 0) {}
  void keep(std::size_t first, std::size_t count) {
    for (std::size_t i = first; i < first + count; ++i) {
      result_.samples.add_column(narrow_.samples.names()[i], "");
      kept_.push_back(i);
    }
  }
  void start(const State& state) { recorder_.start(state); }
  /// A row with room for what is added; returns where that begins.
  double* record(const State& state) {
    recorder_.record(state);
    double* row = result_.samples.append();
    for (const std::size_t column : kept_)
      *row++ = narrow_.samples.value(narrow_.samples.rows() - 1, column);
    return row;
  }
  const Table& narrow() const { return narrow_.samples; }
  const Summary& summary() const { return narrow_.summary; }

 private:
  Result& result_;
  Result narrow_;
  Recorder recorder_;
  std::vector<std::size_t> kept_;
};

}  // namespace yoke
