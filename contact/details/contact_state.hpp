// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What the files of the contact element share: vectors over the coordinates of its two bodies.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include <yoke/contact/contact_element.hpp>
#include <yoke/core/equations/grips/grip_rules.hpp>

namespace yoke {

inline constexpr std::size_t columns = ContactKinematics::columns;
using ContactRow = std::array<double, columns>;

/// Share of a law's limit at which a run stops. The event must be found by steps that still
/// evaluate the law, and at the limit itself a law may have an infinite stiffness.
inline constexpr double usable_share_of_limit = 0.99;

/// ContactMemory::release_penetration [m] of what is apart behind the wall.
inline constexpr double behind_the_wall = std::numeric_limits<double>::max();

inline bool wants_jacobian(const ForceRequest& out) {
  return out.dQ_dq != nullptr || out.dQ_dv != nullptr || out.dQ_dz != nullptr ||
         out.dz_dq != nullptr || out.dz_dv != nullptr || out.dz_dz != nullptr;
}

inline double dot(const ContactRow& a, const ContactRow& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < columns; ++i) sum += a[i] * b[i];
  return sum;
}

inline ContactRow times(const std::array<double, columns * columns>& matrix, const ContactRow& v) {
  ContactRow product{};
  for (std::size_t i = 0; i < columns; ++i)
    for (std::size_t j = 0; j < columns; ++j) product[i] += matrix[i * columns + j] * v[j];
  return product;
}

}  // namespace yoke
