// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/core/equations/system.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <yoke/core/equations/linear/index.hpp>
#include <yoke/core/error.hpp>

namespace yoke {

System::System(const Model& model) : model_(model) {
  lay_out_bodies();
  lay_out_constraints();
  lay_out_forces();
  lay_out_holds();
  natural_length_ = scales_.length = length_of_layout();
  rounding_ = rounding_of_coordinates();
}

void System::lay_out_bodies() {
  dofs_ = 3 * model_.body_count();
  bodies_.resize(model_.bodies().size());
  mass_.reserve(at(dofs_));
  for (std::size_t i = 1; i < model_.bodies().size(); ++i) {
    const Body& b = model_.bodies()[i];
    mass_.insert(mass_.end(), {b.mass, b.mass, b.inertia});
  }
  motion_.bodies = bodies_;
  motion_.inertia = model_.bodies();
}

int System::add_dofs(const std::vector<BodyId>& bodies) {
  const int offset = static_cast<int>(dof_.size());
  for (const BodyId id : bodies)
    for (int i = 0; i < 3; ++i) dof_.push_back(id == ground ? -1 : 3 * (id.index - 1) + i);
  return offset;
}

void System::lay_out_constraints() {
  int block = 0;
  reserve_constraints();
  for (const auto& c : model_.constraints()) {
    ConstraintSlot slot{.element = c.get(),
                        .row = rows_,
                        .rows = c->rows(),
                        .columns = c->columns(),
                        .dofs = add_dofs(c->bodies()),
                        .block = block};
    if (c->rheonomic()) slot.quadrature = quadratures_++;
    for (const Equation& e : c->equations()) measure_.push_back(e.measure);
    rows_ += slot.rows;
    block += slot.rows * slot.columns;
    constraints_.push_back(slot);
  }
  G_.assign(at(block), 0.0);
  joint_count_ = constraints_.size();
  joint_rows_ = rows_;
}

/// As if all had two rows and two bodies, which most have: counting would look at every one.
void System::reserve_constraints() {
  const std::size_t count = model_.constraints().size();
  constraints_.reserve(count);
  measure_.reserve(2 * count);
  dof_.reserve(6 * count);
}

void System::lay_out_holds() {
  std::size_t block = G_.size();
  for (std::size_t i = 0; i < forces_.size(); ++i) {
    ForceSlot& f = forces_[i];
    if (!f.element->may_hold()) continue;
    held_rows_.push_back(
        std::make_unique<HeldRow>(*this, i, *f.element, f.element->bodies(model_)));
    f.row = rows_++;
    constraints_.push_back({.element = held_rows_.back().get(),
                            .row = f.row,
                            .rows = 1,
                            .columns = f.columns,
                            .dofs = f.dofs,
                            .block = static_cast<int>(block),
                            .hold = static_cast<int>(i)});
    measure_.push_back(Measure::length);
    block += at(f.columns);
  }
  G_.assign(block, 0.0);
  phi_t_.assign(at(rows_), 0.0);
  left_out_.assign(at(rows_), 0);
  dropped_.assign(at(rows_), 0);
  dropped_rows_.reserve(at(rows_));
  holding_.assign(held_rows_.size(), 0);
  hold_forces_.assign(held_rows_.size(), 0.0);
  collect_dropped();
}

void System::leave_out(const std::vector<int>& rows) {
  std::ranges::fill(left_out_, 0);
  for (const int row : rows) left_out_[at(row)] = 1;
  left_out_rows_ = rows;
  collect_dropped();
}

void System::collect_dropped() {
  dropped_ = left_out_;
  dropped_rows_.assign(left_out_rows_.begin(), left_out_rows_.end());
  for (std::size_t i = 0; i < holding_.size(); ++i) {
    if (holding_[i] != 0) continue;
    const int row = joint_rows_ + static_cast<int>(i);
    dropped_[at(row)] = 1;
    dropped_rows_.push_back(row);
  }
}

void System::note_holds() {
  bool changed = false;
  any_grip_ = false;
  for (std::size_t i = 0; i < holding_.size(); ++i) {
    const Grip grip = grip_memory(holds()[i]).grip;
    const char holding = grip == Grip::held ? 1 : 0;
    any_grip_ = any_grip_ || rests(grip);
    changed = changed || holding != holding_[i];
    holding_[i] = holding;
  }
  if (!changed) return;
  ++hold_version_;
  hold_forces_known_ = false;
  collect_dropped();
}

void System::set_hold_forces(const double* forces) {
  std::copy_n(forces, hold_forces_.size(), hold_forces_.begin());
  hold_forces_known_ = true;
}

void HeldRow::evaluate(const Motion& motion, const ConstraintRequest& out) const {
  if (out.phi != nullptr) *out.phi = 0.0;  // no position holds it
  if (out.phi_t != nullptr) *out.phi_t = 0.0;
  if (out.gamma != nullptr) *out.gamma = 0.0;
  const ForceSlot& slot = system_.forces()[force_];
  if (system_.is_dropped(slot.row)) {
    if (out.G != nullptr) std::fill_n(out.G, columns(), 0.0);
    if (out.H != nullptr) std::fill_n(out.H, columns(), 0.0);
    return;
  }
  const ForceInput bound = system_.force_input(slot);
  element_.calc_hold({.motion = motion,
                      .z = bound.z,
                      .parameters = bound.parameters,
                      .contact = bound.contact,
                      .scales = bound.scales,
                      .rounding = bound.rounding},
                     out);
}

void System::lay_out_forces() {
  int block = 0, contacts = 0;
  std::size_t joint = 0;
  for (const auto& f : model_.forces()) {
    const std::vector<BodyId> bodies = f->bodies(model_);
    ForceSlot slot{.element = f.get(),
                   .columns = 3 * static_cast<int>(bodies.size()),
                   .dofs = add_dofs(bodies),
                   .block = block,
                   .states = static_cast<int>(f->states().size()),
                   .z = states_,
                   .parameters = static_cast<int>(model_.first_parameter_of_force(forces_.size())),
                   .contacts = contacts,
                   .events = events_};
    if (f->dissipates()) slot.dissipated = quadratures_++;
    if (f->supplies()) slot.supplied = quadratures_++;
    block += slot.columns;
    states_ += slot.states;
    contacts += f->contacts();
    events_ += f->events();
    find_load(slot, joint);
    if (slot.load >= 0) loaded_.push_back(forces_.size());
    forces_.push_back(slot);
  }
  Q_.assign(at(block), 0.0);
  for (std::size_t i = 0; i < constraints_.size(); ++i)
    constraints_[i].parameters = static_cast<int>(model_.first_parameter_of_constraint(i));
  for (const OwnedParameter& p : model_.parameters())
    start_parameters_.push_back(p.parameter.value);
  parameters_ = start_parameters_.data();
}

/// Looked for from joint `near` on, which gets the place: loads mostly come in the order of their joints, and a
/// long chain is not searched from its start for each.
void System::find_load(ForceSlot& slot, std::size_t& near) const {
  const Constraint* joint = slot.element->loaded_by();
  if (joint == nullptr) return;
  const std::size_t count = joints().size();
  for (std::size_t looked = 0; looked < count; ++looked, near = near + 1 < count ? near + 1 : 0) {
    const ConstraintSlot& c = joints()[near];
    if (c.element != joint) continue;
    slot.load = c.row;
    slot.load_rows = c.rows;
    return;
  }
  throw ModelError(fmt::format("'{}' depends on the reaction of a joint that is not in the model",
                               slot.element->name()));
}

double System::length_of_layout() {
  const auto& bodies = model_.bodies();
  Vec2 centre = Vec2::Zero();
  for (std::size_t i = 1; i < bodies.size(); ++i) centre += bodies[i].pose.position;
  const double count = std::max(1.0, static_cast<double>(bodies.size() - 1));
  centre /= count;
  double spread = 0.0, gyration = 0.0;
  for (std::size_t i = 1; i < bodies.size(); ++i) {
    spread += (bodies[i].pose.position - centre).squaredNorm() / count;
    if (bodies[i].mass > 0.0)
      gyration = std::max(gyration, std::sqrt(bodies[i].inertia / bodies[i].mass));
  }
  const double length = std::max(std::sqrt(spread), gyration);
  if (length > 0.0) return length;
  double arm = 0.0;  // a point mass, or a body without any, on its joint
  for (const double square : squared_arms())
    if (square > 0.0 && std::isfinite(square)) arm = std::max(arm, std::sqrt(square));
  return arm > 0.0 ? arm : 1.0;  // alone it has no size
}

std::vector<double> System::squared_arms(double turned) {
  std::vector<double> q(at(dofs_)), v(at(dofs_), 0.0);
  for (std::size_t i = 1; i < model_.bodies().size(); ++i) {
    const Pose& pose = model_.bodies()[i].pose;
    double* body = q.data() + 3 * (i - 1);
    body[0] = pose.position.x();
    body[1] = pose.position.y();
    body[2] = pose.angle + turned * static_cast<double>(i);
  }
  set_motion(0.0, q.data(), v.data());
  std::vector<double> turn(at(dofs_ / 3), 0.0), shift = turn;
  for (const ConstraintSlot& c : constraints_) {
    evaluate(c, {.G = G_.data() + c.block});
    const double* g = G_.data() + c.block;
    for (int i = 0; i < c.rows; ++i, g += c.columns)
      for (int j = 0; j < c.columns && measure(c.row + i) == Measure::length; j += 3) {
        const int dof = dof_[at(c.dofs + j)];  // of a body, its first
        if (dof < 0) continue;
        shift[at(dof / 3)] += g[j] * g[j];
        shift[at(dof / 3)] += g[j + 1] * g[j + 1];
        turn[at(dof / 3)] += g[j + 2] * g[j + 2];
      }
  }
  for (std::size_t body = 0; body < turn.size(); ++body) turn[body] /= shift[body];
  return turn;
}

double System::mean_mass() const {
  double mass = 0.0, inertia = 0.0;
  for (int i = 0; i < dofs_; i += 3) {
    mass += mass_[at(i)];
    inertia += mass_[at(i + 2)];
  }
  const double count = std::max<double>(1.0, static_cast<double>(dofs_ / 3));
  if (mass > 0.0) return mass / count;
  return inertia > 0.0 ? inertia / (natural_length_ * natural_length_ * count) : 1.0;
}

/// A few units in the last place of the largest coordinate.
double System::rounding_of_coordinates() const {
  double largest = 0.0;
  for (const Body& body : model_.bodies())
    largest = std::max(largest, body.pose.position.lpNorm<Eigen::Infinity>());
  return 8.0 * machine_epsilon * largest;
}

std::string System::equation_name(int row) const {
  for (const ConstraintSlot& c : constraints_)
    if (row < c.row + c.rows)
      return c.element->name() + ": " + c.element->equations()[at(row - c.row)].label;
  return "?";
}

std::vector<std::string> System::quadrature_names() const {
  std::vector<std::string> names(at(quadratures_));
  for (const ConstraintSlot& c : constraints_)
    if (c.quadrature >= 0) names[at(c.quadrature)] = c.element->name() + ".work";
  for (const ForceSlot& f : forces_) {
    if (f.dissipated >= 0) names[at(f.dissipated)] = f.element->name() + ".dissipated";
    if (f.supplied >= 0) names[at(f.supplied)] = f.element->name() + ".work";
  }
  return names;
}

std::vector<bool> System::quadratures_of_work() const {
  std::vector<bool> work(at(quadratures_), false);
  for (const ConstraintSlot& c : constraints_)
    if (c.quadrature >= 0) work[at(c.quadrature)] = true;
  for (const ForceSlot& f : forces_)
    if (f.supplied >= 0) work[at(f.supplied)] = true;
  return work;
}

void System::bind(const State& state) {
  z_ = state.z.data();
  parameters_ = state.parameters.data();
  contacts_ = state.contacts.data();
  note_holds();
}

void System::set_motion(double t, const double* q, const double* v) {
  motion_.t = t;
  hold_forces_known_ = false;
  multipliers_ = nullptr;
  for (std::size_t i = 1; i < bodies_.size(); ++i, q += 3, v += 3) {
    BodyMotion& b = bodies_[i];
    b.x = q[0];
    b.y = q[1];
    // Bodies that only slide keep their angle: two sines saved.
    if (const double angle = q[2]; b.angle != angle) {
      b.angle = angle;
      b.c = std::cos(angle);
      b.s = std::sin(angle);
    }
    b.vx = v[0];
    b.vy = v[1];
    b.omega = v[2];
  }
}

ForceInput System::force_input(const ForceSlot& slot) const {
  return {.motion = motion_,
          .z = z_ + slot.z,
          .parameters = parameters_ + slot.parameters,
          .contact = contacts_ + slot.contacts,
          .scales = scales_,
          .rounding = rounding_,
          .hold = slot.row >= 0 && hold_forces_known_
                      ? hold_forces_.data() + (slot.row - joint_rows_)
                      : nullptr,
          .multipliers =
              slot.load >= 0 && multipliers_ != nullptr ? multipliers_ + slot.load : nullptr};
}

void System::calc_position_level(double* phi) {
  for (const ConstraintSlot& c : constraints_)
    evaluate(c, {.phi = phi + c.row, .G = G_.data() + c.block});
}

double System::norm(const double* residual, int* worst) const {
  double largest = 0.0;
  for (int i = 0; i < rows_; ++i) {
    if (is_dropped(i)) continue;
    const double size = measure(i) == Measure::length ? scales_.length : 1.0;
    const double r = std::abs(residual[i]) / size;
    if (!(r <= largest)) {  // catches NaN
      largest = r;
      if (worst != nullptr) *worst = i;
      if (std::isnan(r)) break;
    }
  }
  return largest;
}

void System::calc_velocity_residual(double* residual) {
  for (const ConstraintSlot& c : constraints_) {
    double* out = residual + c.row;
    if (c.quadrature >= 0 || c.hold >= 0) {
      evaluate(c, {.phi_t = out});
    } else {
      std::fill_n(out, c.rows, 0.0);
    }
    for (int j = 0; j < c.columns; j += 3) {  // body by body
      const int dof = dof_[at(c.dofs + j)];
      if (dof < 0) continue;
      const BodyMotion& b = bodies_[at(dof / 3 + 1)];
      const double* G = G_.data() + c.block + j;
      for (int i = 0; i < c.rows; ++i, G += c.columns)
        out[i] = out[i] + G[0] * b.vx + G[1] * b.vy + G[2] * b.omega;
    }
  }
}

void System::add_jacobian_times(const double* x, double* out) const {
  for (const ConstraintSlot& c : constraints_) {
    for (int j = 0; j < c.columns; j += 3) {
      const int dof = dof_[at(c.dofs + j)];
      if (dof < 0) continue;
      const double* G = G_.data() + c.block + j;
      const double x0 = x[dof], x1 = x[dof + 1], x2 = x[dof + 2];
      for (int i = c.row; i < c.row + c.rows; ++i, G += c.columns)
        out[i] = out[i] + G[0] * x0 + G[1] * x1 + G[2] * x2;
    }
  }
}

void System::subtract_constraint_forces(const double* lambda, double* force) const {
  for (const ConstraintSlot& c : constraints_) {
    for (int j = 0; j < c.columns; j += 3) {
      const double* G = G_.data() + c.block + j;
      double x = 0.0, y = 0.0, moment = 0.0;
      for (int i = c.row; i < c.row + c.rows; ++i, G += c.columns) {
        x += G[0] * lambda[i];
        y += G[1] * lambda[i];
        moment += G[2] * lambda[i];
      }
      const int dof = dof_[at(c.dofs + j)];
      if (dof < 0) {
        force[dofs_] -= x + y + moment;
      } else {
        force[dof] -= x;
        force[dof + 1] -= y;
        force[dof + 2] -= moment;
      }
    }
  }
}

Reaction System::reaction(std::size_t constraint, const double* lambda) const {
  const ConstraintSlot& c = constraints_[constraint];
  const double* G = G_.data() + c.block;
  const std::size_t body = c.element->reaction_body();
  double f[3] = {0.0, 0.0, 0.0};
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < c.rows; ++i)
      f[j] -= G[i * c.columns + 3 * static_cast<int>(body) + j] * lambda[c.row + i];
  const Vec2 force(f[0], f[1]);
  const Vec2 centre = motion_[c.element->bodies()[body]].position();
  const Vec2 arm = c.element->reaction_point(motion_) - centre;
  return {.force = force, .moment = f[2] - cross(arm, force)};
}

