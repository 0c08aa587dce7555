// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/analyses/reduction/element_blocks.hpp>

#include <algorithm>

#include <yoke/core/equations/linear/index.hpp>
#include <yoke/core/error.hpp>

namespace yoke {

namespace {

bool has_derivatives(const ForceSlot& f) {
  const Dependence depends = f.element->dependence();
  return depends.position || depends.velocity || f.states > 0;
}

void clear(std::vector<double>& block, int size) { std::fill_n(block.begin(), size, 0.0); }

}  // namespace

ForceBlocks::ForceBlocks(const System& system) {
  std::size_t k = 0, nz = 0;
  for (const ForceSlot& f : system.forces()) {
    if (!has_derivatives(f)) continue;
    k = std::max(k, at(f.columns));
    nz = std::max(nz, at(f.states));
  }
  for (std::vector<double>* block : {&Q_q, &Q_v}) block->resize(k * k);
  for (std::vector<double>* block : {&Q_z, &z_q, &z_v}) block->resize(k * nz);
  z_z.resize(nz * nz);
  Q_.resize(k);
  rate_.resize(nz);
}

bool ForceBlocks::evaluate(const System& system, const ForceSlot& f) {
  if (!has_derivatives(f)) return false;
  const int k = f.columns, nz = f.states;
  for (std::vector<double>* block : {&Q_q, &Q_v}) clear(*block, k * k);
  for (std::vector<double>* block : {&Q_z, &z_q, &z_v}) clear(*block, k * nz);
  clear(z_z, nz * nz);
  clear(Q_, k);
  clear(rate_, nz);
  ForceRequest out{.Q = Q_.data(), .dQ_dq = Q_q.data(), .dQ_dv = Q_v.data()};
  if (nz > 0) {
    out.dQ_dz = Q_z.data();
    out.z_dot = rate_.data();
    out.dz_dq = z_q.data();
    out.dz_dv = z_v.data();
    out.dz_dz = z_z.data();
  }
  f.element->evaluate(system.force_input(f), out);
  return true;
}

ConstraintBlocks::ConstraintBlocks(const System& system) {
  std::size_t k = 0, entries = 0;
  for (const ConstraintSlot& c : system.constraints()) {
    k = std::max(k, at(c.columns));
    entries = std::max(entries, at(c.rows * c.columns));
  }
  G.resize(entries);
  H.resize(entries);
  K.resize(k * k);
}

void ConstraintBlocks::evaluate(const System& system, const ConstraintSlot& c,
                                const double* lambda) {
  clear(G, c.rows * c.columns);
  clear(H, c.rows * c.columns);
  clear(K, c.columns * c.columns);
  system.evaluate(c, {.G = G.data(), .H = H.data(), .K = K.data(), .lambda = lambda + c.row});
}

LoadCheck::LoadCheck(const System& system) {
  std::size_t k = 0, entries = 0;
  for (const std::size_t i : system.loaded()) {
    const ForceSlot& f = system.forces()[i];
    k = std::max(k, at(f.columns));
    entries = std::max(entries, at(f.columns * f.load_rows));
  }
  Q_.resize(k);
  slope_.resize(entries);
}

void LoadCheck::refuse(System& system, const double* lambda) {
  const ForceElement* found = nullptr;
  system.set_multipliers(lambda);
  for (const std::size_t i : system.loaded()) {
    const ForceSlot& f = system.forces()[i];
    const int entries = f.columns * f.load_rows;
    clear(Q_, f.columns);
    clear(slope_, entries);
    f.element->evaluate(system.force_input(f), {.Q = Q_.data(), .dQ_dlambda = slope_.data()});
    if (std::any_of(slope_.begin(), slope_.begin() + entries, [](double x) { return x != 0.0; }))
      found = f.element;
  }
  system.set_multipliers(nullptr);
  if (found != nullptr)
    throw ModelError(fmt::format(
        "linearisation: '{}' slides at this state, and its friction follows the reactions it makes; "
        "linearise about a state at rest",
        found->name()));
}

}  // namespace yoke
