// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/formulations/explicit/dense_step.hpp>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

namespace yoke {

namespace {

constexpr std::size_t most_nodes = 4;
// Parts of the step, chosen so that each of the first few leaves a small error in positions, velocities
// and the others. Not the middle, nor Lobatto's points: rates there follow from values and rates at the ends.
constexpr std::array<double, most_nodes> nodes = {0.15, 0.4, 0.9, 0.55};
// What is evaluated one after the other. The first evaluations are made where the polynomial was poor yet, so
// they are made again.
constexpr std::size_t evaluations[] = {0, 1, 2, 0, 1, 2, 3, 0, 1};
// Of what an evaluation changes, in tolerances: the first may be more than the last, by far.
constexpr double enough = 0.3, enough_at_last = 1.0, hopeless = 1e7;
constexpr double stagnant = 0.5;  // of the first evaluation to the second
constexpr double again = 0.02;    // about what is left of a change when its node is evaluated again

using Powers = std::array<double, most_nodes>;

/// s^k (1 - s)^k r(s) and its first two derivatives; r is given by powers of 2 s - 1.
std::array<double, 3> derivatives(int zeros, const Powers& powers, double s) {
  double r = 0.0, r1 = 0.0, r2 = 0.0;  // Horner's scheme
  const double x = 2.0 * s - 1.0;
  for (std::size_t i = powers.size(); i-- > 0;) {
    r2 = r2 * x + 2.0 * r1;
    r1 = r1 * x + r;
    r = r * x + powers[i];
  }
  r1 *= 2.0;
  r2 *= 4.0;
  const double p = s * (1.0 - s), p1 = 1.0 - 2.0 * s, k = zeros;
  const double b = zeros == 3 ? p * p * p : p * p, b1 = k * (zeros == 3 ? p * p : p) * p1;
  const double b2 =
      k * (k - 1.0) * (zeros == 3 ? p : 1.0) * p1 * p1 - 2.0 * k * (zeros == 3 ? p * p : p);
  return {b * r, b1 * r + b * r1, b2 * r + 2.0 * b1 * r1 + b * r2};
}

/// For each of the first `count` nodes such a polynomial whose derivative of order 2 (k = 3) or 1 (k = 2)
/// is one there, and none at the others.
struct Cardinal {
  std::array<Powers, most_nodes> powers{};
  std::array<double, most_nodes> largest{};  // within the step

