// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The stabilised index-2 equations of Gear, Gupta and Leimkuhler and their exact iteration matrix.
//
//   R_q = M (q' - v) + G^T mu          unknowns y = (q, v, z, lambda, mu)
//   R_v = M v' + G^T lambda - Q
//   R_z = z' - f
//   R_p = Phi
//   R_w = G v + Phi_t
//
// Iteration matrix dR/dy + c dR/dy', with K(.) = d(G^T .)/dq and H = d(G v + Phi_t)/dq:
//
//        q                   v              z           lambda  mu
//   R_q  c M + K(mu)         -M             .           .       G^T
//   R_v  K(lambda) - Q_q     c M - Q_v      -Q_z        G^T     .
//   R_z  -f_q                -f_v           c I - f_z   .       .
//   R_p  G                   .              .           .       .
//   R_w  H                   G              .           .       .
//
// It is scaled before KLU sees it: with time measured in 1/c, lengths in the length scale and
// masses in the mean mass all entries are of order one; unscaled, the reciprocal condition falls to
// 1e-12 at steps of a microsecond and the pivots of the last factor are never good enough.
#pragma once

#include <optional>
#include <vector>

#include <yoke/core/dynamics.hpp>

namespace yoke {

class GglMatrix {
 public:
  explicit GglMatrix(System& system);

  int size() const { return size_; }
  int v() const { return n_; }  // offsets of the parts of y
  int z() const { return 2 * n_; }
  int lambda() const { return 2 * n_ + nz_; }
  int mu() const { return 2 * n_ + nz_ + rows_; }

  /// R(t, y, y') [size]. False if it is not finite.
  bool calc_residual(double t, const double* y, const double* y_dot, double* residual);
  /// Fills the matrix for the shift c [1/s].
  void calc_jacobian(double t, double c, const double* y);
  /// Scales and factorises what calc_jacobian filled.
  bool factorise();
  /// b := (matrix)^-1 b.
  void solve(double* b);
  void reset() { lu_->reset(); }
  const FactorCounters& counters() const { return lu_->counters(); }
  /// The unscaled matrix, for checks.
  const SparseMatrix& matrix() const { return matrix_; }

 private:
  struct GStamp {
    int entry;                          // in the blocks of G (and H)
    int p_q, w_v, v_lambda, q_mu, w_q;  // slots; w_q takes H
  };
  struct KStamp {
    int entry;     // in the 3k x 3k block of its constraint
    int v_q, q_q;  // slots for K(lambda), K(mu)
  };
  struct BlockStamp {
    int entry;  // in the scratch of its force element
    int slot;
  };
  struct Slots {  // stamps of one element: [first, last)
    std::size_t first = 0, last = 0;
  };
  struct ForceStamps {
    std::vector<BlockStamp> Q_q, Q_v, Q_z, z_q, z_v, z_z;
  };

  void build_pattern();
  void add_constraint(PatternBuilder& pattern, const ConstraintSlot& c);
  void add_force(PatternBuilder& pattern, const ForceSlot& f);
  void resolve(const std::vector<int>& slot);
  void stamp_constraint(std::size_t i, const double* y);
  void stamp_force(std::size_t i);
  void calc_scaling();

  System& system_;
  int n_, nz_, rows_, size_;
  double c_ = 1.0;
  SparseMatrix matrix_, scaled_;
  std::optional<SparseLU> lu_;
  std::vector<int> diagonal_qq_, diagonal_qv_, diagonal_vv_, diagonal_zz_;
  std::vector<GStamp> g_stamps_;
  std::vector<KStamp> k_stamps_;
  std::vector<Slots> g_of_, k_of_;
  std::vector<ForceStamps> f_of_;
  std::vector<double> H_, K_lambda_, K_mu_, scratch_;
  std::vector<double> force_, stabilisation_;  // [n + 1], the last for the ground
  std::vector<double> row_scale_, column_scale_;
  double mean_mass_ = 1.0;
};

}  // namespace yoke
