// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/run/recorder.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <yoke/core/error.hpp>
#include <yoke/core/output/pattern.hpp>
#include <yoke/integrators/run/constraint_summary.hpp>

namespace yoke {

namespace {

void add_body_columns(Table& table, const Body& body) {
  const std::string n = body.name + ".";
  for (const auto& [name, unit] : {std::pair{"x", "m"},
                                   {"y", "m"},
                                   {"angle", "rad"},
                                   {"vx", "m/s"},
                                   {"vy", "m/s"},
                                   {"omega", "rad/s"},
                                   {"ax", "m/s^2"},
                                   {"ay", "m/s^2"},
                                   {"alpha", "rad/s^2"}})
    table.add_column(n + name, unit);
}

/// Columns that fit a pattern, and the first one, the time.
std::vector<std::size_t> choose_columns(const Table& all,
                                        const std::vector<std::string>& patterns) {
  std::vector<bool> wanted(all.names().size(), false);
  wanted.front() = true;
  for (const std::string& pattern : patterns) {
    bool fits = false;
    for (std::size_t i = 0; i < wanted.size(); ++i)
      if (matches(pattern, all.names()[i])) wanted[i] = fits = true;
    if (!fits)
      throw ModelError(
          fmt::format("simulation: columns: none fits '{}' (* is any text, ? any character); {}",
                      pattern, all.nearest(pattern)));
  }
  std::vector<std::size_t> columns;
  for (std::size_t i = 0; i < wanted.size(); ++i)
    if (wanted[i]) columns.push_back(i);
  return columns;
}

}  // namespace

Recorder::Recorder(Dynamics& dynamics, Result& result, std::size_t rows,
                   const std::vector<std::string>& patterns)
    : dynamics_(dynamics), result_(result) {
  add_columns(result.samples);
  if (!patterns.empty()) {
    chosen_ = choose_columns(result.samples, patterns);
    row_.resize(result.samples.names().size());
    result.samples = result.samples.only(chosen_);
  }
  result.samples.reserve(rows);
}

void Recorder::add_columns(Table& table) {
  const System& system = dynamics_.system();
  table.add_column("t", "s");
  for (std::size_t i = 1; i < system.model().bodies().size(); ++i)
    add_body_columns(table, system.model().bodies()[i]);
  table.begin_part("reactions");
  for (const ConstraintSlot& c : system.joints()) {
    table.add_column(c.element->name() + ".fx", "N");
    table.add_column(c.element->name() + ".fy", "N");
    table.add_column(c.element->name() + ".moment", "N m");
  }
  for (const ForceSlot& f : system.forces()) {
    table.begin_part(f.element->penetration_scale() > 0.0 ? "contacts" : "forces");
    for (const Channel& z : f.element->states())
      table.add_column(f.element->name() + "." + z.name, z.unit);
    const std::vector<Channel> channels = f.element->channels();
    for (const Channel& c : channels)
      table.add_column(f.element->name() + "." + c.name, c.unit, c.labels);
    channels_.push_back(channels.size());
  }
  table.begin_part("energies");
  for (const std::string& name : system.quadrature_names()) table.add_column(name, "J");
  is_work_ = system.quadratures_of_work();
  for (const char* name : {"kinetic", "potential", "stored", "dissipated", "work", "balance"})
    table.add_column(name, "J");
}

void Recorder::start(const State& state) {
  System& system = dynamics_.system();
  system.bind(state);
  system.set_motion(state.t, state.q.data(), state.v.data());
  ledger_.start = system.calc_energy();
  ledger_.initial = ledger_.start.kinetic + ledger_.start.potential + ledger_.start.stored;
  for (std::size_t i = 0; i < is_work_.size(); ++i)
    ledger_.initial += (is_work_[i] ? -1.0 : 1.0) * state.energy[static_cast<Eigen::Index>(i)];
}

void Recorder::record(const State& state, Table& table) {
  check(state);
  dynamics_.share_hold_forces(state.lambda.data());
  if (chosen_.empty()) return fill(state, table.append());
  fill(state, row_.data());
  double* row = table.append();
  for (const std::size_t i : chosen_) *row++ = row_[i];
}

void Recorder::fill(const State& state, double* row) {
  *row++ = state.t;
  row = record_bodies(state, row);
  row = record_reactions(row);
  row = record_channels(row);
  record_energy(state, row);
}

void Recorder::check(const State& state) { note_violation(dynamics_, state, result_.summary); }

double* Recorder::record_bodies(const State& state, double* row) const {
  for (Eigen::Index i = 0; i < state.q.size(); i += 3) {
    for (const Eigen::VectorXd* values : {&state.q, &state.v, &state.a})
      for (Eigen::Index j = 0; j < 3; ++j) *row++ = (*values)[i + j];
  }
  return row;
}

double* Recorder::record_reactions(double* row) const {
  for (std::size_t i = 0; i < dynamics_.system().joints().size(); ++i) {
    const Reaction reaction = dynamics_.reaction(i, dynamics_.shared_multipliers());
    *row++ = reaction.force.x();
    *row++ = reaction.force.y();
    *row++ = reaction.moment;
  }
  return row;
}

double* Recorder::record_channels(double* row) const {
  const auto forces = dynamics_.system().forces();
  for (std::size_t i = 0; i < forces.size(); ++i) {
    const ForceInput input = dynamics_.system().force_input(forces[i]);
    row = std::copy_n(input.z, forces[i].states, row);
    if (channels_[i] == 0) continue;
    forces[i].element->calc_channels(input, row);
    row += channels_[i];
  }
  return row;
}

void Recorder::record_energy(const State& state, double* row) {
  const EnergyTerms energy = dynamics_.system().calc_energy();
  double work = 0.0, dissipated = 0.0, moved = 0.0;
  for (std::size_t i = 0; i < is_work_.size(); ++i) {
    const double value = state.energy[static_cast<Eigen::Index>(i)];
    *row++ = value;
    (is_work_[i] ? work : dissipated) += value;
    moved = std::max(moved, std::abs(value));
  }
  const double balance =
      energy.kinetic + energy.potential + energy.stored + dissipated - work - ledger_.initial;
  for (const double x :
       {energy.kinetic, energy.potential, energy.stored, dissipated, work, balance})
    *row++ = x;
  Summary& summary = result_.summary;
  summary.energy_balance = std::max(summary.energy_balance, std::abs(balance));
  summary.energy_exchanged =
      std::max({summary.energy_exchanged, moved, std::abs(energy.kinetic - ledger_.start.kinetic),
                std::abs(energy.potential - ledger_.start.potential),
                std::abs(energy.stored - ledger_.start.stored)});
}

}  // namespace yoke
