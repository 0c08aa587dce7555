// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/core/equations/dynamics.hpp>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <yoke/core/equations/least_change.hpp>
#include <yoke/core/equations/linear/index.hpp>

namespace yoke {

Dynamics::Dynamics(const Model& model, LinearSolver choice)
    : system_(model), choice_(choice), length_metric_(metric_of_lengths(system_)) {
  saddle_.emplace(layout(), choice_);
  if (!system_.loaded().empty()) loaded_.emplace(system_, *saddle_);
  const std::size_t size = at(system_.dofs() + system_.rows());
  b_.assign(size + 1, 0.0);
  free_ = b_;
  shared_.assign(at(system_.rows()), 0.0);
  phi_.assign(at(system_.rows()), 0.0);
  residual_.assign(at(system_.rows()), 0.0);
  zero_.assign(at(system_.dofs()), 0.0);
  q_factorised_.assign(at(system_.dofs()), 0.0);
}

SaddleLayout Dynamics::layout() const {
  SaddleLayout layout{.mass = system_.mass(),
                      .dof = system_.dof(),
                      .blocks = {},
                      .entries = [this] { return entries(); },
                      .left_out = system_.left_out_rows(),
                      .switched = {},
                      .rows = system_.rows()};
  for (const ConstraintSlot& c : system_.holds()) layout.switched.push_back(c.row);
  layout.blocks.reserve(system_.constraints().size());
  for (const ConstraintSlot& c : system_.constraints())
    layout.blocks.push_back({c.row, c.rows, c.columns, c.dofs, c.block});
  return layout;
}

std::vector<JacobianEntry> Dynamics::entries() const {
  std::vector<JacobianEntry> entries;
  entries.reserve(system_.jacobian_size());
  for (const ConstraintSlot& c : system_.constraints())
    for (int i = 0; i < c.rows; ++i)
      for (int j = 0; j < c.columns; ++j) {
        const int dof = system_.dof()[at(c.dofs + j)];
        if (dof < 0 || !c.element->in_pattern(i, j) || system_.is_left_out(c.row + i)) continue;
        entries.push_back({c.block + i * c.columns + j, c.row + i, dof});
      }
  return entries;
}

void Dynamics::leave_out(const std::vector<int>& rows) {
  if (rows == system_.left_out_rows()) return;
  system_.leave_out(rows);
  retired_ = counters();
  const bool loaded = loaded_.has_value();
  loaded_.reset();
  saddle_.emplace(layout(), choice_);
  if (loaded) loaded_.emplace(system_, *saddle_);
  lengths_.reset();
  factorised_ = false;
  weakest_.clear();
}

FactorCounters Dynamics::counters() const {
  FactorCounters sum = retired_;
  const auto add = [&](const FactorCounters& now) {
    sum.refactorisations += now.refactorisations;
    sum.fresh += now.fresh;
  };
  add(saddle_->counters());
  if (loaded_) add(loaded_->counters());
  return sum;
}

void Dynamics::reset() {
  saddle_->reset();
  if (loaded_) loaded_->reset();
  lengths_.reset();
  factorised_ = false;
  weakest_.clear();
}

bool Dynamics::same_as_factorised(double t, const double* q) const {
  return factorised_ && t == t_factorised_ && version_factorised_ == system_.hold_version() &&
         std::memcmp(q, q_factorised_.data(), sizeof(double) * q_factorised_.size()) == 0;
}

bool Dynamics::factorise_at(double t, const double* q) {
  factorised_ = saddle_->factorise(system_.G(), system_.dropped());
  version_factorised_ = system_.hold_version();
  t_factorised_ = t;
  std::copy_n(q, q_factorised_.size(), q_factorised_.begin());
  return factorised_;
}

bool Dynamics::calc_accelerations(const Instant& instant, const Accelerations& out,
                                  const Baumgarte* stabilisation) {
  const auto [t, q, v, z] = instant;
  const auto [a, lambda, z_dot, quadrature_rates] = out;
  ++evaluations_;
  const int n = system_.dofs();
  double* gamma = b_.data() + n;
  system_.set_motion(t, q, v);
  system_.set_states(z);
  // A step ends with a projection whose factors serve the first evaluation of the next step.
  const bool reuse = same_as_factorised(t, q);
  for (const ConstraintSlot& c : system_.constraints())
    system_.evaluate(c, {.phi = stabilisation != nullptr ? phi_.data() + c.row : nullptr,
                         .G = reuse ? nullptr : system_.G() + c.block,
                         .gamma = gamma + c.row});
  for (const int row : system_.dropped_rows()) gamma[row] = 0.0;
  if (stabilisation != nullptr) {
    system_.calc_velocity_residual(residual_.data());
    const double damping = 2.0 * stabilisation->alpha;
    const double stiffness = stabilisation->beta * stabilisation->beta;
    for (int i = 0; i < system_.rows(); ++i)
      if (!system_.is_dropped(i)) gamma[i] -= damping * residual_[at(i)] + stiffness * phi_[at(i)];
  }
  if (!reuse && !factorise_at(t, q)) return false;

  // Forces on the ground are collected in b_[n], which belongs to gamma: it is put back afterwards.
  std::fill_n(b_.begin(), n, 0.0);
  const double first_gamma = gamma[0];
  if (loaded_)
    system_.add_unloaded_forces(b_.data(), z_dot, quadrature_rates);
  else
    system_.add_forces(b_.data(), z_dot, quadrature_rates);
  gamma[0] = first_gamma;
  if (!loaded_)
    saddle_->solve(b_.data());
  else if (!solve_loaded(z_dot, quadrature_rates))
    return false;

  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < b_.size(); ++i) sum += b_[i];
  if (z_dot != nullptr)
    for (int i = 0; i < system_.states(); ++i) sum += z_dot[i];
  if (!std::isfinite(sum)) {
    system_.blame_not_finite();
    factorised_ = false;
    return false;
  }
  std::copy_n(b_.begin(), n, a);
  if (lambda != nullptr) std::copy_n(b_.begin() + n, system_.rows(), lambda);
  if (quadrature_rates != nullptr) system_.add_driver_power(gamma, quadrature_rates);
  return true;
}

