// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/results/contact_spans.hpp>

#include <algorithm>
#include <map>

namespace yoke::cases {

namespace {

/// Rows within, and what they show.
void look_into(ContactSpan& impact, const Table& samples) {
  const std::size_t t = samples.index("t_s");
  const auto row_after = [&](double time) {
    std::size_t low = 0, high = samples.rows();
    while (low < high) {
      const std::size_t middle = (low + high) / 2;
      if (samples.value(middle, t) < time)
        low = middle + 1;
      else
        high = middle;
    }
    return low;
  };
  impact.first = impact.peak = row_after(impact.onset);
  impact.last = row_after(impact.release);
  const std::string force = impact.element + ".normal_force_N",
                    depth = impact.element + ".penetration_m";
  if (!samples.has(force) || !samples.has(depth)) return;
  const std::size_t f = samples.index(force), d = samples.index(depth);
  for (std::size_t i = impact.first; i < impact.last; ++i) {
    if (samples.value(i, f) > impact.peak_force) {
      impact.peak_force = samples.value(i, f);
      impact.peak = i;
    }
    impact.deepest = std::max(impact.deepest, samples.value(i, d));
  }
}

}  // namespace

std::vector<ContactSpan> contact_spans(const Table& samples,
                                       const std::vector<EventRecord>& events) {
  std::vector<ContactSpan> found;
  if (samples.rows() == 0) return found;
  const double end = samples.value(samples.rows() - 1, samples.index("t_s"));
  std::map<std::string, std::size_t> open;  // by element, the one that lasts
  for (const EventRecord& e : events) {
    if (e.kind == "onset") {
      open[e.element] = found.size();
      found.push_back({.element = e.element,
                       .region = e.region,
                       .onset = e.t,
                       .release = end,
                       .speed = e.speed});
    } else if (e.kind == "release") {
      const auto it = open.find(e.element);
      if (it == open.end()) continue;
      ContactSpan& impact = found[it->second];
      impact.release = e.t;
      if (impact.speed > 0.0) impact.restitution = -e.speed / impact.speed;
      open.erase(it);
    }
  }
  for (ContactSpan& impact : found) look_into(impact, samples);
  return found;
}

}  // namespace yoke::cases