void System::add_forces(double* Q, double* z_dot, double* quadrature_rates) {
  for (const ForceSlot& f : forces_) add_force(f, Q, z_dot, quadrature_rates);
}

void System::add_unloaded_forces(double* Q, double* z_dot, double* quadrature_rates) {
  for (const ForceSlot& f : forces_)
    if (f.load < 0) add_force(f, Q, z_dot, quadrature_rates);
}

void System::add_loaded_forces(double* Q, double* z_dot, double* quadrature_rates) {
  for (const std::size_t i : loaded_) add_force(forces_[i], Q, z_dot, quadrature_rates);
}

void System::add_force(const ForceSlot& f, double* Q, double* z_dot, double* quadrature_rates) {
  double* local = Q_.data() + f.block;
  std::fill_n(local, f.columns, 0.0);  // an element without bodies has none
  Energy energy;
  const bool wants_energy = quadrature_rates != nullptr && (f.dissipated >= 0 || f.supplied >= 0);
  if (z_dot != nullptr) std::fill_n(z_dot + f.z, f.states, 0.0);
  f.element->evaluate(force_input(f),
                      {.Q = local,
                       .z_dot = f.states > 0 && z_dot != nullptr ? z_dot + f.z : nullptr,
                       .energy = wants_energy ? &energy : nullptr});
  for (int j = 0; j < f.columns; ++j) {
    const int dof = dof_[at(f.dofs + j)];
    Q[dof < 0 ? dofs_ : dof] += local[j];
  }
  if (!wants_energy) return;
  if (f.dissipated >= 0) quadrature_rates[f.dissipated] = energy.dissipated_power;
  if (f.supplied >= 0) quadrature_rates[f.supplied] = energy.supplied_power;
}

