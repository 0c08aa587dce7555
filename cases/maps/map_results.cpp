// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/maps/map_results.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace yoke::cases {

std::string draw_map(const MapRequest& request, const Figure& figure, std::size_t points) {
  if (!request.plots || points == 0) return {};
  return draw_figures({figure}, request.output / "plots", 1);
}

MapProgress::MapProgress(bool shown) : line_(shown), start_(std::chrono::steady_clock::now()) {}

void MapProgress::report(std::size_t done, std::size_t total) {
  StudyProgress p{.total = total, .done = done};
  p.elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  p.remaining = p.elapsed * double(total - done) / double(std::max<std::size_t>(done, 1));
  line_.report(p);
}

void print_ranges(const Table& points, std::size_t first) {
  if (points.rows() == 0) return;
  for (std::size_t j = first; j < points.names().size(); ++j) {
    const Eigen::VectorXd column = points[points.names()[j]];
    const double low = column.minCoeff(), high = column.maxCoeff();
    const std::string from = fmt::format("{:.9g}", low), to = fmt::format("{:.9g}", high);
    fmt::print("  {:<28} {}{}{}\n", points.names()[j], from, from == to ? "" : " to ",
               from == to ? "" : to);
  }
}

std::string period_text(std::size_t period, std::size_t points) {
  return period > 0 ? fmt::format("period {}", period)
                    : fmt::format("no period within {} points", points / 2);
}

void print_files(const MapRequest& request, const std::string& files, const std::string& plots) {
  fmt::print("results: {}: {}\n", request.output.string(), files);
  if (!plots.empty()) fmt::print("{}\n", plots);
}

}  // namespace yoke::cases
