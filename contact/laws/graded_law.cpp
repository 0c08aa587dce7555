// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/contact/laws/graded_law.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include <yoke/core/error.hpp>
#include <yoke/core/types.hpp>

namespace yoke {

namespace {

constexpr std::size_t most_laws = 32;
constexpr double accuracy = 1e-11;   // relative, of force and energy
constexpr double slack = 1e-3;       // share of the range beyond its ends: extremes are sampled
constexpr double near_limit = 0.98;  // of the smallest limit
constexpr int checks = 24;           // curvatures, in two distributions

/// A function of the curvature, and its first two derivatives.
struct Jet {
  double x = 0.0, x1 = 0.0, x2 = 0.0;
};

enum class Coordinate { curvature, relative, difference };

/// NaN where it is not defined.
Jet coordinate(Coordinate kind, double k, double r) {
  const double s = 1.0 / r + k;
  switch (kind) {
    case Coordinate::relative:
      return {std::log(s), 1.0 / s, -1.0 / (s * s)};
    case Coordinate::difference:  // ln((1/r + k)/|k|)
      return {std::log(s / std::abs(k)), 1.0 / s - 1.0 / k, 1.0 / (k * k) - 1.0 / (s * s)};
    default:
      return {k, 1.0, 0.0};
  }
}

/// The curvature where the coordinate has a value; for set-up.
double curvature_of(Coordinate kind, double x, const GradedRange& range) {
  double low = range.low, high = range.high;
  if (kind == Coordinate::curvature) return x;
  const bool grows =
      coordinate(kind, high, range.disc_radius).x > coordinate(kind, low, range.disc_radius).x;
  while (true) {
    const double middle = 0.5 * (low + high);
    if (!(middle > low && middle < high)) return middle;
    (((coordinate(kind, middle, range.disc_radius).x < x) == grows) ? low : high) = middle;
  }
}

class Interpolated {
 public:
  Interpolated(const GradedRange& range, Coordinate kind, std::size_t count,
               const std::function<ElasticLaw(double)>& law_at)
      : range_(range), kind_(kind) {
    const double width = slack * (range.high - range.low);
    const double a = coordinate(kind, range.low, range.disc_radius).x,
                 b = coordinate(kind, range.high, range.disc_radius).x;
    middle_ = 0.5 * (a + b);
    half_ = 0.5 * (b - a);
    for (std::size_t j = 0; j < count; ++j) {
      const double at = std::cos(pi * (static_cast<double>(j) + 0.5) / static_cast<double>(count));
      points_.push_back(at);
      laws_.push_back(law_at(curvature_of(kind, middle_ + half_ * at, range)));
      limit_ = std::min(limit_, laws_.back().limit());
    }
    for (std::size_t j = 0; j < count; ++j) {
      double product = 1.0;
      for (std::size_t i = 0; i < count; ++i)
        if (i != j) product *= points_[j] - points_[i];
      factors_.push_back(1.0 / product);
    }
    lowest_ = range.low - width, highest_ = range.high + width;
    const bool all_end = std::ranges::all_of(
        laws_, [](const ElasticLaw& law) { return std::isfinite(law.limit()); });
    for (const ElasticLaw& law : laws_) sizes_.push_back(all_end ? law.limit() : 1.0);
    for (const double size : sizes_) log_sizes_.push_back(std::log(size));
  }

  GradedResponse operator()(double penetration, double curvature) const {
    const double k = std::clamp(curvature, lowest_, highest_), d = penetration;
    std::array<Jet, most_laws> w;
    calc_weights(k, w);
    Jet l;  // ln L
    for (std::size_t j = 0; j < laws_.size(); ++j) {
      const double size = log_sizes_[j];
      l.x += w[j].x * size, l.x1 += w[j].x1 * size, l.x2 += w[j].x2 * size;
    }
    const double L = std::exp(l.x), x = d / L, x_k = -x * l.x1;
    double F = 0.0, F1 = 0.0, s = 0.0, u = 0.0, u1 = 0.0, u2 = 0.0;
    for (std::size_t j = 0; j < laws_.size(); ++j) {
      const ElasticResponse r = laws_[j].response(std::min(x * sizes_[j], laws_[j].limit()));
      const double energy = r.energy / sizes_[j];
      F += w[j].x * r.force, F1 += w[j].x1 * r.force;
      s += w[j].x * r.stiffness * sizes_[j];
      u += w[j].x * energy, u1 += w[j].x1 * energy, u2 += w[j].x2 * energy;
    }
    const double U = L * u;
    if (k != curvature) return {.here = {F, s / L, U}};
    const double F_k = F1 + s * x_k, U_k = L * u1 + l.x1 * (U - F * d);
    const double U_kk =
        L * (l.x1 * u1 + u2 + F1 * x_k) + l.x2 * (U - F * d) + l.x1 * (U_k - F_k * d);
    return {{F, s / L, U}, F_k, U_k, U_kk};
  }
  ElasticResponse operator()(double penetration) const {
    return (*this)(penetration, 0.5 * (range_.low + range_.high)).here;
  }
  double limit() const { return limit_; }
  std::string name() const { return laws_.front().name(); }
  void lower_limit(double limit) { limit_ = std::min(limit_, limit); }