  Cardinal(int zeros, std::size_t count) {
    const auto size = static_cast<Eigen::Index>(count),
               order = static_cast<Eigen::Index>(zeros) - 1;
    Eigen::MatrixXd at_nodes(size, size);
    for (Eigen::Index i = 0; i < size; ++i)
      for (Eigen::Index j = 0; j < size; ++j) {
        Powers one{};
        one[static_cast<std::size_t>(j)] = 1.0;
        at_nodes(i, j) = derivatives(
            zeros, one, nodes[static_cast<std::size_t>(i)])[static_cast<std::size_t>(order)];
      }
    const Eigen::MatrixXd all = at_nodes.inverse();
    for (std::size_t k = 0; k < count; ++k) {
      std::copy_n(all.col(static_cast<Eigen::Index>(k)).data(), count, powers[k].begin());
      for (int i = 1; i < 64; ++i)
        largest[k] = std::max(largest[k], std::abs(derivatives(zeros, powers[k], i / 64.0)[0]));
    }
  }
};

/// What evaluations at the first nodes add to positions, by accelerations, and to others, by rates.
struct Additions {
  Cardinal by_acceleration, by_rate;
  explicit Additions(std::size_t count) : by_acceleration(3, count), by_rate(2, count) {}
};

const Additions& additions(std::size_t count) {
  static const std::array<Additions, most_nodes> all = {Additions(1), Additions(2), Additions(3),
                                                        Additions(4)};
  return all[count - 1];
}

}  // namespace

DenseStep::DenseStep(int size, int n, Rates rates)
    : rates_(std::move(rates)),
      size_(static_cast<std::size_t>(size)),
      n_(static_cast<std::size_t>(n)) {
  static_assert(most == most_nodes);
  begin_rates_.assign(size_, 0.0);
  end_rates_ = stage_ = change_ = scratch_ = begin_rates_;
  beyond_.fill(begin_rates_);
  additions(1);
}

void DenseStep::from(const End& begin, const End& end) {
  begin_ = begin;
  end_ = end;
  h_ = end.t - begin.t;
  count_ = 0;
  verdict_ = Verdict::open;
}

bool DenseStep::raise(const Norm& norm) {
  if (verdict_ == Verdict::open) {
    verdict_ = converges(norm) ? Verdict::good : Verdict::bad;
    if (verdict_ == Verdict::bad) count_ = 0;
  }
  return verdict_ == Verdict::good;
}

bool DenseStep::converges(const Norm& norm) {
  if (!(h_ > 0.0) || !find_slopes()) return false;
  double size = 0.0, at_first = 0.0;  // of the last change, of that at the first node
  for (const std::size_t node : evaluations) {
    const bool second = node == 1 && count_ == 1;
    if (!evaluate(node)) return false;
    size = size_of_change(node, norm);
    if (node == 0) at_first = size;
    if (size <= enough && at_first <= enough / again) return true;
    if (!(size < hopeless)) return false;
    if (second && size > stagnant * at_first) break;
  }
  return size <= enough_at_last;
}

bool DenseStep::find_slopes() {
  const auto find = [&](End& end, std::vector<double>& rates) {
    if (end.rates != nullptr) return true;
    if (!rates_(end.t, end.y, rates.data())) return false;
    end.rates = rates.data();
    return true;
  };
  return find(begin_, begin_rates_) && find(end_, end_rates_);
}

// Rates at a node; `change_` is what they add to those the polynomial had there.
bool DenseStep::evaluate(std::size_t node) {
  const double s = nodes[node];
  std::vector<double>& beyond = beyond_[node];
  at(begin_.t + s * h_, stage_.data());
  if (!rates_(begin_.t + s * h_, stage_.data(), change_.data())) return false;
  std::copy_n(change_.begin() + static_cast<std::ptrdiff_t>(n_), n_, change_.begin());
  calc_hermite_rates(s, scratch_.data());
  for (std::size_t i = 0; i < size_; ++i) change_[i] -= scratch_[i];
  if (node == count_) {
    std::ranges::fill(beyond, 0.0);
    for (std::size_t k = 0; k < count_; ++k) {
      const auto [by_acceleration, by_rate] = factors(k, s);
      for (std::size_t i = 0; i < size_; ++i)
        beyond[i] += (i < n_ ? by_acceleration[2] : by_rate[1]) * beyond_[k][i];
    }
    ++count_;
  }
  for (std::size_t i = 0; i < size_; ++i) change_[i] -= std::exchange(beyond[i], change_[i]);
  return true;
}

// Of the last change, in tolerances.
double DenseStep::size_of_change(std::size_t node, const Norm& norm) {
  const auto& [by_acceleration, by_rate] = additions(count_);
  for (std::size_t i = 0; i < n_; ++i)
    scratch_[i] = h_ * h_ * by_acceleration.largest[node] * change_[i];
  for (std::size_t i = n_; i < size_; ++i) scratch_[i] = h_ * by_rate.largest[node] * change_[i];
  return norm(scratch_.data());
}

// Of what is known at a node, at s.
DenseStep::Factors DenseStep::factors(std::size_t node, double s) const {
  const auto& [by_acceleration, by_rate] = additions(count_);
  return {derivatives(3, by_acceleration.powers[node], s), derivatives(2, by_rate.powers[node], s)};
}

void DenseStep::at(double t, double* y) const {
  if (!(h_ > 0.0)) {
    std::copy_n(end_.y, size_, y);
    return;
  }
  const double s = (t - begin_.t) / h_;
  if (begin_.rates == nullptr || end_.rates == nullptr) return calc_cubic(s, y);
  calc_quintic(s, y, count_ == 0);
  calc_hermite(s, count_ == 0 ? 2 * n_ : n_, y);
  for (std::size_t k = 0; k < count_; ++k) {
    const std::vector<double>& beyond = beyond_[k];
    const auto [by_acceleration, by_rate] = factors(k, s);
    for (std::size_t i = 0; i < n_; ++i) y[i] += h_ * h_ * by_acceleration[0] * beyond[i];
    for (std::size_t i = n_; i < size_; ++i) y[i] += h_ * by_rate[0] * beyond[i];
  }
}

// Without rates: positions by velocities, velocities by the derivative, the rest along a line.
void DenseStep::calc_cubic(double s, double* y) const {
  const double h = h_, r = 1.0 - s, *from = begin_.y, *to = end_.y;
  for (std::size_t i = 0; i < n_; ++i) {
    const std::size_t j = n_ + i;
    const double mean = (to[i] - from[i]) / h, a = from[j] - mean, b = to[j] - mean;
    y[i] = from[i] + s * (to[i] - from[i]) + h * s * r * (r * a - s * b);
    y[j] = mean + r * (1.0 - 3.0 * s) * a + s * (3.0 * s - 2.0) * b;
  }
  for (std::size_t i = 2 * n_; i < size_; ++i) y[i] = from[i] + s * (to[i] - from[i]);
}

// Positions by velocities and accelerations, and velocities by the derivative if they are wanted.
void DenseStep::calc_quintic(double s, double* y, bool velocities) const {
  calc_cubic(s, y);
  const double h = h_, r = 1.0 - s, w = s * s * r * r, w_s = 2.0 * s * r * (r - s);
  for (std::size_t i = 0; i < n_; ++i) {
    const auto [c, d] = beyond_cubic(i);
    y[i] += 0.5 * h * w * (r * c + s * d);
    if (velocities) y[n_ + i] += 0.5 * (w_s * (r * c + s * d) + w * (d - c));
  }
}

/// What accelerations are beyond those of the cubic, at either end, times the step.
std::pair<double, double> DenseStep::beyond_cubic(std::size_t i) const {
  const std::size_t j = n_ + i;
  const double mean = (end_.y[i] - begin_.y[i]) / h_, a = begin_.y[j] - mean, b = end_.y[j] - mean;
  return {h_ * begin_.rates[j] + 4.0 * a + 2.0 * b, h_ * end_.rates[j] - 2.0 * a - 4.0 * b};
}

// Entries from `first` on by their rates alone. Velocities too, once they are raised: as the derivative
// of positions they would bear what these err at the ends, over the step.
void DenseStep::calc_hermite(double s, std::size_t first, double* y) const {
  const double h = h_, r = 1.0 - s;
  for (std::size_t i = first; i < size_; ++i) {
    const double mean = end_.y[i] - begin_.y[i];
    y[i] = begin_.y[i] + s * mean +
           s * r * (r * (h * begin_.rates[i] - mean) - s * (h * end_.rates[i] - mean));
  }
}

// Of the polynomials through the ends alone: accelerations of the positions' in place of these, and rates
// of all others.
void DenseStep::calc_hermite_rates(double s, double* y_dot) const {
  const double r = 1.0 - s, h = h_, *from = begin_.y, *to = end_.y;
  for (std::size_t i = 0; i < n_; ++i) {
    const double mean = (to[i] - from[i]) / h, a = from[n_ + i] - mean, b = to[n_ + i] - mean;
    const auto [c, d] = beyond_cubic(i);
    y_dot[i] =
        ((6.0 * s - 4.0) * a - (2.0 - 6.0 * s) * b + r * (r * r - 6.0 * s * r + 3.0 * s * s) * c +
         s * (3.0 * r * r - 6.0 * s * r + s * s) * d) /
        h;
  }
  for (std::size_t i = n_; i < size_; ++i) {
    const double mean = (to[i] - from[i]) / h;
    y_dot[i] = mean + r * (1.0 - 3.0 * s) * (begin_.rates[i] - mean) +
               s * (3.0 * s - 2.0) * (end_.rates[i] - mean);
  }
}

}  // namespace yoke
