// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/analyses/details/tangent.hpp>

#include <algorithm>
#include <vector>

#include <yoke/core/equations/linear/index.hpp>

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

void add_force(const System& system, const ForceSlot& f, double share, ForceEntries& to) {
  const std::size_t k = at(f.columns), nz = at(f.states);
  std::vector<double> Q(k), Q_q(k * k), Q_v(k * k), Q_z(k * nz);
  std::vector<double> rate(nz), z_q(nz * k), z_v(nz * k), z_z(nz * nz);
  ForceRequest out{.Q = Q.data(), .dQ_dq = Q_q.data(), .dQ_dv = Q_v.data()};
  if (nz > 0) {
    out.dQ_dz = Q_z.data();
    out.z_dot = rate.data();
    out.dz_dq = z_q.data();
    out.dz_dv = z_v.data();
    out.dz_dz = z_z.data();
  }
  f.element->evaluate(system.force_input(f), out);
  const std::span<const int> dofs = system.dof().subspan(at(f.dofs), k);
  const std::vector<int> own = range(f.z, f.states);
  to.Q_q.add(dofs, dofs, Q_q.data(), share);
  to.Q_v.add(dofs, dofs, Q_v.data(), share);
  to.Q_z.add(dofs, own, Q_z.data(), share);
  to.z_q.add(own, dofs, z_q.data());
  to.z_v.add(own, dofs, z_v.data());
  to.z_z.add(own, own, z_z.data());
}

}  // namespace

std::string follows_reactions(System& system, const State& state) {
  system.bind(state);
  system.set_motion(state.t, state.q.data(), state.v.data());
  system.set_multipliers(state.lambda.data());
  std::string found;
  for (const std::size_t i : system.loaded()) {
    const ForceSlot& f = system.forces()[i];
    std::vector<double> Q(at(f.columns)), slope(at(f.columns * f.load_rows));
    f.element->evaluate(system.force_input(f), {.Q = Q.data(), .dQ_dlambda = slope.data()});
    if (std::ranges::any_of(slope, [](double x) { return x != 0.0; })) found = f.element->name();
  }
  system.set_multipliers(nullptr);
  return found;
}

Tangent calc_tangent(System& system, const State& state, std::span<const double> share) {
  system.bind(state);
  system.set_motion(state.t, state.q.data(), state.v.data());
  std::vector<double> lambda(state.lambda.begin(), state.lambda.end());
  for (const int row : system.dropped_rows()) lambda[at(row)] = 0.0;
  system.set_multipliers(lambda.data());
  const int n = system.dofs(), nz = system.states();
  ForceEntries force;
  for (std::size_t i = 0; i < system.forces().size(); ++i) {
    const ForceSlot& f = system.forces()[i];
    const Dependence depends = f.element->dependence();
    if (!depends.position && !depends.velocity && f.states == 0) continue;
    add_force(system, f, share.empty() ? 1.0 : share[i], force);
  }
  system.set_multipliers(nullptr);
  Entries K, G, H;
  for (const ConstraintSlot& c : system.constraints()) {
    const std::size_t k = at(c.columns), rows = at(c.rows);
    std::vector<double> g(rows * k), h(rows * k), stiffness(k * k);
    system.evaluate(
        c, {.G = g.data(), .H = h.data(), .K = stiffness.data(), .lambda = lambda.data() + c.row});
    const std::span<const int> dofs = system.dof().subspan(at(c.dofs), k);
    std::vector<int> equations = range(c.row, c.rows);
    for (int& equation : equations)
      if (system.is_dropped(equation)) equation = -1;
    G.add(equations, dofs, g.data());
    H.add(equations, dofs, h.data());
    K.add(dofs, dofs, stiffness.data());
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
