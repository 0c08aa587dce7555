// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/clearance/bearings.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include <yoke/core/units.hpp>

namespace yoke::cases {

using namespace yoke::literals;

std::vector<Vec2> point_path(const Model& model, const Result& run, const std::string& body,
                             const Vec2& at) {
  std::vector<Vec2> path(run.samples.rows(), at);
  if (body.empty()) return path;
  const Vec2 local = model.to_local(model.find_body(body), at);
  const Eigen::VectorXd x = run[body + ".x_m"], y = run[body + ".y_m"],
                        angle = run[body + ".angle_rad"];
  for (std::size_t i = 0; i < path.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    path[i] = Vec2(x[row], y[row]) + rotate(angle[row], local);
  }
  return path;
}

std::vector<Vec2> journal_path(const Model& model, const Result& run, const Bearing& bearing) {
  const std::vector<Vec2> bore = point_path(model, run, bearing.a, bearing.at);
  std::vector<Vec2> path = point_path(model, run, bearing.b, bearing.at);
  Eigen::VectorXd turned = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(path.size()));
  if (!bearing.a.empty()) turned = run[bearing.a + ".angle_rad"];
  for (std::size_t i = 0; i < path.size(); ++i)
    path[i] = rotate(-turned[static_cast<Eigen::Index>(i)], path[i] - bore[i]);
  return path;
}

Check journal_check(const Model& model, const Result& run, const Bearing& bearing) {
  const std::vector<Vec2> path = journal_path(model, run, bearing);
  const std::size_t column = run.samples.index(bearing.joint + ".penetration_m");
  double worst = 0.0;
  for (std::size_t i = 0; i < path.size(); ++i)
    worst =
        std::max(worst, std::abs(path[i].norm() - bearing.radial - run.samples.value(i, column)));
  return {.what = fmt::format("{}: journal and penetration reported differ by", bearing.joint),
          .value = 1e6 * worst,
          .unit = "um",
          .tolerance = 1e6 * 1e-12,  // rounding of poses of a metre
          .remark = "from the poses; deepest " +
                    fmt::format("{:.3g} um", 1e6 * (play_of(run, bearing) - bearing.radial))};
}

double play_of(const Result& run, const Bearing& bearing) {
  return bearing.radial + std::max(0.0, run[bearing.joint + ".penetration_m"].maxCoeff());
}

Portrait orbit_portrait(const Model& model, const Result& run,
                        const std::vector<Bearing>& bearings) {
  Portrait orbit{.name = "orbit",
                 .title = "paths of journals in their bearings",
                 .x_label = "x in axes of the bearing [µm]",
                 .y_label = "y [µm]",
                 .lines = {},
                 .equal_scales = true};
  for (const Bearing& bearing : bearings) {
    PortraitLine line{.name = bearing.joint, .points = journal_path(model, run, bearing)};
    for (Vec2& p : line.points) p *= 1e6;
    orbit.lines.push_back(std::move(line));
  }
  PortraitLine circle{.name = "clearance", .points = {}};
  for (int i = 0; i <= 360; ++i)
    circle.points.push_back(rotate(i * 1.0_deg, {1e6 * bearings.front().radial, 0.0}));
  orbit.lines.push_back(std::move(circle));
  return orbit;
}

}  // namespace yoke::cases
