// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Error bars for a result: the run is repeated with a formulation that has as little as possible in
// common with the first (another index of the equations, another family of methods), at a tighter
// tolerance, and the number of digits that agree is determined for each recorded quantity.
#pragma once

#include <string>
#include <vector>

#include <yoke/integrators/simulate.hpp>

namespace yoke {

/// One column of the samples, over all rows.
struct Agreement {
  std::string column;       // its name
  double peak = 0.0;        // largest value, in the unit of the column
  double difference = 0.0;  // largest difference between the two runs
  /// -log10(difference / peak), from 0 to 16; 16 if both are zero throughout.
  double digits = 0.0;
};

/// The second run, and how far both agree.
struct Verification {
  std::string formulation;             // the second one
  double relative_tolerance = 0.0;     // of the second run
  Summary summary;                     // of the second run
  std::vector<Agreement> quantities;   // in the order of the samples, but for time and the balance
  long events = 0, other_events = 0;   // of the first and of the second run
  double event_time_difference = 0.0;  // [s] largest, if both have the same events
  bool same_events = false;            // kind and element, one by one

  /// The quantity that agrees least; null if there is none.
  const Agreement* worst() const;
};

/// Runs `model` again as `result` was run with `options`, from the same start. Throws ModelError
/// if `result` has no samples or did not complete.
Verification verify(const Model& model, const SimulationOptions& options, const Result& result);
Verification verify(const Model& model, const State& start, const SimulationOptions& options,
                    const Result& result);

/// The verification as JSON text.
std::string to_json(const Verification& verification);

}  // namespace yoke
