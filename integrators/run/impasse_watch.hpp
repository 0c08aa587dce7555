// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Stops a run at an impasse (core/equations/massless.hpp), for the same reason and at the same time
// in every formulation. On the way there massless bodies become fast without bound while the masses
// keep their speed: with the distance d to the impasse as 1/d, and d falls as the root of the time
// that is left. Beyond a ratio of 1e5 nothing but rounding would follow.
#pragma once

#include <string>
#include <vector>

#include <yoke/core/equations/dynamics.hpp>

namespace yoke {

class ImpasseWatch {
 public:
  explicit ImpasseWatch(Dynamics& dynamics);

  /// Is there anything that could come to an impasse?
  bool watches() const { return watches_; }
  /// After an accepted step: empty, or the reason to stop there.
  std::string look(const State& state);
  /// After a step that failed, at the last good state: empty, or that it is an impasse.
  std::string explain(const State& there);

 private:
  double time_left(State there);
  double size_of(const State& state, int body, bool massless) const;

  Dynamics& dynamics_;
  bool watches_;
  std::vector<int> assembly_;       // [bodies]
  std::vector<double> mass_speed_;  // [assemblies, m/s] scratch
  std::vector<double> looked_at_;   // [bodies, m/s] massless speed when it was last looked at
};

}  // namespace yoke
