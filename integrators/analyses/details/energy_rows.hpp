// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The rows of a driven motion with their energies.
#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <yoke/integrators/analyses/details/driven_motion.hpp>
#include <yoke/integrators/analyses/details/wide_table.hpp>
#include <yoke/integrators/analyses/kinematics.hpp>

namespace yoke {

/// "motor.work" is fed by "motor.power".
inline std::string power_name(const std::string& quadrature) {
  return quadrature.ends_with(".work") ? quadrature.substr(0, quadrature.size() - 4) + "power"
                                       : quadrature + "_power";
}

/// Energies along a driven motion, from their rates at three points within each step.
class EnergyIntegral {
 public:
  explicit EnergyIntegral(DrivenMotion& motion)
      : motion_(motion),
        rates_(Eigen::VectorXd::Zero(motion.dynamics().system().quadratures())),
        total_(rates_) {}

  /// False if a state within the step cannot be found.
  bool add(const State& before, const State& after) {
    if (rates_.size() == 0) return true;
    const double h = after.t - before.t, offset = std::sqrt(0.15);
    at_ = before;
    for (const auto& [place, weight] :
         {std::pair{0.5 - offset, 5.0 / 18.0}, {0.5, 8.0 / 18.0}, {0.5 + offset, 5.0 / 18.0}}) {
      next_ = at_;
      if (!motion_.solve_near(at_, before.t + place * h, next_)) return false;
      std::swap(at_, next_);
      if (!calc_rates(at_)) return false;
      total_ += weight * h * rates_;
    }
    return true;
  }
  bool calc_rates(State& state) {
    motion_.dynamics().system().bind(state);
    return motion_.dynamics().calc_accelerations(
        {.t = state.t, .q = state.q.data(), .v = state.v.data(), .z = state.z.data()},
        {.a = state.a.data(), .lambda = state.lambda.data(), .quadrature_rates = rates_.data()});
  }
  const Eigen::VectorXd& rates() const { return rates_; }
  const Eigen::VectorXd& total() const { return total_; }
  void add(const Eigen::VectorXd& energy) { total_ += energy; }

 private:
  DrivenMotion& motion_;
  Eigen::VectorXd rates_, total_;
  State at_, next_;
};

/// Rates of energy through a stretch of the motion where they cannot be evaluated, by the
/// polynomial through those before and after it.
class Bridge {
 public:
  void add(double t, const Eigen::VectorXd& rates) { nodes_.push_back({t, rates}); }
  Eigen::VectorXd rates(double t) const {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(nodes_.front().rates.size());
    for (const Node& node : nodes_) {
      double weight = 1.0;  // Lagrange's
      for (const Node& other : nodes_)
        if (&other != &node) weight *= (t - other.t) / (node.t - other.t);
      sum += weight * node.rates;
    }
    return sum;
  }
  /// Exact for the polynomial, of degree 3 or less.
  Eigen::VectorXd integral(double from, double to) const {
    const double h = to - from, offset = std::sqrt(1.0 / 12.0);
    return 0.5 * h * (rates(from + (0.5 - offset) * h) + rates(from + (0.5 + offset) * h));
  }

 private:
  struct Node {
    double t;
    Eigen::VectorXd rates;
  };
  std::vector<Node> nodes_;
};

/// The rows of a driven motion with their energies. Next to a singular position multipliers, and
/// with them the powers of drives, are lost to rounding, though the powers stay finite: they are
/// the rates of all other energies. There the rates are bridged between two states before and two
/// behind, and rows wait until they are known.
class EnergyRows {
 public:
  EnergyRows(DrivenMotion& motion, WideTable& table)
      : motion_(motion),
        table_(table),
        energies_(motion),
        watch_(motion, KinematicsOptions{}.warn_below) {
    is_lost(motion.state());
    table_.start(motion.state());
  }

  /// A step accepted; false if energies within it cannot be found.
  bool step(const State& before, const State& after) {
    if (is_lost(after)) return open(before);
    if (open_ && behind_++ == 0) {
      first_behind_ = after;
      return true;
    }
    if (open_ && !close(&after)) return false;
    earlier_ = before;
    has_earlier_ = true;
    return energies_.add(before, after);
  }
  /// A row at the state reached; false if its forces are not finite.
  bool row(State state) {
    if (open_) {
      waiting_.push_back(std::move(state));
      return true;
    }
    state.energy = energies_.total();
    if (!energies_.calc_rates(state)) return false;
    record(state, energies_.rates());
    return true;
  }
  /// No step comes any more. False as for a step.
  bool finish() {
    watch_.finish();
    return !open_ || close(nullptr);
  }
  const std::vector<SingularPosition>& singular_positions() const { return watch_.found(); }
  const State& last() const { return last_; }

 private:
  // Of the best independence met: below this the powers of drives are lost to rounding, which grows
  // as its power -3/2.
  static constexpr double lost_below = 2e-6;

  bool is_lost(const State& state) {
    watch_.see(state);
    best_ = std::max(best_, watch_.last());
    return watch_.last() < lost_below * best_;
  }
  bool open(const State& before) {
    behind_ = 0;
    if (open_) return true;
    open_ = true;
    entry_ = before;
    bridge_ = {};
    return (!has_earlier_ || add_node(earlier_)) && add_node(before);
  }
  bool add_node(State state) {
    if (!energies_.calc_rates(state)) return false;
    bridge_.add(state.t, energies_.rates());
    return true;
  }
  // With the second state behind, if there is one.
  bool close(const State* second) {
    if (behind_ > 0 && !add_node(first_behind_)) return false;
    if (second != nullptr && !add_node(*second)) return false;
    for (State& state : waiting_) {
      state.energy = energies_.total() + bridge_.integral(entry_.t, state.t);
      record(state, bridge_.rates(state.t));
    }
    if (behind_ > 0) energies_.add(bridge_.integral(entry_.t, first_behind_.t));
    waiting_.clear();
    open_ = false;
    return true;
  }
  void record(const State& state, const Eigen::VectorXd& rates) {
    motion_.dynamics().system().bind(state);
    std::ranges::copy(rates, table_.record(state));
    last_ = state;
  }

  DrivenMotion& motion_;
  WideTable& table_;
  EnergyIntegral energies_;
  SingularityWatch watch_;
  double best_ = 0.0;  // independence seen
  bool open_ = false, has_earlier_ = false;
  int behind_ = 0;  // states behind the stretch
  State earlier_, entry_, first_behind_, last_;
  Bridge bridge_;
  std::vector<State> waiting_;
};

}  // namespace yoke
