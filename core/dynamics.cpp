// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/core/dynamics.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <yoke/core/rank.hpp>

namespace yoke {

namespace {
std::size_t at(int i) { return static_cast<std::size_t>(i); }
constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr int max_projection_iterations = 12;
constexpr int max_assembly_iterations = 60;
}  // namespace

Dynamics::Dynamics(const Model& model) : system_(model) {
  build_matrix();
  lu_.emplace(matrix_);
  const std::size_t size = at(system_.dofs() + system_.rows());
  b_.assign(size + 1, 0.0);
  phi_.assign(at(system_.rows()), 0.0);
  residual_.assign(at(system_.rows()), 0.0);
  zero_.assign(at(system_.dofs()), 0.0);
  q_factorised_.assign(at(system_.dofs()), 0.0);
}

void Dynamics::build_matrix() {
  const int n = system_.dofs();
  PatternBuilder pattern(n + system_.rows());
  for (int i = 0; i < n; ++i) pattern.add(i, i);
  stamp_start_.push_back(0);
  for (const ConstraintSlot& c : system_.constraints()) {
    for (int i = 0; i < c.rows; ++i) {
      for (int j = 0; j < c.columns; ++j) {
        const int dof = system_.dof()[at(c.dofs + j)];
        if (dof < 0 || !c.element->in_pattern(i, j)) continue;
        const int row = n + c.row + i;
        const int lower = pattern.add(row, dof);
        stamps_.push_back({c.block + i * c.columns + j, lower, pattern.add(dof, row)});
      }
    }
    stamp_start_.push_back(stamps_.size());
  }
  std::vector<int> slot;
  matrix_ = pattern.compile(slot);
  for (int i = 0; i < n; ++i) matrix_.value[at(slot[at(i)])] = system_.mass()[at(i)];
  for (Stamp& s : stamps_) {
    s.lower = slot[at(s.lower)];
    s.upper = slot[at(s.upper)];
  }
}

void Dynamics::reset() {
  lu_->reset();
  factorised_ = false;
}

void Dynamics::stamp(std::size_t constraint) {
  const double* G = system_.G();
  double* value = matrix_.value.data();
  for (std::size_t i = stamp_start_[constraint]; i < stamp_start_[constraint + 1]; ++i) {
    const Stamp& s = stamps_[i];
    value[s.lower] = value[s.upper] = G[s.entry];
  }
}

bool Dynamics::same_as_factorised(double t, const double* q) const {
  return factorised_ && t == t_factorised_ &&
         std::memcmp(q, q_factorised_.data(), sizeof(double) * q_factorised_.size()) == 0;
}

bool Dynamics::factorise_at(double t, const double* q) {
  factorised_ = lu_->factorise(matrix_);
  t_factorised_ = t;
  std::copy_n(q, q_factorised_.size(), q_factorised_.begin());
  return factorised_;
}

bool Dynamics::calc_accelerations(double t, const double* q, const double* v, const double* z,
                                  double* a, double* lambda, double* z_dot,
                                  double* quadrature_rates, const Baumgarte* stabilisation) {
  ++evaluations_;
  const int n = system_.dofs();
  double* gamma = b_.data() + n;
  system_.set_motion(t, q, v);
  system_.set_states(z);
  // A step ends with a projection whose factors serve the first evaluation of the next step.
  const bool reuse = same_as_factorised(t, q);
  const auto constraints = system_.constraints();
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    const ConstraintSlot& c = constraints[i];
    c.element->evaluate(system_.motion(),
                        {.phi = stabilisation != nullptr ? phi_.data() + c.row : nullptr,
                         .G = reuse ? nullptr : system_.G() + c.block,
                         .gamma = gamma + c.row});
    if (!reuse) stamp(i);
  }
  if (stabilisation != nullptr) {
    system_.calc_velocity_residual(residual_.data());
    const double damping = 2.0 * stabilisation->alpha;
    const double stiffness = stabilisation->beta * stabilisation->beta;
    for (int i = 0; i < system_.rows(); ++i)
      gamma[i] -= damping * residual_[at(i)] + stiffness * phi_[at(i)];
  }
  if (!reuse && !factorise_at(t, q)) return false;

