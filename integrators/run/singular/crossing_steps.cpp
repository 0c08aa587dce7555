// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The steps inside a crossing: their length, their error, events within them, what is reported.
#include <algorithm>
#include <cmath>
#include <utility>

#include <yoke/integrators/run/singular/crossing.hpp>

namespace yoke {

namespace {

constexpr double too_close = 1e-7;   // of a stage; errors of a position grow by its root
constexpr double longest = 0.5;      // of the time scale
constexpr double error_share = 0.5;  // of the error weights
// Of the largest independence: where rounding may be all that is left of accuracy.
constexpr double nearly_singular = 1e-4;
constexpr double shortest_regular = 1e-6;  // of the time scale, elsewhere
constexpr double bearable = 10.0;          // error that rounding may leave, of the tolerance
constexpr double energy_share = 100.0;     // of the relative tolerance
constexpr int max_attempts = 200;
constexpr int max_segments = 2000;  // without getting away

}  // namespace

Step SingularCrossing::cross(double t_stop) {
  const double energy_before = energy(t_, segment_.end.data());
  if (!try_step(t_stop, energy_before)) return Step::failed;
  return accept_segment();
}

// What a step, or the whole crossing, may change in the energy balance: more is reported. 0.01 of
// the kinetic energy of the error weights is what tolerances.energy allows a step of a formulation.
double SingularCrossing::allowed_energy_change(double energy) const {
  return energy_share * tolerances_.relative * (kinetic_entry_ + std::abs(energy)) +
         1e2 * tolerances_.energy;
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
// False, without a reason: none that is accurate can be had although the rank does not collapse.
bool SingularCrossing::try_step(double t_stop, double energy_before) {
  const double scale = dynamics_.system().scales().time;
  std::vector<double> y = segment_.end;
  const auto n = dynamics_.system().dofs();
  std::vector<double> a(static_cast<std::size_t>(n), 0.0);
  if (segments_ > 0)
    std::copy_n(segment_.rates.back().begin() + n, n, a.begin());
  else if (m_ > too_close * largest_)
    dynamics_.calc_accelerations({.t = t_, .q = y.data(), .v = y.data() + n, .z = y.data() + 2 * n},
                                 {.a = a.data()});
  using Stages = GaussCollocation::Outcome;
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
    Stages outcome = check_.step(trial_, a.data(), closest, last);
    if (outcome == Stages::solved) outcome = gauss_.step(segment_, a.data(), closest, last);
    if (outcome == Stages::close && ++closes < static_cast<int>(std::size(shift))) continue;
    if (outcome != Stages::solved) {
      closes = 0;
      h_ = 0.6 * std::min(h, h_);
      ++own_.rejected;
      if (h_ < 1e-10 * scale) break;
      continue;
    }
    const bool collapses = segment_.least < nearly_singular * largest_;
    const double change = std::abs(energy(t_ + h, segment_.end.data()) - energy_before);
    const double distance = gauss_.distance(trial_.end.data(), segment_.end.data()) /
                            std::max(error_share, 1e-10 / tolerances_.relative);
    const double error =
        collapses ? distance : std::max(distance, change / allowed_energy_change(energy_before));
    const double factor = std::clamp(0.9 * std::pow(std::max(error, 1e-12), -1.0 / 9.0), 0.3, 2.0);
    const double shortest = (collapses ? shortest_ : shortest_regular) * scale;
    // An error that does not fall with the step is rounding.
    if (error > 1.0 && h > shortest && error < 0.5 * last_error) {
      last_error = error;
      h_ = std::max(factor * h, shortest);
      ++own_.rejected;
      continue;
    }
    if (!collapses && error > bearable) break;
    h_ = std::clamp(factor * std::max(h, h_), shortest, longest * scale);
    return true;
  }
  segment_.end = std::move(y);
  if (m_last_ >= nearly_singular * largest_) return false;  // not a matter of rank: see cross()
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

}  // namespace yoke
