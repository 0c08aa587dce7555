// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Eigenvalues and eigenvectors of dense matrices. The library's templates are compiled here alone.
#pragma once

#include <Eigen/Core>
#include <string_view>

namespace yoke {

/// Columns of `vectors` belong to the values.
struct RealSpectrum {
  Eigen::VectorXd values;  // in ascending order
  Eigen::MatrixXd vectors;
};
/// Of a symmetric matrix.
RealSpectrum symmetric_spectrum(const Eigen::MatrixXd& matrix);

struct Spectrum {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;
};
/// Of any square matrix. Throws ModelError in the name of `owner` if the iteration does not
/// converge.
Spectrum general_spectrum(std::string_view owner, const Eigen::MatrixXd& matrix);

}  // namespace yoke
