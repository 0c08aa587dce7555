// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/analyses/details/linearisation.hpp>

#include <algorithm>
#include <cmath>

#include <yoke/integrators/analyses/details/tangent.hpp>
#include <yoke/integrators/analyses/reduction/reduction.hpp>

namespace yoke {

namespace {

constexpr double at_rest = 1e-7;  // of the fastest mode, in length scales or rad

}  // namespace

std::string restlessness(const System& system, const State& state, double rate) {
  const double length = system.scales().length;
  double speed = 0.0, acceleration = 0.0;
  std::size_t fastest = 0, pushed = 0;
  for (Eigen::Index i = 0; i < state.v.size(); ++i) {
    const double size = i % 3 == 2 ? 1.0 : length;
    const auto body = static_cast<std::size_t>(i / 3 + 1);
    if (const double v = std::abs(state.v[i]) / size; v > speed) speed = v, fastest = body;
    if (const double a = std::abs(state.a[i]) / size; a > acceleration)
      acceleration = a, pushed = body;
  }
  const std::vector<Body>& bodies = system.model().bodies();
  if (speed > at_rest * std::max(rate, 1e-3))
    return fmt::format(
        "the state is no equilibrium: '{}' moves ({:.3g} length scales or rad per s); the "
        "coefficients are those of the instant",
        bodies[fastest].name, speed);
  if (acceleration > at_rest * std::max(rate * rate, 1e-3))
    return fmt::format(
        "the state is no equilibrium: '{}' is accelerated ({:.3g} length scales or rad per s^2); "
        "the coefficients are those of the instant",
        bodies[pushed].name, acceleration);
  return {};
}

void check_linearisable(const Model& model) {
  const State start = model.start_state();
  const auto size = start.q.size() + start.z.size();
  if (size > largest_linearisation)
    throw ModelError(fmt::format(
        "linearisation: {} coordinates and element states; dense matrices are made for at most {}",
        size, largest_linearisation));
}

Linearisation linearise_sparse(Dynamics& dynamics, const State& state,
                               std::span<const double> share) {
  const System& system = dynamics.system();
  Linearisation l;
  l.state = state;
  refuse_loads(dynamics.system(), state);
  Tangent tangent = calc_tangent(dynamics.system(), l.state, share);
  l.mass = Eigen::Map<const Eigen::VectorXd>(system.mass().data(), system.dofs());
  const std::vector<double> metric = metric_of_masses(system);
  l.metric = Eigen::Map<const Eigen::VectorXd>(metric.data(), system.dofs());
  l.C = -tangent.Q_v;
  l.K = tangent.K_lambda - tangent.Q_q;
  l.G = std::move(tangent.G);
  l.H = std::move(tangent.H);
  l.Q_z = std::move(tangent.Q_z);
  l.z_q = std::move(tangent.z_q);
  l.z_v = std::move(tangent.z_v);
  l.z_z = std::move(tangent.z_z);
  l.freedom = system.dofs() - system.rows() + static_cast<int>(system.dropped_rows().size());
  return l;
}

Linearisation linearise_at(Dynamics& dynamics, const State& state, std::span<const double> share) {
  const System& system = dynamics.system();
  Linearisation l = linearise_sparse(dynamics, state, share);
  Reduction reduced(system);
  reduced.compute(dynamics.system(), l.state, share);
  l.basis = reduced.basis();
  l.basis_rate = reduced.basis_rate();
  l.C_reduced = reduced.C();
  l.K_reduced = reduced.K();
  l.A = reduced.A();
  l.freedom = static_cast<int>(l.basis.cols());
  const double rate = l.K_reduced.size() > 0 ? std::sqrt(l.K_reduced.cwiseAbs().maxCoeff()) : 0.0;
  l.warning = restlessness(system, l.state, rate);
  return l;
}

}  // namespace yoke
