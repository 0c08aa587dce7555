// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/core/equations/assemblies.hpp>

#include <numeric>

#include <yoke/core/equations/linear/index.hpp>

namespace yoke {

std::vector<int> assemblies_of(const System& system) {
  std::vector<int> parent(at(system.dofs() / 3));
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int i) {
    while (parent[at(i)] != i) i = parent[at(i)] = parent[at(parent[at(i)])];
    return i;
  };
  for (const ConstraintSlot& c : system.joints()) {
    int first = -1;
    for (int j = 0; j < c.columns; j += 3) {
      const int dof = system.dof()[at(c.dofs + j)];
      if (dof < 0) continue;
      if (first < 0) first = root(dof / 3);
      parent[at(root(dof / 3))] = first;
    }
  }
  for (int& p : parent) p = root(p);
  return parent;
}

}  // namespace yoke
