// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/core/motion_laws.hpp>

#include <algorithm>
#include <cmath>

#include <yoke/core/error.hpp>
#include <yoke/core/types.hpp>

namespace yoke {

namespace {

MotionValue stay(double) { return {}; }

MotionValue straight(double x) { return {.value = x, .first = 1.0}; }

/// x - sin(k x) / k.
MotionValue cycloid(double k, double x) {
  const double c = std::cos(k * x), s = std::sin(k * x);
  return {x - s / k, 1.0 - c, k * s, k * k * c};
}

/// The rest of a law that is the same backwards: s(x) = 1 - s(1 - x). It ends at rest to the bit if
/// it starts so.
MotionValue mirrored(const MotionValue& y) { return {1.0 - y.value, y.first, -y.second, y.third}; }

MotionValue half_cosine(double x) {
  if (x > 0.5) return mirrored(half_cosine(1.0 - x));
  const double c = std::cos(pi * x), s = std::sin(pi * x);
  return {0.5 * (1.0 - c), 0.5 * pi * s, 0.5 * pi * pi * c, -0.5 * pi * pi * pi * s};
}

MotionValue whole_cycloid(double x) {
  return x > 0.5 ? mirrored(cycloid(2.0 * pi, 1.0 - x)) : cycloid(2.0 * pi, x);
}

MotionValue first_half_cycloid(double x) { return cycloid(pi, x); }
MotionValue last_half_cycloid(double x) { return mirrored(first_half_cycloid(1.0 - x)); }

/// The acceleration is a quarter of a sine of period 1/2, then of period 3/2, up to the middle.
MotionValue modified_sine_rise(double x) {
  if (x > 0.5) return mirrored(modified_sine_rise(1.0 - x));
  const double k = 1.0 / (4.0 + pi);
  if (x < 0.125) {
    const MotionValue y = cycloid(4.0 * pi, x);
    return {pi * k * y.value, pi * k * y.first, pi * k * y.second, pi * k * y.third};
  }
  const double w = 4.0 * pi / 3.0, c = std::cos(w * x + pi / 3.0), s = std::sin(w * x + pi / 3.0);
  return {k * (2.0 + pi * x - 2.25 * s), k * (pi - 2.25 * w * c), k * 2.25 * w * w * s,
          k * 2.25 * w * w * w * c};
}

/// The acceleration rises as a quarter of a sine, stays, and falls as it rose, up to the middle.
MotionValue modified_trapezoid_rise(double x) {
  if (x > 0.5) return mirrored(modified_trapezoid_rise(1.0 - x));
  const double peak = 8.0 * pi / (2.0 + pi), w = 4.0 * pi, b = peak / w;
  if (x < 0.125) {
    const MotionValue y = cycloid(w, x);
    return {b * y.value, b * y.first, b * y.second, b * y.third};
  }
  const double value_1 = b * (0.125 - 1.0 / w);  // at 1/8, where the rate is b
  if (x < 0.375) {
    const double u = x - 0.125;
    return {value_1 + u * (b + 0.5 * peak * u), b + peak * u, peak, 0.0};
  }
  const double u = x - 0.375, c = std::cos(w * u), s = std::sin(w * u);
  const double rate_2 = b + 0.25 * peak, value_2 = value_1 + 0.25 * (b + 0.125 * peak);
  return {value_2 + rate_2 * u + b / w * (1.0 - c), rate_2 + b * s, peak * c, -peak * w * s};
}

MotionValue fifth_degree(double x) {
  const double r = 1.0 - x;
  return {x * x * x * (10.0 + x * (6.0 * x - 15.0)), 30.0 * x * x * r * r,
          60.0 * x * r * (1.0 - 2.0 * x), 60.0 * (1.0 - 6.0 * x * r)};
}

MotionValue seventh_degree(double x) {
  const double r = 1.0 - x, x2 = x * x;
  return {x2 * x2 * (35.0 + x * (x * (70.0 - 20.0 * x) - 84.0)), 140.0 * x2 * x * r * r * r,
          420.0 * x2 * r * r * (1.0 - 2.0 * x), 840.0 * x * r * (1.0 - 5.0 * x * r)};
}

}  // namespace

constinit const MotionLaw dwell{"dwell", stay};
constinit const MotionLaw constant_velocity{"constant velocity", straight};
constinit const MotionLaw simple_harmonic{"simple harmonic", half_cosine};
constinit const MotionLaw cycloidal{"cycloidal", whole_cycloid};
constinit const MotionLaw modified_sine{"modified sine", modified_sine_rise};
constinit const MotionLaw modified_trapezoid{"modified trapezoid", modified_trapezoid_rise};
constinit const MotionLaw polynomial_345{"polynomial 3-4-5", fifth_degree};
constinit const MotionLaw polynomial_4567{"polynomial 4-5-6-7", seventh_degree};
constinit const MotionLaw cycloidal_start{"cycloidal start", first_half_cycloid};
constinit const MotionLaw cycloidal_end{"cycloidal end", last_half_cycloid};

const std::vector<MotionLaw>& motion_laws() {
  static const std::vector<MotionLaw> all = {dwell,          constant_velocity, simple_harmonic,
                                             cycloidal,      modified_sine,     modified_trapezoid,
                                             polynomial_345, polynomial_4567,   cycloidal_start,
                                             cycloidal_end};
  return all;
}

// ---- chains

namespace {

/// "motion: segment 2 (cycloidal)".
std::string segment_name(std::size_t index, const MotionLaw& law) {
  return fmt::format("motion: segment {} ({})", index + 1, law.name);
}

/// What a law must be at its ends.
void check_law(const std::string& owner, const MotionLaw& law) {
  if (law.at == nullptr)
    throw ModelError(
        fmt::format("{}: a law needs its function; give one of motion_laws() or a "
                    "name and a function",
                    owner));
  const double rise = law.at == dwell.at ? 0.0 : 1.0, low = law.at(0.0).value,
               high = law.at(1.0).value;
  if (!(std::abs(low) <= 1e-12 && std::abs(high - rise) <= 1e-12))
    throw ModelError(
        fmt::format("{}: a law rises from 0 at x = 0 to 1 at x = 1, this one from {:g} to {:g}",
                    owner, low, high));
}

}  // namespace

void MotionChain::add(const MotionSegment& s) {
  const std::string owner = segment_name(laws_.size(), s.law);
  check_law(owner, s.law);
  require_positive(owner, "over", s.over, "");
  const double from = ends_.back().value, to = s.to.value_or(from);
  require_finite(owner, "to", to);
  if (s.law.at == dwell.at && to != from)
    throw ModelError(
        fmt::format("{}: to = {:g}, but a dwell stays at {:g}; leave `to` out, or give "
                    "the segment a law that rises",
                    owner, to, from));
  if (s.law.at != dwell.at && !s.to)
    throw ModelError(
        fmt::format("{}: `to`, the value at its end, is missing; only a dwell has "
                    "none",
                    owner));
  laws_.push_back(s.law);
  ends_.push_back({ends_.back().argument + s.over, to});
}

MotionChain::MotionChain(std::vector<MotionSegment> segments, MotionOptions options)
    : repeat_(options.repeat) {
  require_finite("motion", "start", options.start);
  require_finite("motion", "begin", options.begin);
  if (segments.empty()) throw ModelError("motion: no segments; give at least one, {law, over, to}");
  ends_.push_back({options.begin, options.start});
  for (const MotionSegment& s : segments) add(s);
  const double first = ends_.front().value, last = ends_.back().value;
  double scale = 0.0;
  for (const End& e : ends_) scale = std::max(scale, std::abs(e.value));
  if (repeat_ == Repeat::periodic && std::abs(last - first) > 1e-12 * scale)
    throw ModelError(
        fmt::format("motion: it is periodic, but starts at {:g} and ends at {:g}; let the last "
                    "segment end where the first begins, or use Repeat::advancing",
                    first, last));
  check_velocities();
}

void MotionChain::check_velocities() const {
  const std::size_t count = laws_.size();
  double fastest = 0.0;  // mean of a segment
  for (std::size_t i = 0; i < count; ++i)
    fastest = std::max(fastest, std::abs((ends_[i + 1].value - ends_[i].value) /
                                         (ends_[i + 1].argument - ends_[i].argument)));
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t next = (i + 1) % count;
    if (next == 0 && repeat_ == Repeat::never) break;
    const double before = inside(i, ends_[i + 1].argument).first,
                 after = inside(next, ends_[next].argument).first;
    if (std::abs(after - before) <= 1e-9 * fastest) continue;
    throw ModelError(fmt::format(
        "motion: the velocity jumps from {:g} to {:g} at {:g}, where {} '{}' and {} '{}' meet; use "
        "laws that start and end at rest, or cycloidal_start and cycloidal_end beside a constant "
        "velocity",
        before, after, ends_[i + 1].argument, i + 1, laws_[i].name, next + 1, laws_[next].name));
  }
}

