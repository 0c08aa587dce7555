// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Where the force and the penetration of a contact are largest. Steps end where the integrator likes,
// most often beside the peak: it is looked for on the dense output that costs no evaluation. There both
// are flat, so the small error of its place means nothing for the row that is taken there.
#pragma once

#include <array>
#include <vector>

#include <yoke/integrators/formulations/formulation.hpp>

namespace yoke {

class ContactPeaks {
 public:
  explicit ContactPeaks(const System& system);
  /// Counts afresh from here, whatever touches.
  void start(const State& state);
  /// At a restart: what touches more than before counts afresh.
  void restart(const State& state);
  /// Appends the times [s] inside (from, to) of the last step of `formulation` at which a force or a
  /// penetration is larger than ever before in its contact. `scratch` has the memory and the
  /// parameters of that step; `system` is left bound to it.
  void find(double from, double to, System& system, Formulation& formulation, State& scratch,
            std::vector<double>& times);

 private:
  static constexpr std::size_t looks = 4;  // at equal distances, both ends
  using Values = std::array<double, looks>;

  struct Watched {
    ForceSlot force;
    std::size_t channel = 0;  // of the element's own
    std::ptrdiff_t touching = 0;
    double largest = 0.0;
    Values seen{};
  };

  double value(const Watched& w, const System& system);
  double value_of(const State& state, const Watched& w, System& system);
  double value_at(double t, const Watched& w, System& system, Formulation& formulation,
                  State& scratch);

  std::vector<Watched> watched_;
  std::vector<double> channels_;  // of one element
};

}  // namespace yoke