bool Dynamics::solve_loaded(double* z_dot, double* quadrature_rates) {
  free_ = b_;
  saddle_->solve(b_.data());
  if (!loaded_->solve(free_.data(), b_.data())) {
    if (!std::ranges::all_of(free_, [](double x) { return std::isfinite(x); }))
      system_.blame_not_finite();
    return false;
  }
  system_.set_multipliers(nullptr);
  if (z_dot == nullptr && quadrature_rates == nullptr) return true;
  system_.set_multipliers(b_.data() + system_.dofs());
  std::ranges::fill(free_, 0.0);
  system_.add_loaded_forces(free_.data(), z_dot, quadrature_rates);
  system_.set_multipliers(nullptr);
  return true;
}

bool Dynamics::calc_accelerations(State& state) {
  system_.bind(state);
  return calc_accelerations(
      {.t = state.t, .q = state.q.data(), .v = state.v.data(), .z = state.z.data()},
      {.a = state.a.data(), .lambda = state.lambda.data()});
}

double Dynamics::position_tolerance(const double* q) const {
  double size = 1.0;  // largest coordinate in units of the length scale or 1 rad
  for (int i = 0; i < system_.dofs(); i += 3) {
    const double extent = std::max(std::abs(q[i]), std::abs(q[i + 1])) / system_.scales().length;
    size = std::max({size, extent, std::abs(q[i + 2])});
  }
  return 16.0 * machine_epsilon * size;
}

bool Dynamics::improve_position(double* q) {
  const int n = system_.dofs();
  std::fill_n(b_.begin(), n, 0.0);
  for (int i = 0; i < system_.rows(); ++i)
    b_[at(n + i)] = system_.is_dropped(i) ? 0.0 : -phi_[at(i)];
  saddle_->solve_nearly(b_.data());
  for (int i = 0; i < n; ++i) {
    if (!std::isfinite(b_[at(i)])) return false;
    q[i] += b_[at(i)];
  }
  return true;
}

