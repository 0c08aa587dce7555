// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Dense output of generalised-alpha, and steps that end at events.
#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <limits>
#include <utility>

#include <yoke/core/equations/linear/index.hpp>
#include <yoke/integrators/formulations/generalised_alpha.hpp>

namespace yoke {

namespace {

constexpr int max_root_steps = 20;
constexpr double parts_per_radian = 16.0;
constexpr double root_accuracy = 1e-9;  // of the step

}  // namespace

/// The first root on the dense output of the step being tried, or infinity; marks in found_ who has
/// it. A long step is looked at in parts: what comes back within it is not seen at its end.
double GeneralisedAlpha::find_root() {
  if (g_to_.empty()) return std::numeric_limits<double>::infinity();
  const double h = new_.t - end_.t;
  const int parts = 1 + static_cast<int>(parts_per_radian * h * fastest_turn());
  double from = end_.t;
  g_low_ = g_from_;
  for (int part = 1; part <= parts; ++part) {
    const double to = part == parts ? new_.t : end_.t + h * part / parts;
    if (part == parts) {
      g_high_ = g_to_;
    } else {
      calc_event(0, to);
      g_high_ = g_;
    }
    const double root = find_root_between(from, to);
    if (root <= to) return root;
    from = to;
    std::swap(g_low_, g_high_);
  }
  return std::numeric_limits<double>::infinity();
}

double GeneralisedAlpha::find_root_between(double from, double to) {
  double t_root = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < g_low_.size(); ++i) {
    if (!(g_low_[i] < 0.0 && g_high_[i] >= 0.0)) continue;
    double root = to;
    if (g_high_[i] > 0.0) {
      std::uintmax_t iterations = 100;
      root = boost::math::tools::toms748_solve(
                 [&](double t) { return calc_event(i, t); }, from, to, g_low_[i], g_high_[i],
                 boost::math::tools::eps_tolerance<double>(std::numeric_limits<double>::digits),
                 iterations)
                 .second;
    }
    if (root < t_root) {
      t_root = root;
      std::ranges::fill(found_, 0);
    }
    if (root == t_root) found_[i] = 1;
  }
  return t_root;
}

/// [rad/s] of all bodies.
double GeneralisedAlpha::fastest_turn() const {
  double fastest = 0.0;
  for (std::size_t i = 2; i < end_.v.size(); i += 3)
    fastest = std::max(fastest, std::abs(end_.v[i]));
  return fastest;
}

double GeneralisedAlpha::calc_event(std::size_t slot, double t) {
  calc_interpolant(end_, new_, t);
  guard_.evaluate(t, absolute(dense_u_), dense_v_.data(), dense_z_.data(), g_.data());
  return g_[slot];
}

/// Accepts the step being tried, or if an event function crosses zero in it a shorter one that ends
/// there: dense output would err by h^2 in v, most of all in a contact.
bool GeneralisedAlpha::finish_at_event() {
  const double t_root = find_root();
  const bool event = t_root <= new_.t;
  if (event) step_to_root(t_root);
  integrate_energy();
  accept();
  t_ = end_.t;
  std::swap(g_from_, g_to_);
  if (!event) {
    guard_.accept(t_, absolute(end_.u), end_.v.data(), end_.z.data());
    return false;
  }
  guard_.collect(t_, absolute(end_.u), end_.v.data(), end_.z.data(), found_);
  for (const int slot : guard_.fired()) {
    double& g = g_from_[at(slot)];
    g = std::max(g, 0.0);  // not again if the caller goes on
  }
  return true;
}

/// Steps of the method to where its own solution has the root, by secants that begin at the root of
/// the dense output. Ends where the function is not negative: elements expect it to have crossed
/// zero.
void GeneralisedAlpha::step_to_root(double t_root) {
  const auto slot = static_cast<std::size_t>(std::ranges::find(found_, 1) - found_.begin());
  const double close =
      std::max(root_accuracy * (new_.t - end_.t), 4.0 * machine_epsilon * std::abs(new_.t));
  double low = end_.t + close;  // the root is between low and high
  double high = std::min(new_.t, t_root + 0.05 * (new_.t - end_.t));
  double t = std::max(t_root, low);
  if (t >= high) return;
  const double aside = t - 1e3 * close;
  double slope = (calc_event(slot, t) - calc_event(slot, aside)) / (t - aside);
  double t_last = t, g_last = 0.0;
  for (int i = 0; i < max_root_steps && high - low > close; ++i) {
    if (!advance(t)) break;
    const double g = g_to_[slot];
    (g < 0.0 ? low : high) = t;
    if (i > 0 && t != t_last) slope = (g - g_last) / (t - t_last);
    t_last = t;
    g_last = g;
    double next = t - g / slope;
    if (g >= 0.0 && !(t - next > close)) return;
    if (g < 0.0 && next - t < close) next = t + close;
    t = next > low && next < high ? next : 0.5 * (low + high);
  }
  advance(high);
}

/// Quintic Hermite from positions, velocities and accelerations, cubic from the others.
void GeneralisedAlpha::calc_interpolant(const Node& from, const Node& to, double t) {
  if (t == to.t) {
    dense_u_ = to.u;
    dense_v_ = to.v;
    dense_z_ = to.z;
    dense_energy_ = to.energy;
    return;
  }
  const double h = to.t - from.t, s = (t - from.t) / h;
  for (std::size_t i = 0; i < dense_u_.size(); ++i) {
    const double v = h * from.v[i], a = h * h * from.a[i];
    const double D = to.u[i] - from.u[i] - v - 0.5 * a;
    const double V = h * (to.v[i] - from.v[i]) - a;
    const double A = h * h * (to.a[i] - from.a[i]);
    const double c3 = 10.0 * D - 4.0 * V + 0.5 * A;
    const double c4 = -15.0 * D + 7.0 * V - A;
    const double c5 = 6.0 * D - 3.0 * V + 0.5 * A;
    dense_u_[i] = from.u[i] + s * (v + s * (0.5 * a + s * (c3 + s * (c4 + s * c5))));
    dense_v_[i] = (v + s * (a + s * (3.0 * c3 + s * (4.0 * c4 + s * 5.0 * c5)))) / h;
  }
  const auto cubic = [h, s](const Vector& x0, const Vector& x1, const Vector& f0, const Vector& f1,
                            Vector& out) {
    for (std::size_t i = 0; i < out.size(); ++i) {
      const double D = x1[i] - x0[i] - h * f0[i], F = h * (f1[i] - f0[i]);
      out[i] = x0[i] + s * (h * f0[i] + s * (3.0 * D - F + s * (F - 2.0 * D)));
    }
  };
  cubic(from.z, to.z, from.z_dot, to.z_dot, dense_z_);
  cubic(from.energy, to.energy, from.power, to.power, dense_energy_);
}

void GeneralisedAlpha::interpolate(double t, State& state) {
  calc_interpolant(begin_, end_, t);
  state.t = t;
  std::copy_n(absolute(dense_u_), n_, state.q.data());
  std::copy_n(dense_v_.data(), n_, state.v.data());
  std::copy_n(dense_z_.data(), nz_, state.z.data());
  std::copy_n(dense_energy_.data(), quadratures_, state.energy.data());
}

}  // namespace yoke
