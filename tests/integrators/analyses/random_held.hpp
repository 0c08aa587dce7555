// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Mechanisms drawn at random that springs, gravity and joints hold: trees and loops of revolute,
// prismatic and distance joints, 1 to 10 bodies, masses over four decades, springs soft and stiff,
// stretched, off the centres. Their potential energy is bounded below.
#pragma once

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <yoke/core/model.hpp>
#include <yoke/joints/distance.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/forces/torsional_spring.hpp>
#include <yoke/joints/forces/translational_spring.hpp>
#include <yoke/joints/prismatic.hpp>
#include <yoke/joints/revolute.hpp>

namespace yoke::tests {

class HeldMechanism {
 public:
  explicit HeldMechanism(unsigned seed) : random_(seed) {
    const int count = 1 + below(10);
    for (int i = 0; i < count; ++i) add_body(i);
    const int loops = count > 1 ? below(3) : 0;
    for (int i = 0; i < loops; ++i) close_loop(i);
    const int more = below(3);
    for (int i = 0; i < more; ++i) add_spring("extra " + std::to_string(i), any_body(), any_body());
    if (below(4) > 0) model_.add(Gravity{.name = "gravity", .acceleration = {0.0, -9.81}});
  }
  Model take() { return std::move(model_); }

 private:
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
  }
  int below(int n) { return static_cast<int>(uniform(0.0, n)); }
  Vec2 offset(double size) { return {uniform(-size, size), uniform(-size, size)}; }
  std::size_t any_body() {
    return static_cast<std::size_t>(below(static_cast<int>(bodies_.size())));
  }

  void add_body(int i) {
    const std::size_t to = any_body();
    const Vec2 centre = centres_[to] + offset(0.8);
    const double mass = std::pow(10.0, uniform(-2.0, 2.0)), radius = uniform(0.05, 0.4);
    const std::string name = "body " + std::to_string(i);
    const BodyId body = model_.add({.name = name,
                                    .mass = mass,
                                    .inertia = mass * radius * radius,
                                    .pose = {centre, uniform(-3.0, 3.0)}});
    bodies_.push_back(body);
    centres_.push_back(centre);
    const BodyId a = bodies_[to];
    const Vec2 at = 0.5 * (centre + centres_[to]) + offset(0.3);
    const int kind = below(4);
    if (kind == 0) model_.add(Revolute{name + " pin", a, body, at});
    if (kind == 1)
      model_.add(Prismatic{name + " guide", a, body, rotate(uniform(-3.0, 3.0), {1.0, 0.0})});
    if (kind == 2)
      model_.add(Distance{.name = name + " rod",
                          .a = a,
                          .b = body,
                          .at_a = centres_[to] + offset(0.3),
                          .at_b = centre + offset(0.3)});
    // What slides or is free needs a spring, or it may fall for ever.
    if (kind == 1 || kind == 3 || below(3) == 0)
      add_spring(name + " spring", 0, bodies_.size() - 1);
    if (below(6) == 0)
      model_.add(TorsionalSpring{.name = name + " coil",
                                 .a = ground,
                                 .b = body,
                                 .stiffness = std::pow(10.0, uniform(-1.0, 3.0))});
  }

  void close_loop(int i) {
    const std::size_t a = any_body(), b = any_body();
    if (a == b) return;
    const std::string name = "loop " + std::to_string(i);
    const Vec2 at_a = centres_[a] + offset(0.3), at_b = centres_[b] + offset(0.3);
    if (below(2) == 0)
      model_.add(Revolute{name, bodies_[a], bodies_[b], 0.5 * (at_a + at_b)});
    else
      model_.add(
          Distance{.name = name, .a = bodies_[a], .b = bodies_[b], .at_a = at_a, .at_b = at_b});
  }

  void add_spring(const std::string& name, std::size_t a, std::size_t b) {
    if (a == b) return;
    const Vec2 from = centres_[a] + offset(0.5), to = centres_[b] + offset(0.2);
    model_.add(TranslationalSpring{.name = name,
                                   .a = bodies_[a],
                                   .b = bodies_[b],
                                   .at_a = from,
                                   .at_b = to,
                                   .stiffness = std::pow(10.0, uniform(0.5, 5.0)),
                                   .free_length = uniform(0.2, 1.8) * (to - from).norm()});
  }

  std::mt19937_64 random_;
  Model model_;
  std::vector<BodyId> bodies_{ground};
  std::vector<Vec2> centres_{Vec2(0.0, 0.0)};
};

inline Model held_mechanism(unsigned seed) { return HeldMechanism(seed).take(); }

}  // namespace yoke::tests
