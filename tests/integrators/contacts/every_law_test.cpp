// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Every law in every contact: a free disc that meets a fixed shape along its normal moves in one
// coordinate, so the shape may not matter. And what a collision of two free bodies conserves.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include <yoke/contact/laws/catalog/dissipative_catalog.hpp>
#include <yoke/contact/laws/catalog/elastic_catalog.hpp>
#include <yoke/contact/laws/dissipative/hunt_crossley.hpp>
#include <yoke/contact/laws/elastic/power_law.hpp>
#include <yoke/core/model.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/tests/contact/every_contact.hpp>

using namespace yoke;
using namespace yoke::tests;
using doctest::Approx;

namespace {

/// [J] Every step may err by the tolerance: of all positions and rates in the natural sizes of the
/// model, with this mass [kg].
double allowed_imbalance(const Summary& s, double mass) {
  const double speed = s.length_scale / s.time_scale;
  return static_cast<double>(s.steps) * s.relative_tolerance * mass * speed * speed;
}

/// [m/s] at which a disc of 0.1 kg that comes along the normal at 0.2 m/s is let go.
double rebound(const AnyContact& contact, const Vec2& near, const ContactLaw& law) {
  Model m;
  const Vec2 start = contact.touching(near, -2e-5), n = contact.normal(start);
  const BodyId disc = m.add({.name = "disc",
                             .mass = 0.1,
                             .inertia = 1e-5,
                             .pose = {start, 0.3},
                             .twist = {0.2 * n, 0.0}});
  m.insert(contact.build(m, disc, ground, start, law));
  const Result run = simulate(m, {.until = 3e-3, .relative_tolerance = 1e-12, .samples = 2});
  INFO(run.summary.reason);
  CHECK(run.summary.ok());
  CHECK(run.summary.energy_balance < allowed_imbalance(run.summary, 0.1));
  for (const EventRecord& event : run.events)
    if (event.kind == "release") return -event.speed;
  return 0.0;
}

/// A free disc about to strike a free shape, both turning; `sense` is -1 in a mirror in the x axis.
Model collision(const AnyContact& contact, const Vec2& near, const WallLaw& law,
                double sense = 1.0) {
  Model m;
  const Vec2 start = contact.touching(near, -2e-5), n = contact.normal(start);
  const BodyId disc = m.add({.name = "disc",
                             .mass = 0.1,
                             .inertia = 1e-5,
                             .pose = {start, sense * 0.3},
                             .twist = {0.2 * n + sense * 0.05 * perp(n), sense * 3.0}});
  const BodyId shape = m.add({.name = "shape",
                              .mass = 0.3,
                              .inertia = 4e-4,
                              .pose = {start + Vec2(0.03, sense * -0.02), 0.0},
                              .twist = {{0.01, sense * 0.02}, sense * -0.5}});
  m.insert(contact.build(m, disc, shape, start, law));
  return m;
}

}  // namespace

TEST_CASE("every dissipative law delivers in every contact what it delivers in the first") {
  const std::vector<AnyContact> contacts = every_contact();
  for (const DissipativeNote& note : dissipative_catalog()) {
    const ContactLaw law{note.linear_only ? per_mm(5e5, 1.0) : per_mm(49070, 1.10),
                         make_dissipative(note.name, {.restitution = 0.7})};
    const double expected = rebound(contacts.front(), contacts.front().near.front(), law);
    CHECK(expected > 0.0);
    for (const AnyContact& contact : contacts) {
      INFO(note.name << " in " << contact.name);
      CHECK(rebound(contact, contact.near.back(), law) == Approx(expected).epsilon(1e-8));
    }
  }
}

TEST_CASE("every elastic law stores and returns in every contact what it does in the first") {
  const std::vector<AnyContact> contacts = every_contact();
  for (const ElasticNote& note : elastic_catalog()) {
    if (note.name == "power") continue;
    const ContactLaw law{
        make_elastic(note.name, {.pin_radius = 7.9e-3, .wall_radius = 8e-3, .length = 0.01}),
        HuntCrossley{0.32}};
    const double expected = rebound(contacts.front(), contacts.front().near.front(), law);
    CHECK(expected > 0.1);
    for (const AnyContact& contact : contacts) {
      INFO(note.name << " in " << contact.name);
      CHECK(rebound(contact, contact.near.back(), law) == Approx(expected).epsilon(1e-8));
    }
  }
}

