// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/core/equations/consistency.hpp>

#include <algorithm>
#include <cmath>

#include <yoke/core/equations/linear/index.hpp>

namespace yoke {

namespace {

constexpr double agreement = 1e-8;  // of the terms
// What velocities violate of the joints is the least they err by: rounding itself, 1e-16, has no
// effect.
constexpr double noise_effect = 1e4;

/// sizes += |G| |x|
void add_products(const System& system, const Eigen::VectorXd& x, std::vector<double>& sizes) {
  for (const ConstraintSlot& c : system.constraints())
    for (int i = 0; i < c.rows; ++i)
      for (int j = 0; j < c.columns; ++j)
        if (const int dof = system.dof()[at(c.dofs + j)]; dof >= 0)
          sizes[at(c.row + i)] += std::abs(system.G()[c.block + i * c.columns + j] * x[dof]);
}

/// A motion whose velocities are set one by one.
class Probe {
 public:
  explicit Probe(const Motion& motion)
      : bodies_(motion.bodies.begin(), motion.bodies.end()), motion_(motion) {
    for (BodyMotion& b : bodies_) b.vx = b.vy = b.omega = 0.0;
    motion_.bodies = bodies_;
  }
  Probe(const Probe&) = delete;
  Probe& operator=(const Probe&) = delete;
  const Motion& motion() const { return motion_; }
  double& velocity(BodyId body, int component) {
    BodyMotion& b = bodies_[at(body.index)];
    return component == 0 ? b.vx : component == 1 ? b.vy : b.omega;
  }

 private:
  std::vector<BodyMotion> bodies_;
  Motion motion_;
};

/// gamma = -(H v + ...), and H is linear in v: its columns for one velocity at a time have no sums
/// in which large terms have cancelled already.
void add_velocity_products(const ConstraintSlot& c, const System& system, const Eigen::VectorXd& v,
                           Probe& probe, std::vector<double>& sizes) {
  const std::size_t block = at(c.rows * c.columns);
  std::vector<double> gamma(at(c.rows)), still(block), H(block);
  const auto speed = [&](int j) {
    const int dof = system.dof()[at(c.dofs + j)];
    return dof < 0 ? 0.0 : std::abs(v[dof]);
  };
  system.evaluate(c, probe.motion(), {.gamma = gamma.data(), .H = still.data()});
  for (int i = 0; i < c.rows; ++i) {
    sizes[at(c.row + i)] += std::abs(gamma[at(i)]);
    for (int k = 0; k < c.columns; ++k)
      sizes[at(c.row + i)] += std::abs(still[at(i * c.columns + k)]) * speed(k);
  }
  for (int j = 0; j < c.columns; ++j) {
    if (speed(j) == 0.0) continue;
    double& velocity = probe.velocity(c.element->bodies()[at(j / 3)], j % 3);
    velocity = 1.0;
    std::ranges::fill(H, 0.0);
    system.evaluate(c, probe.motion(), {.H = H.data()});
    velocity = 0.0;
    for (int i = 0; i < c.rows; ++i)
      for (int k = 0; k < c.columns; ++k) {
        const std::size_t entry = at(i * c.columns + k);
        sizes[at(c.row + i)] += speed(j) * std::abs(H[entry] - still[entry]) * speed(k);
      }
  }
}

}  // namespace

double largest_position_term(const System& system, const double* q) {
  const double length = system.scales().length;
  double largest = 0.0;
  for (int i = 0; i < system.dofs(); ++i)
    largest = std::max(largest, std::abs(q[i]) / (i % 3 == 2 ? 1.0 : length));
  for (const ConstraintSlot& c : system.constraints())
    for (int i = 0; i < c.rows; ++i) {
      const double size = system.measure(c.row + i) == Measure::length ? length : 1.0;
      for (int j = 0; j < c.columns; ++j) {
        const int dof = system.dof()[at(c.dofs + j)];
        if (dof < 0) continue;
        // The sine of an angle is of order one, however small the angle.
        const double x = j % 3 == 2 ? std::max(1.0, std::abs(q[dof])) : std::abs(q[dof]);
        largest = std::max(largest, std::abs(system.G()[c.block + i * c.columns + j]) * x / size);
      }
    }
  return largest;
}

EquationTerms rate_terms(System& system, const Eigen::VectorXd& v) {
  EquationTerms terms;
  terms.value.assign(at(system.rows()), 0.0);
  for (const ConstraintSlot& c : system.constraints())
    if (c.element->rheonomic()) system.evaluate(c, {.phi_t = terms.value.data() + c.row});
  for (const double value : terms.value) terms.size.push_back(std::abs(value));
  add_products(system, v, terms.size);
  return terms;
}

EquationTerms acceleration_terms(System& system, const State& state) {
  const std::size_t rows = at(system.rows());
  EquationTerms terms;
  terms.value.assign(rows, 0.0);
  terms.products = terms.noise = terms.value;
  Probe probe(system.motion());
  for (const ConstraintSlot& c : system.constraints()) {
    system.evaluate(c, {.gamma = terms.value.data() + c.row});
    add_velocity_products(c, system, state.v, probe, terms.products);
  }
  terms.size = terms.products;
  add_products(system, state.a, terms.size);
  const EquationTerms rates = rate_terms(system, state.v);
  system.calc_velocity_residual(terms.noise.data());
  for (std::size_t i = 0; i < rows; ++i)
    terms.noise[i] = rates.size[i] > 0.0 ? std::abs(terms.noise[i]) / rates.size[i] : 0.0;
  return terms;
}

std::optional<Disagreement> find_disagreement(const RankAnalysis& analysis,
                                              const EquationTerms& terms) {
  for (int k = 0; k < analysis.null_space.outerSize(); ++k) {
    double sum = 0.0, size = 0.0, products = 0.0, noise = 0.0, own = 0.0;
    int row = -1;
    for (Eigen::SparseMatrix<double>::InnerIterator it(analysis.null_space, k); it; ++it) {
      const int i = static_cast<int>(it.row());
      const double share = std::abs(it.value());
      sum += it.value() * terms.value[at(i)];
      size += share * terms.size[at(i)];
      if (!terms.noise.empty()) {
        products += share * terms.products[at(i)];
        noise = std::max(noise, terms.noise[at(i)]);
      }
      if (std::ranges::find(analysis.dependent, i) == analysis.dependent.end()) continue;
      row = i;
      own = it.value();
    }
    const double uncertainty = agreement * size + noise_effect * noise * products;
    if (row >= 0 && std::abs(sum) > uncertainty) return Disagreement{row, sum / own};
  }
  return std::nullopt;
}

}  // namespace yoke