bool Dynamics::project_positions(double t, double* q, Correction how) {
  const double tolerance = position_tolerance(q);
  double last = std::numeric_limits<double>::infinity();
  factors_for_ = last;
  for (int iteration = 0; iteration < max_projection_iterations; ++iteration) {
    system_.set_motion(t, q, zero_.data());
    system_.calc_position_level(phi_.data());
    const double norm = system_.norm(phi_.data(), &worst_row_);
    worst_residual_ = system_.rows() > 0 ? phi_[at(worst_row_)] : 0.0;
    const bool enough = norm <= tolerance &&
                        (how == Correction::coarse || (how == Correction::smooth && iteration > 0));
    // Newton squares the error; where it stops doing so, rounding is all that is left.
    if (enough || norm == 0.0 || (norm < 1e3 * tolerance && norm > 0.5 * last)) return true;
    if (!std::isfinite(norm)) return false;
    // With the factors of the first correction another one leaves as little where that was small.
    const bool chord = iteration == 1 && norm * norm <= 0.1 * tolerance * last;
    last = norm;
    if (!chord) {
      if (!same_as_factorised(t, q) && !factorise_at(t, q)) return false;
      factors_for_ = norm;
    }
    if (!improve_position(q)) return false;
  }
  return false;
}

bool Dynamics::project_velocities(double t, const double* q, double* v, Rows which) {
  system_.set_motion(t, q, v);
  if (!same_as_factorised(t, q)) {
    system_.calc_position_level(phi_.data());
    if (!factorise_at(t, q)) return false;
  }
  return improve_velocity(v, which);
}

bool Dynamics::project(double t, double* q, double* v, Correction how) {
  if (!project_positions(t, q, how)) return false;
  system_.set_motion(t, q, v);
  // Factors of a position within rounding of this one serve as well.
  const bool serve = how == Correction::smooth && factors_for_ <= 1e3 * position_tolerance(q);
  if (!serve && !same_as_factorised(t, q) && !factorise_at(t, q)) return false;
  return improve_velocity(v);
}

// At the motion set, with the factors there are.
bool Dynamics::improve_velocity(double* v, Rows which) {
  const int n = system_.dofs();
  system_.calc_velocity_residual(residual_.data());
  std::fill_n(b_.begin(), n, 0.0);
  for (int i = 0; i < system_.rows(); ++i)
    b_[at(n + i)] = system_.is_dropped(i) ? 0.0 : -residual_[at(i)];
  if (which == Rows::of_positions) std::fill(b_.begin() + n + system_.joint_rows(), b_.end(), 0.0);
  saddle_->solve_nearly(b_.data());
  for (int i = 0; i < n; ++i) {
    if (!std::isfinite(b_[at(i)])) return false;
    const double before = v[i];
    v[i] += b_[at(i)];
    // What is left of a velocity that was taken back whole is rounding: what is held rests to the last bit.
    if (std::abs(v[i]) <= 4.0 * machine_epsilon * std::abs(before)) v[i] = 0.0;
  }
  return true;
}

bool Dynamics::project(State& state) {
  system_.bind(state);
  if (project(state.t, state.q.data(), state.v.data()) && calc_accelerations(state)) return true;
  return project_singular(state);
}

// Where the rank falls short, what is left of the equations still has a solution.
bool Dynamics::project_singular(State& state) {
  if (!system_.not_finite().empty() || !state.q.allFinite() || !state.v.allFinite()) return false;
  const std::vector<int> left_out = system_.left_out_rows();
  LeastChange nearest(system_, metric_of_masses(system_), {}, dropped_marks());
  factorised_ = false;  // the blocks of G are no longer those of the factors
  if (!nearest.solve_positions(state.t, state.q.data())) return false;
  if (!nearest.solve_velocities(state.t, state.q.data(), state.v.data())) return false;
  const RankAnalysis here = analyse_rank(system_);
  if (here.dependent.empty()) return false;
  leave_out(here.dependent);
  const bool solved = calc_accelerations(state);
  const bool consistent = solved && check_left_out(state, here);
  leave_out(left_out);
  if (!consistent) return false;
  const Eigen::MatrixXd u = here.null_space;
  state.lambda -= u * (u.transpose() * u).ldlt().solve(u.transpose() * state.lambda);
  return true;
}

}  // namespace yoke