 private:
  static Jet times(const Jet& a, const Jet& b) {
    return {a.x * b.x, a.x1 * b.x + a.x * b.x1, a.x2 * b.x + 2.0 * a.x1 * b.x1 + a.x * b.x2};
  }

  /// The polynomials of Lagrange: products of the distances from the other points, left and right.
  void calc_weights(double k, std::array<Jet, most_laws>& weights) const {
    const Jet x = coordinate(kind_, k, range_.disc_radius);
    const double t = (x.x - middle_) / half_, t1 = x.x1 / half_, t2 = x.x2 / half_;
    Jet product{1.0, 0.0, 0.0};
    for (std::size_t j = 0; j < laws_.size(); ++j) {
      weights[j] = product;
      product = times(product, {t - points_[j], t1, t2});
    }
    product = {1.0, 0.0, 0.0};
    for (std::size_t j = laws_.size(); j-- > 0;) {
      const Jet w = times(weights[j], product);
      weights[j] = {factors_[j] * w.x, factors_[j] * w.x1, factors_[j] * w.x2};
      product = times(product, {t - points_[j], t1, t2});
    }
  }

  GradedRange range_;
  Coordinate kind_;
  double lowest_ = 0.0, highest_ = 0.0;  // [1/m] beyond, the law of the end
  double middle_ = 0.0, half_ = 1.0;     // of the coordinate
  double limit_ = std::numeric_limits<double>::infinity();
  std::vector<double> points_, factors_;  // in -1 to 1, of the coordinate
  std::vector<double> sizes_;             // [m] of the laws: their limits, if all have one, or 1
  std::vector<double> log_sizes_;
  std::vector<ElasticLaw> laws_;
};

/// Exact laws between the points, and what they respond.
class Judge {
 public:
  Judge(const std::function<ElasticLaw(double)>& law_at, const GradedRange& range) {
    for (const Coordinate kind : {Coordinate::curvature, Coordinate::relative}) {
      const double a = coordinate(kind, range.low, range.disc_radius).x,
                   b = coordinate(kind, range.high, range.disc_radius).x;
      if (!(std::isfinite(a) && std::isfinite(b))) continue;
      for (int i = 0; i < checks; ++i) {
        const double x = 0.5 * (a + b) - 0.5 * (b - a) * std::cos(pi * i / (checks - 1.0));
        curvatures_.push_back(std::clamp(curvature_of(kind, x, range), range.low, range.high));
        laws_.push_back(law_at(curvatures_.back()));
        limit_ = std::min(limit_, laws_.back().limit());
      }
    }
    const ElasticLaw& typical = laws_[checks / 2];
    for (int decade = -4; decade <= 4; ++decade) {
      const double d = typical.penetration_at(range.reference_force * std::pow(10.0, decade));
      if (d < near_limit * limit_) penetrations_.push_back(d);
    }
    if (std::isfinite(limit_)) penetrations_.push_back(near_limit * limit_);
  }

  double limit() const { return limit_; }

  /// Greatest relative error; NaN counts as infinite.
  double error(const Interpolated& law) const {
    double worst = 0.0;
    for (std::size_t i = 0; i < laws_.size(); ++i)
      for (const double d : penetrations_) {
        const ElasticResponse exact = laws_[i].response(d), r = law(d, curvatures_[i]).here;
        for (const double e : {r.force / exact.force - 1.0, r.energy / exact.energy - 1.0})
          if (!(std::abs(e) <= worst)) worst = std::isnan(e) ? 1e300 : std::abs(e);
      }
    return worst;
  }

 private:
  std::vector<double> curvatures_, penetrations_;
  std::vector<ElasticLaw> laws_;
  double limit_ = std::numeric_limits<double>::infinity();
};

}  // namespace

ElasticLaw graded_law(const std::string& owner,
                      const std::function<ElasticLaw(double curvature)>& law_at,
                      const GradedRange& range) {
  if (!(std::isfinite(range.low) && std::isfinite(range.high) && range.low < range.high))
    throw ModelError(
        fmt::format("{}: the curvature of the wall goes from {:g} to {:g} 1/m; a law "
                    "that follows it needs finite ones",
                    owner, range.low, range.high));
  const Judge judge(law_at, range);
  std::vector<Coordinate> kinds{Coordinate::curvature};
  for (const Coordinate kind : {Coordinate::relative, Coordinate::difference})
    if (std::isfinite(coordinate(kind, range.low, range.disc_radius).x) &&
        std::isfinite(coordinate(kind, range.high, range.disc_radius).x) &&
        (kind == Coordinate::relative || range.low * range.high > 0.0))
      kinds.push_back(kind);
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t count : {2u, 4u, 6u, 8u, 10u, 12u, 16u, 20u, 24u, 32u})
    for (const Coordinate kind : kinds) {
      Interpolated law(range, kind, count, law_at);
      law.lower_limit(judge.limit());
      const double error = judge.error(law);
      if (error <= accuracy) return law;
      least = std::min(least, error);
    }
  throw ModelError(fmt::format(
      "{}: the law '{}' cannot follow the curvature of the wall from {:g} to {:g} 1/m: between {} "
      "exact laws it is still {:.1e} off. It is not smooth there, as a law of the difference of the "
      "radii is not where a wall turns from hollow to round. Take Radii::mean, or a law for each wall",
      owner, law_at(range.low).name(), range.low, range.high, most_laws, least));
}

}  // namespace yoke
