// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/studies/linearised/carried_variation.hpp>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <yoke/core/error.hpp>

namespace yoke {

namespace {

constexpr int stages = 3;
/// Butcher's coefficients of collocation with three stages.
struct Collocation {
  std::array<double, stages> c, b;
  std::array<std::array<double, stages>, stages> a;
};

const double r15 = std::sqrt(15.0), r6 = std::sqrt(6.0);
const Collocation gauss = {.c = {0.5 - r15 / 10.0, 0.5, 0.5 + r15 / 10.0},
                           .b = {5.0 / 18.0, 4.0 / 9.0, 5.0 / 18.0},
                           .a = {{{5.0 / 36.0, 2.0 / 9.0 - r15 / 15.0, 5.0 / 36.0 - r15 / 30.0},
                                  {5.0 / 36.0 + r15 / 24.0, 2.0 / 9.0, 5.0 / 36.0 - r15 / 24.0},
                                  {5.0 / 36.0 + r15 / 30.0, 2.0 / 9.0 + r15 / 15.0, 5.0 / 36.0}}}};
const Collocation radau = {.c = {0.4 - r6 / 10.0, 0.4 + r6 / 10.0, 1.0},
                           .b = {4.0 / 9.0 - r6 / 36.0, 4.0 / 9.0 + r6 / 36.0, 1.0 / 9.0},
                           .a = {{{11.0 / 45.0 - 7.0 * r6 / 360.0,
                                   37.0 / 225.0 - 169.0 * r6 / 1800.0, -2.0 / 225.0 + r6 / 75.0},
                                  {37.0 / 225.0 + 169.0 * r6 / 1800.0,
                                   11.0 / 45.0 + 7.0 * r6 / 360.0, -2.0 / 225.0 - r6 / 75.0},
                                  {4.0 / 9.0 - r6 / 36.0, 4.0 / 9.0 + r6 / 36.0, 1.0 / 9.0}}}};

constexpr double error_constant = 1e5;   // of Gauss: (h w)^6 / 100800 of a phase
constexpr int most_parts = 64;           // of a step
constexpr double parts_at_events = 4.0;  // of a step that begins or ends there
constexpr double stiff_from = 2.0;       // h times a rate of decay in such a part
constexpr double small_alignment = 0.9;  // cosine at which the frame takes a new reference
constexpr double memory_change = 6e-6;   // relative: cube root of rounding

}  // namespace

CarriedVariation::CarriedVariation(const Model& model, double relative_tolerance, int columns,
                                   bool with_memory)
    : tolerance_(relative_tolerance),
      columns_(columns),
      with_memory_(with_memory),
      dynamics_(model),
      frame_(dynamics_.system()),
      numbers_(dynamics_.system()),
      beside_(model.start_state()),
      events_(dynamics_, beside_, scratch_,
              [this](Stop why, const std::string&) { stopped_ = stopped_ || why == Stop::failed; }),
      g_(static_cast<std::size_t>(dynamics_.system().events()), 0.0) {}

void CarriedVariation::start(const State& state, const System& system) {
  dynamics_.leave_out(system.left_out_rows());
  dynamics_.system().set_scales(system.scales());
  t_ = state.t;
  refuse_grips(state);
  look_at(state);
  if (frame_.freedom() == 0)
    throw ModelError("variation: drivers and joints leave the mechanism no motion of its own");
  const Eigen::Index s = size();
  varied_.clear();
  if (with_memory_)
    for (int i = 0; i < numbers_.contact_numbers(); ++i)
      if (numbers_.acts(state, i)) varied_.push_back(i);
  if (columns_ > s)
    throw ModelError(fmt::format(
        "variation: columns = {} must be at most {}, twice the degrees of freedom and the states of "
        "elements",
        columns_, s));
  const Eigen::Index own = columns_ == 0 ? s : columns_, all = own + std::ssize(varied_);
  y.setIdentity(s, all);
  m.setZero(numbers_.size(), all);
  for (std::size_t i = 0; i < varied_.size(); ++i)
    m(varied_[i], own + static_cast<Eigen::Index>(i)) = 1.0;
  if (at_start) at_start(*this, state);
}

void CarriedVariation::sample(const State& state) {
  throw ModelError(fmt::format(
      "variation: a controller samples at t = {:.9g} s; what it keeps has no linear equations here",
      state.t));
}

void CarriedVariation::refuse_grips(const State& state) const {
  for (const ContactMemory& memory : state.contacts)
    if (rests(memory.grip))
      throw ModelError(fmt::format(
          "variation: friction holds at t = {:.9g} s, where the number of degrees of freedom is "
          "another; take a friction law that is a force (stribeck, lugre)",
          state.t));
}

State CarriedVariation::shown(Formulation& formulation, const State& memory, double t) {
  State state = memory;
  dynamics_.system().bind(state);
  formulation.look(t, state, dynamics_);
  if (!dynamics_.project(state))
    throw ModelError(fmt::format("variation: no accelerations at t = {:.9g} s", t));
  return state;
}

const TurningFrame& CarriedVariation::look_at(const State& state) {
  State there = state;
  if (!dynamics_.calc_accelerations(there))
    throw ModelError(fmt::format("variation: no accelerations at t = {:.9g} s", state.t));
  frame_.at(dynamics_.system(), there);
  frame_.refer();
  return frame_;
}

CarriedVariation::Matrix CarriedVariation::positions() const {
  return frame_.basis() * y.topRows(frame_.freedom());
}

CarriedVariation::Matrix CarriedVariation::velocities() const {
  const int f = frame_.freedom();
  return frame_.basis() * y.middleRows(f, f) + frame_.basis_rate() * y.topRows(f);
}

// ---- between events

/// N^T Q and z' at `state`, whose motion is that of the frame.
void CarriedVariation::calc_forces(const State& state, Vector& rates) {
  System& system = dynamics_.system();
  const int n = system.dofs(), f = frame_.freedom();
  Vector Q = Vector::Zero(n + 1), z_dot = Vector::Zero(system.states());
  system.bind(state);
  system.set_motion(state.t, state.q.data(), state.v.data());
  system.add_forces(Q.data(), z_dot.data(), nullptr);
  rates.setZero(size());
  rates.segment(f, f) = frame_.basis().transpose() * Q.head(n);
  rates.tail(z_dot.size()) = z_dot;
}

/// Derivative of y' by one number of the memory.
void CarriedVariation::calc_memory_forces(const State& state, int number, Vector& rates) {
  const double value = std::abs(numbers_.get(state, number));
  const double h = memory_change * (value > 0.0 ? value : 1.0);
  State there = state;
  Vector behind;
  numbers_.add(there, number, h);
  calc_forces(there, rates);
  numbers_.add(there, number, -2.0 * h);
  calc_forces(there, behind);
  rates = (rates - behind) / (2.0 * h);
}

CarriedVariation::Stage CarriedVariation::calc_stage(const State& state) {
  ++evaluations_;
  frame_.at(dynamics_.system(), state);
  Stage stage{.A = frame_.A(), .Bm = Matrix::Zero(size(), y.cols())};
  Vector rates;
  for (int i = 0; i < numbers_.size(); ++i) {
    if (!numbers_.acts(state, i) || m.row(i).isZero(0.0)) continue;
    calc_memory_forces(state, i, rates);
    stage.Bm += rates * m.row(i);
  }
  const int f = frame_.freedom();
  const double damping = stage.A.block(f, f, f, f).norm();
  stage.decay = damping + stage.A.bottomRightCorner(size() - 2 * f, size() - 2 * f).norm();
  stage.rate = stage.decay + std::sqrt(stage.A.block(f, 0, f, f).norm());
  if (!std::isfinite(stage.rate) || !stage.Bm.allFinite())
    throw ModelError(fmt::format("variation: a derivative is not finite at t = {:.9g} s", state.t));
  return stage;
}

void CarriedVariation::step(Formulation& formulation, const State& memory, double t,
                            bool at_event) {
  if (!(t > t_)) return;
  refuse_grips(memory);
  while (pause > t_ && pause < t) go_to(pause, formulation, memory, false);
  go_to(t, formulation, memory, at_event);
}

// Within a step of the run, or to its end.
void CarriedVariation::go_to(double t, Formulation& formulation, const State& memory,
                             bool at_event) {
  advance(formulation, memory, {.from = t_, .to = t, .begins = jumped_, .ends = at_event});
  t_ = t;
  jumped_ = false;
  if (frame_.alignment() < small_alignment) look_at(shown(formulation, memory, t));
  if (at_step) at_step(*this);
}

// With x = 1 - s where it ends at an event, t goes like x^4 there; between two events like both.
double CarriedVariation::Pace::time(double s) const {
  const auto fourth = [](double x) { return x * x * x * x; };
  double share = s;
  if (begins && ends)
    share = s < 0.5 ? 8.0 * fourth(s) : 1.0 - 8.0 * fourth(1.0 - s);
  else if (begins)
    share = fourth(s);
  else if (ends)
    share = 1.0 - fourth(1.0 - s);
  return from + share * (to - from);
}

double CarriedVariation::Pace::rate(double s) const {
  const auto cube = [](double x) { return x * x * x; };
  double share = 1.0;
  if (begins && ends)
    share = 32.0 * cube(std::min(s, 1.0 - s));
  else if (begins)
    share = 4.0 * cube(s);
  else if (ends)
    share = 4.0 * cube(1.0 - s);
  return share * (to - from);
}

/// A step of the run, in parts so short that the collocation is more accurate than the run.
void CarriedVariation::advance(Formulation& formulation, const State& memory, const Pace& pace) {
  const double h = pace.to - pace.from;
  const Stage middle = calc_stage(shown(formulation, memory, pace.from + 0.5 * h));
  const double accurate = std::pow(error_constant * tolerance_, 1.0 / 6.0);
  const double least = pace.begins || pace.ends ? parts_at_events : 1.0;
  const double wanted = std::ceil(least * h * middle.rate / accurate);
  const int parts = static_cast<int>(std::clamp(wanted, least, double{most_parts}));
  const bool stiff = h / parts * middle.decay > stiff_from;
  for (int i = 0; i < parts; ++i)
    collocate(formulation, memory, pace, double(i) / parts, 1.0 / parts, stiff,
              least == 1.0 && parts == 1 && !stiff ? &middle : nullptr);
}

/// By s of the pace: dy/ds = t'(s) (A y + B m).
void CarriedVariation::collocate(Formulation& formulation, const State& memory, const Pace& pace,
                                 double from, double h, bool stiff, const Stage* middle) {
  const Collocation& method = stiff ? radau : gauss;
  const Eigen::Index s = size(), columns = y.cols();
  std::array<Stage, stages> at;
  for (std::size_t i = 0; i < stages; ++i) {
    const double place = from + method.c[i] * h, rate = pace.rate(place);
    at[i] = i == 1 && middle != nullptr ? *middle
                                        : calc_stage(shown(formulation, memory, pace.time(place)));
    at[i].A *= rate;
    at[i].Bm *= rate;
  }
  // k_i - h A_i sum_j a_ij k_j = A_i y + B_i m
  Matrix system = Matrix::Identity(stages * s, stages * s), rates(stages * s, columns);
  for (int i = 0; i < stages; ++i) {
    const Stage& stage = at[static_cast<std::size_t>(i)];
    rates.middleRows(i * s, s) = stage.A * y + stage.Bm;
    for (int j = 0; j < stages; ++j)
      system.block(i * s, j * s, s, s) -=
          h * method.a[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] * stage.A;
  }
  rates = system.partialPivLu().solve(rates);
  for (int i = 0; i < stages; ++i) {
    const double weight = h * method.b[static_cast<std::size_t>(i)];
    y += weight * rates.middleRows(i * s, s);
    trace_ += weight * at[static_cast<std::size_t>(i)].A.trace();
  }
}

}  // namespace yoke
