// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/run/singular/singular_crossing.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <yoke/integrators/formulations/event_guard.hpp>
#include <yoke/integrators/run/singular/gauss_collocation.hpp>

namespace yoke {

namespace {

constexpr double near = 0.02;     // of the largest independence seen: leave the formulation
constexpr double troubled = 0.1;  // the same, if the formulation fails
constexpr double singular_at_start = 1e-8;  // absolute, while nothing larger has been seen
constexpr double too_close = 1e-7;          // of a stage; errors of a position grow by its root
constexpr double was_singular = 1e-6;       // of the largest: what is reported as crossed
constexpr double look_ahead = 4.0;          // steps
// Of the time scale: steps are not cut below for accuracy; while a contact touches its impact must
// be followed.
constexpr double shortest_apart = 1e-3, shortest_touching = 1e-7;
constexpr double longest = 0.5;      // of the time scale
constexpr double error_share = 0.5;  // of the error weights
constexpr double far = 1e300;        // [s] no singular position in sight
constexpr int max_attempts = 200;
constexpr int max_segments = 2000;     // without getting away
constexpr double energy_bound = 1e-6;  // of the energies that take part

}  // namespace

bool has_closed_loops(const System& system) {
  std::vector<int> parent(system.model().bodies().size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int i) {
    while (parent[static_cast<std::size_t>(i)] != i) {
      auto& above = parent[static_cast<std::size_t>(i)];
      above = parent[static_cast<std::size_t>(above)];
      i = above;
    }
    return i;
  };
  for (const ConstraintSlot& c : system.constraints()) {
    const auto& equations = c.element->equations();
    if (std::ranges::all_of(equations,
                            [](const Equation& e) { return e.measure == Measure::angle; }))
      continue;
    std::vector<BodyId> bodies = c.element->bodies();
    if (bodies.size() == 1) bodies.push_back(ground);
    for (std::size_t i = 1; i < bodies.size(); ++i) {
      const int a = root(bodies[i - 1].index), b = root(bodies[i].index);
      if (a == b) return true;
      parent[static_cast<std::size_t>(a)] = b;
    }
  }
  return false;
}

namespace {

class SingularCrossing final : public Formulation {
 public:
  SingularCrossing(const FormulationEntry& entry, Dynamics& dynamics, const Tolerances& tolerances,
                   std::function<void(const SingularPosition&)> record);

  void start(const State& state) override;
  Step step(double t_stop) override;
  double time() const override { return crossing_ ? t_ : inner_->time(); }
  double last_step() const override { return crossing_ ? segment_.h : inner_->last_step(); }
  void interpolate(double t, State& state) override;
  const std::vector<int>& fired() const override {
    return crossing_ ? guard_.fired() : inner_->fired();
  }
  const std::vector<int>& passed() const override {
    return crossing_ ? guard_.passed() : inner_->passed();
  }
  StepCounters counters() const override;
  std::string failure() const override { return crossing_ ? failure_ : inner_->failure(); }

 private:
  Step step_inside(double t_stop);
  void renew();
  Step cross(double t_stop);
  void watch();
  bool choose_other_rows();
  void begin_crossing();
  bool try_step(double t_stop);
  double propose(double rest) const;
  Step accept_segment();
  bool find_event(int& slot, double& t);
  void end_crossing();
  void report();
  double energy(double t, const double* y);
  void unpack(double t, const double* y, State& state) const;
  void check_redundant(double t, const double* q);

  const FormulationEntry& entry_;
  Dynamics& dynamics_;
  Tolerances tolerances_;
  double shortest_ = shortest_apart;
  std::function<void(const SingularPosition&)> record_;
  std::unique_ptr<Formulation> inner_;
  GaussCollocation gauss_, check_;
  EventGuard guard_;
  StepCounters before_{}, own_{};
  bool watches_;
  std::vector<bool> is_work_;

  State here_;                      // where the last step ended, or a restart began
  double m_ = 1.0, largest_ = 0.0;  // independence there and the largest seen
  double t_m_ = 0.0, m_before_ = 1.0, dt_ = 1.0;
  bool has_before_ = false;
  double hold_off_ = 2.0;  // enter only below this: what has proved to be harmless is above

