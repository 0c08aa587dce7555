// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/ggl_matrix.hpp>

#include <algorithm>
#include <cmath>

namespace yoke {

namespace {
std::size_t at(int i) { return static_cast<std::size_t>(i); }
}  // namespace

GglMatrix::GglMatrix(System& system)
    : system_(system),
      n_(system.dofs()),
      nz_(system.states()),
      rows_(system.rows()),
      size_(2 * n_ + nz_ + 2 * rows_) {
  build_pattern();
  lu_.emplace(scaled_);
  row_scale_.assign(at(size_), 1.0);
  column_scale_.assign(at(size_), 1.0);
  force_.assign(at(n_) + 1, 0.0);
  stabilisation_ = force_;
  double total = 0.0;
  for (int i = 0; i < n_; i += 3) total += system.mass()[at(i)];
  if (n_ > 0) mean_mass_ = total / (n_ / 3);
}

void GglMatrix::build_pattern() {
  PatternBuilder pattern(size_);
  for (int i = 0; i < n_; ++i) {
    diagonal_qq_.push_back(pattern.add(i, i));
    diagonal_qv_.push_back(pattern.add(i, v() + i));
    diagonal_vv_.push_back(pattern.add(v() + i, v() + i));
  }
  for (int i = 0; i < nz_; ++i) diagonal_zz_.push_back(pattern.add(z() + i, z() + i));
  int largest = 0, blocks = 0;
  for (const ConstraintSlot& c : system_.constraints()) {
    add_constraint(pattern, c);
    largest = std::max(largest, c.columns);
    blocks = std::max(blocks, c.block + c.rows * c.columns);
  }
  H_.assign(at(blocks), 0.0);
  K_lambda_.assign(at(largest * largest), 0.0);
  K_mu_ = K_lambda_;
  std::size_t scratch = 0;
  for (const ForceSlot& f : system_.forces()) {
    add_force(pattern, f);
    // Q and f come along with their derivatives; an element without derivatives needs no blocks.
    const Dependence d = f.element->dependence();
    const bool blocks_needed = d.position || d.velocity || f.states > 0;
    const std::size_t k = blocks_needed ? at(f.columns) : 0, z = at(f.states);
    scratch = std::max(scratch, 2 * k * k + 3 * k * z + z * z + at(f.columns) + z);
  }
  scratch_.assign(scratch, 0.0);
  std::vector<int> slot;
  matrix_ = pattern.compile(slot);
  scaled_ = matrix_;
  resolve(slot);
}

void GglMatrix::add_constraint(PatternBuilder& pattern, const ConstraintSlot& c) {
  const auto dof = [&](int j) { return system_.dof()[at(c.dofs + j)]; };
  Slots g{.first = g_stamps_.size()}, k{.first = k_stamps_.size()};
  for (int i = 0; i < c.rows; ++i) {
    const int row = c.row + i;
    for (int j = 0; j < c.columns; ++j) {
      const int d = dof(j);
      if (d < 0 || !c.element->in_pattern(i, j)) continue;
      g_stamps_.push_back({.entry = c.block + i * c.columns + j,
                           .p_q = pattern.add(lambda() + row, d),
                           .w_v = pattern.add(mu() + row, v() + d),
                           .v_lambda = pattern.add(v() + d, lambda() + row),
                           .q_mu = pattern.add(d, mu() + row),
                           .w_q = pattern.add(mu() + row, d)});
    }
  }
  // K couples two coordinates only if one equation depends on both.
  for (int j = 0; j < c.columns; ++j) {
    for (int l = 0; l < c.columns; ++l) {
      bool coupled = false;
      for (int i = 0; i < c.rows; ++i)
        coupled = coupled || (c.element->in_pattern(i, j) && c.element->in_pattern(i, l));
      if (!coupled || dof(j) < 0 || dof(l) < 0) continue;
      k_stamps_.push_back({.entry = j * c.columns + l,
                           .v_q = pattern.add(v() + dof(j), dof(l)),
                           .q_q = pattern.add(dof(j), dof(l))});
    }
  }
  g.last = g_stamps_.size();
  k.last = k_stamps_.size();
  g_of_.push_back(g);
  k_of_.push_back(k);
}

void GglMatrix::add_force(PatternBuilder& pattern, const ForceSlot& f) {
  const auto dof = [&](int j) { return system_.dof()[at(f.dofs + j)]; };
  const Dependence depends = f.element->dependence();
  ForceStamps stamps;
  const auto add = [&](std::vector<BlockStamp>& list, int entry, int row, int column) {
    if (row >= 0 && column >= 0) list.push_back({entry, pattern.add(row, column)});
  };
  const auto offset = [](int part, int d) { return d < 0 ? -1 : part + d; };
  if (depends.position || depends.velocity) {
    for (int i = 0; i < f.columns; ++i) {
      for (int j = 0; j < f.columns; ++j) {
        const int entry = i * f.columns + j;
        if (depends.position) add(stamps.Q_q, entry, offset(v(), dof(i)), dof(j));
        if (depends.velocity) add(stamps.Q_v, entry, offset(v(), dof(i)), offset(v(), dof(j)));
      }
    }
  }
  for (int s = 0; s < f.states; ++s) {
    const int row = z() + f.z + s;
    for (int j = 0; j < f.columns; ++j) {
      add(stamps.Q_z, j * f.states + s, offset(v(), dof(j)), row);
      add(stamps.z_q, s * f.columns + j, row, dof(j));
      add(stamps.z_v, s * f.columns + j, row, offset(v(), dof(j)));
    }
    for (int r = 0; r < f.states; ++r) add(stamps.z_z, s * f.states + r, row, z() + f.z + r);
  }
  f_of_.push_back(std::move(stamps));
}

void GglMatrix::resolve(const std::vector<int>& slot) {
  const auto fix = [&](int& request) { request = slot[at(request)]; };
  for (auto* list : {&diagonal_qq_, &diagonal_qv_, &diagonal_vv_, &diagonal_zz_})
    for (int& s : *list) fix(s);
  for (GStamp& s : g_stamps_)
    for (int* p : {&s.p_q, &s.w_v, &s.v_lambda, &s.q_mu, &s.w_q}) fix(*p);
  for (KStamp& s : k_stamps_)
    for (int* p : {&s.v_q, &s.q_q}) fix(*p);
  for (ForceStamps& f : f_of_)
    for (auto* list : {&f.Q_q, &f.Q_v, &f.Q_z, &f.z_q, &f.z_v, &f.z_z})
      for (BlockStamp& s : *list) fix(s.slot);
}

bool GglMatrix::calc_residual(double t, const double* y, const double* y_dot, double* residual) {
  system_.set_motion(t, y, y + v());
  system_.set_states(y + z());
  system_.calc_position_level(residual + lambda());
  system_.calc_velocity_residual(residual + mu());

  double* r_q = residual;
  double* r_v = residual + v();
  double* r_z = residual + z();
  double* force = force_.data();
  std::ranges::fill(force_, 0.0);
  system_.add_forces(force, r_z, nullptr);
  system_.subtract_constraint_forces(y + lambda(), force);
  double* stabilisation = stabilisation_.data();
  std::ranges::fill(stabilisation_, 0.0);
  system_.subtract_constraint_forces(y + mu(), stabilisation);
  double sum = 0.0;
  for (int i = 0; i < n_; ++i) {
    const double mass = system_.mass()[at(i)];
    r_q[i] = mass * (y_dot[i] - y[v() + i]) - stabilisation[i];
    r_v[i] = mass * y_dot[v() + i] - force[i];
    sum += r_q[i] + r_v[i];
  }
  for (int i = 0; i < nz_; ++i) {
    r_z[i] = y_dot[z() + i] - r_z[i];
    sum += r_z[i];
  }
  for (int i = lambda(); i < size_; ++i) sum += residual[i];
  if (!std::isfinite(sum)) system_.blame_not_finite();
  return std::isfinite(sum);
}

void GglMatrix::calc_jacobian(double t, double c, const double* y) {
  c_ = c;
  std::ranges::fill(matrix_.value, 0.0);
  double* value = matrix_.value.data();
  for (int i = 0; i < n_; ++i) {
    const double mass = system_.mass()[at(i)];
    value[diagonal_qq_[at(i)]] = value[diagonal_vv_[at(i)]] = c * mass;
    value[diagonal_qv_[at(i)]] = -mass;
  }
  for (const int slot : diagonal_zz_) value[slot] = c;
  system_.set_motion(t, y, y + v());
  system_.set_states(y + z());
  for (std::size_t i = 0; i < g_of_.size(); ++i) stamp_constraint(i, y);
  for (std::size_t i = 0; i < f_of_.size(); ++i) stamp_force(i);
}

void GglMatrix::stamp_constraint(std::size_t i, const double* y) {
  const ConstraintSlot& c = system_.constraints()[i];
  const int square = c.columns * c.columns;
  std::fill_n(K_lambda_.begin(), square, 0.0);
  std::fill_n(K_mu_.begin(), square, 0.0);
  c.element->evaluate(system_.motion(), {.G = system_.G() + c.block,
                                         .H = H_.data() + c.block,
                                         .K = K_lambda_.data(),
                                         .lambda = y + lambda() + c.row});
  c.element->evaluate(system_.motion(), {.K = K_mu_.data(), .lambda = y + mu() + c.row});
  double* value = matrix_.value.data();
  for (std::size_t k = g_of_[i].first; k < g_of_[i].last; ++k) {
    const GStamp& s = g_stamps_[k];
    const double g = system_.G()[s.entry];
    value[s.p_q] += g;
    value[s.w_v] += g;
    value[s.v_lambda] += g;
    value[s.q_mu] += g;
    value[s.w_q] += H_[at(s.entry)];
  }
  for (std::size_t k = k_of_[i].first; k < k_of_[i].last; ++k) {
    const KStamp& s = k_stamps_[k];
    value[s.v_q] += K_lambda_[at(s.entry)];
    value[s.q_q] += K_mu_[at(s.entry)];
  }
}

void GglMatrix::stamp_force(std::size_t i) {
  const ForceSlot& f = system_.forces()[i];
  const ForceStamps& stamps = f_of_[i];
  const Dependence depends = f.element->dependence();
  if (!depends.position && !depends.velocity && f.states == 0) return;
  const int k = f.columns, nz = f.states;
  double* next = scratch_.data();
  const auto block = [&](int size) {
    double* p = next;
    next += size;
    return p;
  };
  ForceRequest out;
  out.Q = block(k);
  out.dQ_dq = block(k * k);
  out.dQ_dv = block(k * k);
  if (nz > 0) {
    out.z_dot = block(nz);
    out.dQ_dz = block(k * nz);
    out.dz_dq = block(nz * k);
    out.dz_dv = block(nz * k);
    out.dz_dz = block(nz * nz);
  }
  std::fill(scratch_.data(), next, 0.0);
  f.element->evaluate(system_.force_input(f), out);
  const auto subtract = [&](const std::vector<BlockStamp>& list, const double* values) {
    for (const BlockStamp& s : list) matrix_.value[at(s.slot)] -= values[s.entry];
  };
  subtract(stamps.Q_q, out.dQ_dq);
  subtract(stamps.Q_v, out.dQ_dv);
  subtract(stamps.Q_z, out.dQ_dz);
  subtract(stamps.z_q, out.dz_dq);
  subtract(stamps.z_v, out.dz_dv);
  subtract(stamps.z_z, out.dz_dz);
}

void GglMatrix::calc_scaling() {
  const double length = system_.scales().length, c = std::abs(c_), m = mean_mass_;
  for (int i = 0; i < n_; ++i) {
    const double size = i % 3 == 2 ? 1.0 : length;
    const double force = i % 3 == 2 ? m * length * length : m * length;  // over c^2
    column_scale_[at(i)] = size;
    column_scale_[at(v() + i)] = size * c;
    row_scale_[at(i)] = 1.0 / (force * c);
    row_scale_[at(v() + i)] = 1.0 / (force * c * c);
  }
  for (int i = 0; i < nz_; ++i) row_scale_[at(z() + i)] = 1.0 / c;
  for (int i = 0; i < rows_; ++i) {
    const bool is_length = system_.measure(i) == Measure::length;
    const double size = is_length ? length : 1.0;
    const double force = is_length ? m * length : m * length * length;
    column_scale_[at(lambda() + i)] = force * c * c;
    column_scale_[at(mu() + i)] = force * c;
    row_scale_[at(lambda() + i)] = 1.0 / size;
    row_scale_[at(mu() + i)] = 1.0 / (size * c);
  }
}

bool GglMatrix::factorise() {
  calc_scaling();
  for (int j = 0; j < size_; ++j) {
    const double column = column_scale_[at(j)];
    for (int k = matrix_.column_start[at(j)]; k < matrix_.column_start[at(j) + 1]; ++k)
      scaled_.value[at(k)] = matrix_.value[at(k)] * column * row_scale_[at(matrix_.row[at(k)])];
  }
  return lu_->factorise(scaled_);
}

void GglMatrix::solve(double* b) {
  for (int i = 0; i < size_; ++i) b[i] *= row_scale_[at(i)];
  lu_->solve(b);
  for (int i = 0; i < size_; ++i) b[i] *= column_scale_[at(i)];
}

}  // namespace yoke
