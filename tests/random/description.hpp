// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A mechanism as plain data: what the generator draws, transformations turn, the shrinker reduces
// and the printer writes as C++. Joints and forces are placed by global points of the start pose,
// where all are satisfied whatever the numbers are; so any number may be changed. SI units, before
// `units` are applied.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <yoke/contact/laws/catalog/dissipative_catalog.hpp>
#include <yoke/contact/laws/catalog/elastic_catalog.hpp>
#include <yoke/core/types.hpp>

namespace yoke::tests::random {

struct BodyData {
  std::string name;
  double mass = 1.0;     // [kg]
  double inertia = 0.1;  // [kg m^2]
  Vec2 at{0.0, 0.0};     // [m]
  double angle = 0.0;    // [rad]
  Vec2 velocity{0.0, 0.0};
  double omega = 0.0;
};

/// f(t) = rate t + amplitude (1 - cos(frequency t)), counted from the start pose.
struct Wave {
  double rate = 0.0;       // [m/s, rad/s]
  double amplitude = 0.0;  // [m, rad]
  double frequency = 0.0;  // [rad/s]
};

enum class JointKind {
  revolute,
  prismatic,
  weld,
  distance,
  point_on_line,
  gear,
  angle_driver,
  displacement_driver
};

/// Indices of bodies are 1, 2, ...; 0 is the ground.
struct JointData {
  JointKind kind = JointKind::revolute;
  std::string name;
  int a = 0, b = 0;        // drivers: b is driven relative to a
  int carrier = 0;         // gear
  Vec2 at{0.0, 0.0};       // the pin, the point on the line, the end on a, the driven point
  Vec2 other{0.0, 0.0};    // distance: the end on b; point on line: a point of the line
  Vec2 along{1.0, 0.0};    // prismatic, point on line, displacement driver
  double ratio = 1.0;      // gear
  Wave wave{};             // drivers
  double friction = 0.0;   // revolute: coefficient; 0: none
  double radius = 0.0;     // [m] of the pin
  double threshold = 0.0;  // [m/s] of regularised friction; 0: Coulomb's
};

enum class ForceKind { gravity, spring, torsion, load, torque, drag };

struct ForceData {
  ForceKind kind = ForceKind::gravity;
  std::string name;
  int a = 0, b = 0;         // loads act on b
  Vec2 at{0.0, 0.0};        // spring: the end on a; load, drag: the point
  Vec2 other{0.0, 0.0};     // spring: the end on b
  Vec2 vector{0.0, 0.0};    // [m/s^2] gravity; [N] load, times cos(frequency t + phase)
  double stiffness = 0.0;   // spring, torsion
  double damping = 0.0;     // spring, torsion, drag
  double stretch = 0.0;     // [m, rad] of the spring at the start
  double magnitude = 0.0;   // [N m] torque, times cos(frequency t + phase)
  double frequency = 0.0;   // [rad/s]
  double phase = 0.0;       // [rad]
  bool body_frame = false;  // load
};

/// A law of the catalogue, by name.
struct LawData {
  std::string elastic = "power";
  double K = 1e6, n = 1.0;  // of "power" [N/m^n]
  ElasticArguments arguments{};
  std::string dissipative = "none";
  DissipativeArguments damping{};
};

struct SlotData {
  std::string name;
  int pin_body = 0;
  Vec2 pin{0.0, 0.0};
  double radius = 0.0;  // [m] of the pin
  int slot_body = 0;
  Vec2 center{0.0, 0.0};  // of the arc
  double arc_radius = 0.0, direction = 0.0, angle = 0.0, half_width = 0.0;
  std::vector<LawData> laws;  // one for all regions, or inner, outer, cap
  double reference_force = 100.0;
};

/// The size of the units the model is written in: a length of x m is x * length, and so on.
struct Units {
  double length = 1.0, mass = 1.0, time = 1.0;
  double speed() const { return length / time; }
  double force() const { return mass * length / (time * time); }
  double energy() const { return force() * length; }
  bool si() const { return length == 1.0 && mass == 1.0 && time == 1.0; }
};

struct Description {
  std::uint64_t seed = 0;
  std::string family;
  std::vector<BodyData> bodies;
  std::vector<JointData> joints;
  std::vector<ForceData> forces;
  std::vector<SlotData> slots;
  double size = 1.0;      // [m] about the distance of neighbours
  double duration = 1.0;  // [s] of a run
  Units units{};

  /// Bodies, joints, forces and slots: what a shrinker makes small.
  std::size_t parts() const { return bodies.size() + joints.size() + forces.size() + slots.size(); }
};

inline bool is_driver(const JointData& joint) {
  return joint.kind == JointKind::angle_driver || joint.kind == JointKind::displacement_driver;
}

}  // namespace yoke::tests::random
