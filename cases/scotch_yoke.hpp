// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The scotch-yoke with a circular slot of Autiero et al., Machines 2022, 10, 966, section 4: the
// mechanism, the choices the paper leaves open, and the closed form of its motion without
// clearance.
#pragma once

#include <optional>
#include <string_view>

#include <yoke/cases/case.hpp>
#include <yoke/contact/pin_in_slot.hpp>
#include <yoke/core/model.hpp>
#include <yoke/core/units.hpp>

namespace yoke::cases {

/// Table 10 and the text of section 4.
namespace scotch_yoke_data {
using namespace yoke::literals;
inline constexpr double arc_radius = 60.0_mm;  // R_m, centreline of the slot
inline constexpr double arc_angle = 120.0_deg;
inline constexpr double half_width = 8.0_mm;  // walls 52 and 68 mm, caps 8 mm
inline constexpr double pin_radius = 7.9_mm;
inline constexpr double gap = half_width - pin_radius;
inline constexpr double pin_length = 10.0_mm;  // from the pin's mass
inline constexpr double crank_mass = 0.090_kg;
inline constexpr double crank_inertia = 30.40_kg_mm2;
inline constexpr double pin_mass = 0.015_kg;
inline constexpr double pin_inertia = 0.48_kg_mm2;
inline constexpr double slider_mass = 0.353_kg;
inline constexpr double slider_inertia = 3495.6_kg_mm2;
inline constexpr double end_mass = 1.0_kg;  // at each end of the slot
inline constexpr double moving_mass = slider_mass + 2.0 * end_mass;
inline constexpr double speed = 24.0 * pi;  // [rad/s] of the crank
}  // namespace scotch_yoke_data

/// What the paper leaves open, SI. The defaults are in the parameters of the case.
struct ScotchYoke {
  double crank_length = 0.0;
  double start_angle = 0.0;
  double spin_up = 0.0;     // [s] duration of the ramp of the crank's speed
  bool consistent = true;   // slider starts with the velocity of the ideal mechanism, or at rest
  double pin_offset = 0.0;  // of the pin at the start, away from the arc's centre
  bool rolling = false;     // the pin is a body that turns on the crank
  enum class Slot { arc, spline, ideal } slot = Slot::arc;  // how the slot is described
  double alpha = 0.0;                                       // [s/m] Hunt and Crossley
  double contact_length = 0.0;  // multiplies the K of Table 11 per mm; 0: as printed
  double revolutions = 0.0;
  bool one_wall_law = false;  // both walls with the law of the outer one

  explicit ScotchYoke(const Parameters& parameters);

  double end_time() const;               ///< [s] when the crank has made its revolutions
  double last_revolution_start() const;  ///< [s]
};

/// The laws of the case by name, for the walls of the slot. Throws ModelError.
SlotLaws scotch_yoke_laws(const ScotchYoke& choices, std::string_view name);

/// The mechanism: bodies crank, slider (and pin if rolling); elements pivot, motor, guide, slot. An
/// ideal slot needs no laws.
Model scotch_yoke(const ScotchYoke& choices, const std::optional<SlotLaws>& laws);

/// Motion of the slider without clearance, for a crank at `angle` with speed omega (constant). x is
/// the position of the arc's centre, which is what slider_x_m means in the results.
struct IdealMotion {
  double x = 0.0;      // [m] r cos(phi) + sqrt(R^2 - r^2 sin^2 phi)
  double v = 0.0;      // [m/s]
  double a = 0.0;      // [m/s^2]
  double force = 0.0;  // [N] between pin and slot; > 0 on the outer wall, < 0 on the inner one
};
IdealMotion ideal_scotch_yoke(double crank_length, double angle, double omega,
                              double arc_radius = scotch_yoke_data::arc_radius);

/// x of the arc's centre minus x of the slider's centre of mass [m]; constant, as the slider does
/// not turn.
double arc_centre_offset(const Model& model, const ScotchYoke& choices);

}  // namespace yoke::cases