void System::add_driver_power(const double* lambda, double* quadrature_rates) {
  for (const ConstraintSlot& c : constraints_) {
    const bool drives = c.quadrature >= 0;
    const int quadrature = drives || c.hold < 0 ? c.quadrature : forces_[at(c.hold)].supplied;
    if (quadrature < 0 || (c.hold >= 0 && is_dropped(c.row))) continue;
    // Force on the mechanism -G^T lambda, so its power is -lambda^T G v = lambda^T Phi_t.
    double* phi_t = phi_t_.data() + c.row;
    evaluate(c, {.phi_t = phi_t});
    double power = 0.0;
    for (int i = 0; i < c.rows; ++i) power += lambda[c.row + i] * phi_t[i];
    if (drives)
      quadrature_rates[quadrature] = power;
    else
      quadrature_rates[quadrature] += power;  // a belt works on what sticks to it
  }
}

void System::calc_events(double* g) const {
  for (const ForceSlot& f : forces_)
    if (f.element->events() > 0) f.element->calc_events(force_input(f), g + f.events);
}

void System::blame_event(int slot) {
  for (const ForceSlot& f : forces_)
    if (slot >= f.events && slot < f.events + f.element->events()) not_finite_ = f.element->name();
}

void System::blame_wedged(const ForceSlot& force) {
  not_finite_ = force.element->name();
  wedged_ = true;
}

