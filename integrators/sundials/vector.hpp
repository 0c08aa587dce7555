// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// SUNDIALS' serial vector with our own loops for what its integrators do with vectors in a step.
// Debian builds SUNDIALS without optimisation: on a chain of 10 links its loops took more than half
// of the time of a step of IDA. Results agree with its own to rounding.
#pragma once

#include <nvector/nvector_serial.h>

namespace yoke {

/// A vector of `size` zeros; free it with N_VDestroy. Its clones are of the same kind.
N_Vector new_vector(int size, SUNContext context);

/// Owns such a vector.
class SundialsVector {
 public:
  SundialsVector(int size, SUNContext context) : vector_(new_vector(size, context)) {}
  ~SundialsVector() { N_VDestroy(vector_); }
  SundialsVector(const SundialsVector&) = delete;
  SundialsVector& operator=(const SundialsVector&) = delete;

  operator N_Vector() const { return vector_; }
  double* data() const { return NV_DATA_S(vector_); }

 private:
  N_Vector vector_;
};

}  // namespace yoke
