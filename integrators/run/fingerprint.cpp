// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/run/fingerprint.hpp>

#include <cmath>
#include <cstring>
#include <string>

#include <yoke/core/equations/system.hpp>

namespace yoke {

namespace {

/// Fowler-Noll-Vo 1a, 64 bits, over whatever it is fed.
class Hash {
 public:
  void bytes(const void* data, std::size_t size) {
    const auto* p = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) value_ = (value_ ^ p[i]) * 0x100000001b3u;
  }
  void add(const std::string& text) {
    bytes(text.data(), text.size());
    add(static_cast<double>(text.size()));
  }
  void add(double x) {
    if (std::isnan(x)) x = 0.0;  // its bits are not defined
    bytes(&x, sizeof x);
  }
  void add(const double* values, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) add(values[i]);
  }
  void add(const Eigen::VectorXd& values) {
    add(values.data(), static_cast<std::size_t>(values.size()));
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

void add_parameters(Hash& hash, const std::vector<Parameter>& parameters) {
  for (const Parameter& p : parameters) {
    hash.add(p.name);
    hash.add(p.value);
  }
}

void add_layout(Hash& hash, const Model& model) {
  for (const Body& b : model.bodies()) {
    hash.add(b.name);
    for (const double x : {b.mass, b.inertia, b.pose.position.x(), b.pose.position.y(),
                           b.pose.angle, b.twist.velocity.x(), b.twist.velocity.y(), b.twist.omega})
      hash.add(x);
  }
  for (const auto& c : model.constraints()) {
    hash.add(c->name());
    for (const BodyId id : c->bodies()) hash.add(id.index);
    for (const Equation& e : c->equations()) hash.add(e.label);
    add_parameters(hash, c->parameters());
  }
  for (const auto& f : model.forces()) {
    hash.add(f->name());
    for (const BodyId id : f->bodies(model)) hash.add(id.index);
    add_parameters(hash, f->parameters());
    for (const Channel& c : f->channels()) hash.add(c.name);
    for (const Channel& c : f->states()) hash.add(c.name);
    hash.add(f->contacts());
    hash.add(f->events());
    hash.add(f->penetration_scale());
    hash.add(f->signature());
  }
}

/// What all elements answer at one motion.
void add_answers(Hash& hash, System& system, State& state) {
  system.bind(state);
  system.set_motion(state.t, state.q.data(), state.v.data());
  std::vector<double> block;
  for (const ConstraintSlot& c : system.constraints()) {
    const auto rows = static_cast<std::size_t>(c.rows);
    block.assign(3 * rows + rows * static_cast<std::size_t>(c.columns), 0.0);
    double* p = block.data();
    system.evaluate(c, {.phi = p, .G = p + 3 * rows, .phi_t = p + rows, .gamma = p + 2 * rows});
    hash.add(block.data(), block.size());
  }
  for (const ForceSlot& f : system.forces()) {
    const auto columns = static_cast<std::size_t>(f.columns);
    block.assign(columns + static_cast<std::size_t>(f.states), 0.0);
    Energy energy;
    f.element->evaluate(system.force_input(f),
                        {.Q = block.data(),
                         .z_dot = f.states > 0 ? block.data() + columns : nullptr,
                         .energy = &energy});
    hash.add(block.data(), block.size());
    if (f.element->events() > 0) {
      block.assign(static_cast<std::size_t>(f.element->events()), 0.0);
      f.element->calc_events(system.force_input(f), block.data());
      hash.add(block.data(), block.size());
    }
    for (const double x :
         {energy.potential, energy.stored, energy.dissipated_power, energy.supplied_power})
      hash.add(x);
  }
}

}  // namespace

std::uint64_t fingerprint(const Model& model) {
  Hash hash;
  add_layout(hash, model);
  System system(model);
  const State start = model.start_state();
  const double length = system.natural_length();
  for (int probe = 0; probe < 4; ++probe) {
    State state = start;
    state.t = 0.37 * probe;
    for (Eigen::Index i = 0; i < state.q.size(); ++i) {
      const double wave = std::sin(1.0 + 3.7 * static_cast<double>(i) + 11.3 * probe);
      const double size = i % 3 == 2 ? 1.0 : length;
      state.q[i] += 1e-3 * probe * size * wave;
      state.v[i] += 0.1 * size * wave;
    }
    for (std::size_t i = 0; i < state.contacts.size() && probe % 2 == 1; ++i) {
      state.contacts[i].phase = probe == 1 ? ContactPhase::compressing : ContactPhase::restituting;
      state.contacts[i].approach_velocity = 0.3;
      state.contacts[i].effective_mass = 1.7;
      state.contacts[i].largest_penetration = 1e-5 * length;
    }
    add_answers(hash, system, state);
  }
  return hash.value();
}

}  // namespace yoke
