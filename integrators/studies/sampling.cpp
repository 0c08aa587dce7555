// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Which points of the box: all of a grid, random ones, Sobol's.
#include <fmt/ranges.h>

#include <boost/random/sobol.hpp>
#include <cmath>
#include <random>
#include <utility>

#include <yoke/core/error.hpp>
#include <yoke/integrators/studies/points.hpp>

namespace yoke {

namespace {

void require_axes(const std::vector<StudyAxis>& axes) {
  if (axes.empty()) throw ModelError("a study needs at least one axis");
}

void require_count(std::size_t count) {
  if (count < 1 || count > most_study_points)
    throw ModelError(fmt::format("{} points; accepted are 1 to {}", count, most_study_points));
}

/// The coordinate at a share 0 <= u < 1 of an axis.
double at_share(const StudyAxis& axis, double u) {
  if (!axis.range) return axis.values[static_cast<std::size_t>(u * double(axis.values.size()))];
  if (axis.whole) return std::floor(axis.low + u * (axis.high - axis.low + 1.0));
  if (axis.logarithmic) return axis.low * std::pow(axis.high / axis.low, u);
  return axis.low + u * (axis.high - axis.low);
}

/// The upper 53 bits as a number 0 <= u < 1: all that a double can tell apart.
double share_of(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

template <class Bits>
StudyPoints sampled(std::vector<StudyAxis> axes, std::size_t count, std::string origin,
                    Bits&& next_bits) {
  require_axes(axes);
  require_count(count);
  std::vector<double> coordinates;
  coordinates.reserve(count * axes.size());
  for (std::size_t i = 0; i < count; ++i)
    for (const StudyAxis& axis : axes) coordinates.push_back(at_share(axis, share_of(next_bits())));
  return {std::move(axes), std::move(coordinates), std::move(origin)};
}

}  // namespace

StudyPoints grid_points(std::vector<StudyAxis> axes) {
  require_axes(axes);
  std::vector<std::size_t> sizes;
  double product = 1.0;
  for (const StudyAxis& axis : axes) {
    sizes.push_back(axis.values.size());
    product *= static_cast<double>(axis.values.size());
  }
  const std::string origin = fmt::format("grid of {}", fmt::join(sizes, " x "));
  if (product > static_cast<double>(most_study_points))
    throw ModelError(fmt::format("{}: {:g} points; accepted are at most {}", origin, product,
                                 most_study_points));
  const std::size_t count = static_cast<std::size_t>(product);
  std::vector<double> coordinates(count * axes.size());
  std::size_t period = count;  // after which an axis begins again
  for (std::size_t a = 0; a < axes.size(); ++a) {
    const std::size_t run = period / sizes[a];  // of one value
    for (std::size_t i = 0; i < count; ++i)
      coordinates[i * axes.size() + a] = axes[a].values[i % period / run];
    period = run;
  }
  return {std::move(axes), std::move(coordinates), origin};
}

StudyPoints random_points(std::vector<StudyAxis> axes, std::size_t count, std::uint64_t seed) {
  std::mt19937_64 generator(seed);  // the standard says its every bit
  return sampled(std::move(axes), count, fmt::format("{} random points, seed {}", count, seed),
                 [&] { return generator(); });
}

StudyPoints sobol_points(std::vector<StudyAxis> axes, std::size_t count) {
  require_axes(axes);
  constexpr std::size_t most_axes = 3667;
  if (axes.size() > most_axes)
    throw ModelError(
        fmt::format("Sobol points of {} axes; accepted are at most {}", axes.size(), most_axes));
  boost::random::sobol generator(axes.size());
  return sampled(std::move(axes), count, fmt::format("{} points of Sobol's sequence", count),
                 [&] { return generator(); });
}

StudyPoints listed_points(std::vector<StudyAxis> axes,
                          const std::vector<std::vector<double>>& rows) {
  require_axes(axes);
  require_count(rows.size());
  std::vector<double> coordinates;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].size() != axes.size())
      throw ModelError(fmt::format("point {} has {} coordinates; there are {} axes", i,
                                   rows[i].size(), axes.size()));
    coordinates.insert(coordinates.end(), rows[i].begin(), rows[i].end());
  }
  return {std::move(axes), std::move(coordinates), fmt::format("list of {} points", rows.size())};
}

}  // namespace yoke
