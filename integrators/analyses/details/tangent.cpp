// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/analyses/details/tangent.hpp>

#include <vector>

#include <yoke/core/equations/linear/index.hpp>
#include <yoke/integrators/analyses/reduction/element_blocks.hpp>

namespace yoke {

namespace {

/// Entries of one matrix, given as blocks.
class Entries {
 public:
  /// block [rows.size() x columns.size()], row-major; -1 in the indices: the ground.
  void add(std::span<const int> rows, std::span<const int> columns, const double* block,
           double factor = 1.0) {
    for (const int row : rows)
      for (const int column : columns) {
        const double value = *block++;
        if (row >= 0 && column >= 0 && value != 0.0)
          entries_.emplace_back(row, column, factor * value);
      }
  }
  Tangent::Matrix matrix(int rows, int columns) const {
    Tangent::Matrix m(rows, columns);
    m.setFromTriplets(entries_.begin(), entries_.end());
    m.makeCompressed();
    return m;
  }

 private:
  std::vector<Eigen::Triplet<double>> entries_;
};

std::vector<int> range(int first, int count) {
  std::vector<int> indices(at(count));
  for (int i = 0; i < count; ++i) indices[at(i)] = first + i;
  return indices;
}

struct ForceEntries {
  Entries Q_q, Q_v, Q_z, z_q, z_v, z_z;
};

void add_force(const System& system, const ForceSlot& f, const ForceBlocks& blocks, double share,
               ForceEntries& to) {
  const std::span<const int> dofs = system.dof().subspan(at(f.dofs), at(f.columns));
  const std::vector<int> own = range(f.z, f.states);
  to.Q_q.add(dofs, dofs, blocks.Q_q.data(), share);
  to.Q_v.add(dofs, dofs, blocks.Q_v.data(), share);
  to.Q_z.add(dofs, own, blocks.Q_z.data(), share);
  to.z_q.add(own, dofs, blocks.z_q.data());
  to.z_v.add(own, dofs, blocks.z_v.data());
  to.z_z.add(own, own, blocks.z_z.data());
}

}  // namespace

void refuse_loads(System& system, const State& state) {
  system.bind(state);
  system.set_motion(state.t, state.q.data(), state.v.data());
  LoadCheck(system).refuse(system, state.lambda.data());
}

Tangent calc_tangent(System& system, const State& state, std::span<const double> share) {
  system.bind(state);
  system.set_motion(state.t, state.q.data(), state.v.data());
  std::vector<double> lambda(state.lambda.begin(), state.lambda.end());
  for (const int row : system.dropped_rows()) lambda[at(row)] = 0.0;
  system.set_multipliers(lambda.data());
  const int n = system.dofs(), nz = system.states();
  ForceEntries force;
  ForceBlocks of_force(system);
  for (std::size_t i = 0; i < system.forces().size(); ++i)
    if (const ForceSlot& f = system.forces()[i]; of_force.evaluate(system, f))
      add_force(system, f, of_force, share.empty() ? 1.0 : share[i], force);
  system.set_multipliers(nullptr);
  Entries K, G, H;
  ConstraintBlocks of_constraint(system);
  for (const ConstraintSlot& c : system.constraints()) {
    of_constraint.evaluate(system, c, lambda.data());
    const std::span<const int> dofs = system.dof().subspan(at(c.dofs), at(c.columns));
    std::vector<int> equations = range(c.row, c.rows);
    for (int& equation : equations)
      if (system.is_dropped(equation)) equation = -1;
    G.add(equations, dofs, of_constraint.G.data());
    H.add(equations, dofs, of_constraint.H.data());
    K.add(dofs, dofs, of_constraint.K.data());
  }
  return {.Q_q = force.Q_q.matrix(n, n),
          .Q_v = force.Q_v.matrix(n, n),
          .Q_z = force.Q_z.matrix(n, nz),
          .z_q = force.z_q.matrix(nz, n),
          .z_v = force.z_v.matrix(nz, n),
          .z_z = force.z_z.matrix(nz, nz),
          .K_lambda = K.matrix(n, n),
          .G = G.matrix(system.rows(), n),
          .H = H.matrix(system.rows(), n)};
}

}  // namespace yoke
