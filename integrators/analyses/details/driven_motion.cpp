// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/analyses/details/driven_motion.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include <yoke/integrators/run/constraint_summary.hpp>
#include <yoke/integrators/run/failure_messages.hpp>
#include <yoke/integrators/run/start/start_checks.hpp>

namespace yoke {

namespace {

constexpr double shortest_step = 1e-13;   // of the whole time
constexpr double small_correction = 0.1;  // of the step
constexpr double largest_move = 0.1;      // length scales or rad in one step
// Near a singular position branches are close: they part at a distance of about the root of the
// independence. A step is a part of that, but need not be smaller than `always_allowed`.
constexpr double part_of_distance = 0.1;
constexpr double always_allowed = 1e-5;
constexpr double singular = 1e-10;  // independence where nothing but the past tells the velocities
constexpr double coasting =
    1e-12;  // violation after a step by prediction alone, length scales or rad
constexpr double rounding = 1e-9;  // length scales or rad: a correction that needs no excuse
constexpr double nearly_dependent = 1e-4;  // independence at a dead point, as near as one can go
constexpr double worth_a_look = 0.05;      // independence of a minimum that is located
constexpr long steps_to_get_on = 5000;     // to go a little way, in the search for a dead point:
constexpr double little_way = 1e-2;        // of how far ahead it is looked for

/// Bodies that the constraints let move at this pose, at most five.
std::vector<std::string> movable_bodies(Dynamics& dynamics, const State& state) {
  System& system = dynamics.system();
  std::vector<double> phi(static_cast<std::size_t>(system.rows()));
  const std::vector<double> rest(static_cast<std::size_t>(system.dofs()), 0.0);
  system.set_motion(state.t, state.q.data(), rest.data());
  system.calc_position_level(phi.data());
  LeastChange change(system, metric_of_masses(system));
  Eigen::VectorXd d(system.dofs());
  for (Eigen::Index i = 0; i < d.size(); ++i) d[i] = std::cos(1.0 + 2.4 * static_cast<double>(i));
  for (Eigen::Index i = 0; i < d.size(); ++i)
    if (i % 3 != 2) d[i] *= system.scales().length;
  change.make_admissible(d.data());
  std::vector<std::string> names;
  for (Eigen::Index i = 0; i < d.size() && names.size() < 5; i += 3) {
    const double move =
        std::max(d.segment<2>(i).norm() / system.scales().length, std::abs(d[i + 2]));
    if (move > 1e-6)
      names.push_back(system.model().bodies()[static_cast<std::size_t>(i / 3 + 1)].name);
  }
  return names;
}

}  // namespace

DrivenMotion::DrivenMotion(const Model& model, std::string_view analysis, double until)
    : dynamics_(model), state_(model.start_state()) {
  check_model(model);
  require_finite(analysis, "until", until);
  if (!(until > state_.t))
    throw ModelError(
        fmt::format("{}: until = {:g} s must be later than the start, 0 s", analysis, until));
  if (const Outcome outcome = dynamics_.assemble(state_); !outcome) throw ModelError(outcome.why);
  dynamics_.system().set_scales({.length = dynamics_.system().natural_length(), .time = 1.0});
  require_driven(model, analysis);
  check_drivers(dynamics_.system(), state_, until);
  dynamics_.reset();
  if (!dynamics_.project(state_))
    throw ModelError(fmt::format("{}: accelerations at the start are not finite", analysis));
  begin(until);
}

DrivenMotion::DrivenMotion(const Model& model, const State& from, const std::vector<int>& dropped,
                           double until)
    : dynamics_(model), state_(from) {
  System& system = dynamics_.system();
  system.bind(state_);
  system.set_scales({.length = system.natural_length(), .time = 1.0});
  dynamics_.leave_out(dropped);
  if (!dynamics_.project(state_)) throw ModelError(not_projected("", from.t));
  begin(until);
}

void DrivenMotion::begin(double until) {
  trial_ = state_;
  span_ = until - state_.t;
  h_ = span_;
}

double DrivenMotion::independence(const State& state, int iterations) {
  return dynamics_.independence(state.t, state.q.data(), iterations);
}

void DrivenMotion::require_driven(const Model& model, std::string_view analysis) const {
  const int dofs = degrees_of_freedom(dynamics_);
  if (dofs == 0) return;
  Dynamics fresh(model);
  throw ModelError(
      fmt::format("{}: {} degree{} of freedom {} left, of '{}': drive {}, or use simulate() for "
                  "the motion that "
                  "follows from the forces",
                  analysis, dofs, dofs == 1 ? "" : "s", dofs == 1 ? "is" : "are",
                  fmt::join(movable_bodies(fresh, state_), "', '"), dofs == 1 ? "it" : "them"));
}

double DrivenMotion::distance(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const {
  const double length = dynamics_.system().scales().length;
  double largest = 0.0;
  for (Eigen::Index i = 0; i < a.size(); ++i)
    largest = std::max(largest, std::abs(a[i] - b[i]) / (i % 3 == 2 ? 1.0 : length));
  return largest;
}

bool DrivenMotion::solve_near(const State& from, double t, State& state) {
  const double h = t - from.t;
  state.t = t;
  state.q = from.q + h * from.v + 0.5 * h * h * from.a;
  state.v = from.v + h * from.a;
  if (!state.q.allFinite() || !state.v.allFinite()) return false;
  predicted_ = state.q;
  const double move = distance(predicted_, from.q);
  if (move > largest_move) return false;
  dynamics_.system().bind(state);
  if (move <= always_allowed && coasts(from, state)) return true;
  const bool regular = dynamics_.project_positions(t, state.q.data(), Correction::exact) &&
                       dynamics_.project_velocities(t, state.q.data(), state.v.data()) &&
                       dynamics_.calc_accelerations(state);
  if (!regular) {  // a singular position may have been hit exactly
    state.q = predicted_;
    state.v = from.v + h * from.a;
    if (!dynamics_.project(state)) return false;
  }
  return distance(state.q, predicted_) <= std::max(small_correction * move, rounding);
}

// At a singular position velocities and accelerations do not follow from the constraints, and next
// to it they are lost to rounding (as 1/independence and more). The motion that came there goes
// through: over so short a way its prediction is as good as rounding.
bool DrivenMotion::coasts(const State& from, State& state) {
  if (independence(state, 3) > singular) return false;
  state.a = from.a;
  state.lambda = from.lambda;
  const double length = dynamics_.system().scales().length, time = state.t - from.t;
  const auto small = [length](const Violation& v) {
    return v.length <= coasting * length && v.angle <= coasting;
  };
  const Violation rate = dynamics_.velocity_violation(state);
  return small(dynamics_.position_violation(state)) &&
         small({rate.length * time, rate.angle * time});
}

bool DrivenMotion::advance(double t, const Observer& observer) {
  while (state_.t < t) {
    const double left = t - state_.t;
    const double h = std::min(h_, left);
    const double next = h >= left * (1.0 - 1e-12) ? t : state_.t + h;
    if (solve_near(state_, next, trial_) && keeps_to_branch()) {
      const double bound = 1e-8;
      if (failure_ = dynamics_.contradiction(trial_.t, trial_.q.data(), bound); !failure_.empty())
        return false;
      ++steps_;
      if (observer && !observer(state_, trial_)) return false;
      std::swap(state_, trial_);
      h_ = std::min(2.0 * h, span_);
      continue;
    }
    h_ = 0.5 * h;
    if (h_ > shortest_step * span_ && state_.t + h_ > state_.t) continue;
    explain_failure(h_);
    return false;
  }
  return true;
}

bool DrivenMotion::keeps_to_branch() {
  const double move = distance(trial_.q, state_.q);
  return move <= std::max(always_allowed, part_of_distance * std::sqrt(independence(trial_, 3)));
}

void DrivenMotion::explain_failure(double h) {
  const int violated = dynamics_.worst_row();
  const double value = independence(state_, 30);
  const System& system = dynamics_.system();
  at_dead_point_ = system.not_finite().empty() && value < nearly_dependent;
  if (!system.not_finite().empty())
    failure_ = fmt::format("'{}' gives a value that is not finite after t = {:.9g} s",
                           system.not_finite(), state_.t);
  else if (at_dead_point_)
    failure_ = fmt::format(
        "dead point at t = {:.9g} s: the drivers cannot take the mechanism any further; '{}' is "
        "nearly dependent on the other equations there",
        state_.t, system.equation_name(dynamics_.weakest_row()));
  else
    failure_ = fmt::format(
        "no position near that at t = {:.9g} s satisfies all joints {:g} s later, though the "
        "Jacobian is regular ({:.1e}): does a driver jump? Worst equation '{}'",
        state_.t, h, value, system.equation_name(violated));
}

std::string find_dead_point(const Model& model, const State& from, const std::vector<int>& dropped,
                            double t_failed, double reach) {
  const bool driven =
      std::ranges::any_of(model.constraints(), [](const auto& c) { return c->rheonomic(); });
  if (!driven) return {};
  try {
    DrivenMotion motion(model, from, dropped, t_failed + reach);
    // What runs away, as a degree of freedom that is left may, gets nowhere in ever shorter steps.
    double t_marked = from.t;
    const auto gets_on = [&](const State&, const State& after) {
      if (motion.steps() % steps_to_get_on != 0) return true;
      const double way = after.t - std::exchange(t_marked, after.t);
      return way > little_way * reach;
    };
    if (motion.advance(t_failed + reach, gets_on)) return {};
    return motion.at_dead_point() ? motion.failure() : "";
  } catch (const std::exception&) {  // whatever it is, it is not this
    return {};
  }
}

SingularityWatch::SingularityWatch(DrivenMotion& motion, double warn_below)
    : motion_(motion), warn_below_(warn_below) {}

double SingularityWatch::value_at(const State& state) {
  return motion_.dynamics().independence(state.t, state.q.data(), 4);
}

void SingularityWatch::note(const State& state, double value) {
  if (!(value < warn_below_)) return;
  const System& system = motion_.dynamics().system();
  if (!found_.empty() && found_.back().t == state.t) return;
  found_.push_back({.t = state.t,
                    .equation = system.equation_name(motion_.dynamics().weakest_row()),
                    .independence = value});
}

void SingularityWatch::see(const State& state) {
  const double value = value_at(state);
  if (seen_ == 1 && values_[1] < value) note(middle_, values_[1]);  // a start that is singular
  if (seen_ >= 2 && values_[1] < values_[0] && values_[1] <= value && values_[1] < worth_a_look)
    locate(state.t);
  before_ = middle_;
  middle_ = state;
  values_[0] = values_[1];
  values_[1] = value;
  ++seen_;
}

// By golden section between the neighbours of the smallest value seen.
void SingularityWatch::locate(double until) {
  constexpr double share = 0.6180339887498949;
  double low = before_.t, high = until;
  State state = middle_, best = middle_;
  double least = values_[1];
  const auto at = [&](double t) {
    if (!motion_.solve_near(middle_, t, state)) return 1.0;
    const double value = value_at(state);
    if (value < least) {
      least = value;
      best = state;
    }
    return value;
  };
  double a = high - share * (high - low), b = low + share * (high - low);
  double fa = at(a), fb = at(b);
  for (int i = 0; i < 40 && high - low > 1e-12 * std::abs(high); ++i) {
    if (fa < fb) {
      high = b, b = a, fb = fa;
      a = high - share * (high - low), fa = at(a);
    } else {
      low = a, a = b, fa = fb;
      b = low + share * (high - low), fb = at(b);
    }
  }
  value_at(best);  // so that the weakest row is that of the minimum
  note(best, least);
}

void SingularityWatch::finish() {
  if (seen_ >= 2 && values_[1] < values_[0]) {
    value_at(middle_);
    note(middle_, values_[1]);
  }
}

}  // namespace yoke
