// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A description as C++ that builds the same model, for a test or a report.
#pragma once

#include <string>

#include <yoke/tests/random/description.hpp>

namespace yoke::tests::random {

/// `Model m; ... m.add(...)`, and as a comment how it was run for a fault of that kind. Numbers
/// have 17 significant digits. If the kind names a change, the changed model follows.
std::string as_code(const Description& d, const std::string& kind);

}  // namespace yoke::tests::random
