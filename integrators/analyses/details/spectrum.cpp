// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/analyses/details/spectrum.hpp>

#include <Eigen/Eigenvalues>

#include <yoke/core/error.hpp>

namespace yoke {

RealSpectrum symmetric_spectrum(const Eigen::MatrixXd& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Spectrum general_spectrum(std::string_view owner, const Eigen::MatrixXd& matrix) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(matrix);
  if (solver.info() != Eigen::Success)
    throw ModelError(
        fmt::format("{}: the eigenvalues of the linearised equations were not found", owner));
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace yoke
