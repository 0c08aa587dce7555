// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The code printed in docs/authoring.md, block by block. documentation_test.cpp compares, checks
// and runs it.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <yoke/cases/case.hpp>

#include <yoke/contact/geometry/arc_slot.hpp>
#include <yoke/contact/laws/dissipative/hunt_crossley.hpp>
#include <yoke/contact/laws/elastic/johnson.hpp>
#include <yoke/contact/pin_in_slot.hpp>
#include <yoke/core/units.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/forces/translational_spring.hpp>
#include <yoke/joints/prismatic.hpp>
#include <yoke/joints/revolute.hpp>

#include <yoke/core/authoring/auto_constraint.hpp>
#include <yoke/core/authoring/auto_force.hpp>
#include <yoke/core/authoring/check.hpp>

// A pendulum whose bob pin runs in an upright arc slot of a block on a spring.
//
//             O pivot              x right, y up, gravity down
//              \                   rod 200 mm, 20 deg to the right at the start
//               \ rod              block slides along x on the ground, spring to the wall
//           ____ \_                slot in the block: arc of radius 80 mm, centre to the right,
//   |/\/\/\|    (o |  block        half-width 6.1 mm; pin radius 6 mm, so 0.1 mm of clearance
//
// To be expected: pendulum and block swing together; the pin changes walls now and then and bounces
// there. What is missing in the energy of both is what the walls have dissipated.
namespace pendulum_follower {

using namespace yoke;
using namespace yoke::literals;

struct Choices {
  double start_angle = 20.0_deg;  // of the rod, from hanging down, > 0 to the right
  double stiffness = 60.0_N_per_m;
};

Model mechanism(const Choices& choices, const SlotLaws& laws) {
  const Vec2 pivot{0.0, 0.0}, bob = rotate(choices.start_angle, {0.0, -200.0_mm});
  const Vec2 wall{-300.0_mm, bob.y()};

  Model m;
  Body bar{.name = "rod",
           .mass = 0.150_kg,
           .inertia = 520.0_kg_mm2,
           .pose = {0.5 * (pivot + bob), choices.start_angle}};
  const BodyId rod = m.add(with_point_mass(bar, 0.300_kg, bob));
  const BodyId block =
      m.add({.name = "block", .mass = 0.400_kg, .inertia = 310.0_kg_mm2, .pose = {bob, 0.0}});

  m.add(Gravity{});
  m.add(Revolute{.name = "pivot", .a = ground, .b = rod, .at = pivot});
  m.add(Prismatic{.name = "guide", .a = ground, .b = block, .along = {1.0, 0.0}});
  m.add(TranslationalSpring{.name = "spring",
                            .a = ground,
                            .b = block,
                            .at_a = wall,
                            .at_b = bob,
                            .stiffness = choices.stiffness,
                            .free_length = 300.0_mm});
  const Slot slot = arc_slot({.center = bob + Vec2{80.0_mm, 0.0},
                              .radius = 80.0_mm,
                              .direction = 180.0_deg,
                              .angle = 60.0_deg,
                              .half_width = 6.1_mm});
  m.add(PinInSlot{.name = "slot", .pin = {rod, bob, 6.0_mm}, .slot = {block, slot}, .law = laws});
  return m;
}

// Steel on steel over 10 mm of pin, one law for each region: the walls differ in curvature.
SlotLaws steel_walls() {
  const auto law = [](double wall_radius, Conformity conformity) {
    const RoundPair pair{
        .pin_radius = 6.0_mm, .wall_radius = wall_radius, .conformity = conformity};
    return ContactLaw{johnson(pair, 10.0_mm), HuntCrossley{.alpha = 0.32_s_per_m}};
  };
  return {law(73.9_mm, Conformity::external), law(86.1_mm, Conformity::internal),
          law(6.1_mm, Conformity::internal)};
}

Result run(const Model& m) {
  const Result result = simulate(m, {.until = 2.0_s, .relative_tolerance = 1e-8});
  if (!result.summary.ok()) fmt::print("{}\n", result.summary.reason);
  fmt::print("peak contact force {:.1f} N, dissipated {:.4f} J, energy balance {:.1e} J\n",
             result["slot.normal_force_N"].maxCoeff(), result["dissipated_J"].tail(1)[0],
             result.summary.energy_balance);
  return result;
}

// ---- as a case of the program

// Where the pin touches, as an elastic law needs to know it.
std::vector<cases::Wall> walls(const cases::Parameters&) {
  const auto wall = [](const char* name, double radius, Conformity conformity) {
    const RoundPair pair{.pin_radius = 6.0_mm, .wall_radius = radius, .conformity = conformity};
    return cases::Wall{.name = name, .pair = pair, .length = 10.0_mm};
  };
  return {wall("inner", 73.9_mm, Conformity::external),
          wall("outer", 86.1_mm, Conformity::internal), wall("cap", 6.1_mm, Conformity::internal)};
}

ContactLaw johnson_on_steel(const cases::Parameters&, const cases::Wall& wall) {
  return {johnson(wall.pair, wall.length), HuntCrossley{.alpha = 0.32_s_per_m}};
}

cases::Case pendulum_follower_case() {
  return {.name = "pendulum_follower",
          .group = "joints with clearance",
          .description = "pendulum whose pin drives a sprung block through an arc slot",
          .parameters = {{.name = "start_angle",
                          .quantity = cases::Quantity::angle,
                          .default_text = "20deg",
                          .low = 1.0_deg,
                          .high = 40.0_deg,
                          .description = "of the rod, from hanging down"},
                         {.name = "duration",
                          .quantity = cases::Quantity::time,
                          .default_text = "2s",
                          .low = 0.01,
                          .high = 100.0,
                          .description = "how long to run"}},
          .contact = {.walls = walls,
                      .laws = {{"johnson", "Johnson, damping of Hunt-Crossley", johnson_on_steel}}},
          .default_output = "results/pendulum_follower",
          .model =
              [](const cases::Parameters& p, const cases::WallLaws& laws) {
                return mechanism({.start_angle = p.number("start_angle")},
                                 {laws["inner"], laws["outer"], laws["cap"]});
              },
          .duration = [](const cases::Parameters& p) { return p.number("duration"); },
          .checks = [](const cases::Parameters&, const Model&,
                       const Result& run) { return std::vector{cases::energy_check(run)}; },
          .paths = {"rod", "block"}};
}

}  // namespace pendulum_follower

