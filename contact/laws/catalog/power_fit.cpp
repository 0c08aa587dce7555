// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/contact/laws/catalog/power_fit.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

#include <yoke/core/error.hpp>

namespace yoke {

namespace {

/// One sample, both between 0 and 1: ln(d/d_last) and F/F_last.
struct Sample {
  double log_penetration, load;
};

/// c and n of c x^n, x = d/d_last.
struct Parameters {
  double c, n;
};

double sum_of_squares(const std::vector<Sample>& samples, const Parameters& p) {
  double sum = 0.0;
  for (const Sample& s : samples) {
    const double residual = p.c * std::exp(p.n * s.log_penetration) - s.load;
    sum += residual * residual;
  }
  return sum;
}

/// The step of Gauss and Newton in ln c and n: least squares of the residual made linear.
Parameters step(const std::vector<Sample>& samples, const Parameters& p) {
  double cc = 0.0, cn = 0.0, nn = 0.0, rc = 0.0, rn = 0.0;
  for (const Sample& s : samples) {
    const double dc = p.c * std::exp(p.n * s.log_penetration), dn = dc * s.log_penetration;
    const double residual = dc - s.load;
    cc += dc * dc;
    cn += dc * dn;
    nn += dn * dn;
    rc += dc * residual;
    rn += dn * residual;
  }
  const double determinant = cc * nn - cn * cn;
  return {(rn * cn - rc * nn) / determinant, (rc * cn - rn * cc) / determinant};
}

Parameters moved(const Parameters& p, const Parameters& by, double share) {
  return {p.c * std::exp(share * by.c), p.n + share * by.n};
}

/// From the curve through the last sample; the steps are halved while they do not pay.
Parameters minimise(const std::vector<Sample>& samples) {
  Parameters p{1.0, 1.2};
  double sum = sum_of_squares(samples, p);
  for (int iteration = 0; iteration < 100; ++iteration) {
    const Parameters by = step(samples, p);
    if (!std::isfinite(by.c) || !std::isfinite(by.n)) break;
    double share = 1.0;
    Parameters next = moved(p, by, share);
    double next_sum = sum_of_squares(samples, next);
    while (!(next_sum <= sum) && share > 1e-6) {
      share *= 0.5;
      next = moved(p, by, share);
      next_sum = sum_of_squares(samples, next);
    }
    if (!(next_sum <= sum)) break;  // rounding is reached
    p = next;
    sum = next_sum;
    if (std::abs(by.c) + std::abs(by.n) < 1e-12) break;
  }
  return p;
}

/// The penetration under `load`, between `low` and `high`, by Newton's method from `guess`, halving
/// the bracket where a step leaves it.
double penetration_between(const ElasticLaw& law, double load, double low, double high,
                           double guess) {
  double d = guess;
  for (int i = 0; i < 200; ++i) {
    const ElasticResponse at = law.response(d);
    (at.force > load ? high : low) = d;
    const double step = (at.force - load) / at.stiffness;
    if (std::abs(step) <= 4e-15 * d) return d - step;
    d -= step;
    if (!(d > low && d < high)) d = 0.5 * (low + high);
  }
  return d;
}

}  // namespace

PowerFit fit_power_law(const ElasticLaw& law, double max_load, int samples, double min_load) {
  const std::string owner = fmt::format("power law fitted to '{}'", law.name());
  require_positive(owner, "max_load", max_load, "N");
  require_range(owner, "samples", samples, 3, 1e7);
  require_range(owner, "min_load", min_load, 0.0, max_load * (1.0 - 1e-9), "N");
  const double last = law.penetration_at(max_load);
  const double reached = law.response(last).force;
  if (!(std::abs(reached / max_load - 1.0) < 1e-6))
    throw ModelError(fmt::format(
        "{}: max_load = {:g} N is beyond the range of the law, which ends at {:g} N (d = {:g} m)",
        owner, max_load, reached, last));

  std::vector<Sample> points;
  points.reserve(static_cast<std::size_t>(samples));
  const double first = min_load / max_load;
  double d = 0.0, load_before = 0.0;
  for (int i = first > 0.0 ? 0 : 1; i < samples; ++i) {  // K 0^n is right whatever K and n
    const double load = first + (1.0 - first) * static_cast<double>(i) / (samples - 1);
    d = points.empty() ? law.penetration_at(load * max_load)
                       : penetration_between(law, load * max_load, d, last,
                                             std::min(last, d * load / load_before));
    load_before = load;
    points.push_back({std::log(d / last), load});
  }
  const Parameters p = minimise(points);

  PowerFit fit{.K = max_load * p.c / std::pow(last, p.n),
               .n = p.n,
               .max_load = max_load,
               .min_load = min_load,
               .samples = samples};
  double squares = 0.0;
  for (const Sample& s : points) {
    const double error = p.c * std::exp(p.n * s.log_penetration) / s.load - 1.0;
    fit.max_error = std::max(fit.max_error, std::abs(error));
    squares += error * error;
  }
  fit.rms_error = std::sqrt(squares / static_cast<double>(points.size()));
  const double small = 1e-3 * max_load;
  fit.error_at_small_load = fit.K * std::pow(law.penetration_at(small), fit.n) / small - 1.0;
  return fit;
}

}  // namespace yoke
