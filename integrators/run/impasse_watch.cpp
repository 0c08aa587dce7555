// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/run/impasse_watch.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <yoke/core/equations/assemblies.hpp>
#include <yoke/core/equations/linear/index.hpp>

namespace yoke {

namespace {
constexpr double soon = 1e-3;        // of the time scale: as far as the law of growth is trusted
constexpr double rush = 1e5;         // massless over other speeds
constexpr double much_faster = 2.0;  // than when it was last looked at: worth another look
}  // namespace

ImpasseWatch::ImpasseWatch(Dynamics& dynamics)
    : dynamics_(dynamics), watches_(dynamics.system().has_massless()) {
  if (!watches_) return;
  assembly_ = assemblies_of(dynamics.system());
  mass_speed_.assign(assembly_.size(), 0.0);
  looked_at_.assign(assembly_.size(), 0.0);
}

// The largest speed of the body's coordinates with mass, or of those without.
double ImpasseWatch::size_of(const State& state, int body, bool massless) const {
  double size = 0.0;
  for (int i = 3 * body; i < 3 * body + 3; ++i)
    if ((dynamics_.system().mass()[at(i)] == 0.0) == massless)
      size = std::max(size, std::abs(state.v[i]) * std::sqrt(dynamics_.length_metric()[at(i)]));
  return size;
}

std::string ImpasseWatch::look(const State& state) {
  const int bodies = static_cast<int>(assembly_.size());
  std::ranges::fill(mass_speed_, 0.0);
  for (int body = 0; body < bodies; ++body) {
    double& speed = mass_speed_[at(assembly_[at(body)])];
    speed = std::max(speed, size_of(state, body, false));
  }
  bool rushes = false;
  for (int body = 0; body < bodies; ++body) {
    const double speed = size_of(state, body, true);
    const bool rushing = speed > rush * mass_speed_[at(assembly_[at(body)])];
    // A driven body may move where all masses rest: that is seen once.
    rushes = rushes || (rushing && speed > much_faster * looked_at_[at(body)]);
    looked_at_[at(body)] = rushing ? std::max(looked_at_[at(body)], speed) : 0.0;
  }
  return rushes ? explain(state) : std::string();
}

// [s] Speeds grow as the root of one over the time that is left: v / v' is twice that.
double ImpasseWatch::time_left(State there) {
  if (!dynamics_.calc_accelerations(there)) return 0.0;
  double square = 0.0, growth = 0.0;
  for (Eigen::Index i = 0; i < there.v.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (dynamics_.system().mass()[k] > 0.0) continue;
    square += dynamics_.length_metric()[k] * there.v[i] * there.v[i];
    growth += dynamics_.length_metric()[k] * there.v[i] * there.a[i];
  }
  const double left = 0.5 * square / growth;
  return left > 0.0 && left < soon * dynamics_.system().scales().time ? left : 0.0;
}

std::string ImpasseWatch::explain(const State& there) {
  if (!watches_) return {};
  const std::string moves = dynamics_.impasse(there);
  if (moves.empty()) return {};
  return fmt::format("impasse at t = {:.9g} s: {}; the motion has no continuation",
                     there.t + time_left(there), moves);
}

}  // namespace yoke
