// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A state of one model as a start of another.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <yoke/integrators/studies/maps/poincare.hpp>

namespace yoke {

namespace {

/// The state as elements see it; valid while the state is.
std::vector<BodyMotion> motions_of(const Model& model, const State& state) {
  std::vector<BodyMotion> bodies(model.bodies().size());
  for (std::size_t i = 1; i < bodies.size(); ++i) {
    const Eigen::Index at = 3 * (static_cast<Eigen::Index>(i) - 1);
    bodies[i] = {.x = state.q[at],
                 .y = state.q[at + 1],
                 .angle = state.q[at + 2],
                 .c = std::cos(state.q[at + 2]),
                 .s = std::sin(state.q[at + 2]),
                 .vx = state.v[at],
                 .vy = state.v[at + 1],
                 .omega = state.v[at + 2]};
  }
  return bodies;
}

/// Phi and Phi_t of the drivers at a time, one after the other.
struct DriverEquations {
  std::vector<double> phi, phi_t;
};

DriverEquations drivers_at(const Model& model, const State& state,
                           const std::vector<BodyMotion>& bodies, double t) {
  DriverEquations all;
  const Motion motion{.t = t, .bodies = bodies, .inertia = model.bodies()};
  for (std::size_t i = 0; i < model.constraints().size(); ++i) {
    const Constraint& c = *model.constraints()[i];
    if (!c.rheonomic()) continue;
    const auto rows = static_cast<std::size_t>(c.rows());
    std::vector<double> phi(rows), phi_t(rows);
    c.evaluate(motion,
               {.phi = phi.data(),
                .phi_t = phi_t.data(),
                .parameters = state.parameters.data() + model.first_parameter_of_constraint(i)});
    all.phi.insert(all.phi.end(), phi.begin(), phi.end());
    all.phi_t.insert(all.phi_t.end(), phi_t.begin(), phi_t.end());
  }
  return all;
}

}  // namespace

double time_of_drivers(const Model& model, const State& state, double t) {
  constexpr int most_steps = 50;
  constexpr double small = 1e-13;
  const std::vector<BodyMotion> bodies = motions_of(model, state);
  double at = t;
  for (int i = 0; i < most_steps; ++i) {
    const DriverEquations e = drivers_at(model, state, bodies, at);
    double slope = 0.0, error = 0.0;  // of the least squares of all drivers
    for (std::size_t r = 0; r < e.phi.size(); ++r) {
      slope += e.phi_t[r] * e.phi_t[r];
      error += e.phi_t[r] * e.phi[r];
    }
    if (!(slope > 0.0) || !std::isfinite(error)) return t;
    const double step = error / slope;
    at -= step;
    if (std::abs(step) <= small * std::max(1.0, std::abs(at))) return at;
  }
  return t;
}

State carried_over(const Model& from_model, const State& from, const Model& to_model, State to) {
  const auto body_index = [](const Model& model, const std::string& name) {
    const auto found = std::ranges::find(model.bodies(), name, &Body::name);
    return found == model.bodies().end() ? Eigen::Index{0}
                                         : Eigen::Index{found - model.bodies().begin()};
  };
  for (std::size_t i = 1; i < to_model.bodies().size(); ++i) {
    const Eigen::Index there = body_index(from_model, to_model.bodies()[i].name);
    if (there == 0) continue;
    const Eigen::Index here = static_cast<Eigen::Index>(i);
    to.q.segment<3>(3 * (here - 1)) = from.q.segment<3>(3 * (there - 1));
    to.v.segment<3>(3 * (here - 1)) = from.v.segment<3>(3 * (there - 1));
  }
  Eigen::Index here = 0;
  for (const auto& force : to_model.forces()) {
    const auto count = static_cast<Eigen::Index>(force->states().size());
    Eigen::Index there = 0;
    for (const auto& other : from_model.forces()) {
      const auto others = static_cast<Eigen::Index>(other->states().size());
      if (other->name() == force->name() && others == count)
        to.z.segment(here, count) = from.z.segment(there, count);
      there += others;
    }
    here += count;
  }
  return to;
}

}  // namespace yoke
