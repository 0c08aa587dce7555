// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The documents `yoke validate` prints. Each measures; none holds a number of its own.
#pragma once

#include <string>

namespace yoke::cases {

/// The scotch-yoke (defaults, Johnson's column of Table 11) by both integrators as the tolerance is
/// tightened: distance to a reference run, amplification of a perturbation, energy ledger, drift.
std::string convergence_document();

}  // namespace yoke::cases
