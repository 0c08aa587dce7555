// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/formulations/equations/iteration_matrix.hpp>

#include <algorithm>
#include <cmath>

#include <yoke/core/equations/curvature_pattern.hpp>
#include <yoke/core/equations/linear/index.hpp>

namespace yoke {

namespace {

bool is_diagonal(Block b) { return b <= Block::hold; }
bool is_of_holds(Block b) { return b == Block::open || b == Block::hold; }
bool is_of_constraint(Block b) { return b >= Block::G && b <= Block::K_mu; }
bool is_of_force(Block b) { return b >= Block::Q_q; }

// An element without derivatives is not asked for any.
bool has_derivatives(const ForceSlot& f) {
  const Dependence depends = f.element->dependence();
  return depends.position || depends.velocity || f.states > 0 || f.load_rows > 0;
}

// K couples two coordinates only if one equation depends on both, and not linearly.
bool couples(const Constraint& c, const CurvaturePattern* curvature, int j, int l) {
  if (curvature != nullptr && !curvature->is_curved(j, l)) return false;
  for (int i = 0; i < c.rows(); ++i)
    if (c.in_pattern(i, j) && c.in_pattern(i, l)) return true;
  return false;
}

// A column of H is zero if G does not depend on its coordinate.
bool may_have_rate(const Constraint& c, const CurvaturePattern* curvature, int j) {
  if (curvature == nullptr || c.rheonomic()) return true;
  for (int l = 0; l < c.columns(); ++l)
    if (couples(c, curvature, j, l)) return true;
  return false;
}

bool is_of_rates(Block b) { return b == Block::H || b == Block::H_hold || b == Block::H_second; }
}  // namespace

IterationMatrix::IterationMatrix(System& system, const MatrixLayout& layout)
    : system_(system), rows_(layout.rows), columns_(layout.columns) {
  build_pattern(layout);
  lu_.emplace(scaled_);
  size_scratch();
  row_scale_.assign(at(layout.size), 1.0);
  column_scale_.assign(at(layout.size), 1.0);
  mean_mass_ = system.mean_mass();
}

void IterationMatrix::build_pattern(const MatrixLayout& layout) {
  PatternBuilder pattern(layout.size);
  for (const Placement& p : layout.placements)
    if (is_diagonal(p.block)) place_diagonal(pattern, p);
  const auto close = [&](Block from, Block to) {
    for (std::size_t b = static_cast<std::size_t>(from); b <= static_cast<std::size_t>(to); ++b)
      stamps_[b].first.push_back(stamps_[b].list.size());
  };
  for (const ConstraintSlot& c : system_.constraints()) {
    for (const Placement& p : layout.placements)
      if (is_of_constraint(p.block)) place_constraint(pattern, c, p);
    close(Block::G, Block::K_mu);
  }
  for (const ForceSlot& f : system_.forces()) {
    for (const Placement& p : layout.placements)
      if (is_of_force(p.block)) place_force(pattern, f, p);
    close(Block::Q_q, Block::z_lambda);
  }
  std::vector<int> slot;
  matrix_ = pattern.compile(slot);
  scaled_ = matrix_;
  for (Diagonal& d : diagonals_)
    for (int& s : d.slots) s = slot[at(s)];
  for (Stamps& stamps : stamps_)
    for (Stamp& s : stamps.list) s.slot = slot[at(s.slot)];
}

void IterationMatrix::place_diagonal(PatternBuilder& pattern, const Placement& p) {
  Diagonal d{p.block, p.row, p.column, p.factor, {}};
  const auto request = [&](int i) { d.slots.push_back(pattern.add(p.row + i, p.column + i)); };
  if (p.block == Block::dropped) {
    for (const int i : system_.left_out_rows()) request(i);
  } else if (is_of_holds(p.block)) {
    for (const ConstraintSlot& c : system_.holds()) request(c.row);
  } else {
    const int count = p.block == Block::states ? system_.states() : system_.dofs();
    for (int i = 0; i < count; ++i) request(i);
  }
  diagonals_.push_back(std::move(d));
}

void IterationMatrix::place_constraint(PatternBuilder& pattern, const ConstraintSlot& c,
                                       const Placement& p) {
  const auto dof = [&](int j) { return system_.dof()[at(c.dofs + j)]; };
  const auto* curvature = dynamic_cast<const CurvaturePattern*>(c.element);
  std::vector<Stamp>& list = stamps(p.block).list;
  if (p.block == Block::K_lambda || p.block == Block::K_mu) {
    for (int j = 0; j < c.columns; ++j)
      for (int l = 0; l < c.columns; ++l)
        if (dof(j) >= 0 && dof(l) >= 0 && couples(*c.element, curvature, j, l))
          list.push_back(
              {j * c.columns + l, pattern.add(p.row + dof(j), p.column + dof(l)), p.factor});
    return;
  }
  if (p.block == Block::G_position && c.hold >= 0) return;
  if (p.block == Block::H_hold && c.hold < 0) return;
  for (int i = 0; i < c.rows; ++i) {
    const int equation = c.row + i;
    if (system_.is_left_out(equation)) continue;
    for (int j = 0; j < c.columns; ++j) {
      if (dof(j) < 0 || !c.element->in_pattern(i, j)) continue;
      if (is_of_rates(p.block) && !may_have_rate(*c.element, curvature, j)) continue;
      const int request = p.block == Block::G_T ? pattern.add(p.row + dof(j), p.column + equation)
                                                : pattern.add(p.row + equation, p.column + dof(j));
      list.push_back({c.block + i * c.columns + j, request, p.factor});
    }
  }
}

void IterationMatrix::place_force(PatternBuilder& pattern, const ForceSlot& f, const Placement& p) {
  const Dependence depends = f.element->dependence();
  if (p.block == Block::Q_q && !depends.position) return;
  if (p.block == Block::Q_v && !depends.velocity) return;
  enum Kind { coordinates, states, multipliers };
  const Kind across = p.block >= Block::z_q ? states : coordinates;
  const bool by_states = p.block == Block::Q_z || p.block == Block::z_z;
  const bool by_load = p.block == Block::Q_lambda || p.block == Block::z_lambda;
  const Kind along = by_states ? states : by_load ? multipliers : coordinates;
  const auto count = [&](Kind kind) {
    return kind == states ? f.states : kind == multipliers ? f.load_rows : f.columns;
  };
  const auto place = [&](Kind kind, int i) {  // -1: the ground, or left out
    if (kind == states) return f.z + i;
    if (kind == coordinates) return system_.dof()[at(f.dofs + i)];
    return system_.is_left_out(f.load + i) ? -1 : f.load + i;
  };
  const int rows = count(across), columns = count(along);
  for (int i = 0; i < rows; ++i) {
    const int row = place(across, i);
    for (int j = 0; j < columns; ++j) {
      const int column = place(along, j);
      if (row < 0 || column < 0) continue;
      stamps(p.block).list.push_back(
          {i * columns + j, pattern.add(p.row + row, p.column + column), p.factor});
    }
  }
}

void IterationMatrix::size_scratch() {
  int largest = 0, blocks = 0;
  for (const ConstraintSlot& c : system_.constraints()) {
    largest = std::max(largest, c.columns);
    blocks = std::max(blocks, c.block + c.rows * c.columns);
  }
  H_.assign(at(blocks), 0.0);
  K_.assign(at(largest * largest), 0.0);
  std::size_t scratch = 0;
  for (const ForceSlot& f : system_.forces()) {
    if (!has_derivatives(f)) continue;
    const std::size_t k = at(f.columns), z = at(f.states), m = at(f.load_rows);
    scratch = std::max(scratch, 2 * k * k + 3 * k * z + z * z + k + z + (k + z) * m);
  }
  scratch_.assign(scratch, 0.0);
}

void IterationMatrix::evaluate(const Point& at, std::span<const double> factors) {
  factors_ = factors;
  std::ranges::fill(matrix_.value, 0.0);
  add_diagonals();
  if (uses(Block::H_second)) add_second_velocity(at);
  system_.set_motion(at.t, at.q, at.v);
  system_.set_states(at.z);
  system_.set_multipliers(at.lambda);
  for (std::size_t i = 0; i < system_.constraints().size(); ++i) add_constraint(i, at);
  for (std::size_t i = 0; i < system_.forces().size(); ++i) add_force(i);
}

void IterationMatrix::add_diagonals() {
  for (const Diagonal& d : diagonals_) {
    const double factor = factors_[at(d.factor)];
    for (std::size_t i = 0; i < d.slots.size(); ++i) {
      double value = factor;
      if (d.block == Block::mass) value *= system_.mass()[i];
      if (d.block == Block::open && !system_.is_dropped(system_.holds()[i].row)) value = 0.0;
      matrix_.value[at(d.slots[i])] += value;
    }
  }
}

void IterationMatrix::add(Block block, std::size_t element, const double* values) {
  const Stamps& s = stamps(block);
  if (s.list.empty()) return;
  double* value = matrix_.value.data();
  for (std::size_t k = s.first[element]; k < s.first[element + 1]; ++k) {
    const Stamp& stamp = s.list[k];
    value[stamp.slot] += factors_[at(stamp.factor)] * values[stamp.entry];
  }
}

void IterationMatrix::add_constraint(std::size_t i, const Point& at) {
  const ConstraintSlot& c = system_.constraints()[i];
  const auto clear = [&] { std::fill_n(K_.begin(), c.columns * c.columns, 0.0); };
  ConstraintRequest out{.G = system_.G() + c.block};
  if (uses(Block::H) || uses(Block::H_hold)) out.H = H_.data() + c.block;
  if (uses(Block::K_lambda)) {
    clear();
    out.K = K_.data();
    out.lambda = at.lambda + c.row;
  }
  system_.evaluate(c, out);
  add(Block::G, i, system_.G());
  add(Block::G_position, i, system_.G());
  add(Block::G_T, i, system_.G());
  add(Block::H, i, H_.data());
  add(Block::H_hold, i, H_.data());
  add(Block::K_lambda, i, K_.data());
  if (!uses(Block::K_mu)) return;
  clear();
  system_.evaluate(c, {.K = K_.data(), .lambda = at.mu + c.row});
  add(Block::K_mu, i, K_.data());
}

void IterationMatrix::add_second_velocity(const Point& at) {
  system_.set_motion(at.t, at.q, at.v_second);
  for (std::size_t i = 0; i < system_.constraints().size(); ++i) {
    const ConstraintSlot& c = system_.constraints()[i];
    system_.evaluate(c, {.H = H_.data() + c.block});
    add(Block::H_second, i, H_.data());
  }
}

void IterationMatrix::add_force(std::size_t i) {
  const ForceSlot& f = system_.forces()[i];
  if (!has_derivatives(f)) return;
  const int k = f.columns, nz = f.states, loads = f.load_rows;
  double* next = scratch_.data();
  const auto block = [&](int size) {
    double* p = next;
    next += size;
    return p;
  };
  ForceRequest out;
  out.Q = block(k);  // Q and f come along with their derivatives
  out.dQ_dq = block(k * k);
  out.dQ_dv = block(k * k);
  if (nz > 0) {
    out.z_dot = block(nz);
    out.dQ_dz = block(k * nz);
    out.dz_dq = block(nz * k);
    out.dz_dv = block(nz * k);
    out.dz_dz = block(nz * nz);
  }
  if (loads > 0) out.dQ_dlambda = block(k * loads);
  if (loads > 0 && nz > 0) out.dz_dlambda = block(nz * loads);
  std::fill(scratch_.data(), next, 0.0);
  f.element->evaluate(system_.force_input(f), out);
  add(Block::Q_q, i, out.dQ_dq);
  add(Block::Q_v, i, out.dQ_dv);
  if (loads > 0) add(Block::Q_lambda, i, out.dQ_dlambda);
  if (nz == 0) return;
  if (loads > 0) add(Block::z_lambda, i, out.dz_dlambda);
  add(Block::Q_z, i, out.dQ_dz);
  add(Block::z_q, i, out.dz_dq);
  add(Block::z_v, i, out.dz_dv);
  add(Block::z_z, i, out.dz_dz);
}

int IterationMatrix::count(Unit unit) const {
  switch (unit) {
    case Unit::coordinate:
    case Unit::force:
      return system_.dofs();
    case Unit::equation:
    case Unit::multiplier:
      return system_.rows();
    case Unit::state:
      break;
  }
  return system_.states();
}

double IterationMatrix::unit_of(Unit unit, int i) const {
  const double length = system_.scales().length, m = mean_mass_;
  switch (unit) {
    case Unit::coordinate:
      return i % 3 == 2 ? 1.0 : length;
    case Unit::force:
      return i % 3 == 2 ? m * length * length : m * length;
    case Unit::equation:
      return system_.measure(i) == Measure::length ? length : 1.0;
    case Unit::multiplier:
      return system_.measure(i) == Measure::length ? m * length : m * length * length;
    case Unit::state:
      break;
  }
  return 1.0;
}

void IterationMatrix::calc_scaling(double rate) {
  const auto size_of = [&](const Part& part, int i) {
    double size = unit_of(part.unit, i);
    for (int k = 0; k < part.power; ++k) size *= rate;
    for (int k = 0; k > part.power; --k) size /= rate;
    return size;
  };
  for (const Part& part : columns_)
    for (int i = 0; i < count(part.unit); ++i)
      column_scale_[at(part.offset + i)] = size_of(part, i);
  for (const Part& part : rows_)
    for (int i = 0; i < count(part.unit); ++i)
      row_scale_[at(part.offset + i)] = 1.0 / size_of(part, i);
  const auto alone = [&](const Diagonal& d, int i) {  // on its row
    row_scale_[at(d.row + i)] = 1.0 / column_scale_[at(d.column + i)];
  };
  for (const Diagonal& d : diagonals_) {
    if (d.block == Block::dropped)
      for (const int i : system_.left_out_rows()) alone(d, i);
    if (is_of_holds(d.block))
      for (const ConstraintSlot& c : system_.holds())
        if (d.block == Block::hold || system_.is_dropped(c.row)) alone(d, c.row);
  }
}

bool IterationMatrix::factorise(double rate) {
  calc_scaling(std::abs(rate));
  for (int j = 0; j < size(); ++j) {
    const double column = column_scale_[at(j)];
    for (int k = matrix_.column_start[at(j)]; k < matrix_.column_start[at(j) + 1]; ++k)
      scaled_.value[at(k)] = matrix_.value[at(k)] * column * row_scale_[at(matrix_.row[at(k)])];
  }
  return lu_->factorise(scaled_);
}

void IterationMatrix::solve(double* b) {
  for (int i = 0; i < size(); ++i) b[i] *= row_scale_[at(i)];
  lu_->solve(b);
  for (int i = 0; i < size(); ++i) b[i] *= column_scale_[at(i)];
}

}  // namespace yoke
