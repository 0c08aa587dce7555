// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/analyses/details/rest_equations.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <yoke/core/equations/least_change.hpp>

namespace yoke {

namespace {

constexpr double regularisation = 1e-9;      // scaled, where the derivative is singular
constexpr double small_displacement = 1e-9;  // length scales or rad
constexpr double rounding_share = 256.0 * std::numeric_limits<double>::epsilon();  // of the terms

using Vector = Eigen::VectorXd;

std::size_t at(Eigen::Index i) { return static_cast<std::size_t>(i); }

}  // namespace

Statics::Statics(const Model& model, const State& start, const EquilibriumOptions& options)
    : dynamics_(model),
      system_(dynamics_.system()),
      state_(start),
      load_factor_(options.load_factor) {
  state_.t = options.t;
  state_.v.setZero();
  if (const Outcome outcome = dynamics_.assemble(state_); !outcome) throw ModelError(outcome.why);
  // Multipliers of the pose released from rest: without any, the derivative of a pendulum is
  // singular.
  state_.v.setZero();
  dynamics_.calc_accelerations(state_);
  state_.a.setZero();
  n_ = system_.dofs(), nz_ = system_.states(), rows_ = system_.rows();
  length_ = system_.natural_length();
  system_.set_scales({.length = length_, .time = 1.0});
  choose_loads(model, options);
  start_ = state_.q;
  choose_force();
}

void Statics::set_load(double part) {
  for (std::size_t i = 0; i < share_.size(); ++i)
    share_[i] = is_load_[i] ? part * load_factor_ : 1.0;
}

Vector Statics::unknowns() const {
  Vector x(n_ + nz_ + rows_);
  for (Eigen::Index i = 0; i < n_; ++i) x[i] = (state_.q[i] - start_[i]) / size(i);
  x.segment(n_, nz_) = state_.z;
  for (Eigen::Index i = 0; i < rows_; ++i)
    x[n_ + nz_ + i] = state_.lambda[i] * measure(i) / (force_ * length_);
  return x;
}

void Statics::set(const Vector& x) {
  for (Eigen::Index i = 0; i < n_; ++i) state_.q[i] = start_[i] + size(i) * x[i];
  state_.z = x.segment(n_, nz_);
  for (Eigen::Index i = 0; i < rows_; ++i)
    state_.lambda[i] = x[n_ + nz_ + i] * (force_ * length_) / measure(i);
  system_.bind(state_);
  system_.set_motion(state_.t, state_.q.data(), state_.v.data());
  find_contacts([](const double*) { return 1.0; }, true);
}

bool Statics::residual(const Vector& x, Vector& F) {
  if (!x.allFinite()) return false;
  set(x);
  if (beyond_law_) return false;
  F = Vector::Zero(n_ + nz_ + rows_ + 1);  // the last entry is the ground's
  Vector force = Vector::Zero(n_ + 1), z_dot = Vector::Zero(nz_);
  add_forces(force, z_dot);
  Vector phi = Vector::Zero(rows_);
  system_.calc_position_level(phi.data());
  Vector lambda = state_.lambda;
  for (const int row : system_.dropped_rows()) lambda[row] = 0.0;
  system_.subtract_constraint_forces(lambda.data(), force.data());
  for (Eigen::Index i = 0; i < n_; ++i) F[i] = force[i] * size(i) / (force_ * length_);
  F.segment(n_, nz_) = z_dot;
  for (Eigen::Index i = 0; i < rows_; ++i)
    F[n_ + nz_ + i] =
        system_.is_dropped(static_cast<int>(i)) ? x[n_ + nz_ + i] : phi[i] / measure(i);
  F.conservativeResize(n_ + nz_ + rows_);
  return F.allFinite();
}

const Tangent::Matrix& Statics::calc_matrix(const Vector& x, double inertia) {
  set(x);
  const Tangent t = calc_tangent(system_, state_, share_);
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](const Tangent::Matrix& m, Eigen::Index row, Eigen::Index column,
                       const auto& factor, bool transpose = false) {
    for (int k = 0; k < m.outerSize(); ++k)
      for (Tangent::Matrix::InnerIterator it(m, k); it; ++it) {
        const Eigen::Index i = transpose ? it.col() : it.row(), j = transpose ? it.row() : it.col();
        entries.emplace_back(static_cast<int>(row + i), static_cast<int>(column + j),
                             it.value() * factor(i, j));
      }
  };
  const double unit = 1.0 / (force_ * length_);
  const Eigen::Index l = n_ + nz_;
  const auto stiffness = [&](auto i, auto j) { return unit * size(i) * size(j); };
  add(t.Q_q, 0, 0, stiffness);
  add(t.K_lambda, 0, 0, [&](auto i, auto j) { return -stiffness(i, j); });
  add(t.Q_z, 0, n_, [&](auto i, auto) { return unit * size(i); });
  add(t.z_q, n_, 0, [&](auto, auto j) { return size(j); });
  add(t.z_z, n_, n_, [](auto, auto) { return 1.0; });
  add(t.G, l, 0, [&](auto i, auto j) { return size(j) / measure(i); });
  add(
      t.G, 0, l, [&](auto i, auto j) { return -size(i) / measure(j); }, true);
  for (const int row : system_.dropped_rows())
    entries.emplace_back(static_cast<int>(l) + row, static_cast<int>(l) + row, 1.0);
  // A state that nothing moves at rest, as bristles between surfaces that do not slide, stays.
  const Vector idle = t.z_q.cwiseAbs() * Vector::Ones(n_) + t.z_z.cwiseAbs() * Vector::Ones(nz_);
  for (Eigen::Index i = 0; i < nz_; ++i)
    if (idle[i] == 0.0)
      entries.emplace_back(static_cast<int>(n_ + i), static_cast<int>(n_ + i), -1.0);
  matrix_.resize(l + rows_, l + rows_);
  matrix_.setFromTriplets(entries.begin(), entries.end());
  if (inertia > 0.0) add_inertia(inertia);
  return matrix_;
}

