// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The smallest mechanism found that still has a fault of a kind: bodies, joints, forces and slots
// are dropped while the fault remains, then numbers made plain.
#pragma once

#include <functional>
#include <string>

#include <yoke/tests/random/description.hpp>

namespace yoke::tests::random {

/// The smallest found for which `faulty` holds; `d` itself if it does not hold there.
Description shrink(Description d, const std::function<bool(const Description&)>& faulty);
/// The same for a fault of check().
Description shrink(Description d, const std::string& kind);

/// Without one body and all that is attached to it; `body` from 1.
Description without_body(Description d, int body);

}  // namespace yoke::tests::random
