// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Changeable parameters: numbers of elements that live in the State.
#pragma once

#include <limits>
#include <string>

namespace yoke {

/// A number that may be changed from run to run without building the model again. It lives in the
/// State under "element.name".
struct Parameter {
  std::string name;                                       // as "stiffness"
  std::string unit;                                       // as "N/m"
  double value = 0.0;                                     // default, in the unit
  double low = -std::numeric_limits<double>::infinity();  // least and greatest value accepted
  double high = std::numeric_limits<double>::infinity();  // greatest value accepted
  bool own = false;   // kept by the element; read, but not set by others
  bool load = false;  // changes neither stiffness, damping nor stored energy
};

}  // namespace yoke