  bool crossing_ = false, entering_ = false, leaving_ = false;
  GaussCollocation::Segment segment_, trial_;
  double t_ = 0.0, h_ = 0.0, to_singular_ = far;
  int segments_ = 0;
  double m_entry_ = 0.0, m_last_ = 0.0;
  double energy_entry_ = 0.0, kinetic_entry_ = 0.0;
  SingularPosition found_;
  bool has_found_ = false;
  std::vector<double> y_, g_;
  std::vector<int> found_events_;
  std::string failure_;
};

SingularCrossing::SingularCrossing(const FormulationEntry& entry, Dynamics& dynamics,
                                   const Tolerances& tolerances,
                                   std::function<void(const SingularPosition&)> record)
    : entry_(entry),
      dynamics_(dynamics),
      tolerances_(tolerances),
      record_(std::move(record)),
      inner_(entry.make(dynamics, tolerances)),
      gauss_(dynamics, tolerances, 6),
      check_(dynamics, tolerances, 4),
      guard_(dynamics),
      watches_(has_closed_loops(dynamics.system())),
      segment_(gauss_.make_segment()),
      trial_(check_.make_segment()),
      y_(static_cast<std::size_t>(gauss_.size())) {
  for (const std::string& name : dynamics.system().quadrature_names())
    is_work_.push_back(name.ends_with(".work"));
  g_.assign(static_cast<std::size_t>(guard_.count()), 0.0);
  found_events_.assign(g_.size(), 0);
}

void SingularCrossing::start(const State& state) {
  const bool touching = std::ranges::any_of(
      state.contacts, [](const ContactMemory& c) { return c.phase != ContactPhase::apart; });
  shortest_ = touching ? shortest_touching : shortest_apart;
  here_ = state;
  leaving_ = entering_ = has_before_ = false;
  t_m_ = state.t;
  if (watches_) {
    m_ = dynamics_.independence(state.t, state.q.data());
    const bool singular = largest_ > 0.0 ? m_ < near * largest_ : m_ < singular_at_start;
    largest_ = std::max(largest_, m_);
    if ((crossing_ && m_ < m_entry_) || singular) {
      crossing_ = false;
      begin_crossing();
      return;
    }
  }
  if (crossing_) renew();
  crossing_ = false;
  inner_->start(state);
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
    if (choose_other_rows()) return step_inside(t_stop);
    begin_crossing();
  }
  return cross(t_stop);
}

// Pivots chosen near a singular position are bad ones and the measure of what is a bad one.
void SingularCrossing::renew() {
  dynamics_.reset();
  before_ = counters();
  own_ = {};
  inner_ = entry_.make(dynamics_, tolerances_);
}

Step SingularCrossing::step_inside(double t_stop) {
  const Step step = inner_->step(t_stop);
  if (step == Step::advanced) {
    inner_->interpolate(inner_->time(), here_);
    check_redundant(here_.t, here_.q.data());
    if (watches_) watch();
  } else if (step == Step::failed && watches_) {
    entering_ = m_ < troubled * largest_;
  }
  return step;
}

void SingularCrossing::watch() {
  const double t = here_.t, m = dynamics_.independence(t, here_.q.data());
  has_before_ = t > t_m_;
  m_before_ = m_;
  dt_ = t - t_m_;
  m_ = m;
  t_m_ = t;
  largest_ = std::max(largest_, m);
  if (!(m < m_before_) || m > hold_off_ || !has_before_) return;
  const double s = std::sqrt(m), rate = (s - std::sqrt(m_before_)) / dt_;
  entering_ = m < near * largest_ ||
              (m < 0.3 * largest_ && s < -rate * look_ahead * std::max(dt_, inner_->last_step()));
}

void SingularCrossing::check_redundant(double t, const double* q) {
  const double bound = std::clamp(1e4 * tolerances_.relative, 1e-7, 1e-2);
  const std::string conflict = dynamics_.contradiction(t, q, bound);
  if (!conflict.empty()) throw ModelError(conflict);
}

// Equations kept may become dependent where others are not.
bool SingularCrossing::choose_other_rows() {
  System& system = dynamics_.system();
  if (system.dropped_rows().empty()) return false;
  // Where it is going: on the spot the choice that is about to fail still looks good.
  const double s = std::sqrt(m_), rate = (s - std::sqrt(m_before_));
  const double ahead = rate < 0.0 ? s / -rate * std::max(inner_->last_step(), 0.0) : 0.0;
  const Eigen::VectorXd q = here_.q + std::min(ahead, system.scales().time) * here_.v;
  std::vector<double> phi(static_cast<std::size_t>(system.rows()));
  system.set_motion(here_.t, q.data(), here_.v.data());
  system.calc_position_level(phi.data());
  const std::vector<int> before = system.dropped_rows();
  const RankAnalysis analysis = analyse_rank(system);
  const bool other = analysis.dependent.size() == before.size() && analysis.dependent != before;
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

Step SingularCrossing::cross(double t_stop) {
  if (!try_step(t_stop)) return Step::failed;
  return accept_segment();
}

// The length of the next step: the singular position, where it is expected, is to lie in the middle
// or in another wide gap between stages.
double SingularCrossing::propose(double rest) const {
  double h = h_;
  if (to_singular_ < 0.6 * h_) {
    for (const double gap : {0.5, 0.25, 0.12, 0.017}) {
      h = to_singular_ / gap;
      if (h > 0.4 * h_) break;
      h = h_;
    }
  } else if (to_singular_ < 2.0 * h_) {
    h = 0.5 * to_singular_;
  }
  // Two steps to the end rather than one and a sliver.
  return h >= rest ? rest : h > 0.5 * rest ? 0.5 * rest : h;
}

// A step with 6 stages, judged by one with 4, until they agree or it is as short as is sensible.
bool SingularCrossing::try_step(double t_stop) {
  const double scale = dynamics_.system().scales().time;
  std::vector<double> y = segment_.end;
  const auto n = dynamics_.system().dofs();
  std::vector<double> a(static_cast<std::size_t>(n), 0.0);
  if (segments_ > 0)
    std::copy_n(segment_.rates.back().begin() + n, n, a.begin());
  else if (m_ > too_close * largest_)
    dynamics_.calc_accelerations(t_, y.data(), y.data() + n, y.data() + 2 * n, a.data(), nullptr,
                                 nullptr, nullptr);
  using Outcome = GaussCollocation::Outcome;
  constexpr double shift[] = {1.0, 1.3, 0.77, 1.7, 0.6};  // to move stages off a singular position
  int closes = 0;
  double last_error = far;
  const double closest = too_close * largest_;
  for (int attempt = 0; attempt < max_attempts; ++attempt) {
    const double rest = t_stop - t_, proposed = propose(rest);
    const double h = closes == 0 ? proposed : std::min(proposed * shift[closes], rest);
    const bool last = h == rest;
    for (GaussCollocation::Segment* s : {&trial_, &segment_}) {
      s->t = t_;
      s->h = h;
      s->begin = y;
    }
    Outcome outcome = check_.step(trial_, a.data(), closest, last);
    if (outcome == Outcome::solved) outcome = gauss_.step(segment_, a.data(), closest, last);
    if (outcome == Outcome::close && ++closes < static_cast<int>(std::size(shift))) continue;
    if (outcome != Outcome::solved) {
      closes = 0;
      h_ = 0.6 * std::min(h, h_);
      ++own_.rejected;
      if (h_ < 1e-10 * scale) break;
      continue;
    }
    const double error = gauss_.distance(trial_.end.data(), segment_.end.data()) /
                         std::max(error_share, 1e-10 / tolerances_.relative);
    const double factor = std::clamp(0.9 * std::pow(std::max(error, 1e-12), -1.0 / 9.0), 0.3, 2.0);
    // An error that does not fall with the step is rounding.
    if (error > 1.0 && h > shortest_ * scale && error < 0.5 * last_error) {
      last_error = error;
      h_ = std::max(factor * h, shortest_ * scale);
      ++own_.rejected;
      continue;
    }
    h_ = std::clamp(factor * std::max(h, h_), shortest_ * scale, longest * scale);
    return true;
  }
  segment_.end = std::move(y);
  failure_ = fmt::format(
      "the singular position of '{}' could not be crossed: no motion beyond it was found",
      dynamics_.system().equation_name(dynamics_.weakest_row()));
  return false;
}

bool SingularCrossing::find_event(int& slot, double& t) {
  const int n = dynamics_.system().dofs();
  const auto value = [&](double time, std::size_t i) {
    gauss_.interpolate(segment_, time, y_.data());
    guard_.evaluate(time, y_.data(), y_.data() + n, y_.data() + 2 * n, g_.data());
    return g_[i];
  };
  constexpr int looks = 8;
  double low = segment_.t;
  for (int look = 1; look <= looks; ++look) {
    const double high = segment_.t + segment_.h * look / looks;
    value(high, 0);
    const auto crossed = std::ranges::find_if(g_, [](double g) { return g >= 0.0; });
    if (crossed != g_.end()) {
      // The first of those that crossed here.
      slot = static_cast<int>(crossed - g_.begin());
      double above = high;
      for (int i = 0; i < 200 && above > std::nextafter(low, above); ++i) {
        const double middle = 0.5 * (low + above);
        if (middle <= low || middle >= above) break;
        value(middle, 0);
        const auto first = std::ranges::find_if(g_, [](double g) { return g >= 0.0; });
        if (first != g_.end()) {
          slot = static_cast<int>(first - g_.begin());
          above = middle;
        } else {
          low = middle;
        }
      }
      t = above;
      return true;
    }
    low = high;
  }
  return false;
}

Step SingularCrossing::accept_segment() {
  const int n = dynamics_.system().dofs();
  ++own_.steps;
  ++segments_;
  int slot = 0;
  double t_event = 0.0;
  if (guard_.count() > 0 && find_event(slot, t_event)) {
    gauss_.interpolate(segment_, t_event, segment_.end.data());
    double m = 1.0;
    gauss_.project(t_event, segment_.end.data(), 0.0, m);
    t_ = t_event;
    std::ranges::fill(found_events_, 0);
    found_events_[static_cast<std::size_t>(slot)] = 1;
    guard_.collect(t_, segment_.end.data(), segment_.end.data() + n, segment_.end.data() + 2 * n,
                   found_events_);
    unpack(t_, segment_.end.data(), here_);
    return Step::event;
  }
  report();
  t_ = segment_.t + segment_.h;
  unpack(t_, segment_.end.data(), here_);
  guard_.accept(t_, segment_.end.data(), segment_.end.data() + n, segment_.end.data() + 2 * n);
  check_redundant(t_, here_.q.data());
  gauss_.interpolate(segment_, t_ - 0.02 * segment_.h, y_.data());
  const double before = dynamics_.independence(t_ - 0.02 * segment_.h, y_.data(), 3);
  const double m = dynamics_.independence(t_, segment_.end.data(), 3);
  const bool rising = m > before;
  const double fall = (std::sqrt(before) - std::sqrt(m)) / (0.02 * segment_.h);
  to_singular_ = fall > 0.0 ? std::sqrt(m) / fall : far;
  m_last_ = m;
  largest_ = std::max(largest_, m);
  const double away = std::max({2.0 * m_entry_, 5.0 * near * largest_});
  if (rising && m > away) end_crossing();
  if (!leaving_ && segments_ > max_segments) end_crossing();
  return failure_.empty() ? Step::advanced : Step::failed;
}

// The least independence within the segment, by golden section.
void SingularCrossing::report() {
  if (has_found_ && segment_.least > found_.independence) return;
  const auto measure = [&](double t) {
    gauss_.interpolate(segment_, t, y_.data());
    return dynamics_.independence(t, y_.data());
  };
  constexpr double golden = 0.6180339887498949;
  double low = segment_.t, high = segment_.t + segment_.h;
  double a = high - golden * (high - low), b = low + golden * (high - low);
  double m_a = measure(a), m_b = measure(b);
  for (int i = 0; i < 40; ++i) {
    if (m_a < m_b) {
      high = std::exchange(b, a);
      m_b = m_a;
      a = high - golden * (high - low);
      m_a = measure(a);
    } else {
      low = std::exchange(a, b);
      m_a = m_b;
      b = low + golden * (high - low);
      m_b = measure(b);
    }
  }
  const double m = std::min(m_a, m_b);
  if (has_found_ && m >= found_.independence) return;
  has_found_ = true;
  found_.t = m_a < m_b ? a : b;
  found_.independence = m;
  found_.equation = dynamics_.system().equation_name(dynamics_.weakest_row());
}

void SingularCrossing::end_crossing() {
  leaving_ = true;
  m_ = m_last_;
  t_m_ = t_;
  found_.energy_before = energy_entry_;
  found_.energy_after = energy(t_, segment_.end.data());
  const double jump = std::abs(found_.energy_after - energy_entry_);
  if (jump > energy_bound * (kinetic_entry_ + std::abs(energy_entry_)) + 1e4 * tolerances_.energy)
    failure_ = fmt::format(
        "the energy changed by {:g} J from {:g} J over the singular position of "
        "'{}' at t = {:.9g} s",
        found_.energy_after - energy_entry_, energy_entry_, found_.equation, found_.t);
  if (has_found_ && found_.independence < was_singular * largest_)
    record_(found_);
  else  // it only came near: not to be left for that again
    hold_off_ = 0.3 * found_.independence;
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

StepCounters SingularCrossing::counters() const {
  StepCounters total = inner_->counters();
  for (const StepCounters* more : {&before_, &own_}) {
    total.steps += more->steps;
    total.rejected += more->rejected;
    total.jacobians += more->jacobians;
    total.evaluations += more->evaluations;
    total.factors.refactorisations += more->factors.refactorisations;
    total.factors.fresh += more->factors.fresh;
  }
  return total;
}

}  // namespace

std::unique_ptr<Formulation> guard_singular_positions(
    const FormulationEntry& entry, Dynamics& dynamics, const Tolerances& tolerances,
    std::function<void(const SingularPosition&)> record) {
  if (!has_closed_loops(dynamics.system()) && dynamics.system().dropped_rows().empty())
    return entry.make(dynamics, tolerances);
  return std::make_unique<SingularCrossing>(entry, dynamics, tolerances, std::move(record));
}

}  // namespace yoke
