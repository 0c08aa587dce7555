// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/core/authoring/check_tools.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace yoke::checking {

double largest(std::span<const double> values) {
  double size = 0.0;
  for (const double x : values) size = std::max(size, std::abs(x));
  return size;
}

namespace {

// Central differences with steps that are halved from level to level span four decades, so that
// truncation and rounding are both small somewhere.
constexpr std::size_t levels = 14;
using Differences = std::array<double, levels>;

// Extrapolation to step zero (Ridders 1982): of all extrapolated values the one whose neighbours
// agree best with it.
double extrapolate(const Differences& differences) {
  Differences previous{}, current{};
  double best = 0.0, least = std::numeric_limits<double>::infinity();
  for (std::size_t level = 0; level < levels; ++level) {
    current[0] = differences[level];
    double factor = 4.0;
    for (std::size_t order = 1; order <= level; ++order, factor *= 4.0) {
      current[order] = (factor * current[order - 1] - previous[order - 1]) / (factor - 1.0);
      const double error = std::max(std::abs(current[order] - current[order - 1]),
                                    std::abs(current[order] - previous[order - 1]));
      if (error < least) least = error, best = current[order];
    }
    previous = current;
  }
  return best;
}

void turn(BodyMotion& b) { b.c = std::cos(b.angle), b.s = std::sin(b.angle); }

}  // namespace

Values differentiate(const std::function<Values(double h)>& f, double scale) {
  std::vector<Differences> differences;
  double h = 0.02 * scale;
  for (std::size_t level = 0; level < levels; ++level, h /= 2.0) {
    const Values right = f(h), left = f(-h);
    differences.resize(right.size());
    for (std::size_t i = 0; i < right.size(); ++i)
      differences[i][level] = (right[i] - left[i]) / (2.0 * h);
  }
  Values slopes;
  for (const Differences& d : differences) slopes.push_back(extrapolate(d));
  return slopes;
}

Probe::Probe(const Model& model, const State& state)
    : model_(&model), bodies_(model.bodies().size()), t_(state.t) {
  for (std::size_t i = 1; i < bodies_.size(); ++i) {
    const auto offset = static_cast<Eigen::Index>(3 * (i - 1));
    BodyMotion& b = bodies_[i];
    b.x = state.q[offset], b.y = state.q[offset + 1], b.angle = state.q[offset + 2];
    b.vx = state.v[offset], b.vy = state.v[offset + 1], b.omega = state.v[offset + 2];
    turn(b);
  }
}

void Probe::move_coordinate(BodyId id, int axis, double h) {
  BodyMotion& b = bodies_[index(id.index)];
  (axis == 0 ? b.x : axis == 1 ? b.y : b.angle) += h;
  turn(b);
}

void Probe::move_velocity(BodyId id, int axis, double h) {
  BodyMotion& b = bodies_[index(id.index)];
  (axis == 0 ? b.vx : axis == 1 ? b.vy : b.omega) += h;
}

void Probe::drift(double h) {
  t_ += h;
  for (BodyMotion& b : bodies_) {
    b.x += h * b.vx, b.y += h * b.vy, b.angle += h * b.omega;
    turn(b);
  }
}

Values Probe::velocities(const std::vector<BodyId>& ids) const {
  Values v;
  for (const BodyId id : ids) {
    const BodyMotion& b = bodies_[index(id.index)];
    v.insert(v.end(), {b.vx, b.vy, b.omega});
  }
  return v;
}

void Comparison::complain(const std::string& problem) {
  if (check_.problem.empty()) check_.problem = problem;
}

void Comparison::require_finite_block(const char* name, const Values& block) {
  if (!std::ranges::all_of(block, [](double x) { return std::isfinite(x); }))
    complain(fmt::format("{} holds a number that is not finite", name));
}

void Comparison::compare(const char* name, int rows, int columns, const Values& analytic,
                         const Values& numeric, const std::vector<bool>& skip, double natural) {
  const double block = std::max({largest(analytic), largest(numeric), natural});
  for (int r = 0; r < rows; ++r) {
    const std::size_t start = index(r * columns), width = index(columns);
    const double row = std::max({largest(std::span(analytic).subspan(start, width)),
                                 largest(std::span(numeric).subspan(start, width)), 1e-3 * block,
                                 std::numeric_limits<double>::min()});
    for (int c = 0; c < columns; ++c)
      if (!skip[index(c)])
        entry(name, r, c, analytic[start + index(c)], numeric[start + index(c)], row);
  }
}

void Comparison::require_same(const char* name, const Values& alone, const Values& together) {
  const double size = std::max(largest(alone), largest(together));
  for (std::size_t i = 0; i < alone.size(); ++i)
    if (std::abs(alone[i] - together[i]) > 1e-11 * size)
      complain(fmt::format("{} asked for alone differs from {} asked for with the other blocks",
                           name, name));
}

void Comparison::entry(const char* name, int r, int c, double analytic, double numeric,
                       double scale) {
  ++check_.entries;
  double error = std::abs(analytic - numeric) / scale;
  if (!std::isfinite(error)) error = std::numeric_limits<double>::infinity();
  if (error <= check_.worst_error) return;
  check_.worst_error = error;
  check_.block = name;
  check_.row = r, check_.column = c;
  check_.analytic = analytic, check_.numeric = numeric;
}

std::vector<bool> ground_columns(const std::vector<BodyId>& bodies) {
  std::vector<bool> skip;
  for (const BodyId id : bodies) skip.insert(skip.end(), 3, id == ground);
  return skip;
}

double step_scale(int column, const CheckOptions& options) {
  return column % 3 == 2 ? options.angle : options.length;
}

double drift_scale(const Values& v, const CheckOptions& options) {
  double scale = options.time;
  for (std::size_t i = 0; i < v.size(); ++i)
    if (v[i] != 0.0)
      scale = std::min(scale, step_scale(static_cast<int>(i), options) / std::abs(v[i]));
  return scale;
}

bool any_nonzero(const Values& block, const std::vector<bool>& skip) {
  for (std::size_t i = 0; i < block.size(); ++i)
    if (block[i] != 0.0 && !skip[i % skip.size()]) return true;
  return false;
}

}  // namespace yoke::checking
