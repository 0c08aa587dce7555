// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// SUNDIALS' serial vector with our own loops for what its integrators do with vectors in a step.
// Debian builds SUNDIALS without optimisation: on a chain of 10 links its loops took more than half
// of the time of a step of IDA. Results agree with its own to rounding.
#pragma once

struct _generic_N_Vector;  // N_Vector and SUNContext point to these
struct _SUNContext;

namespace yoke {

/// A vector of `size` zeros; free it with N_VDestroy. Its clones are of the same kind.
_generic_N_Vector* new_vector(int size, _SUNContext* context);

}  // namespace yoke