bool Statics::factorise(const Vector& x, double inertia) {
  calc_matrix(x, inertia);
  under_ = 1.0 + inertia;
  if (inertia > 0.0) moderate();
  lu_.compute(matrix_);
  if (lu_.info() == Eigen::Success) return true;
  add_inertia(regularisation);
  lu_.compute(matrix_);
  return lu_.info() == Eigen::Success;
}

// Under much inertia nearly nothing moves, and beside 1e16 on the diagonal of the forces the elimination
// of the joints would lose itself in rounding. What moves is therefore found times 1 + inertia.
void Statics::moderate() {
  for (int k = 0; k < n_ + nz_; ++k)
    for (Tangent::Matrix::InnerIterator it(matrix_, k); it; ++it)
      if (it.row() < n_) it.valueRef() /= under_;
}

bool Statics::solve(Vector& b) {
  b.segment(n_, nz_) *= under_;
  for (Eigen::Index i = 0; i < rows_; ++i)
    if (!system_.is_dropped(static_cast<int>(i))) b[n_ + nz_ + i] *= under_;
  b = lu_.solve(b).eval();
  b.head(n_ + nz_) /= under_;
  return b.allFinite();
}

NonlinearProblem Statics::problem() {
  return {.residual = [this](const Vector& x, Vector& F) { return residual(x, F); },
          .factorise = [this](const Vector& x) { return factorise(x); },
          .solve = [this](Vector& b) { return solve(b); },
          .multiply = [this](const Vector& x, Vector& Jx) { multiply(x, Jx); }};
}

double Statics::largest_displacement(const Vector& dx) const {
  double largest = 0.0;
  for (Eigen::Index i = 0; i < n_; i += 3) largest = std::max(largest, dx.segment<2>(i).norm());
  return largest;
}

double Statics::largest_turn(const Vector& dx) const {
  double largest = 0.0;
  for (Eigen::Index i = 2; i < n_; i += 3) largest = std::max(largest, std::abs(dx[i]));
  return largest;
}

bool Statics::is_rounding(const Vector& x, const Vector& F) {
  set(x);
  const Tangent t = calc_tangent(system_, state_, share_);
  // Of coordinates: an angle enters by its sine, which is of order one however small it is.
  Vector q = state_.q.cwiseAbs(), lambda = state_.lambda.cwiseAbs();
  for (Eigen::Index i = 2; i < n_; i += 3) q[i] = std::max(q[i], 1.0);
  Vector force =
      t.Q_q.cwiseAbs() * q + t.K_lambda.cwiseAbs() * q + t.G.cwiseAbs().transpose() * lambda;
  std::vector<double> local;
  for (std::size_t k = 0; k < system_.forces().size(); ++k) {
    const ForceSlot& f = system_.forces()[k];
    local.assign(at(f.columns), 0.0);
    f.element->evaluate(system_.force_input(f), {.Q = local.data()});
    for (Eigen::Index j = 0; j < f.columns; ++j)
      if (const int dof = system_.dof()[at(f.dofs + j)]; dof >= 0)
        force[dof] += std::abs(share_[k] * local[at(j)]);
  }
  const Vector phi = t.G.cwiseAbs() * q;
  const Vector rate = t.z_q.cwiseAbs() * q + t.z_z.cwiseAbs() * state_.z.cwiseAbs();
  // Joints hand on what rounding leaves of the largest force.
  double largest = 0.0;
  for (Eigen::Index i = 0; i < n_; ++i) largest = std::max(largest, force[i] * size(i));
  for (Eigen::Index i = 0; i < n_; ++i)
    if (!(std::abs(F[i]) <= rounding_share * largest / (force_ * length_))) return false;
  for (Eigen::Index i = 0; i < nz_; ++i)
    if (!(std::abs(F[n_ + i]) <= rounding_share * rate[i])) return false;
  for (Eigen::Index i = 0; i < rows_; ++i)
    if (!(std::abs(F[n_ + nz_ + i]) <= rounding_share * std::max(1.0, phi[i] / measure(i))))
      return false;
  return true;
}

