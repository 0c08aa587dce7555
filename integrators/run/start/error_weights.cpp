// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/run/start/error_weights.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <vector>

namespace yoke {

Scales choose_scales(const System& system, const State& state, const SimulationOptions& options) {
  const double length = options.length_scale > 0.0 ? options.length_scale : system.natural_length();
  if (options.time_scale > 0.0) return {length, options.time_scale};
  double rate = 1.0 / (options.until - state.t);
  for (Eigen::Index i = 0; i < state.q.size(); ++i) {
    const double size = i % 3 == 2 ? 1.0 : length;
    rate = std::max({rate, std::abs(state.v[i]) / size, std::sqrt(std::abs(state.a[i]) / size)});
  }
  return {length, 1.0 / rate};
}

namespace {

// Positions and velocities of bodies in a contact are weighted with this power of its penetration
// over the size of the model. Less would leave a train of bounces to errors of the velocity, more
// follows the rounding of positions with short steps.
constexpr double share_of_contacts = 0.25;

}  // namespace

Tolerances choose_tolerances(const System& system, const SimulationOptions& options) {
  const Scales scales = system.scales();
  const double rtol = options.relative_tolerance;
  Tolerances tolerances;
  tolerances.relative = rtol;
  tolerances.q.resize(system.dofs());
  tolerances.v.resize(system.dofs());
  double mass = 0.0;
  for (int i = 0; i < system.dofs(); ++i) {
    const double size = i % 3 == 2 ? 1.0 : scales.length;
    tolerances.q[i] = rtol * size;
    tolerances.v[i] = rtol * size / scales.time;
    if (i % 3 == 0) mass = std::max(mass, system.mass()[static_cast<std::size_t>(i)]);
  }
  for (const ForceSlot& f : system.forces()) {
    const double penetration = f.element->penetration_scale();
    if (!(penetration > 0.0 && penetration < scales.length)) continue;
    const double share = std::pow(penetration / scales.length, share_of_contacts);
    for (int j = 0; j < f.columns; ++j) {
      const int dof = system.dof()[static_cast<std::size_t>(f.dofs + j)];
      if (dof < 0) continue;
      const double size = dof % 3 == 2 ? 1.0 : scales.length;
      tolerances.q[dof] = std::min(tolerances.q[dof], rtol * share * size);
      tolerances.v[dof] = std::min(tolerances.v[dof], rtol * share * size / scales.time);
    }
  }
  tolerances.z.resize(system.states());
  for (const ForceSlot& f : system.forces()) {
    const std::vector<Channel> states = f.element->states();
    for (int i = 0; i < f.states; ++i)
      tolerances.z[f.z + i] = rtol * states[static_cast<std::size_t>(i)].scale;
  }
  if (mass == 0.0) mass = system.mean_mass();
  // A tenth of the kinetic energy at the scales: ledgers are judged by what is exchanged, often
  // less.
  tolerances.energy = 0.1 * rtol * mass * std::pow(scales.length / scales.time, 2);
  tolerances.baumgarte_rate = std::max(0.0, options.baumgarte_rate);
  // Steps of a method of order 5 go with the fifth root of the tolerance; half of that keeps the
  // gain well below what an explicit step bears.
  tolerances.natural_rate = std::pow(rtol, -0.1) / scales.time;
  tolerances.spectral_radius = options.spectral_radius;
  tolerances.order = options.order;
  return tolerances;
}

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

// A residual is known to epsilon x length, and rate^2 of it is added to the accelerations. Where
// that is a hundred times their tolerance, the steps only follow rounding (measured: a thousand
// times as many for IDA).
void check_baumgarte_rate(const System& system, const SimulationOptions& options) {
  const double time = system.scales().time;
  const double bound = 10.0 * std::sqrt(options.relative_tolerance / epsilon) / time;
  if (options.baumgarte_rate <= bound) return;
  throw ModelError(fmt::format(
      "simulation: baumgarte_rate = {:g} 1/s: at relative_tolerance = {:g} and a time scale of "
      "{:g} "
      "s accepted is up to {:.3g} 1/s; beyond it steps only follow rounding of the constraints",
      options.baumgarte_rate, options.relative_tolerance, time, bound));
}

/// How far the drivers go from where they are, as far as they can be asked beforehand.
struct Travel {
  double angle = 0.0;   // [rad]
  double length = 0.0;  // [m]
};

Travel travel_of_drivers(System& system, const State& state, double until) {
  constexpr int probes = 33;
  Travel travel;
  for (const ConstraintSlot& c : system.constraints()) {
    if (!c.element->rheonomic()) continue;
    std::vector<double> start(static_cast<std::size_t>(c.rows)), now = start;
    for (int i = 0; i <= probes; ++i) {
      const double t = state.t + (until - state.t) * i / probes;
      system.set_motion(t, state.q.data(), state.v.data());
      try {
        system.evaluate(c, {.phi = now.data()});
      } catch (const std::exception&) {  // a user's function; the run will tell if it gets there
        break;
      }
      if (i == 0) start = now;
      for (int k = 0; k < c.rows; ++k) {
        const auto at = static_cast<std::size_t>(k);
        double& far = system.measure(c.row + k) == Measure::length ? travel.length : travel.angle;
        if (const double way = std::abs(now[at] - start[at]); std::isfinite(way))
          far = std::max(far, way);
      }
    }
  }
  return travel;
}

/// Which bodies stand where the drivers want them, whatever the forces are.
std::vector<char> driven_bodies(const System& system) {
  const bool all = system.dofs() == system.rows() - static_cast<int>(system.dropped_rows().size());
  std::vector<char> driven(static_cast<std::size_t>(system.dofs() / 3), all ? 1 : 0);
  for (const ConstraintSlot& c : system.constraints())
    for (int j = 0; c.element->rheonomic() && j < c.columns; ++j)
      if (const int dof = system.dof()[static_cast<std::size_t>(c.dofs + j)]; dof >= 0)
        driven[static_cast<std::size_t>(dof / 3)] = 1;
  return driven;
}

// [J] The work of the drivers against springs and dampers that only driven bodies stretch, from
// their stiffness and damping at the start. Such a spring takes what it takes, however little the
// bodies move of their own: the kinetic energy knows nothing of it. It is an estimate for a floor
// at rounding and may be too large by orders.
double driven_exchange(System& system, const State& state, double until) {
  const Travel travel = travel_of_drivers(system, state, until);
  const double length = system.scales().length;
  const double turn = std::max(travel.angle, travel.length / length);
  const double shift = std::max(travel.length, length * std::min(travel.angle, 1.0));
  const std::vector<char> driven = driven_bodies(system);
  system.set_motion(state.t, state.q.data(), state.v.data());
  double work = 0.0;
  std::vector<double> dQ_dq, dQ_dv;
  for (const ForceSlot& f : system.forces()) {
    const auto free_body = [&](int j) {
      const int dof = system.dof()[static_cast<std::size_t>(f.dofs + j)];
      return dof >= 0 && driven[static_cast<std::size_t>(dof / 3)] == 0;
    };
    bool counts = f.element->contacts() == 0;
    for (int j = 0; j < f.columns && counts; ++j) counts = !free_body(j);
    if (!counts) continue;
    const auto n = static_cast<std::size_t>(f.columns);
    dQ_dq.assign(n * n, 0.0);
    dQ_dv.assign(n * n, 0.0);
    f.element->evaluate(system.force_input(f), {.dQ_dq = dQ_dq.data(), .dQ_dv = dQ_dv.data()});
    for (std::size_t j = 0; j < n; ++j) {
      const double way = j % 3 == 2 ? turn : shift;
      const double force =
          0.5 * std::abs(dQ_dq[j * n + j]) + std::abs(dQ_dv[j * n + j]) / (until - state.t);
      if (const double part = force * way * way; std::isfinite(part)) work = std::max(work, part);
    }
  }
  return work;
}

// A driver that stands at the start, goes and comes back is seen by none of the first error estimates.
constexpr double least_steps_driven = 32.0;

}  // namespace

Tolerances choose_tolerances(System& system, const State& state, const SimulationOptions& options) {
  check_baumgarte_rate(system, options);
  Tolerances tolerances = choose_tolerances(system, options);
  double exchanged = state.energy.size() > 0 ? state.energy.cwiseAbs().maxCoeff() : 0.0;
  const auto drives = [](const ConstraintSlot& c) { return c.element->rheonomic(); };
  if (std::ranges::any_of(system.constraints(), drives)) {
    exchanged = std::max(exchanged, driven_exchange(system, state, options.until));
    tolerances.longest_step = (options.until - state.t) / least_steps_driven;
  }
  tolerances.energy = std::max(tolerances.energy, rounding_of(exchanged));
  return tolerances;
}

}  // namespace yoke