  // Forces on the ground are collected in b_[n], which belongs to gamma: it is put back afterwards.
  std::fill_n(b_.begin(), n, 0.0);
  const double first_gamma = gamma[0];
  system_.add_forces(b_.data(), z_dot, quadrature_rates);
  gamma[0] = first_gamma;
  lu_->solve(b_.data());

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

bool Dynamics::calc_accelerations(State& state) {
  system_.bind(state);
  return calc_accelerations(state.t, state.q.data(), state.v.data(), state.z.data(), state.a.data(),
                            state.lambda.data(), nullptr, nullptr);
}

double Dynamics::position_tolerance(const double* q) const {
  double size = 1.0;  // largest coordinate in units of the length scale or 1 rad
  for (int i = 0; i < system_.dofs(); i += 3) {
    const double extent = std::max(std::abs(q[i]), std::abs(q[i + 1])) / system_.scales().length;
    size = std::max({size, extent, std::abs(q[i + 2])});
  }
  return 16.0 * eps * size;
}

bool Dynamics::improve_position(double* q) {
  const int n = system_.dofs();
  std::fill_n(b_.begin(), n, 0.0);
  for (int i = 0; i < system_.rows(); ++i) b_[at(n + i)] = -phi_[at(i)];
  lu_->solve(b_.data());
  for (int i = 0; i < n; ++i) {
    if (!std::isfinite(b_[at(i)])) return false;
    q[i] += b_[at(i)];
  }
  return true;
}

bool Dynamics::project_positions(double t, double* q) {
  const double tolerance = position_tolerance(q);
  double last = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < max_projection_iterations; ++iteration) {
    system_.set_motion(t, q, zero_.data());
    system_.calc_position_level(phi_.data());
    const double norm = system_.norm(phi_.data(), &worst_row_);
    worst_residual_ = system_.rows() > 0 ? phi_[at(worst_row_)] : 0.0;
    // Newton squares the error; where it stops doing so, rounding is all that is left.
    if (norm <= tolerance || (norm < 1e3 * tolerance && norm > 0.5 * last)) return true;
    if (!std::isfinite(norm)) return false;
    last = norm;
    if (!same_as_factorised(t, q)) {
      for (std::size_t i = 0; i < system_.constraints().size(); ++i) stamp(i);
      if (!factorise_at(t, q)) return false;
    }
    if (!improve_position(q)) return false;
  }
  return false;
}

bool Dynamics::project_velocities(double t, const double* q, double* v) {
  const int n = system_.dofs();
  system_.set_motion(t, q, v);
  if (!same_as_factorised(t, q)) {
    system_.calc_position_level(phi_.data());
    for (std::size_t i = 0; i < system_.constraints().size(); ++i) stamp(i);
    if (!factorise_at(t, q)) return false;
  }
  system_.calc_velocity_residual(residual_.data());
  std::fill_n(b_.begin(), n, 0.0);
  for (int i = 0; i < system_.rows(); ++i) b_[at(n + i)] = -residual_[at(i)];
  lu_->solve(b_.data());
  for (int i = 0; i < n; ++i) {
    if (!std::isfinite(b_[at(i)])) return false;
    v[i] += b_[at(i)];
  }
  return true;
}

bool Dynamics::project(State& state) {
  system_.bind(state);
  return project_positions(state.t, state.q.data()) &&
         project_velocities(state.t, state.q.data(), state.v.data()) && calc_accelerations(state);
}

