// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A contact element and the state around it, without any integrator.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <yoke/core/force.hpp>

namespace yoke::tests {

using Row6 = std::array<double, 6>;

/// Two bodies with a contact between them; the ground may be one of the two.
struct Scene {
  std::unique_ptr<ForceElement> element;
  BodyId a{1}, b{2};
  std::vector<BodyMotion> bodies = std::vector<BodyMotion>(3);
  std::vector<Body> inertia = std::vector<Body>(3);
  ContactMemory memory;
  double z = 0.0;  // of an element with one state
  double t = 0.0;
  Row6 acceleration{};
  double effective_mass = 0.83;
  Scales scales{.length = 0.1, .time = 1.0};  // of a mechanism as large as a hand
  std::vector<EventRecord> records;
  double dissipated = 0.0;  // [J] at events
  std::string failure;

  Motion motion() const { return {t, bodies, inertia}; }
  ForceInput input() const {
    return {.motion = motion_ = motion(), .z = &z, .contact = &memory, .scales = scales};
  }

  /// Coordinates of both bodies in the order of the element's blocks.
  Row6 q() const {
    const BodyMotion &p = body(a), &s = body(b);
    return {p.x, p.y, p.angle, s.x, s.y, s.angle};
  }
  Row6 v() const {
    const BodyMotion &p = body(a), &s = body(b);
    return {p.vx, p.vy, p.omega, s.vx, s.vy, s.omega};
  }
  void set(const Row6& q, const Row6& v) {
    for (const std::size_t k : {std::size_t{0}, std::size_t{3}}) {
      BodyMotion& m = bodies[static_cast<std::size_t>((k == 0 ? a : b).index)];
      m = {q[k], q[k + 1], q[k + 2], std::cos(q[k + 2]), std::sin(q[k + 2]),
           v[k], v[k + 1], v[k + 2]};
    }
  }

  EventContext context() {
    return {.input = input(),
            .contact = &memory,
            .z = &z,
            .effective_mass = [this](const double*) { return effective_mass; },
            .acceleration = acceleration.data(),
            .dissipate = [this](double joules) { dissipated += joules; },
            .record = [this](EventRecord event) { records.push_back(std::move(event)); },
            .fail = [this](std::string why) { failure = std::move(why); }};
  }
  void initialise() {
    EventContext c = context();
    element->initialise_contacts(c);
  }
  /// The same, without a search for the impact that led there.
  void touch() {
    EventContext c = context();
    c.at_rest = true;
    element->initialise_contacts(c);
  }
  void handle(int event) {
    EventContext c = context();
    element->handle_event(event, c);
  }
  std::vector<double> event_functions() const {
    std::vector<double> g(static_cast<std::size_t>(element->events()));
    element->calc_events(input(), g.data());
    return g;
  }
  std::vector<double> channel_values() const {
    std::vector<double> values(element->channels().size());
    element->calc_channels(input(), values.data());
    return values;
  }
  Energy energy() const {
    Energy e;
    element->evaluate(input(), {.energy = &e});
    return e;
  }
  Row6 Q() const {
    Row6 force{};
    element->evaluate(input(), {.Q = force.data()});
    return force;
  }

 private:
  const BodyMotion& body(BodyId id) const { return bodies[static_cast<std::size_t>(id.index)]; }
  mutable Motion motion_{};  // ForceInput refers to one
};

}  // namespace yoke::tests
