// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// SUNDIALS' serial vector with our own loops for what its integrators do with vectors in a step.
// Debian builds SUNDIALS without optimisation: on a chain of 10 links its loops took more than half
// of the time of a step of IDA. Results agree with its own to rounding, but for the norm of errors if
// the vector has groups.
#pragma once

#include <nvector/nvector_serial.h>

#include <vector>

namespace yoke {

/// What an error norm looks at: y = (q, v, z, ..., energies). The norm is the largest of the root
/// mean squares of the bodies (three positions and three velocities each), the element states and
/// the energies, so that the accuracy of one body does not depend on how many others there are.
/// What lies between z and the energies has no part in it.
struct ErrorGroups {
  int dofs = 0;      // 3 per body; q at 0, v behind it
  int states = 0;    // at 2 dofs
  int energies = 0;  // the last ones of the vector
  /// [bodies] numbers below the number of bodies: those with the same one count together, by their
  /// root mean square. Empty: each for itself.
  std::vector<int> together{};
  std::vector<double> sum{}, count{};  // scratch and sizes [bodies]; empty if `together` is

  void tie(std::vector<int> bodies);  ///< sets `together` and what goes with it
};

/// A vector of `size` zeros; free it with N_VDestroy. Its clones are of the same kind. With
/// `groups`, which must outlive it, its N_VWrmsNorm is the norm described there.
N_Vector new_vector(int size, SUNContext context, ErrorGroups* groups = nullptr);

/// Owns such a vector.
class SundialsVector {
 public:
  SundialsVector(int size, SUNContext context, ErrorGroups* groups = nullptr)
      : vector_(new_vector(size, context, groups)) {}
  ~SundialsVector() { N_VDestroy(vector_); }
  SundialsVector(const SundialsVector&) = delete;
  SundialsVector& operator=(const SundialsVector&) = delete;

  operator N_Vector() const { return vector_; }
  double* data() const { return NV_DATA_S(vector_); }

 private:
  N_Vector vector_;
};

}  // namespace yoke