double Statics::work(const Vector& x, const Vector& y, int points) {
  constexpr double node[] = {0.0, 0.5384693101056831, -0.5384693101056831, 0.9061798459386640,
                             -0.9061798459386640};
  constexpr double weight[] = {0.5688888888888889, 0.4786286704993665, 0.4786286704993665,
                               0.2369268850561891, 0.2369268850561891};
  double sum = 0.0;
  for (int k = 0; k < points; ++k) {
    const Vector between = points == 1 ? x : x + 0.5 * (1.0 + node[k]) * (y - x);
    set(between);
    Vector force = Vector::Zero(n_ + 1), z_dot = Vector::Zero(nz_);
    add_forces(force, z_dot);
    double power = 0.0;
    for (Eigen::Index i = 0; i < n_; ++i) power += force[i] * size(i) * (y[i] - x[i]);
    sum += (points == 1 ? 1.0 : 0.5 * weight[k]) * power;
  }
  return sum / (force_ * length_);
}

double Statics::inertial(const Vector& d) const { return d.head(n_).squaredNorm(); }

bool Statics::project(Vector& x) {
  set(x);
  if (!dynamics_.project_positions(state_.t, state_.q.data()) && !project_in_metric()) return false;
  for (Eigen::Index i = 0; i < n_; ++i) x[i] = (state_.q[i] - start_[i]) / size(i);
  return true;
}

// At a dead centre of massless links the masses do not say which pose is the nearest.
bool Statics::project_in_metric() {
  if (!system_.has_massless()) return false;
  std::vector<char> dropped(at(rows_), 0);
  for (const int row : system_.dropped_rows()) dropped[at(row)] = 1;
  LeastChange nearest(system_, metric_of_masses(system_), {}, dropped);
  return nearest.solve_positions(state_.t, state_.q.data());
}

void Statics::displace(const Vector& direction, double size_of_move, Vector& x) const {
  Vector scaled(n_);
  for (Eigen::Index i = 0; i < n_; ++i) scaled[i] = direction[i] / size(i);
  x.head(n_) += size_of_move / scaled.cwiseAbs().maxCoeff() * scaled;
}

void Statics::blame(const Vector& F, Equilibrium& e) const {
  Eigen::Index worst = 0;
  if (F.size() == 0) return;
  F.cwiseAbs().maxCoeff(&worst);
  const double value = F[worst];
  if (worst < n_) {
    e.worst = system_.model().bodies()[at(worst / 3 + 1)].name;
    e.residual = value * force_ * length_ / size(worst);
    e.unit = worst % 3 == 2 ? "N m" : "N";
  } else if (worst < n_ + nz_) {
    for (const ForceSlot& f : system_.forces())
      if (worst - n_ >= f.z && worst - n_ < f.z + f.states) e.worst = f.element->name();
    e.residual = value;
    e.unit = "1/s";
  } else {
    const int row = static_cast<int>(worst - n_ - nz_);
    e.worst = system_.equation_name(row);
    e.residual = value * measure(row);
    e.unit = system_.measure(row) == Measure::length ? "m" : "rad";
  }
}

const std::string& Statics::farthest_body() const {
  Eigen::Index worst = 0;
  (state_.q - start_).cwiseAbs().maxCoeff(&worst);
  return system_.model().bodies()[at(worst / 3 + 1)].name;
}

State Statics::finish() {
  State state = state_;
  dynamics_.calc_accelerations(state);  // factors, for the effective masses
  system_.bind(state_);
  find_contacts(nullptr, false);
  state_.a.setZero();
  return state_;
}

