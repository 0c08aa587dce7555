// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Every kind of contact that ships, each with the places where a disc touches it.
#pragma once

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
                                              const ContactLaw&)>
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
                               const ContactLaw& law) {
            return PinInSlot{.name = "contact", .pin = {a, at, pin}, .slot = {b, slot}, .law = law}
                .build(model);
          }};
}

inline AnyContact any_wall(std::string name, const Curve& curve, CurveSide side, double radius,
                           std::vector<Vec2> near) {
  return {
      .name = std::move(name),
      .profile = wall_profile({.curve = curve,
                               .disc_on_left = side == CurveSide::left,
                               .disc_radius = radius,
                               .thickness = std::numeric_limits<double>::infinity()}),
      .radius = radius,
      .near = std::move(near),
      .build = [=](const Model& model, BodyId a, BodyId b, const Vec2& at, const ContactLaw& law) {
        return DiscOnCurve{.name = "contact",
                           .disc = {a, at, radius},
                           .body = b,
                           .curve = curve,
                           .side = side,
                           .law = law}
            .build(model);
      }};
}

inline std::vector<AnyContact> every_contact() {
  constexpr double h = 8e-3, pin = 7e-3;
  std::vector<AnyContact> all;
  all.push_back(any_slot("arc slot",
                         arc_slot({.center = {0.02, 0.01},
                                   .radius = 0.06,
                                   .direction = 0.4,
                                   .angle = 2.0,
                                   .half_width = h}),
                         pin,
                         {Vec2(0.02, 0.01) + 0.058 * Vec2(std::cos(0.6), std::sin(0.6)),
                          Vec2(0.02, 0.01) + 0.062 * Vec2(std::cos(0.1), std::sin(0.1)),
                          Vec2(0.02, 0.01) + 0.06 * Vec2(std::cos(1.43), std::sin(1.43)),
                          Vec2(0.02, 0.01) + 0.06 * Vec2(std::cos(-0.63), std::sin(-0.63))}));
  const Curve bent = polyline({{0.0, 0.0}, {0.06, 0.0}, {0.09, 0.05}, {0.15, 0.04}});
  CurveSlot chain_slot{.centreline = bent, .half_width = h, .end = SlotEnd::open};
  chain_slot.edge_radius = 1e-3;
  all.push_back(any_slot("chain slot with an open end", curve_slot(chain_slot), pin,
                         {{0.02, 0.001},
                          {0.02, -0.001},
                          {-0.001, 0.0003},
                          {0.0607, -0.0006},
                          {0.0593, 0.0013},
                          {0.0705, 0.017},
                          {0.0905, 0.0508},
                          {0.152, 0.0425},
                          {0.1505, 0.0365}}));
  const Curve wave =
      curve_of([](double u) { return Vec2(u, 0.01 * std::sin(50.0 * u)); }, 0.0, 0.2);
  all.push_back(any_slot("slot along a wave", curve_slot({.centreline = wave, .half_width = h}),
                         pin, {{0.03, 0.011}, {0.031, 0.009}, {0.1, -0.009}, {0.07, -0.002}}));
  const CurveSlot flat{.centreline = line_segment({0.01, 0.02}, {0.08, 0.05}),
                       .half_width = h,
                       .end = SlotEnd::flat};
  all.push_back(any_slot("flat end", curve_slot(flat).others().front(), pin, {{0.081, 0.0505}}));
  all.push_back(any_wall("disc on a line", straight_line({0.1, 0.2}, {3.0, 1.0}), CurveSide::left,
                         5e-3, {{0.15, 0.23}}));
  all.push_back(any_wall("disc on the end of a line", line_segment({0.1, 0.2}, {0.2, 0.2}),
                         CurveSide::left, 5e-3, {{0.202, 0.203}, {0.15, 0.205}, {0.099, 0.2045}}));
  all.push_back(any_wall("point on an arc from outside",
                         circular_arc({.center = {0.03, -0.02}, .radius = 0.05, .angle = 2.5}),
                         CurveSide::right, 0.0, {{0.06, 0.02}}));
  all.push_back(any_wall("disc on an arc from inside",
                         circular_arc({.center = {0.03, -0.02}, .radius = 0.05, .angle = 2.5}),
                         CurveSide::left, 0.03, {{0.04, -0.003}}));
  all.push_back(
      any_wall("disc on the corners of a box",
               polyline({{0.0, 0.0}, {0.1, 0.0}, {0.1, 0.05}, {0.0, 0.05}}, {.closed = true}),
               CurveSide::right, 0.01, {{0.106, 0.056}, {0.05, 0.06}, {-0.01, 0.02}}));
  std::vector<Vec2> cam;
  for (int i = 0; i < 60; ++i) {
    const double a = 2.0 * pi * i / 60.0, r = 0.04 + 0.006 * std::cos(2.0 * a);
    cam.emplace_back(r * std::cos(a), r * std::sin(a));
  }
  all.push_back(any_wall("roller on a cam", curve_through(cam, {.closed = true}), CurveSide::right,
                         0.008, {{0.05, 0.0}, {0.03, 0.035}, {-0.001, -0.042}}));
  all.push_back(
      {.name = "journal in a bearing",
       .profile = wall_profile(
           {.curve = circle({0.02, 0.03}, 0.0105), .disc_radius = 0.01, .thickness = 1.0}),
       .radius = 0.01,
       .near = {{0.0203, 0.0303}, {0.0197, 0.0302}},
       .build = [](const Model& model, BodyId a, BodyId b, const Vec2& at, const ContactLaw& law) {
         return DiscInHole{.name = "contact",
                           .disc = {a, at, 0.01},
                           .hole = {b, {0.02, 0.03}, 0.0105},
                           .law = law}
             .build(model);
       }});
  all.push_back(
      {.name = "disc on disc",
       .profile = wall_profile({.curve = circle({0.02, 0.03}, 0.02),
                                .disc_on_left = false,
                                .disc_radius = 0.01,
                                .thickness = 1.0}),
       .radius = 0.01,
       .near = {{0.04, 0.05}},
       .build = [](const Model& model, BodyId a, BodyId b, const Vec2& at, const ContactLaw& law) {
         return DiscOnDisc{
             .name = "contact", .disc = {a, at, 0.01}, .other = {b, {0.02, 0.03}, 0.02}, .law = law}
             .build(model);
       }});
  return all;
}

}  // namespace yoke::tests
