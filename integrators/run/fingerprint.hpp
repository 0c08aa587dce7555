// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A number that tells one model from another: what a checkpoint is checked against.
#pragma once

#include <cstdint>

#include <yoke/core/model.hpp>

namespace yoke {

/// Names, masses and the start pose of the bodies, names and layout of all elements, and what the
/// elements answer at a few ugly states (equations, forces in and out of contact, parameters): two
/// models that differ in any of these have different fingerprints. What only a state elsewhere
/// would show is not seen. The same program gives the same number on every run.
std::uint64_t fingerprint(const Model& model);

}  // namespace yoke