double MotionChain::period() const {
  return repeat_ == Repeat::never ? std::numeric_limits<double>::infinity() : end() - begin();
}

std::vector<double> MotionChain::junctions() const {
  std::vector<double> arguments;
  for (const End& e : ends_) arguments.push_back(e.argument);
  return arguments;
}

MotionValue MotionChain::inside(std::size_t i, double x) const {
  const End &from = ends_[i], &to = ends_[i + 1];
  const double length = to.argument - from.argument, rise = to.value - from.value;
  const double part = std::clamp((x - from.argument) / length, 0.0, 1.0);
  const MotionValue y = laws_[i].at(part);
  return {from.value + rise * y.value, rise / length * y.first, rise / (length * length) * y.second,
          rise / (length * length * length) * y.third};
}

MotionValue MotionChain::operator()(double x) const {
  double advanced = 0.0;
  if (repeat_ != Repeat::never) {
    const double turns = std::floor((x - begin()) / period());
    x -= turns * period();
    if (repeat_ == Repeat::advancing) advanced = turns * (ends_.back().value - ends_.front().value);
  } else if (x < begin() || x >= end()) {
    const bool before = x < begin();
    const double edge = before ? begin() : end();
    const MotionValue y = inside(before ? 0 : laws_.size() - 1, edge);
    return {.value = y.value + y.first * (x - edge), .first = y.first};
  }
  const auto after = std::upper_bound(ends_.begin() + 1, ends_.end() - 1, x,
                                      [](double at, const End& e) { return at < e.argument; });
  MotionValue y = inside(static_cast<std::size_t>(after - ends_.begin()) - 1, x);
  y.value += advanced;
  return y;
}

}  // namespace yoke