std::vector<std::string> Statics::touching() const {
  std::vector<std::string> names;
  for (const ForceSlot& f : system_.forces())
    for (int i = 0; i < f.element->contacts(); ++i)
      if (state_.contacts[at(f.contacts + i)].phase != ContactPhase::apart)
        names.push_back(f.element->name());
  return names;
}

double Statics::measure(Eigen::Index row) const {
  return system_.measure(static_cast<int>(row)) == Measure::length ? length_ : 1.0;
}

void Statics::choose_loads(const Model& model, const EquilibriumOptions& options) {
  for (const std::string& name : options.loads)
    if (std::ranges::none_of(model.forces(), [&](const auto& f) { return f->name() == name; }))
      throw ModelError(fmt::format("equilibrium: there is no force '{}' to be a load", name));
  for (const ForceSlot& f : system_.forces()) {
    const Dependence d = f.element->dependence();
    const bool by_nature = f.element->supplies() || (!d.position && !d.velocity && f.states == 0);
    is_load_.push_back(options.loads.empty()
                           ? by_nature
                           : std::ranges::find(options.loads, f.element->name()) !=
                                 options.loads.end());
  }
  share_.assign(is_load_.size(), 1.0);
  set_load(1.0);
}

void Statics::choose_force() {
  system_.bind(state_);
  system_.set_motion(state_.t, state_.q.data(), state_.v.data());
  for (ContactMemory& memory : state_.contacts) memory = {};
  force_ = 0.0;
  std::vector<double> local;
  for (const ForceSlot& f : system_.forces()) {
    local.assign(at(f.columns), 0.0);
    f.element->evaluate(system_.force_input(f), {.Q = local.data()});
    for (Eigen::Index j = 0; j < f.columns; ++j) {
      const double value = std::abs(local[at(j)]) / (j % 3 == 2 ? length_ : 1.0);
      if (std::isfinite(value)) force_ = std::max(force_, value);
    }
  }
  // Springs that are relaxed but for rounding say nothing: what a small displacement costs.
  const auto stiffness = calc_tangent(system_, state_, share_).Q_q;
  for (Eigen::Index k = 0; k < stiffness.outerSize(); ++k)
    for (typename std::decay_t<decltype(stiffness)>::InnerIterator it(stiffness, k); it; ++it) {
      const double value = std::abs(it.value()) * (it.col() % 3 == 2 ? 1.0 : length_) /
                           (it.row() % 3 == 2 ? length_ : 1.0);
      if (std::isfinite(value)) force_ = std::max(force_, small_displacement * value);
    }
  if (!(force_ > 0.0)) force_ = 1.0;
}

void Statics::add_forces(Vector& Q, Vector& z_dot) {
  std::vector<double> local;
  for (std::size_t k = 0; k < system_.forces().size(); ++k) {
    const ForceSlot& f = system_.forces()[k];
    local.assign(at(f.columns), 0.0);
    f.element->evaluate(system_.force_input(f),
                        {.Q = local.data(), .z_dot = f.states > 0 ? z_dot.data() + f.z : nullptr});
    for (Eigen::Index j = 0; j < f.columns; ++j) {
      const int dof = system_.dof()[at(f.dofs + j)];
      Q[dof < 0 ? n_ : dof] += share_[k] * local[at(j)];
    }
  }
}

void Statics::add_inertia(double inertia) {
  for (Eigen::Index i = 0; i < n_; ++i) matrix_.coeffRef(i, i) -= inertia;
  matrix_.makeCompressed();
}

void Statics::find_contacts(const std::function<double(const double*)>& effective_mass,
                            bool loading) {
  beyond_law_ = false;
  for (const ForceSlot& f : system_.forces()) {
    if (f.element->contacts() == 0) continue;
    for (int i = 0; i < f.element->contacts(); ++i) state_.contacts[at(f.contacts + i)] = {};
    std::vector<double> still(at(f.columns), 0.0);
    EventContext context{
        .input = system_.force_input(f),
        .contact = state_.contacts.data() + f.contacts,
        .z = state_.z.data() + f.z,
        .effective_mass =
            effective_mass ? effective_mass
                           : [this, &f](const double* d) { return dynamics_.effective_mass(f, d); },
        .acceleration = still.data(),
        .fail = [this](const std::string&) { beyond_law_ = true; },
        .at_rest = loading};
    f.element->initialise_contacts(context);
    if (!loading) continue;
    for (int i = 0; i < f.element->contacts(); ++i) {
      ContactMemory& memory = state_.contacts[at(f.contacts + i)];
      if (memory.phase == ContactPhase::restituting) memory.phase = ContactPhase::compressing;
    }
  }
}

}  // namespace yoke
