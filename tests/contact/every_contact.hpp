// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Every kind of contact that ships, each with the places where a disc touches it.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <yoke/contact/disc_on_curve.hpp>
#include <yoke/contact/geometry/arc_slot.hpp>
#include <yoke/contact/geometry/curve_slot.hpp>
#include <yoke/contact/geometry/wall.hpp>
#include <yoke/contact/laws/dissipative/hunt_crossley.hpp>
#include <yoke/contact/laws/elastic/power_law.hpp>
#include <yoke/contact/pin_in_slot.hpp>
#include <yoke/core/curves/lines_and_arcs.hpp>
#include <yoke/core/curves/smooth_curves.hpp>
#include <yoke/core/model.hpp>

namespace yoke::tests {

/// A contact between a disc of one body and a shape of another.
struct AnyContact {
  std::string name;
  Slot profile;              // the shape alone
  double radius = 0;         // [m] of the disc
  std::vector<Vec2> near{};  // [m] global points, one or more near each region
  /// With the disc's centre at a point.
  std::function<std::unique_ptr<ForceElement>(const Model&, BodyId disc, BodyId shape, const Vec2&,
                                              const WallLaw&)>
      build{};

  /// The centre of a disc at this penetration [m] near one of the points.
  Vec2 touching(const Vec2& start, double penetration) const {
    Vec2 p = rotate(-profile.angle(), start - profile.origin());
    for (int i = 0; i < 50; ++i) {
      const Touch touch = profile.touch(profile.nearest(p), p);
      p += (penetration - (touch.distance - profile.half_width() + radius)) * touch.normal;
    }
    return profile.origin() + rotate(profile.angle(), p);
  }
  /// The direction of penetration there, global.
  Vec2 normal(const Vec2& at) const {
    const Vec2 p = rotate(-profile.angle(), at - profile.origin());
    return rotate(profile.angle(), profile.touch(profile.nearest(p), p).normal);
  }
};

inline AnyContact any_slot(std::string name, const Slot& slot, double pin, std::vector<Vec2> near) {
  return {.name = std::move(name),
          .profile = slot,
          .radius = pin,
          .near = std::move(near),
          .build = [slot, pin](const Model& model, BodyId a, BodyId b, const Vec2& at,
                               const WallLaw& law) {
            return PinInSlot{.name = "contact", .pin = {a, at, pin}, .slot = {b, slot}, .law = law}
                .build(model);
          }};
}

inline AnyContact any_wall(std::string name, const Curve& curve, CurveSide side, double radius,
                           std::vector<Vec2> near) {
  return {.name = std::move(name),
          .profile = wall_profile({.curve = curve,
                                   .disc_on_left = side == CurveSide::left,
                                   .disc_radius = radius,
                                   .thickness = std::numeric_limits<double>::infinity()}),
          .radius = radius,
          .near = std::move(near),
          .build = [=](const Model& model, BodyId a, BodyId b, const Vec2& at, const WallLaw& law) {
            return DiscOnCurve{.name = "contact",
                               .disc = {a, at, radius},
                               .body = b,
                               .curve = curve,
                               .side = side,
                               .law = law}
                .build(model);
          }};
}

/// All of them, or what a mirror in the x axis shows of them.
class EveryContact {
 public:
  explicit EveryContact(bool mirrored) : sense_(mirrored ? -1.0 : 1.0) {
    add_slots();
    add_walls();
    add_round_pairs();
  }
  std::vector<AnyContact> all;

 private:
  Vec2 seen(const Vec2& p) const { return {p.x(), sense_ * p.y()}; }
  std::vector<Vec2> all_seen(std::vector<Vec2> points) const {
    for (Vec2& p : points) p = seen(p);
    return points;
  }
  CurveSide seen(CurveSide side) const {
    return (side == CurveSide::left) == (sense_ > 0.0) ? CurveSide::left : CurveSide::right;
  }
  void add_slot(const char* name, const Slot& slot, double pin, const std::vector<Vec2>& near) {
    all.push_back(any_slot(name, slot, pin, all_seen(near)));
  }
  void add_wall(const char* name, const Curve& curve, CurveSide side, double radius,
                const std::vector<Vec2>& near) {
    all.push_back(any_wall(name, curve, seen(side), radius, all_seen(near)));
  }

  void add_slots();
  void add_walls();
  void add_round_pairs();

