// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A run as an object, to be embedded in other programs: it is taken to any time, looked at,
// changed, taken back, copied. simulate() is one of these taken to its end.
//
//   Simulation run(model, {.until = 2.0, .samples = 0});
//   while (run.time() < 2.0) {
//     run.advance_to(run.time() + 1e-3);
//     run.set("motor.torque", controller(run.get("crank.omega_rad_per_s")));
//   }
//
// Where a run stops in between does not change it: the integrator may be ahead, and the state shown
// comes from its dense output. Only set() and restore() restart the integrator, at the time shown.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <yoke/integrators/simulate.hpp>

namespace yoke {

/// All a run needs to go on from an instant, or to go back to it. A value.
struct Snapshot {
  State state;                  // consistent; may be changed, and is projected when it is restored
  double initial_energy = 0.0;  // [J] of the ledger
  std::string formulation;      // by which the run goes on
  double tolerance_kept = 0.0;  // as in Summary
  std::vector<int> left_out;    // redundant equations
  Eigen::VectorXd v_taken;  // as state.v was; where that has been changed, friction at rest lets go
};

/// A snapshot as bytes, every bit of it, and back: for files and other programs, of this version. Throws
/// ModelError for other bytes.
std::vector<std::uint8_t> to_bytes(const Snapshot& snapshot);
/// Of this version. Throws ModelError for other bytes.
Snapshot snapshot_from_bytes(std::span<const std::uint8_t> bytes);

class Simulation {
 public:
  /// As simulate(): throws ModelError for what is wrong before the start. `model` must outlive the
  /// simulation; the options are copied. Rows of the result are taken as time() passes them.
  Simulation(const Model& model, const SimulationOptions& options);
  Simulation(const Model& model, const State& start, const SimulationOptions& options);
  Simulation(const Model&&, const SimulationOptions&) = delete;  // would not outlive it
  Simulation(const Model&&, const State&, const SimulationOptions&) = delete;
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  double time() const;      // [s] that is shown
  double end_time() const;  // [s] SimulationOptions::until
  /// At its end time, or stopped before, by an event or a failure: see summary().
  bool ended() const;
  /// Stop and reason mean something once the run has ended; counters and figures are written by
  /// result().
  const Summary& summary() const;
  /// Events up to time(), in their order. Valid until the simulation is changed or goes on.
  const std::vector<EventRecord>& events() const;

  /// Goes to `t` [s]; false if the run has ended before. Throws ModelError if t is before time() or
  /// behind end_time().
  bool advance_to(double t);
  /// Goes to the end of the integrator's step that time() is in, or of the next one. False if the
  /// run has ended.
  bool step();

  /// The state at time(), on the constraints, with accelerations and multipliers. Valid until the
  /// simulation is changed or goes on.
  const State& state();
  /// A column of the samples ("crank.angle_rad", "hinge.fx_N") or a changeable parameter
  /// ("spring.stiffness") at time(). Throws ModelError that lists near names.
  double get(std::string_view name);
  /// The same for a column by its number, without a search.
  double output(std::size_t column);
  /// Number of a column, for output(). Throws ModelError that lists near names.
  std::size_t find_output(std::string_view column) const;

  /// Changes a parameter "element.name" from time() on. What that changes in stored energy is
  /// counted as initial energy, so the balance stays a check. Throws ModelError for an unknown name
  /// and a value out of range; then nothing has changed. The number is Model::find_parameter().
  void set(std::string_view parameter, double value);
  void set(std::size_t parameter, double value);

  /// All it needs to come back to time().
  Snapshot snapshot();
  /// Goes back, or anywhere else: rows and events behind the snapshot's time are forgotten, the
  /// integrator starts afresh. What follows depends on the snapshot alone: the same bits each time.
  /// Throws ModelError if the snapshot is not of this model, outside the times of the run, not to be
  /// brought onto the constraints, and in a run with checkpoints.
  void restore(const Snapshot& snapshot);
  /// From now on every advance_to() and step() begins with a snapshot, to which rewind() goes back.
  void keep_last(bool keep = true);
  /// Takes back the last advance_to() or step(), with what has been set since. Throws ModelError if
  /// none was kept.
  void rewind();
  /// A copy that goes its own way from here, as the original would after restore(snapshot()). It
  /// writes no checkpoints.
  Simulation fork();

  /// The result up to time(); `final` is state().
  Result result();
  /// Goes to the end and gives the result away, as simulate() does.
  Result finish();

 private:
  struct Engine;
  explicit Simulation(std::unique_ptr<Engine> engine);
  std::unique_ptr<Engine> engine_;
};

}  // namespace yoke