namespace own {

using namespace yoke;
using namespace yoke::literals;

// A pin of body a stays on the curve y = bend x^2 / 2 drawn in the axes of body b:
//   Phi = y - bend x^2 / 2 = 0 [m],   (x, y) the pin as b sees it
class PinOnParabola : public AutoConstraint<PinOnParabola, 1, 2> {
 public:
  PinOnParabola(const std::string& name, BodyId a, BodyId b, const Vec2& pin, double bend)
      : AutoConstraint(name, {a, b}, {{"curve", Measure::length}}), pin_(pin), bend_(bend) {}

  template <class T>
  T phi(const AutoPose<T>& a, const AutoPose<T>& b, const T& /*t*/) const {
    const Eigen::Vector2<T> p = b.to_local(Eigen::Vector2<T>(a.point(pin_) - b.position()));
    return p.y() - 0.5 * bend_ * p.x() * p.x();
  }

 private:
  Vec2 pin_;     // [m] in the axes of a, from its centre of mass
  double bend_;  // [1/m]
};

// Drag of the air, F = -c |v| v [N] at the centre of mass; c [kg/m] is a changeable parameter.
class AirDrag : public AutoForce<AirDrag, 1> {
 public:
  AirDrag(const std::string& name, BodyId body, double c) : AutoForce(name, {body}), c_(c) {}

  template <class T>
  void apply(AutoBody<T>& body, AutoElement<T>& e) const {
    const double c = e.parameters[0];
    const Eigen::Vector2<T> v = body.velocity();
    const T speed = sqrt(v.squaredNorm() + 1e-12);  // 1 um/s: |v| has no derivative at rest
    body.add_force(v * (-c * speed), body.position());
    e.dissipated_power += c * speed * v.squaredNorm();
  }
  bool dissipates() const override { return true; }
  std::vector<Parameter> parameters() const override { return {{"c", "kg/m", c_}}; }

 private:
  double c_;
};

// A wall with a coating: F = k d + k3 d^3, U = k d^2/2 + k3 d^4/4, as thick as `thickness`.
struct CoatedWall {
  double k = 0.0;          // [N/m], > 0
  double k3 = 0.0;         // [N/m^3], >= 0
  double thickness = 0.0;  // [m], > 0: the law ends there

