// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/report/thinning.hpp>

#include <algorithm>
#include <numeric>

namespace yoke::cases {

namespace {

using Rows = std::vector<std::size_t>;

void sort_out(Rows& rows) {
  std::ranges::sort(rows);
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
}

/// Of every impact its ends and its peak, and as many rows between as fit.
Rows rows_of_impacts(const Table& samples, const std::vector<ContactSpan>& impacts,
                     std::size_t most) {
  Rows rows{0, samples.rows() - 1};
  constexpr std::size_t densest = 40;
  const std::size_t parts =
      impacts.empty() ? 1 : std::clamp<std::size_t>(most / (2 * impacts.size()), 1, densest);
  for (const ContactSpan& impact : impacts) {
    if (impact.first > 0) rows.push_back(impact.first - 1);
    for (std::size_t k = 0; k <= parts; ++k)
      rows.push_back(impact.first + (impact.last - impact.first) * k / parts);
    rows.push_back(impact.peak);
  }
  std::erase_if(rows, [&](std::size_t i) { return i >= samples.rows(); });
  sort_out(rows);
  return rows;
}

/// Where a column is least and greatest within each of `parts` stretches.
Rows extremes(const Table& samples, std::size_t parts) {
  Rows rows;
  const std::size_t count = samples.rows(), columns = samples.names().size();
  Rows least(columns), greatest(columns);
  std::vector<double> low(columns), high(columns);
  for (std::size_t k = 0; k < parts; ++k) {
    const std::size_t from = count * k / parts, to = count * (k + 1) / parts;
    if (from >= to) continue;
    std::ranges::fill(least, from);
    std::ranges::fill(greatest, from);
    const double* row = samples.data().data() + from * columns;
    std::copy(row, row + columns, low.begin());
    std::copy(row, row + columns, high.begin());
    for (std::size_t i = from; i < to; ++i, row += columns)
      for (std::size_t j = 0; j < columns; ++j) {
        const double x = row[j];
        if (x < low[j]) low[j] = x, least[j] = i;
        if (x > high[j]) high[j] = x, greatest[j] = i;
      }
    rows.insert(rows.end(), least.begin(), least.end());
    rows.insert(rows.end(), greatest.begin(), greatest.end());
  }
  sort_out(rows);
  return rows;
}

}  // namespace

std::vector<std::size_t> thinned_rows(const Table& samples, const std::vector<ContactSpan>& impacts,
                                      std::size_t most) {
  Rows all(samples.rows());
  std::iota(all.begin(), all.end(), std::size_t{0});
  if (all.size() <= most) return all;
  const Rows needed = rows_of_impacts(samples, impacts, most);
  // Most columns have their extremes at the ends of a stretch, in rows that they share.
  for (std::size_t parts = most / 4; parts > 0; parts = parts / 2) {
    Rows rows = extremes(samples, parts);
    rows.insert(rows.end(), needed.begin(), needed.end());
    sort_out(rows);
    if (rows.size() <= most) return rows;
  }
  return needed;
}

}  // namespace yoke::cases
