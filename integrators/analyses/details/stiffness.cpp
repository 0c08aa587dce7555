// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <Eigen/LU>

#include <yoke/integrators/analyses/details/linearisation.hpp>
#include <yoke/integrators/analyses/details/spectrum.hpp>
#include <yoke/integrators/analyses/details/stiffness.hpp>

namespace yoke {

namespace {

constexpr double neutral_below = 1e-12;  // of the largest stiffness

}  // namespace

std::optional<Stiffness> stiffness_at(Statics& statics, const State& state) {
  const System& system = statics.dynamics().system();
  if (system.dofs() + system.states() > largest_linearisation) return std::nullopt;
  const Linearisation l = linearise_at(statics.dynamics(), state, statics.share());
  if (l.degrees_of_freedom() == 0) return std::nullopt;
  Eigen::MatrixXd K = l.K_reduced;
  if (l.z_z.rows() > 0) {
    const Eigen::FullPivLU<Eigen::MatrixXd> own(Eigen::MatrixXd(l.z_z));
    K += l.basis.transpose() * (l.Q_z * own.solve(Eigen::MatrixXd(l.z_q * l.basis)));
  }
  const auto [eigenvalues, vectors] = general_spectrum("equilibrium", K);
  const Eigen::VectorXd values = eigenvalues.real();
  Eigen::Index lowest = 0, softest = 0;
  Stiffness s;
  s.lowest = values.minCoeff(&lowest);
  const double least = values.cwiseAbs().minCoeff(&softest);
  // Stiffness that the forces at hand could not notice is none.
  const double rounding =
      neutral_below * std::max(eigenvalues.cwiseAbs().maxCoeff(), statics.noticeable_stiffness());
  s.negatives = static_cast<int>((values.array() < -rounding).count());
  s.neutral = least <= rounding;
  s.soft = l.basis * vectors.col(softest).real();
  s.way_down = l.basis * vectors.col(lowest).real();
  return s;
}

}  // namespace yoke