  ElasticResponse operator()(double d) const {
    const double d2 = d * d;
    return {.force = k * d + k3 * d * d2,
            .stiffness = k + 3.0 * k3 * d2,
            .energy = d2 * (k / 2.0 + k3 / 4.0 * d2)};
  }
  double limit() const { return thickness; }
  std::string name() const { return "coated-wall"; }
  void check() const {
    require_positive("law 'coated-wall'", "k", k, "N/m");
    require_not_negative("law 'coated-wall'", "k3", k3, "N/m^3");
    require_positive("law 'coated-wall'", "thickness", thickness, "m");
  }
};

// Flores et al. 2011: F = F_e (1 + chi d'), chi = 8 (1 - e)/(5 e v_i), v_i the approach velocity.
struct Flores {
  double e = 1.0;                  // 0 < e <= 1
  double slowest_approach = 1e-3;  // [m/s] > 0, floor of v_i: a contact may begin at rest

  ContactOutput operator()(const ContactInput& in, const ElasticLaw& elastic) const {
    const ElasticResponse r = elastic.response(in.penetration);
    const double v_i = std::max(in.memory.approach_velocity, slowest_approach);
    const double chi = 8.0 * (1.0 - e) / (5.0 * e * v_i);
    return {.force = r.force * (1.0 + chi * in.rate),
            .dforce_dpenetration = r.stiffness * (1.0 + chi * in.rate),
            .dforce_drate = chi * r.force,
            .stored_energy = r.energy,
            .dissipated_power = chi * r.force * in.rate * in.rate};
  }
  std::string name() const { return "flores"; }
  void check() const {
    require_range("law 'flores'", "e", e, 0.01, 1.0);
    require_positive("law 'flores'", "slowest_approach", slowest_approach, "m/s");
  }
};

// A straight slot with round ends. Profile frame: origin in the middle, x along the slot.
//   upper  D = y     lower  D = -y     cap  D = |p - e|, e the end of the centreline
class StraightProfile {
 public:
  StraightProfile(double length, double half_width) : half_(0.5 * length), width_(half_width) {}

  double half_width() const { return width_; }
  std::vector<SlotRegion> regions() const {  // a straight slot has no inner side: below is "inner"
    return {SlotRegion::inner, SlotRegion::outer, SlotRegion::cap_start, SlotRegion::cap_end};
  }
  Touch touch(int region, const Vec2& p) const {
    if (region == lower) return {.region = region, .distance = -p.y(), .normal = {0.0, -1.0}};
    if (region == upper) return {.region = region, .distance = p.y(), .normal = {0.0, 1.0}};
    const double side = region == left ? -1.0 : 1.0;
    const Vec2 arm = p - Vec2{side * half_, 0.0};
    const double D = arm.norm();
    if (D == 0.0) return {.region = region, .normal = {side, 0.0}, .wall_curvature = -1.0 / width_};
    return {.region = region,
            .distance = D,
            .normal = arm / D,
            .bend = 1.0 / D,
            .wall_curvature = -1.0 / width_};
  }
  int nearest(const Vec2& p) const {
    if (std::abs(p.x()) > half_) return p.x() < 0.0 ? left : right;
    return p.y() < 0.0 ? lower : upper;
  }
  double boundary(int region, const Vec2& p) const {
    if (region == left) return p.x() + half_;
    if (region == right) return half_ - p.x();
    return std::abs(p.x()) - half_;
  }
  int successor(int region, const Vec2& p) const {
    if (region == left || region == right) return p.y() < 0.0 ? lower : upper;
    return p.x() < 0.0 ? left : right;
  }
  void check(std::string_view owner) const {
    require_positive(owner, "length", 2.0 * half_, "m");
    require_positive(owner, "half_width", width_, "m");
  }