Outcome Dynamics::explain_singular(const State& state) {
  system_.set_motion(state.t, state.q.data(), state.v.data());
  system_.calc_position_level(phi_.data());
  const std::vector<int> dependent = find_dependent_rows(system_);
  if (dependent.empty()) return {false, "the mass matrix or a joint is singular at the start pose"};
  std::string names;
  for (const int row : dependent)
    names += (names.empty() ? "'" : ", '") + system_.equation_name(row) + "'";
  return {false, fmt::format("the constraints are redundant or in conflict: {} {} already "
                             "determined by the other joints and drivers; remove or change one",
                             names, dependent.size() == 1 ? "is" : "are")};
}

Outcome Dynamics::assemble(State& state) {
  system_.bind(state);
  const Eigen::VectorXd start = state.q;
  const Outcome not_finite{false, "a joint gives a value that is not finite at the start pose"};
  for (int round = 0; round * max_projection_iterations < max_assembly_iterations; ++round) {
    if (project_positions(state.t, state.q.data())) {
      if (!project_velocities(state.t, state.q.data(), state.v.data()))
        return explain_singular(state);
      if (!calc_accelerations(state))
        return {false, fmt::format("accelerations at the start are not finite because of '{}'",
                                   system_.not_finite())};
      return {};
    }
    if (!std::isfinite(worst_residual_)) return not_finite;
    // Singular where the user put it: dependent equations. Singular where the search ended: it went
    // as far as it could towards a pose that does not exist.
    if (!factorised_ && state.q == start) return explain_singular(state);
    if (!factorised_) break;
  }
  const bool length = system_.measure(worst_row_) == Measure::length;
  return {false,
          fmt::format("the start pose cannot be assembled: '{}' stays violated by {:g} {}",
                      system_.equation_name(worst_row_), worst_residual_, length ? "m" : "rad")};
}

double Dynamics::effective_mass(const ForceSlot& slot, const double* direction) {
  std::fill(b_.begin(), b_.end(), 0.0);
  for (int j = 0; j < slot.columns; ++j)
    if (const int dof = system_.dof()[at(slot.dofs + j)]; dof >= 0) b_[at(dof)] += direction[j];
  lu_->solve(b_.data());
  double mobility = 0.0;
  for (int j = 0; j < slot.columns; ++j)
    if (const int dof = system_.dof()[at(slot.dofs + j)]; dof >= 0)
      mobility += direction[j] * b_[at(dof)];
  return mobility > 0.0 ? 1.0 / mobility : std::numeric_limits<double>::infinity();
}

Reaction Dynamics::reaction(std::size_t constraint, const double* lambda) const {
  const ConstraintSlot& c = system_.constraints()[constraint];
  const double* G = system_.G() + c.block;
  const std::size_t body = c.element->reaction_body();
  double f[3] = {0.0, 0.0, 0.0};
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < c.rows; ++i)
      f[j] -= G[i * c.columns + 3 * static_cast<int>(body) + j] * lambda[c.row + i];
  const Vec2 force(f[0], f[1]);
  const Motion& motion = system_.motion();
  const Vec2 centre = motion[c.element->bodies()[body]].position();
  const Vec2 arm = c.element->reaction_point(motion) - centre;
  return {.force = force, .moment = f[2] - cross(arm, force)};
}

double Dynamics::position_violation(const State& state) {
  system_.set_motion(state.t, state.q.data(), state.v.data());
  system_.calc_position_level(phi_.data());
  double worst = 0.0;
  for (const double r : phi_) worst = std::max(worst, std::abs(r));
  factorised_ = false;  // G changed under the factors
  return worst;
}

double Dynamics::velocity_violation(const State& state) {
  system_.set_motion(state.t, state.q.data(), state.v.data());
  system_.calc_position_level(phi_.data());
  system_.calc_velocity_residual(residual_.data());
  double worst = 0.0;
  for (const double r : residual_) worst = std::max(worst, std::abs(r));
  factorised_ = false;
  return worst;
}

}  // namespace yoke
