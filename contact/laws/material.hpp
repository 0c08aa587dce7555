// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Materials and geometry of two cylinders in contact: the inputs of laws derived from elasticity.
#pragma once

#include <string>
#include <string_view>

namespace yoke {

struct Material {
  double E = 0.0;                 // [Pa] Young's modulus, > 0
  double nu = 0.0;                // Poisson's ratio, -1 < nu <= 0.5
  std::string name = "material";  // for messages
};

// The values the paper's tables were made with.
inline const Material steel{207e9, 0.3, "steel"};          // 207 GPa, 0.3
inline const Material aluminium{70e9, 0.33, "aluminium"};  // 70 GPa, 0.33

/// Composite modulus E* [Pa]: 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2. No pi in it. Throws
/// ModelError.
double composite_modulus(const Material& first, const Material& second);

/// The pin touches a convex wall from outside, or a concave wall (a bore) from inside.
enum class Conformity { external, internal };

/// A round pin on a round wall.
struct RoundPair {
  double pin_radius = 0.0;   // [m], > 0
  double wall_radius = 0.0;  // [m], > 0; internal: greater than pin_radius; infinite: a plane
  Conformity conformity = Conformity::external;  ///< whether the wall is a bore
  Material pin = steel;                          // its material
  Material wall = steel;                         // its material

  /// Throws ModelError that names the law and the parameter. Laws that depend on the sum of the radii
  /// do not take a plane.
  void check(std::string_view law, bool takes_plane = false) const;
  double modulus() const { return composite_modulus(pin, wall); }  ///< [Pa] E*
  /// [m] Delta R: sum of the radii (external) or wall minus pin (internal).
  double radius_difference() const;
  /// [m] |R_wall - R_pin| whichever way they lie, as some formulas are printed. Throws ModelError
  /// that names the law if it is zero.
  double printed_radius_difference(std::string_view law) const;
  /// [m] R = R_pin R_wall / Delta R.
  double relative_radius() const;
};

/// A pin on a wall of curvature [1/m] > 0 convex, < 0 concave, 0 plane, as slots and walls report it.
RoundPair pair_of(double pin_radius, double wall_curvature, const Material& pin = steel,
                  const Material& wall = steel);

}  // namespace yoke