 private:
  enum Region { lower, upper, left, right };  // the places in regions()
  double half_, width_;
};

Slot straight_slot(const Vec2& middle, double direction, double length, double half_width) {
  return Slot(StraightProfile(length, half_width), middle, direction);
}

// Three moving parts of the size of a hand, placed without zeros or ones.
struct Bench {
  Model model;
  BodyId a = model.add({.name = "a", .mass = 0.31, .inertia = 2e-3, .pose = {{0.13, 0.21}, 0.4}});
  BodyId b = model.add({.name = "b", .mass = 0.57, .inertia = 5e-3, .pose = {{0.42, -0.1}, -0.7}});
};

// True if all derivatives and energies of the own elements agree with differences.
bool own_elements_are_right() {
  Bench bench;
  bench.model.add(PinOnParabola("track", bench.a, bench.b, {0.04, -0.07}, 2.3));
  bench.model.add(AirDrag("drag", bench.b, 0.8));
  bool right = true;
  for (const ElementCheck& check : check_elements(bench.model)) {
    fmt::print("{}\n", check.message());
    right = right && check.ok();
  }
  return right;
}

// The same for a contact, which must be looked at in contact: in every region and every phase.
bool own_contact_is_right() {
  Bench bench;
  const Vec2 pin{0.30, 0.05};
  const ContactLaw law{CoatedWall{.k = 2e6, .k3 = 5e14, .thickness = 0.5_mm}, Flores{.e = 0.8}};
  bench.model.add(PinInSlot{.name = "slot",
                            .pin = {bench.a, pin, 5.9_mm},
                            .slot = {bench.b, straight_slot(pin, 35.0_deg, 60.0_mm, 6.0_mm)},
                            .law = law});
  const ForceElement& slot = *bench.model.forces().back();
  const CheckOptions penetration{.length = 0.05_mm, .angle = 1e-3, .rate = 0.1};
  bool right = true;
  for (int region = 0; region < 4; ++region) {
    State state = bench.model.start_state();
    state.v << 0.11, -0.17, 0.23, -0.31, 0.19, 0.41;
    const Vec2 push[] = {{0.0, -0.15_mm}, {0.0, 0.15_mm}, {-30.12_mm, 0.06_mm}, {30.1_mm, 0.11_mm}};
    state.q.head<2>() += rotate(35.0_deg, push[region]);
    state.contacts[0] = {.phase = ContactPhase::compressing,
                         .region = region,
                         .approach_velocity = 0.2,
                         .effective_mass = 0.4};
    const ElementCheck check = check_element(slot, bench.model, state, penetration);
    fmt::print("region {}: {}\n", region, check.message());
    right = right && check.ok(1e-6);
  }
  return right;
}

// A point of one body stays at the height at which it starts.
//
//   Phi = y + d_y - h = 0 [m], row height;   d = A(theta) s, the arm of the point
//   G = [0 1 d_x];   gamma = w^2 d_y;   H = [0 0 -w d_y];   K(theta, theta) = -lambda d_y
//   force on the body = -lambda [N] along y, at the point
class LevelConstraint : public Constraint {
 public:
  LevelConstraint(const std::string& name, BodyId body, const Vec2& s, double height)
      : Constraint(name, {body}, {{"height", Measure::length}}, {false, true, true}),
        s_(s),
        height_(height) {}

  void evaluate(const Motion& motion, const ConstraintRequest& out) const override {
    const BodyMotion& b = motion[bodies()[0]];
    const Vec2 d = b.to_global(s_);
    if (out.phi != nullptr) out.phi[0] = b.y + d.y() - height_;
    if (out.G != nullptr) out.G[1] = 1.0, out.G[2] = d.x();
    if (out.phi_t != nullptr) out.phi_t[0] = 0.0;
    if (out.gamma != nullptr) out.gamma[0] = b.omega * b.omega * d.y();
    if (out.H != nullptr) out.H[1] = 0.0, out.H[2] = -b.omega * d.y();
    if (out.K != nullptr) out.K[2 * 3 + 2] = -out.lambda[0] * d.y();
  }
  Vec2 reaction_point(const Motion& motion) const override { return motion[bodies()[0]].point(s_); }

 private:
  Vec2 s_;  // [m] in the axes of the body
  double height_;
};

// Its description, placed by global geometry in the start pose like the joints of the library.
struct Level {
  std::string name;
  BodyId body;
  Vec2 at{0.0, 0.0};  // [m] global

  std::unique_ptr<Constraint> build(const Model& model) const {
    require_finite("level '" + name + "'", "at y", at.y());
    return std::make_unique<LevelConstraint>(name, body, model.to_local(body, at), at.y());
  }
};

}  // namespace own