void System::forget_wedged() {
  if (wedged_) not_finite_.clear();
  wedged_ = false;
}

void System::blame_not_finite() {
  const auto finite = [](const double* values, int count) {
    return std::all_of(values, values + count, [](double x) { return std::isfinite(x); });
  };
  for (const ForceSlot& f : forces_) {
    double* local = Q_.data() + f.block;
    std::fill_n(local, f.columns, 0.0);
    f.element->evaluate(force_input(f), {.Q = local});
    if (!finite(local, f.columns)) not_finite_ = f.element->name();
  }
  for (const ConstraintSlot& c : constraints_) {
    evaluate(c, {.G = G_.data() + c.block, .gamma = phi_t_.data() + c.row});
    if (!finite(G_.data() + c.block, c.rows * c.columns) || !finite(phi_t_.data() + c.row, c.rows))
      not_finite_ = c.element->name();
  }
}

EnergyTerms System::calc_energy() const {
  EnergyTerms total;
  for (std::size_t i = 1; i < bodies_.size(); ++i) {
    const BodyMotion& b = bodies_[i];
    const Body& body = model_.bodies()[i];
    total.kinetic +=
        0.5 * body.mass * (b.vx * b.vx + b.vy * b.vy) + 0.5 * body.inertia * b.omega * b.omega;
  }
  for (const ForceSlot& f : forces_) {
    Energy energy;
    f.element->evaluate(force_input(f), {.energy = &energy});
    total.potential += energy.potential;
    total.stored += energy.stored;
  }
  return total;
}

}  // namespace yoke
