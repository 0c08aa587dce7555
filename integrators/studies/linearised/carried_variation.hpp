// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Variations carried along a run: columns of motions beside it, to first order. Between events
//   y' = A(t) y + B(t) m          y = (a, b, dz) in the turning frame (turning_frame.hpp)
// with m the variation of what the run remembers (memory_numbers.hpp), constant between events. A is
// exact; the columns of B are central differences of the forces by one number each. The steps are those
// of the run, parted where something is fast beside them; each is a step of Gauss' collocation of order 6
// (Radau IIA of order 5 where something stiff decays), linear and so solved at once. The states within
// are those of the run's own dense output, on the constraints. Beside an event, where a law's stiffness may
// start like the square root of time, or be infinite at first, time goes like the fourth power.
//
// At an event h(x, m, t) = 0 a motion beside meets it later by
//   dt = -(h_x dx + h_m dm) / h'      h' along the motion
// With x + R(x, m) the state behind the event, f the rates before (-) and after (+) it:
//   dx+ = (1 + R_x) (dx + f- dt) + R_m dm - f+ dt    dm+ likewise, without the last term
// R is what the elements do, so its derivative is a central difference of that along each column; h_x and h'
// are such differences of the event's function.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <yoke/integrators/engine/run_watch.hpp>
#include <yoke/integrators/run/event_dispatch.hpp>
#include <yoke/integrators/studies/linearised/memory_numbers.hpp>
#include <yoke/integrators/studies/linearised/turning_frame.hpp>

namespace yoke {

class CarriedVariation final : public RunWatch {
 public:
  using Matrix = Eigen::MatrixXd;

  /// Of a run with this tolerance. At its start `columns` variations begin, the first unit vectors of y, 0:
  /// all; behind them, if `with_memory`, those of the memory numbers that act there.
  CarriedVariation(const Model& model, double relative_tolerance, int columns, bool with_memory);
  CarriedVariation(const CarriedVariation&) = delete;
  CarriedVariation& operator=(const CarriedVariation&) = delete;

  // Of RunWatch; they throw ModelError for what has no linear equations here.
  void start(const State& state, const System& system) override;
  void step(Formulation& formulation, const State& memory, double t, bool at_event) override;
  void jump(const State& before, const std::vector<int>& fired, const State& after) override;
  void sample(const State& state) override;

  /// Called once at the start, on the constraints with its accelerations, where y and m may be changed.
  std::function<void(CarriedVariation&, const State&)> at_start{};
  /// Called at the end of each step, where y and m may be changed.
  std::function<void(CarriedVariation&)> at_step{};
  /// [s] at_step is called there too, although the run makes no step to there.
  double pause = std::numeric_limits<double>::infinity();

  double time() const { return t_; }
  Matrix y, m;  // [2 f + nz], [numbers], by columns
  /// Memory numbers that have a column of their own behind those of y.
  const std::vector<int>& varied_numbers() const { return varied_; }
  const MemoryNumbers& numbers() const { return numbers_; }
  int freedom() const { return frame_.freedom(); }
  const TurningFrame& frame() const { return frame_; }
  /// Sum of the rates of growth of all y, integrated over time: the logarithm of how a volume grows
  /// between events.
  double growth_of_volume() const { return trace_; }
  /// Events at which variations jumped, and evaluations of A.
  long jumps() const { return jumps_; }
  long evaluations() const { return evaluations_; }
  /// What was assumed, a sentence each.
  const std::vector<std::string>& notes() const { return notes_; }
  Scales scales() const { return dynamics_.system().scales(); }

  /// The frame at a state, in which y is given from now on.
  const TurningFrame& look_at(const State& state);
  /// dq, dv [n x columns] at the state of the last look_at().
  Matrix positions() const;
  Matrix velocities() const;
  Eigen::Index size() const { return 2 * frame_.freedom() + dynamics_.system().states(); }

 private:
  using Vector = Eigen::VectorXd;
  struct Stage {
    Matrix A, Bm;                    // Bm = B m
    double rate = 0.0, decay = 0.0;  // [1/s] of what is fast, and of what is damped
  };
  /// A direction of the extended state, and what a jump makes of it.
  struct Direction {
    Vector q, v, z, m;
    double t = 0.0;
  };

  State shown(Formulation& formulation, const State& memory, double t);
  Stage calc_stage(const State& state);
  void calc_memory_forces(const State& state, int number, Vector& rates);
  void calc_forces(const State& state, Vector& rates);
  /// What a step is made of, with s from 0 to 1 in it: the time, and dt/ds.
  struct Pace {
    double from, to;
    bool begins = false, ends = false;  // at an event
    double time(double s) const;
    double rate(double s) const;
  };
  void go_to(double t, Formulation& formulation, const State& memory, bool at_event);
  void advance(Formulation& formulation, const State& memory, const Pace& pace);
  void collocate(Formulation& formulation, const State& memory, const Pace& pace, double from,
                 double h, bool stiff, const Stage* middle);
  void refuse_varied_drivers(const State& state) const;
  void refuse_grips(const State& state) const;
  Direction rates_of(const State& state);
  void move(const State& from, const Direction& along, double by);
  double size_of(const Direction& along, const State& state) const;
  double slope_of_event(const State& at, int slot, const Direction& along);
  double value_of_event(int slot);
  int slot_of(const State& before, const std::vector<int>& fired, const State& after);
  bool pass_event(const State& before, const std::vector<int>& fired, const State& after,
                  const Direction& along, double by, Direction& change);
  Direction derivative_of_event(const State& before, const std::vector<int>& fired,
                                const State& after, const Direction& along);
  void note(std::string text);
  std::string owner_of(int slot) const;

  double tolerance_;
  int columns_;
  bool with_memory_;
  Dynamics dynamics_;
  TurningFrame frame_;
  MemoryNumbers numbers_;
  State beside_;
  Result scratch_;
  bool stopped_ = false;
  ElementEvents events_;
  std::vector<int> varied_;
  std::vector<double> g_;
  double t_ = 0.0, trace_ = 0.0;
  bool jumped_ = false;  // at t_
  long jumps_ = 0, evaluations_ = 0;
  std::vector<std::string> notes_;
};

}  // namespace yoke
