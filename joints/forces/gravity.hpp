// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Weight of all bodies of the model, also of those added after it.
//
//   Q = (m g, 0) for each body;   V = -sum m g . r [J], zero at the global origin
#pragma once

#include <memory>
#include <string>

#include <yoke/core/model.hpp>

namespace yoke {

struct Gravity {
  std::string name = "gravity";
  Vec2 acceleration{0.0, -9.81};  // [m/s^2] g, global

  std::unique_ptr<ForceElement> build(const Model& model) const;
};

}  // namespace yoke