TEST_CASE(
    "two free bodies that collide keep momentum and moment, in all contacts and formulations") {
  const ContactLaw law{per_mm(49070, 1.10), HuntCrossley{0.32}};
  for (const AnyContact& contact : every_contact()) {
    const Model m = collision(contact, contact.near.front(), law);
    const auto momentum = [](const Result& run, Eigen::Index i) {
      const auto at = [&](const char* column) { return run[column](i); };
      const double px = 0.1 * at("disc.vx_m_per_s") + 0.3 * at("shape.vx_m_per_s");
      const double py = 0.1 * at("disc.vy_m_per_s") + 0.3 * at("shape.vy_m_per_s");
      const double moment =
          1e-5 * at("disc.omega_rad_per_s") + 4e-4 * at("shape.omega_rad_per_s") +
          0.1 * (at("disc.x_m") * at("disc.vy_m_per_s") - at("disc.y_m") * at("disc.vx_m_per_s")) +
          0.3 *
              (at("shape.x_m") * at("shape.vy_m_per_s") - at("shape.y_m") * at("shape.vx_m_per_s"));
      return Eigen::Vector3d(px, py, moment);
    };
    Eigen::VectorXd first;
    for (const std::string formulation :
         {"arkode-projection", "ida-ggl", "cvode-projection", "adams-baumgarte"}) {
      INFO(contact.name << ", " << formulation);
      const Result run = simulate(
          m, {.until = 2e-3, .relative_tolerance = 1e-9, .formulation = formulation, .samples = 3});
      REQUIRE(run.summary.ok());
      CHECK(run.events.size() >= 2);
      CHECK((momentum(run, 2) - momentum(run, 0)).norm() < 1e-12);
      CHECK(run.summary.energy_balance < allowed_imbalance(run.summary, 0.4));
      const Eigen::VectorXd final = run["disc.omega_rad_per_s"];
      if (first.size() == 0) first = final;
      CHECK(final(2) == Approx(first(2)).epsilon(1e-6));
    }
  }
}

TEST_CASE("every contact: a collision of free bodies and what a mirror shows of it") {
  const SimulationOptions options{.until = 4e-3, .relative_tolerance = 1e-10, .samples = 11};
  const std::vector<AnyContact> seen = every_contact(), shown = every_contact(true);
  for (std::size_t c = 0; c < seen.size(); ++c)
    for (std::size_t n = 0; n < seen[c].near.size(); ++n)
      for (const WallLaw& law : {WallLaw(ContactLaw{per_mm(49070, 1.10), HuntCrossley{0.32}}),
                                 hertz_of_wall(seen[c].radius, 0.32)}) {
        INFO(seen[c].name << " near " << seen[c].near[n].x() << ", " << seen[c].near[n].y());
        const Result run = simulate(collision(seen[c], seen[c].near[n], law), options);
        const Result image = simulate(collision(shown[c], shown[c].near[n], law, -1.0), options);
        REQUIRE(run.summary.ok());
        REQUIRE(image.summary.ok());
        CHECK(run.events.size() >= 2);
        CHECK(image.events.size() == run.events.size());
        CHECK(run.summary.energy_balance < allowed_imbalance(run.summary, 0.4));
        for (const char* body : {"disc", "shape"}) {
          const auto off = [&](const char* column, double sign) {
            const std::string name = std::string(body) + column;
            return (image[name] - sign * run[name]).cwiseAbs().maxCoeff();
          };
          CHECK(off(".x_m", 1.0) < 1e-11);
          CHECK(off(".y_m", -1.0) < 1e-11);
          CHECK(off(".angle_rad", -1.0) < 1e-9);
        }
      }
}
