// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Assembly of a state, and what to say where equations contradict each other.
#include <algorithm>
#include <cmath>

#include <yoke/core/equations/consistency.hpp>
#include <yoke/core/equations/dynamics.hpp>
#include <yoke/core/equations/least_change.hpp>
#include <yoke/core/equations/linear/index.hpp>
#include <yoke/core/equations/massless.hpp>

namespace yoke {

namespace {
constexpr int max_assembly_iterations = 60;
}  // namespace

// Do the equations left out hold for the rates and accelerations found without them?
Outcome Dynamics::check_left_out(const State& state, const RankAnalysis& analysis) {
  system_.bind(state);
  system_.set_motion(state.t, state.q.data(), state.v.data());
  system_.calc_position_level(phi_.data());
  factorised_ = false;
  const auto refuse = [&](const char* what, const Disagreement& d, double sign, const char* per) {
    return Outcome{false,
                   fmt::format("'{}' is in conflict with {}: its {} stays violated by {:g} {}/{}",
                               system_.equation_name(d.row), partners_of(system_, analysis, d.row),
                               what, sign * d.residual,
                               system_.measure(d.row) == Measure::length ? "m" : "rad", per)};
  };
  if (const auto rate = find_disagreement(analysis, rate_terms(system_, state.v)))
    return refuse("rate", *rate, 1.0, "s");
  if (const auto acceleration = find_disagreement(analysis, acceleration_terms(system_, state)))
    return refuse("acceleration", *acceleration, -1.0, "s^2");
  return {};
}

Outcome Dynamics::assemble(State& state) {
  system_.bind(state);
  const Eigen::VectorXd q = state.q, v = state.v;
  bool positions = false;
  for (int round = 0; round * max_projection_iterations < max_assembly_iterations; ++round) {
    positions = project_positions(state.t, state.q.data());
    if (positions) break;
    if (!std::isfinite(worst_residual_))
      return {false, "a joint gives a value that is not finite at the start pose"};
    if (!factorised_) break;
  }
  if (positions && project_velocities(state.t, state.q.data(), state.v.data()) &&
      saddle_->well_conditioned())
    return finish_assembly(state);
  state.q = q;
  state.v = v;
  return assemble_from_afar(state);
}

Outcome Dynamics::finish_assembly(State& state) {
  if (system_.has_massless()) factorised_ = false;  // the blocks of G are computed anew
  if (std::string why = undetermined_motion(system_, state, length_metric_); !why.empty())
    return {false, std::move(why)};
  if (calc_accelerations(state)) return {};
  if (system_.not_finite().empty())
    return {false, "masses and joints do not determine the accelerations at the start pose"};
  if (system_.wedged())
    return {false,
            fmt::format("'{}' wedges at the start pose: no force satisfies the reaction it makes",
                        system_.not_finite())};
  return {false, fmt::format("accelerations at the start are not finite because of '{}'",
                             system_.not_finite())};
}

std::string Dynamics::impasse(const State& state) {
  factorised_ = false;  // the blocks of G are computed anew
  return impasse_at(system_, state, length_metric_);
}

Outcome Dynamics::explain_positions(const LeastChange& failed) const {
  const int worst = failed.worst_row();
  // Lengths and angles are compared in parts of the length scale and rad.
  const auto share = [&](int row) {
    const double size = system_.measure(row) == Measure::length ? system_.scales().length : 1.0;
    return std::abs(failed.residual()[at(row)]) / size;
  };
  // Where the sum of squares is least, what is left of the equations is in balance with each other.
  double largest = 0.0;
  for (int i = 0; i < system_.rows(); ++i)
    if (i != worst) largest = std::max(largest, share(i));
  std::string others;
  int count = 0;
  for (int i = 0; i < system_.rows() && count < 5; ++i) {
    if (i == worst || share(i) < 0.1 * largest || largest < 1e-3 * share(worst)) continue;
    others += (others.empty() ? ", in conflict with '" : ", '") + system_.equation_name(i) + "'";
    ++count;
  }
  return {false, fmt::format("the start pose cannot be assembled: '{}' stays violated by {:g} {}{}",
                             system_.equation_name(worst), failed.residual()[at(worst)],
                             system_.measure(worst) == Measure::length ? "m" : "rad", others)};
}

Outcome Dynamics::assemble_from_afar(State& state) {
  factorised_ = false;
  LeastChange nearest(system_, metric_of_masses(system_));
  if (!nearest.solve_positions(state.t, state.q.data())) return explain_positions(nearest);
  redundancy_ = analyse_redundancy(system_, state);
  if (!redundancy_.conflict.empty()) return {false, redundancy_.conflict};
  if (!nearest.solve_velocities(state.t, state.q.data(), state.v.data())) {
    const int worst = nearest.worst_row();
    return {false,
            fmt::format("'{}' is in conflict with {}: its rate stays violated by {:g} {}/s",
                        system_.equation_name(worst), partners_of(system_, redundancy_.here, worst),
                        nearest.residual()[at(worst)],
                        system_.measure(worst) == Measure::length ? "m" : "rad")};
  }
  return settle_redundancy(state);
}

Outcome Dynamics::settle_redundancy(State& state) {
  leave_out(redundancy_.here.dependent);
  if (Outcome outcome = finish_assembly(state); !outcome) return outcome;
  if (redundancy_.here.dependent.empty()) return {};
  if (Outcome outcome = check_left_out(state, redundancy_.here); !outcome) {
    if (redundancy_.singular_here)
      outcome.why +=
          "; the start is a singular position, where the velocities must be those of one "
          "of the branches that meet there: give them, or start beside it";
    return outcome;
  }
  if (!redundancy_.singular_here) return {};
  if (state.v.isZero(0.0) && system_.dofs() > redundancy_.rank)
    return {false, fmt::format(
                       "the start is a singular position at rest ('{}' depends on {} only there): "
                       "nothing says on which branch it moves on; give a velocity or start beside "
                       "it",
                       system_.equation_name(redundancy_.here.dependent.front()),
                       partners_of(system_, redundancy_.here, redundancy_.here.dependent.front()))};
  leave_out(redundancy_.redundant);
  return project_singular(state)
             ? Outcome{}
             : Outcome{false, "accelerations at the singular position of the start do not exist"};
}

std::string Dynamics::contradiction(double t, const double* q, double bound) {
  if (system_.left_out_rows().empty()) return {};
  system_.set_motion(t, q, zero_.data());
  // Without G, so that the factors stay those of the blocks.
  for (const ConstraintSlot& c : system_.constraints()) {
    bool left_out = false;
    for (int i = c.row; i < c.row + c.rows; ++i) left_out = left_out || system_.is_left_out(i);
    if (left_out) system_.evaluate(c, {.phi = phi_.data() + c.row});
  }
  for (const int row : system_.left_out_rows()) {
    const bool is_length = system_.measure(row) == Measure::length;
    const double residual = phi_[at(row)];
    if (std::abs(residual) <= bound * (is_length ? system_.scales().length : 1.0)) continue;
    return fmt::format(
        "'{}' was redundant at the start but is in conflict with {} at t = {:.9g} s: "
        "it is violated by {:g} {}",
        system_.equation_name(row), partners_of(system_, redundancy_.here, row), t, residual,
        is_length ? "m" : "rad");
  }
  return {};
}

}  // namespace yoke
