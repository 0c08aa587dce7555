// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/analyses/details/descent.hpp>

#include <algorithm>
#include <cmath>

namespace yoke {

namespace {

constexpr int max_steps = 5000;
constexpr double first_way = 0.3;                      // length scales in one step; it may grow
constexpr double largest_turn = 0.5;                   // [rad] in one step
constexpr double close_to_rest = 1e-3;                 // the same: Newton's iteration is tried
constexpr double lost_beyond = 1e6, lost_turns = 1e3;  // length scales, rad: nothing holds it
constexpr double enough = 0.1, good = 0.6;             // work done, in parts of what was predicted
constexpr double first_inertia = 1.0, least_inertia = 1e-14, largest_inertia = 1e16;

using Vector = Eigen::VectorXd;

/// A point on the way, with multipliers that fit it.
class Descent {
 public:
  Descent(Statics& statics, Vector& x) : statics_(statics), x_(x) {}

  /// Multipliers of the forces at x: a step under so much inertia that nothing moves.
  bool begin() {
    Vector F;
    if (!statics_.residual(x_, F) || !statics_.factorise(x_, largest_inertia)) return false;
    Vector step = statics_.along_joints(-F);
    if (!statics_.solve(step)) return false;
    statics_.add_multipliers(step, x_);
    return true;
  }

  /// One step; false if none is possible.
  bool step() {
    Vector F;
    if (!statics_.residual(x_, F)) return false;
    for (; inertia_ <= largest_inertia; inertia_ = std::max(4.0 * inertia_, least_inertia)) {
      if (!statics_.factorise(x_, inertia_)) continue;
      Vector d = statics_.along_joints(-F);
      if (!statics_.solve(d)) continue;
      move_ = statics_.move(d);
      const double way = statics_.largest_displacement(d), turn = statics_.largest_turn(d);
      if (way > longest_way_ || turn > largest_turn) continue;
      const double slope = statics_.work(x_, x_ + d, 1), held = inertia_ * statics_.inertial(d);
      // Rest, to rounding; settle() has the last word.
      if (move_ < nothing) return true;
      if (!(slope > 0.0)) continue;
      Vector next = x_ + d;
      if (!statics_.project(next)) continue;
      const double predicted = 0.5 * (slope + held), work = statics_.work(x_, next, 5);
      Vector F_next;
      if (!(work > enough * predicted) || !statics_.residual(next, F_next)) continue;
      if (work > good * predicted) {
        inertia_ = std::max(0.25 * inertia_, least_inertia);
        if (way > 0.3 * longest_way_) longest_way_ *= 2.0;
      }
      x_ = next;
      return true;
    }
    inertia_ = first_inertia;
    return false;
  }
  double move() const { return move_; }

 private:
  static constexpr double nothing = 1e-15;
  Statics& statics_;
  Vector& x_;
  double inertia_ = first_inertia, move_ = 0.0, longest_way_ = first_way;
};

}  // namespace

DescentEnd descend(Statics& statics, Vector& x, long& iterations,
                   const std::function<bool(Vector&)>& settle) {
  Descent descent(statics, x);
  if (!descent.begin()) return DescentEnd::stuck;
  for (int i = 0; i < max_steps; ++i) {
    ++iterations;
    const bool moved = descent.step();
    if (!moved || descent.move() < close_to_rest) {
      Vector y = x;
      if (settle(y) && statics.move(y - x) < 10.0 * close_to_rest) {
        x = y;
        return DescentEnd::at_rest;
      }
    }
    if (!moved) return DescentEnd::stuck;
    if (statics.largest_displacement(x) > lost_beyond || statics.largest_turn(x) > lost_turns)
      return DescentEnd::lost;
  }
  return DescentEnd::stuck;
}

}  // namespace yoke
