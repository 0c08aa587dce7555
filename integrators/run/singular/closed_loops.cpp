// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/run/singular/closed_loops.hpp>

#include <algorithm>
#include <numeric>
#include <vector>

namespace yoke {

bool has_closed_loops(const System& system) {
  std::vector<int> parent(system.model().bodies().size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int i) {
    while (parent[static_cast<std::size_t>(i)] != i) {
      auto& above = parent[static_cast<std::size_t>(i)];
      above = parent[static_cast<std::size_t>(above)];
      i = above;
    }
    return i;
  };
  for (const ConstraintSlot& c : system.joints()) {
    const auto& equations = c.element->equations();
    if (std::ranges::all_of(equations,
                            [](const Equation& e) { return e.measure == Measure::angle; }))
      continue;
    std::vector<BodyId> bodies = c.element->bodies();
    if (bodies.size() == 1) bodies.push_back(ground);
    for (std::size_t i = 1; i < bodies.size(); ++i) {
      const int a = root(bodies[i - 1].index), b = root(bodies[i].index);
      if (a == b) return true;
      parent[static_cast<std::size_t>(a)] = b;
    }
  }
  return false;
}

}  // namespace yoke