  double sense_;  // -1 in the mirror
};

inline void EveryContact::add_slots() {
  constexpr double h = 8e-3, pin = 7e-3;
  const Vec2 center(0.02, 0.01);
  const auto on_arc = [&](double radius, double angle) {
    return Vec2(center + radius * Vec2(std::cos(angle), std::sin(angle)));
  };
  add_slot("arc slot",
           arc_slot({.center = seen(center),
                     .radius = 0.06,
                     .direction = sense_ * 0.4,
                     .angle = 2.0,
                     .half_width = h}),
           pin, {on_arc(0.058, 0.6), on_arc(0.062, 0.1), on_arc(0.06, 1.43), on_arc(0.06, -0.63)});
  CurveSlot bent{
      .centreline = polyline(all_seen({{0.0, 0.0}, {0.06, 0.0}, {0.09, 0.05}, {0.15, 0.04}})),
      .half_width = h,
      .end = SlotEnd::open};
  bent.edge_radius = 1e-3;
  add_slot("chain slot with an open end", curve_slot(bent), pin,
           {{0.02, 0.001},
            {0.02, -0.001},
            {-0.001, 0.0003},
            {0.0607, -0.0006},
            {0.0593, 0.0013},
            {0.0705, 0.017},
            {0.0905, 0.0508},
            {0.152, 0.0425},
            {0.1505, 0.0365}});
  const double height = sense_ * 0.01;
  const Curve wave =
      curve_of([height](double u) { return Vec2(u, height * std::sin(50.0 * u)); }, 0.0, 0.2);
  add_slot("slot along a wave", curve_slot({.centreline = wave, .half_width = h}), pin,
           {{0.03, 0.011}, {0.031, 0.009}, {0.1, -0.009}, {0.07, -0.002}});
  const CurveSlot flat{.centreline = line_segment(seen(Vec2(0.01, 0.02)), seen(Vec2(0.08, 0.05))),
                       .half_width = h,
                       .end = SlotEnd::flat};
  add_slot("flat end", curve_slot(flat).others().front(), pin, {{0.081, 0.0505}});
}

inline void EveryContact::add_walls() {
  add_wall("disc on a line", straight_line(seen(Vec2(0.1, 0.2)), seen(Vec2(3.0, 1.0))),
           CurveSide::left, 5e-3, {{0.15, 0.23}});
  add_wall("disc on the end of a line", line_segment(seen(Vec2(0.1, 0.2)), seen(Vec2(0.2, 0.2))),
           CurveSide::left, 5e-3, {{0.202, 0.203}, {0.15, 0.205}, {0.099, 0.2045}});
  const Curve arc =
      circular_arc({.center = seen(Vec2(0.03, -0.02)), .radius = 0.05, .angle = sense_ * 2.5});
  add_wall("point on an arc from outside", arc, CurveSide::right, 0.0, {{0.06, 0.02}});
  add_wall("disc on an arc from inside", arc, CurveSide::left, 0.03, {{0.04, -0.003}});
  add_wall("disc on the corners of a box",
           polyline(all_seen({{0.0, 0.0}, {0.1, 0.0}, {0.1, 0.05}, {0.0, 0.05}}), {.closed = true}),
           CurveSide::right, 0.01, {{0.106, 0.056}, {0.05, 0.06}, {-0.01, 0.02}});
  std::vector<Vec2> cam;
  for (int i = 0; i < 60; ++i) {
    const double a = 2.0 * pi * i / 60.0, r = 0.04 + 0.006 * std::cos(2.0 * a);
    cam.emplace_back(r * std::cos(a), r * std::sin(a));
  }
  add_wall("roller on a cam", curve_through(all_seen(cam), {.closed = true}), CurveSide::right,
           0.008, {{0.05, 0.0}, {0.03, 0.035}, {-0.001, -0.042}});
}

inline void EveryContact::add_round_pairs() {
  const Vec2 center = seen(Vec2(0.02, 0.03));
  all.push_back(
      {.name = "journal in a bearing",
       .profile =
           wall_profile({.curve = circle(center, 0.0105), .disc_radius = 0.01, .thickness = 1.0}),
       .radius = 0.01,
       .near = all_seen({{0.0203, 0.0303}, {0.0197, 0.0302}}),
       .build = [center](const Model& model, BodyId a, BodyId b, const Vec2& at,
                         const WallLaw& law) {
         return DiscInHole{
             .name = "contact", .disc = {a, at, 0.01}, .hole = {b, center, 0.0105}, .law = law}
             .build(model);
       }});
  all.push_back(
      {.name = "disc on disc",
       .profile = wall_profile({.curve = circle(center, 0.02),
                                .disc_on_left = false,
                                .disc_radius = 0.01,
                                .thickness = 1.0}),
       .radius = 0.01,
       .near = all_seen({{0.04, 0.05}}),
       .build = [center](const Model& model, BodyId a, BodyId b, const Vec2& at,
                         const WallLaw& law) {
         return DiscOnDisc{
             .name = "contact", .disc = {a, at, 0.01}, .other = {b, center, 0.02}, .law = law}
             .build(model);
       }});
}

inline std::vector<AnyContact> every_contact(bool mirrored = false) {
  return EveryContact(mirrored).all;
}

/// Hertz' law of every wall's radius, with a damping factor: it follows the radius where that changes,
/// and goes through flat places smoothly. An edge counts as round with a radius of 1 mm.
inline auto hertz_law_of_wall(double disc_radius, double damping) {
  return [disc_radius, damping](const SlotWall& wall) {
    const double disc = disc_radius > 0.0 ? 1.0 / disc_radius : 200.0;
    const double relative = disc + std::min(wall.curvature, 1e3);
    return ContactLaw{PowerLaw{5e8 / std::sqrt(relative), 1.5}, HuntCrossley{damping}};
  };
}

inline WallLaw hertz_of_wall(double disc_radius, double damping) {
  return hertz_law_of_wall(disc_radius, damping);
}

}  // namespace yoke::tests
