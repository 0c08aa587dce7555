// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/run/singular/singular_crossing.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include <yoke/core/equations/least_change.hpp>
#include <yoke/integrators/run/singular/closed_loops.hpp>
#include <yoke/integrators/run/singular/crossing.hpp>

namespace yoke {

namespace {

constexpr double in_sight = 0.3;            // of the largest independence: may come near
constexpr double troubled = 0.1;            // the same, if the formulation fails
constexpr double singular_at_start = 1e-8;  // absolute, while nothing larger has been seen
constexpr double look_ahead = 4.0;          // steps
constexpr double missed = 0.05;             // of the largest independence, where it will be least
constexpr double longest_part = 0.1;        // rad or length scales between looks into a step
constexpr int most_looks = 100;
constexpr double edge = 1e-2;          // of a part
constexpr double energy_bound = 1e-6;  // of the energies that take part

}  // namespace

SingularCrossing::SingularCrossing(const FormulationEntry& entry, Dynamics& dynamics,
                                   const Tolerances& tolerances,
                                   std::function<void(const SingularPosition&)> record,
                                   double& largest)
    : entry_(entry),
      dynamics_(dynamics),
      tolerances_(tolerances),
      record_(std::move(record)),
      inner_(entry.make(dynamics, tolerances)),
      gauss_(dynamics, tolerances, 6, 1e-4),
      check_(dynamics, tolerances, 4, 1e-2),  // only judges
      guard_(dynamics),
      watches_(has_closed_loops(dynamics.system())),
      is_work_(dynamics.system().quadratures_of_work()),
      largest_(largest),
      segment_(gauss_.make_segment()),
      trial_(check_.make_segment()),
      y_(static_cast<std::size_t>(gauss_.size())) {
  g_.assign(static_cast<std::size_t>(guard_.count()), 0.0);
  found_events_.assign(g_.size(), 0);
}

void SingularCrossing::start(const State& state) {
  shortest_ = touches(state) ? shortest_touching : shortest_apart;
  here_ = next_ = inside_ = state;
  leaving_ = entering_ = has_before_ = false;
  t_m_ = state.t;
  if (watches_) {
    m_ = dynamics_.independence(state.t, state.q.data());
    const bool singular = largest_ > 0.0 ? m_ < near * largest_ : m_ < singular_at_start;
    largest_ = std::max(largest_, m_);
    if ((crossing_ && m_ < m_entry_) || singular) {
      crossing_ = false;
      forced_ = false;
      begin_crossing();
      return;
    }
  }
  const bool goes_on = loads_only_ && !crossing_;
  if (crossing_) renew();
  crossing_ = false;
  goes_on ? inner_->restart(state) : inner_->start(state);
}

void SingularCrossing::restart(const State& state) {
  loads_only_ = true;
  start(state);
  loads_only_ = false;
}

Step SingularCrossing::step(double t_stop) {
  if (leaving_) {
    leaving_ = crossing_ = false;
    renew();
    inner_->start(here_);
  }
  if (!crossing_ && !entering_) {
    const Step step = step_inside(t_stop);
    if (step != Step::failed || !entering_) return step;
  }
  if (entering_) {
    entering_ = false;
    if (choose_other_rows()) {
      const Step step = step_inside(t_stop);
      if (step != Step::failed || !entering_) return step;
      entering_ = false;
    }
    begin_crossing();
  }
  const Step step = cross(t_stop);
  return step == Step::failed && failure_.empty() ? abandon_crossing(t_stop) : step;
}

// No accurate step can be had from here, but the position is not singular either: the formulation
// goes on, unless it was it that failed.
Step SingularCrossing::abandon_crossing(double t_stop) {
  record_crossed();
  if (forced_) {
    failure_ = inner_failure_;
    return Step::failed;
  }
  crossing_ = false;
  hold_off_ = 0.3 * m_last_;
  renew();
  inner_->start(here_);
  return step_inside(t_stop, false);
}

// Pivots chosen near a singular position are bad ones and the measure of what is a bad one.
void SingularCrossing::renew() {
  dynamics_.reset();
  before_ = counters();
  own_ = {};
  inner_ = entry_.make(dynamics_, tolerances_);
}

// Failed, and entering_: the step is to be taken back, as it has passed a singular position.
Step SingularCrossing::step_inside(double t_stop, bool looks) {
  const Step step = inner_->step(t_stop);
  if (step != Step::failed) {
    inner_->interpolate(inner_->time(), next_);
    passed_ = looks && watches_ && has_passed();
    if (passed_) {
      entering_ = true;
      return Step::failed;
    }
    std::swap(here_, next_);
  }
  if (step == Step::advanced) {
    check_redundant(here_.t, here_.q.data());
    if (watches_) watch();
  } else if (step == Step::failed && watches_) {
    entering_ = forced_ = m_ < troubled * largest_;
    inner_failure_ = inner_->failure();
  }
  return step;
}

// How far the step has moved the mechanism, in parts that are small enough to see a fall and rise of
// the independence.
double SingularCrossing::parts_of_step() const {
  const double length = dynamics_.system().scales().length;
  double fastest = 0.0;
  for (const State* state : {&here_, &next_})
    for (Eigen::Index i = 0; i < state->v.size(); ++i)
      fastest = std::max(fastest, std::abs(state->v[i]) / (i % 3 == 2 ? 1.0 : length));
  return fastest * (next_.t - here_.t) / longest_part;
}

double SingularCrossing::measure_inside(double t) {
  inner_->glance(t, inside_);
  return dynamics_.independence(t, inside_.q.data(), sweeps);
}

// Has a singular position been passed between here_ and next_? With tight tolerances steps are so
// short that watch() sees it come.
bool SingularCrossing::has_passed() {
  const double parts = parts_of_step(), t = here_.t, h = next_.t - t;
  if (!(parts > 1.0)) return false;
  const int looks = std::min(1 + static_cast<int>(parts), most_looks);
  const double part = h / looks;
  if (t_m_ != t) {  // an event that nobody has restarted for
    m_ = dynamics_.independence(t, here_.q.data());
    t_m_ = t;
  }
  double before = m_, now = measure_inside(t + part);
  // What rises at once has its minimum in the first part or before, what falls in the end in the
  // last one or behind.
  if (now >= before && before < in_sight * largest_ && measure_inside(t + edge * part) < before &&
      is_minimum_near(t, t + edge * part, t + part))
    return true;
  for (int i = 1; i < looks; ++i) {
    const double after = measure_inside(t + (i + 1) * part);
    if (now <= before && now <= after && now < in_sight * largest_ &&
        is_minimum_near(t + (i - 1) * part, t + i * part, t + (i + 1) * part))
      return true;
    before = std::exchange(now, after);
  }
  if (!(now < before && now < in_sight * largest_)) return false;
  const double last = next_.t - edge * part;
  if (measure_inside(last) < now) return is_minimum_near(next_.t - part, last, next_.t);
  return now < near * largest_ && has_passed_beside_end(part);
}

// A step that ends beside a singular position may have passed another one close to it, which the
// fall to the end hides from looks that are farther apart.
bool SingularCrossing::has_passed_beside_end(double part) {
  constexpr double further = 1.5;
  const double most = std::min(2.0 * part, next_.t - here_.t);
  double before = 0.0, now = measure_inside(next_.t - edge * part), away = edge * part;
  for (; further * away < most; away *= further) {
    const double after = measure_inside(next_.t - further * away);
    if (now < before && now <= after &&
        is_minimum_near(next_.t - further * away, next_.t - away, next_.t - away / further))
      return true;
    before = std::exchange(now, after);
  }
  return false;
}

// The least independence between a and b, which enclose it, by golden section: is it one to stay
// away from? Then inside_ is there.
bool SingularCrossing::is_minimum_near(double a, double middle, double b) {
  constexpr double golden = 0.3819660112501051;
  constexpr int golden_steps = 30;
  const double bound = std::min(near * largest_, hold_off_);
  double least = measure_inside(middle);
  for (int i = 0; i < golden_steps && least >= bound; ++i) {
    const bool left = middle - a > b - middle;
    const double next = left ? middle - golden * (middle - a) : middle + golden * (b - middle);
    const double there = measure_inside(next);
    if (there < least) {
      (left ? b : a) = std::exchange(middle, next);
      least = there;
    } else {
      (left ? a : b) = next;
    }
  }
  if (least < bound) inner_->glance(middle, inside_);
  return least < bound;
}

void SingularCrossing::watch() {
  passed_ = false;
  const double t = here_.t, m = dynamics_.independence(t, here_.q.data());
  has_before_ = t > t_m_;
  m_before_ = m_;
  dt_ = t - t_m_;
  m_ = m;
  t_m_ = t;
  largest_ = std::max(largest_, m);
  if (m > 5.0 * near * largest_) hold_off_ = 2.0;
  if (!(m < m_before_) || m > hold_off_ || !has_before_) return;
  const double s = std::sqrt(m), rate = (s - std::sqrt(m_before_)) / dt_;
  entering_ = m < near * largest_ ||
              (m < in_sight * largest_ &&
               s < -rate * look_ahead * std::max(dt_, inner_->last_step()) && heads_for_zero());
}

// The independence changes like the square of a distance: a parabola through the last step tells a miss from a
// hit.
bool SingularCrossing::heads_for_zero() {
  const double t = here_.t, half = 0.5 * (t - next_.t);  // next_ is where the step began
  if (!(half > 0.0)) return true;
  const double now = dynamics_.independence(t, here_.q.data(), sweeps);
  const double middle = measure_inside(t - half);
  const double before = dynamics_.independence(next_.t, next_.q.data(), sweeps);
  const double curvature = before - 2.0 * middle + now;  // of what half a step changes
  const double slope = 1.5 * now - 2.0 * middle + 0.5 * before;
  // Where the parabola hardly bends it is not known where it goes.
  const double to_least = -slope / curvature;  // half steps
  return !(curvature > 0.0 && to_least > 0.0 && to_least < 2.0 * look_ahead &&
           now + 0.5 * slope * to_least > missed * largest_);
}

void SingularCrossing::check_redundant(double t, const double* q) {
  const double bound = std::clamp(1e4 * tolerances_.relative, 1e-7, 1e-2);
  const std::string conflict = dynamics_.contradiction(t, q, bound);
  if (!conflict.empty()) throw ModelError(conflict);
}

// Equations kept may become dependent where others are not.
bool SingularCrossing::choose_other_rows() {
  System& system = dynamics_.system();
  if (system.left_out_rows().empty()) return false;
  std::vector<double> phi(static_cast<std::size_t>(system.rows()));
  const std::vector<int> before = system.left_out_rows();
  LeastChange nearest(system, metric_of_lengths(system));
  RankAnalysis analysis;
  // Off the constraints equations that say the same are independent.
  const auto finds_others = [&](double t, Eigen::VectorXd q) {
    if (!nearest.solve_positions(t, q.data())) return false;
    system.set_motion(t, q.data(), here_.v.data());
    system.calc_position_level(phi.data());
    analysis = analyse_rank(system);
    return analysis.dependent.size() == before.size() && analysis.dependent != before;
  };
  // Where it was in the step taken back, or where it is going: on the spot the choice that is about
  // to fail still looks good.
  const double s = std::sqrt(m_), rate = (s - std::sqrt(m_before_));
  const double ahead = rate < 0.0 ? s / -rate * std::max(inner_->last_step(), 0.0) : 0.0;
  bool other = passed_ && finds_others(inside_.t, inside_.q);
  for (const double way : {1.0, 0.75, 1.25, 0.5, 1.5, 2.0, 0.0}) {
    const double later = std::min(way * ahead, system.scales().time);
    other = other || finds_others(here_.t + later, here_.q + later * here_.v);
  }
  dynamics_.leave_out({});  // the blocks of G have changed under the factors
  dynamics_.leave_out(other ? analysis.dependent : before);
  if (!other) return false;
  renew();
  largest_ = m_ = dynamics_.independence(here_.t, here_.q.data());
  inner_->start(here_);
  return true;
}

void SingularCrossing::unpack(double t, const double* y, State& state) const {
  state.t = t;
  for (Eigen::VectorXd* part : {&state.q, &state.v, &state.z, &state.energy}) {
    std::copy_n(y, part->size(), part->data());
    y += part->size();
  }
}

double SingularCrossing::energy(double t, const double* y) {
  System& system = dynamics_.system();
  const auto n = static_cast<std::size_t>(system.dofs());
  system.set_motion(t, y, y + n);
  system.set_states(y + 2 * n);
  const EnergyTerms terms = system.calc_energy();
  double sum = terms.kinetic + terms.potential + terms.stored;
  const double* quadrature = y + 2 * n + static_cast<std::size_t>(system.states());
  for (std::size_t i = 0; i < is_work_.size(); ++i)
    sum += is_work_[i] ? -quadrature[i] : quadrature[i];
  kinetic_entry_ = std::max(kinetic_entry_, terms.kinetic);
  return sum;
}

void SingularCrossing::begin_crossing() {
  crossing_ = true;
  leaving_ = has_found_ = false;
  found_ = {};
  positions_.clear();
  has_recorded_ = false;
  falls_at_end_ = false;
  segments_ = 0;
  failure_.clear();
  t_ = here_.t;
  double* y = segment_.end.data();
  for (const Eigen::VectorXd* part : {&here_.q, &here_.v, &here_.z, &here_.energy})
    y = std::copy_n(part->data(), part->size(), y);
  double m = 1.0;
  gauss_.project(t_, segment_.end.data(), 0.0, m);  // at a singular start it is already
  guard_.start(t_, segment_.end.data(), segment_.end.data() + dynamics_.system().dofs(),
               segment_.end.data() + 2 * dynamics_.system().dofs());
  guard_.settle(here_, t_);
  m_entry_ = m_last_ = m_;
  kinetic_entry_ = 0.0;
  energy_entry_ = energy(t_, segment_.end.data());
  const double scale = dynamics_.system().scales().time;
  h_ = 0.2 * scale;
  const double rate = has_before_ ? (std::sqrt(m_) - std::sqrt(m_before_)) / dt_ : 0.0;
  to_singular_ = rate < 0.0 ? std::sqrt(m_) / -rate : far;
}

void SingularCrossing::end_crossing() {
  leaving_ = true;
  forced_ = false;
  m_ = m_last_;
  t_m_ = t_;
  record_crossed();
  if (found_.independence > was_singular * largest_)  // it only came near: not to be left for again
    hold_off_ = 0.3 * found_.independence;
  const double jump = std::abs(found_.energy_after - energy_entry_);
  if (jump > energy_bound * (kinetic_entry_ + std::abs(energy_entry_)) + 1e4 * tolerances_.energy)
    failure_ = fmt::format(
        "the energy changed by {:g} J from {:g} J over the singular position of "
        "'{}' at t = {:.9g} s",
        found_.energy_after - energy_entry_, energy_entry_, found_.equation, found_.t);
}

// Singular positions, or one that cost energy although it was none.
void SingularCrossing::record_crossed() {
  if (!has_found_) return;
  found_.energy_before = energy_entry_;
  found_.energy_after = energy(t_, segment_.end.data());
  const double jump = std::abs(found_.energy_after - found_.energy_before);
  if (!has_recorded_ && positions_.empty() && jump > allowed_energy_change(energy_entry_))
    positions_.push_back(found_);
  record_positions();
}

void SingularCrossing::record_positions() {
  if (positions_.empty()) return;
  const double now = energy(t_, segment_.end.data());
  for (SingularPosition& position : positions_) {
    position.energy_before = energy_entry_;
    position.energy_after = now;
    record_(position);
  }
  has_recorded_ = true;
  positions_.clear();
}

void SingularCrossing::interpolate(double t, State& state) {
  if (!crossing_) {
    inner_->interpolate(t, state);
    return;
  }
  if (t == t_) {
    unpack(t, segment_.end.data(), state);
    return;
  }
  gauss_.interpolate(segment_, t, y_.data());
  unpack(t, y_.data(), state);
}

void SingularCrossing::sample(double t, State& state) {
  crossing_ ? interpolate(t, state) : inner_->sample(t, state);
}

void SingularCrossing::glance(double t, State& state) {
  crossing_ ? interpolate(t, state) : inner_->glance(t, state);
}

void SingularCrossing::look(double t, State& state, Dynamics& equations) {
  crossing_ ? interpolate(t, state) : inner_->look(t, state, equations);
}

StepCounters SingularCrossing::counters() const {
  StepCounters total = inner_->counters();
  for (const StepCounters* more : {&before_, &own_}) {
    total.raised = std::max(total.raised, more->raised);
    total.steps += more->steps;
    total.rejected += more->rejected;
    total.jacobians += more->jacobians;
    total.evaluations += more->evaluations;
    total.factors.refactorisations += more->factors.refactorisations;
    total.factors.fresh += more->factors.fresh;
  }
  return total;
}

std::unique_ptr<Formulation> guard_singular_positions(
    const FormulationEntry& entry, Dynamics& dynamics, const Tolerances& tolerances,
    std::function<void(const SingularPosition&)> record, double& largest) {
  if (!has_closed_loops(dynamics.system()) && dynamics.system().left_out_rows().empty())
    return entry.make(dynamics, tolerances);
  return std::make_unique<SingularCrossing>(entry, dynamics, tolerances, std::move(record),
                                            largest);
}

}  // namespace yoke
