// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The motion of a mechanism whose drivers leave no degree of freedom: found at each time from the
// equations of the joints alone, by Newton's iteration from a prediction q + v h + a h^2/2. A step
// is accepted if the correction is a small part of it, so that the motion stays on its branch.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <yoke/core/equations/dynamics.hpp>
#include <yoke/core/equations/least_change.hpp>
#include <yoke/core/result.hpp>

namespace yoke {

class DrivenMotion {
 public:
  /// Assembles the start. Throws ModelError, in the name of `analysis`, if a degree of freedom is
  /// left, the start cannot be assembled, or a driver contradicts itself before `until` [s].
  DrivenMotion(const Model& model, std::string_view analysis, double until);
  /// Goes on from a state of a run that left out the equations `dropped`. Degrees of freedom that
  /// remain follow their accelerations, which is good enough over a short time.
  DrivenMotion(const Model& model, const State& from, const std::vector<int>& dropped,
               double until);

  Dynamics& dynamics() { return dynamics_; }
  const State& state() const { return state_; }

  /// Goes on to time t. False if it cannot be reached: see failure(). Called after each step
  /// accepted: from the state before to the state after.
  using Observer = std::function<bool(const State& before, const State& after)>;
  bool advance(double t, const Observer& observer = {});
  const std::string& failure() const { return failure_; }
  /// The failure is a dead point: the drivers cannot take the mechanism any further.
  bool at_dead_point() const { return at_dead_point_; }
  long steps() const { return steps_; }

  /// The state at a time near that of `from`, with its accelerations; false if Newton's iteration
  /// fails or leaves the branch.
  bool solve_near(const State& from, double t, State& state);

 private:
  void begin(double until);
  void require_driven(const Model& model, std::string_view analysis) const;
  bool coasts(const State& from, State& state);
  double distance(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const;
  bool keeps_to_branch();
  double independence(const State& state, int iterations);
  void explain_failure(double h);

  Dynamics dynamics_;
  State state_;
  State trial_;
  Eigen::VectorXd predicted_;
  double span_ = 0.0;
  double h_ = 0.0;
  long steps_ = 0;
  std::string failure_;
  bool at_dead_point_ = false;
};

/// Why a run failed that had come from `from` to `t_failed` [s]: the message of the dead point that
/// its drivers run into within `reach` [s] of there, as kinematics() reports it; empty if there is
/// none.
std::string find_dead_point(const Model& model, const State& from, const std::vector<int>& dropped,
                            double t_failed, double reach);

/// The positions along a driven motion where the Jacobian of the constraints is nearly singular:
/// local minima of Dynamics::independence(), located in time.
class SingularityWatch {
 public:
  SingularityWatch(DrivenMotion& motion, double warn_below);
  /// To be told of the start and of every step.
  void see(const State& state);
  /// At the end: a fall that goes on to the last state counts as well.
  void finish();
  const std::vector<SingularPosition>& found() const { return found_; }
  double last() const { return values_[1]; }

 private:
  double value_at(const State& state);
  void locate(double until);
  void note(const State& state, double value);

  DrivenMotion& motion_;
  double warn_below_;
  State before_, middle_;  // the last two states
  double values_[2] = {1.0, 1.0};
  int seen_ = 0;
  std::vector<SingularPosition> found_;
};

}  // namespace yoke
