// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The code printed in docs/start_and_redundancy.md.
#pragma once

#include <yoke/core/assembly.hpp>

namespace start_example {

using namespace yoke;

State elbow_down(const Model& arm) {
  return assemble(arm, {.near = {{"upper", Coordinate::angle, -0.6}},
                        .rates = {{"upper", Coordinate::angle, 2.0}}});
}

}  // namespace start_example
