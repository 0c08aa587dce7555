// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What a joint becomes when it has clearance: contacts in place of its equations. A joint does not
// know contacts, so it hands its place to a description that does:
//   Revolute{.name = "pin", .a = rod, .b = slider, .at = p,
//            .clearance = BearingClearance{.journal_radius = 10.0_mm, .radial = 0.5_mm, .law = ...}}
#pragma once

#include <concepts>
#include <functional>
#include <string>
#include <utility>

#include <yoke/core/model.hpp>

namespace yoke {

class Curve;

/// A joint between a and b, global, in the start pose.
struct JointPlace {
  std::string name;              // of the joint
  BodyId a, b;                   // that it joins
  Vec2 at{0.0, 0.0};             // [m] its point
  Vec2 along{1.0, 0.0};          // its direction, a unit vector, where it has one
  const Curve* curve = nullptr;  // carried by b, where it has one
};

/// Any value with elements(model, place), which throws ModelError for what is wrong.
class Clearance {
 public:
  /// From a description with elements(model, place). Implicit: a joint's field is written as the
  /// description itself.
  template <class D>
  requires requires(const D& d, const Model& model, const JointPlace& place) {
    { d.elements(model, place) } -> std::convertible_to<Elements>;
  }
  Clearance(D description)
      : make_([d = std::move(description)](const Model& model, const JointPlace& place) {
          return d.elements(model, place);
        }) {}

  Elements elements(const Model& model, const JointPlace& place) const {
    return make_(model, place);
  }

 private:
  std::function<Elements(const Model&, const JointPlace&)> make_;
};

}  // namespace yoke
