// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What holds for every contact, whatever its shape: exact derivatives, action and reaction, power,
// turning, moving and mirroring.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include <yoke/contact/laws/dissipative/hunt_crossley.hpp>
#include <yoke/contact/laws/elastic/power_law.hpp>
#include <yoke/contact/laws/friction/brown_mcphee.hpp>
#include <yoke/contact/laws/friction/coulomb.hpp>
#include <yoke/contact/laws/friction/lugre.hpp>
#include <yoke/tests/messages.hpp>

#include <yoke/tests/contact/every_contact.hpp>
#include <yoke/tests/contact/laws/test_laws.hpp>
#include <yoke/tests/contact/scene.hpp>

using namespace yoke;
using namespace yoke::tests;
using doctest::Approx;

namespace {

using Square6 = std::array<double, 36>;

/// Which of the two bodies is the ground.
enum class Grounded { neither, shape, disc };

/// A law, and the phase of the contact it is looked at in.
struct ContactMode {
  const char* name;
  WallLaw law;
  ContactPhase phase = ContactPhase::compressing;
};

std::vector<ContactMode> modes_for(const AnyContact& contact) {
  const ContactLaw dent{per_mm(49140, 1.50), PermanentSet{0.71}};
  return {{"damped", ContactLaw{per_mm(49140, 1.10), HuntCrossley{0.32}}},
          {"loading", dent},
          {"unloading", dent, ContactPhase::restituting},
          {"following the radius", hertz_of_wall(contact.radius, 0.32)}};
}

/// The same with friction, without a state and with one.
std::vector<ContactMode> friction_modes_for(const AnyContact& contact) {
  const ContactLaw plain{per_mm(49140, 1.10), HuntCrossley{0.32}};
  const BrownMcPhee sliding{.mu = 0.3, .mu_static = 0.4, .threshold = 0.5, .viscous = 2.0};
  const LuGre bristles{
      .mu = 0.3, .mu_static = 0.4, .stribeck_velocity = 0.5, .stiffness = 1e5, .damping = 30.0};
  const WallLaw graded = [hertz = hertz_law_of_wall(contact.radius, 0.32),
                          sliding](const SlotWall& wall) {
    ContactLaw law = hertz(wall);
    law.friction = sliding;
    return law;
  };
  return {{"sliding", ContactLaw{plain.elastic, plain.dissipation, sliding}},
          {"with bristles", ContactLaw{plain.elastic, plain.dissipation, bristles}},
          {"dry", ContactLaw{plain.elastic, plain.dissipation, Coulomb{0.3, 0.4}}},
          {"sliding, following the radius", graded}};
}

std::vector<ContactMode> all_modes_for(const AnyContact& contact) {
  std::vector<ContactMode> all = modes_for(contact);
  for (ContactMode& mode : friction_modes_for(contact)) all.push_back(std::move(mode));
  return all;
}

/// One contact near one of its places, and random states there: both bodies anywhere, with any
/// velocities, the disc within the wall.
class Bench {
 public:
  Bench(const AnyContact& contact, const Vec2& near, const ContactMode& mode, Grounded grounded,
        unsigned seed)
      : contact_(contact), near_(near), mode_(mode), grounded_(grounded), random_(seed) {
    Model model;
    const BodyId a = model.add({.name = "a", .mass = 0.09, .inertia = 3e-5, .pose = pose_a});
    const BodyId b = model.add({.name = "b", .mass = 2.3, .inertia = 3e-3, .pose = pose_b});
    scene.a = grounded == Grounded::disc ? ground : a;
    scene.b = grounded == Grounded::shape ? ground : b;
    start_ = contact.touching(near, 1e-5);
    center_ = model.to_local(scene.a, start_);
    scene.element = contact.build(model, scene.a, scene.b, start_, mode.law);
  }

  /// [m] the depth of the disc, about; the rate is positive, so that the force presses.
  void draw(double depth) {
    const Vec2 place = near_ + 2e-4 * Vec2(uniform(), uniform());
    const Vec2 shift = contact_.touching(place, depth) - start_;
    Pose a = grounded_ == Grounded::disc ? Pose{} : pose_a;
    Pose b = grounded_ == Grounded::shape ? Pose{} : pose_b;
    Row6 v{};
    for (double& x : v) x = uniform();
    v[2] *= 5.0, v[5] *= 5.0;
    if (grounded_ == Grounded::disc) {
      b.position -= shift;
      v[0] = v[1] = v[2] = 0.0;
    } else {
      a.position += shift;
    }
    if (grounded_ == Grounded::shape) v[3] = v[4] = v[5] = 0.0;
    if (grounded_ == Grounded::neither) {
      const double turn = 3.0 * uniform();
      const Vec2 moved(uniform(), uniform());
      for (Pose* pose : {&a, &b})
        *pose = {rotate(turn, pose->position) + moved, pose->angle + turn};
    }
    scene.set({a.position.x(), a.position.y(), a.angle, b.position.x(), b.position.y(), b.angle},
              v);
    scene.memory = {};
    if (scene.channel_values()[1] < 0.0) {
      for (double& x : v) x = -x;
      scene.set(scene.q(), v);
    }
    scene.touch();
    scene.memory.approach_velocity = 0.21;
    scene.z = 2e-5 * uniform();
    if (mode_.phase != ContactPhase::restituting) return;
    scene.memory.phase = mode_.phase;
    scene.memory.largest_penetration = 1.1 * depth;
    scene.memory.permanent_set = 0.2 * depth;
  }

  /// Of the disc, global.
  Vec2 center() const {
    const Row6 q = scene.q();
    return Vec2(q[0], q[1]) + rotate(q[2], center_);
  }
  double uniform() { return std::uniform_real_distribution<double>(-1.0, 1.0)(random_); }

  Scene scene;

 private:
  static inline const Pose pose_a{{0.11, 0.13}, 0.37}, pose_b{{-0.17, 0.05}, -0.61};
  const AnyContact& contact_;
  Vec2 near_, start_{0.0, 0.0}, center_{0.0, 0.0};
  ContactMode mode_;
  Grounded grounded_;
  std::mt19937 random_;
};

double largest_of(const Square6& m) {
  double size = 0.0;
  for (const double x : m) size = std::max(size, std::abs(x));
  return size;
}

/// The derivative of a function of a row at 0, by differences of fourth order.
template <class F>
Row6 slope(double step, F f) {
  Row6 sum{};
  for (const auto& [shift, weight] :
       {std::pair{1.0, 8.0}, {-1.0, -8.0}, {2.0, -1.0}, {-2.0, 1.0}}) {
    const Row6 value = f(shift * step);
    for (std::size_t i = 0; i < 6; ++i) sum[i] += weight * value[i] / (12.0 * step);
  }
  return sum;
}

/// Largest departures of the derivatives by q and by v from differences, relative to the largest entry.
std::pair<double, double> derivative_errors(Scene& scene, double depth) {
  Square6 dQ_dq{}, dQ_dv{};
  scene.element->evaluate(scene.input(), {.dQ_dq = dQ_dq.data(), .dQ_dv = dQ_dv.data()});
  const double size_q = largest_of(dQ_dq), size_v = std::max(largest_of(dQ_dv), 1e-300);
  const Row6 q = scene.q(), v = scene.v();
  double by_q = size_q > 0.0 ? 0.0 : 1.0, by_v = 0.0;
  for (std::size_t j = 0; j < 6; ++j) {
    const double step = (j % 3 == 2 ? 5.0 : 1.0) * 1e-2 * depth;
    const Row6 of_q = slope(step, [&](double x) {
      Row6 moved = q;
      moved[j] += x;
      scene.set(moved, v);
      return scene.Q();
    });
    const Row6 of_v = slope(1e-3, [&](double x) {
      Row6 moved = v;
      moved[j] += x;
      scene.set(q, moved);
      return scene.Q();
    });
    for (std::size_t i = 0; i < 6; ++i) {
      by_q = std::max(by_q, std::abs(dQ_dq[6 * i + j] - of_q[i]) / size_q);
      by_v = std::max(by_v, std::abs(dQ_dv[6 * i + j] - of_v[i]) / size_v);
    }
  }
  scene.set(q, v);
  return {by_q, by_v};
}

/// The same of the derivatives of the element's state, and of those by it; 0 if it has none.
double state_derivative_error(Scene& scene, double depth) {
  if (scene.element->states().empty()) return 0.0;
  Row6 dQ_dz{}, dz_dq{}, dz_dv{};
  double dz_dz = 0.0;
  scene.element->evaluate(
      scene.input(),
      {.dQ_dz = dQ_dz.data(), .dz_dq = dz_dq.data(), .dz_dv = dz_dv.data(), .dz_dz = &dz_dz});
  const auto largest = [](const Row6& row) {
    double size = 0.0;
    for (const double x : row) size = std::max(size, std::abs(x));
    return size;
  };
  const auto rate = [&scene] {
    double z_dot = 0.0;
    scene.element->evaluate(scene.input(), {.z_dot = &z_dot});
    return z_dot;
  };
  const Row6 q = scene.q(), v = scene.v();
  const double z = scene.z;
  const auto with_z = [&](double x) { return scene.z = z + x; };
  const Row6 forces = slope(1e-7, [&](double x) { return with_z(x), scene.Q(); });
  double worst =
      std::abs(slope(1e-7, [&](double x) { return with_z(x), Row6{rate()}; })[0] - dz_dz) /
      std::abs(dz_dz);
  scene.z = z;
  for (std::size_t j = 0; j < 6; ++j) {
    worst = std::max(worst, std::abs(forces[j] - dQ_dz[j]) / largest(dQ_dz));
    const double step = (j % 3 == 2 ? 5.0 : 1.0) * 1e-2 * depth;
    const double of_q = slope(step, [&](double x) {
      Row6 moved = q;
      moved[j] += x;
      scene.set(moved, v);
      return Row6{rate()};
    })[0];
    const double of_v = slope(1e-4, [&](double x) {
      Row6 moved = v;
      moved[j] += x;
      scene.set(q, moved);
      return Row6{rate()};
    })[0];
    scene.set(q, v);
    worst = std::max({worst, std::abs(of_q - dz_dq[j]) / largest(dz_dq),
                      std::abs(of_v - dz_dv[j]) / largest(dz_dv)});
  }
  return worst;
}

/// Calls f(bench, contact, mode) for every contact at every place, in every mode.
template <class F>
void for_every_place(F f, Grounded grounded = Grounded::neither,
                     std::vector<ContactMode> (*modes)(const AnyContact&) = modes_for) {
  unsigned seed = 11;
  for (const AnyContact& contact : every_contact())
    for (const Vec2& near : contact.near)
      for (const ContactMode& mode : modes(contact)) {
        Bench bench(contact, near, mode, grounded, ++seed);
        INFO(contact.name << " near " << near.x() << ", " << near.y() << ", " << mode.name);
        f(bench, contact);
      }
}

/// What happens to a row of forces or coordinates in a mirror in the x axis.
Row6 mirrored(const Row6& row) { return {row[0], -row[1], -row[2], row[3], -row[4], -row[5]}; }

double largest_difference(const Row6& a, const Row6& b) {
  double size = 0.0;
  for (std::size_t i = 0; i < 6; ++i) size = std::max(size, std::abs(a[i] - b[i]));
  return size;
}

}  // namespace

TEST_CASE("every contact: derivatives are exact at 1000 states near each place, in every mode") {
  for_every_place([](Bench& bench, const AnyContact&) {
    double by_q = 0.0, by_v = 0.0;
    for (int i = 0; i < 1000; ++i) {
      const double depth = i % 2 == 0 ? 3e-5 : 6e-6;
      bench.draw(depth);
      REQUIRE(bench.scene.memory.phase != ContactPhase::apart);
      const auto [q, v] = derivative_errors(bench.scene, depth);
      by_q = std::max(by_q, q), by_v = std::max(by_v, v);
    }
    CHECK(by_q < 1e-6);
    CHECK(by_v < 1e-9);
  });
}

TEST_CASE("every contact with friction: derivatives are exact, by the state too") {
  for (const Grounded grounded : {Grounded::neither, Grounded::shape, Grounded::disc})
    for_every_place(
        [](Bench& bench, const AnyContact&) {
          double by_q = 0.0, by_v = 0.0, by_z = 0.0;
          for (int i = 0; i < 100; ++i) {
            bench.draw(2e-5);
            // At rest, bristles have a corner: differences must not reach over it.
            const double sliding = std::abs(bench.scene.channel_values()[6]);
            if (!bench.scene.element->states().empty() && sliding < 5e-3) continue;
            const auto [q, v] = derivative_errors(bench.scene, 2e-5);
            by_q = std::max(by_q, q), by_v = std::max(by_v, v);
            by_z = std::max(by_z, state_derivative_error(bench.scene, 2e-5));
          }
          CHECK(by_q < 1e-6);
          CHECK(by_v < 1e-7);
          CHECK(by_z < 1e-6);
        },
        grounded, friction_modes_for);
}

TEST_CASE(
    "every contact with dry friction: the row that holds is that of the slip, its blocks exact") {
  for_every_place(
      [](Bench& bench, const AnyContact&) {
        double worst_H = 0.0, worst_K = 0.0, worst_gamma = 0.0;
        for (int i = 0; i < 20; ++i) {
          bench.draw(2e-5);
          Scene& scene = bench.scene;
          if (!scene.element->may_hold()) return;
          const Row6 q = scene.q(), v = scene.v();
          const auto slip_at = [&](const Row6& at) {
            scene.set(at, v);
            Row6 s{};
            double drift = 0.0;
            scene.element->calc_hold(scene.input(), {.G = s.data(), .phi_t = &drift});
            double sum = drift;
            for (std::size_t j = 0; j < 6; ++j) sum += s[j] * v[j];
            return std::pair(s, sum);
          };
          Row6 G{}, H{};
          Square6 K{};
          const double lambda = 37.0;
          double gamma = 0.0;
          scene.element->calc_hold(
              scene.input(),
              {.G = G.data(), .gamma = &gamma, .H = H.data(), .K = K.data(), .lambda = &lambda});
          CHECK(slip_at(q).second == Approx(scene.channel_values()[6]).epsilon(1e-12));
          double gamma_by_differences = 0.0;
          const double size = largest_of(K) + 1e-3 * lambda;
          for (std::size_t j = 0; j < 6; ++j) {
            const auto shifted = [&](double x) {
              Row6 at = q;
              at[j] += x;
              return at;
            };
            const double step = 2e-6;
            const Row6 h = slope(step, [&](double x) { return Row6{slip_at(shifted(x)).second}; });
            worst_H = std::max(worst_H, std::abs(h[0] - H[j]) / (size / lambda));
            gamma_by_differences -= h[0] * v[j];
            const Row6 k = slope(step, [&](double x) { return slip_at(shifted(x)).first; });
            for (std::size_t r = 0; r < 6; ++r)
              worst_K = std::max(worst_K, std::abs(lambda * k[r] - K[6 * r + j]) / size);
          }
          worst_gamma =
              std::max(worst_gamma, std::abs(gamma - gamma_by_differences) / (size / lambda));
          scene.set(q, v);
        }
        CHECK(worst_H < 1e-6);
        CHECK(worst_K < 1e-6);
        CHECK(worst_gamma < 1e-5);
      },
      Grounded::neither, friction_modes_for);
}

TEST_CASE(
    "every contact with friction: along the wall at the point of contact, against the sliding") {
  for_every_place(
      [](Bench& bench, const AnyContact& contact) {
        for (int i = 0; i < 20; ++i) {
          bench.draw(2.7e-5);
          Scene& scene = bench.scene;
          const Row6 q = scene.q(), v = scene.v(), Q = scene.Q();
          const auto values = scene.channel_values();
          const double F = values[2], T = values[8];
          CHECK(Q[0] == Approx(-Q[3]).epsilon(1e-12));
          CHECK(Q[1] == Approx(-Q[4]).epsilon(1e-12));
          const Vec2 on_a(Q[0], Q[1]), point(values[4], values[5]);
          const Vec2 normal = (point - bench.center()) / (contact.radius - values[0]);
          CHECK(-normal.dot(on_a) == Approx(F).epsilon(1e-9));
          CHECK(std::abs(-perp(normal).dot(on_a) - T) < 2e-4 * F);  // the radius may change
          const Vec2 arm_a = point - Vec2(q[0], q[1]), arm_b = point - Vec2(q[3], q[4]);
          CHECK(std::abs(Q[2] - cross(arm_a, on_a)) < 1e-5 * F);
          CHECK(std::abs(Q[5] + cross(arm_b, on_a)) < 1e-5 * F);
          if (scene.element->states().empty()) CHECK(T * values[6] > 0.0);
          // What the bodies lose is stored or dissipated.
          double power = 0.0;
          for (std::size_t j = 0; j < 6; ++j) power += Q[j] * v[j];
          double z_dot = 0.0;
          scene.element->evaluate(scene.input(), {.z_dot = &z_dot});
          const double z = scene.z, dissipated = scene.energy().dissipated_power;
          const Row6 rates = slope(1e-7, [&](double t) {
            Row6 at = q;
            for (std::size_t j = 0; j < 6; ++j) at[j] += t * v[j];
            scene.z = z + t * z_dot;
            scene.set(at, v);
            return Row6{scene.energy().stored};
          });
          scene.set(q, v);
          scene.z = z;
          CHECK(std::abs(power + rates[0] + dissipated) < 1e-6 * F);
        }
      },
      Grounded::neither, friction_modes_for);
}

TEST_CASE("every contact: derivatives are exact where one of the bodies is the ground") {
  for (const Grounded grounded : {Grounded::shape, Grounded::disc})
    for_every_place(
        [](Bench& bench, const AnyContact&) {
          for (int i = 0; i < 10; ++i) {
            bench.draw(2e-5);
            const auto [by_q, by_v] = derivative_errors(bench.scene, 2e-5);
            CHECK(by_q < 1e-6);
            CHECK(by_v < 1e-9);
          }
        },
        grounded);
}

TEST_CASE("every contact: action and reaction with their moments, through the centre of the disc") {
  for_every_place([](Bench& bench, const AnyContact& contact) {
    for (int i = 0; i < 20; ++i) {
      bench.draw(2.7e-5);
      Scene& scene = bench.scene;
      const Row6 q = scene.q(), v = scene.v(), Q = scene.Q();
      const auto values = scene.channel_values();
      const double F = values[2];
      CHECK(F > 0.0);
      CHECK(values[0] == Approx(2.7e-5).epsilon(1e-9));
      CHECK(Q[0] == -Q[3]);
      CHECK(Q[1] == -Q[4]);
      const Vec2 on_a(Q[0], Q[1]), center = bench.center();
      const double moment = q[0] * Q[1] - q[1] * Q[0] + Q[2] + q[3] * Q[4] - q[4] * Q[3] + Q[5];
      CHECK(std::abs(moment) < 1e-12 * F);
      // On both bodies it acts along a line through the centre of the disc.
      CHECK(std::abs(Q[2] - cross(center - Vec2(q[0], q[1]), on_a)) < 1e-12 * F);
      CHECK(std::abs(Q[5] + cross(center - Vec2(q[3], q[4]), on_a)) < 1e-12 * F);
      // F is its part along the normal, which leads from there to the point of contact.
      const Vec2 point(values[4], values[5]);
      const Vec2 normal = (point - center) / (contact.radius - values[0]);
      CHECK(normal.norm() == Approx(1.0).epsilon(1e-9));
      CHECK(-normal.dot(on_a) == Approx(F).epsilon(1e-9));
      CHECK(std::abs(cross(normal, on_a)) < 1e-4 * F);
      // Rate and slip are those of the two surfaces at that point.
      const Vec2 slip = Vec2(v[0], v[1]) + v[2] * perp(point - Vec2(q[0], q[1])) -
                        Vec2(v[3], v[4]) - v[5] * perp(point - Vec2(q[3], q[4]));
      CHECK(values[6] == Approx(perp(normal).dot(slip)).epsilon(1e-9));
      CHECK(values[1] == Approx(normal.dot(slip)).epsilon(1e-9));
    }
  });
}

TEST_CASE("every contact: the power of the force is what is stored and what is dissipated") {
  for_every_place([](Bench& bench, const AnyContact&) {
    for (int i = 0; i < 20; ++i) {
      bench.draw(2.7e-5);
      Scene& scene = bench.scene;
      const Row6 q = scene.q(), v = scene.v(), Q = scene.Q();
      double power = 0.0;
      for (std::size_t j = 0; j < 6; ++j) power += Q[j] * v[j];
      const double dissipated = scene.energy().dissipated_power, F = scene.channel_values()[2];
      const Row6 rates = slope(1e-7, [&](double t) {
        Row6 at = q;
        for (std::size_t j = 0; j < 6; ++j) at[j] += t * v[j];
        scene.set(at, v);
        return Row6{scene.energy().stored, scene.channel_values()[0]};
      });
      scene.set(q, v);
      CHECK(std::abs(power + rates[0] + dissipated) < 1e-7 * F);
      CHECK(std::abs(rates[1] - scene.channel_values()[1]) < 1e-7);
    }
  });
}

TEST_CASE("every contact: turned and moved it is the same, with friction or without") {
  const auto check = [](Bench& bench, const AnyContact&) {
    for (int i = 0; i < 5; ++i) {
      bench.draw(2.7e-5);
      Scene& scene = bench.scene;
      const Row6 q = scene.q(), v = scene.v();
      const auto before = scene.channel_values();
      const Row6 Q = scene.Q();
      const double turn = 1.234;
      const auto turned = [&](double x, double y) { return rotate(turn, Vec2(x, y)); };
      const Vec2 a = turned(q[0], q[1]) + Vec2(3.0, -2.0), b = turned(q[3], q[4]) + Vec2(3.0, -2.0);
      const Vec2 va = turned(v[0], v[1]), vb = turned(v[3], v[4]);
      scene.set({a.x(), a.y(), q[2] + turn, b.x(), b.y(), q[5] + turn},
                {va.x(), va.y(), v[2], vb.x(), vb.y(), v[5]});
      const auto after = scene.channel_values();
      const Row6 Q_after = scene.Q();
      for (const std::size_t k : {std::size_t{1}, std::size_t{6}})
        CHECK(after[k] == Approx(before[k]).epsilon(1e-11));
      CHECK(after[2] == Approx(before[2]).epsilon(1e-9));  // 1e-15 m of 27 um
      const Vec2 force = turned(Q[0], Q[1]);
      CHECK((Vec2(Q_after[0], Q_after[1]) - force).norm() < 1e-9 * force.norm());
      CHECK(std::abs(Q_after[2] - Q[2]) < 1e-9 * force.norm());
      CHECK(std::abs(Q_after[5] - Q[5]) < 1e-9 * force.norm());
    }
  };
  for_every_place(check);
  for_every_place(check, Grounded::neither, friction_modes_for);
}

TEST_CASE("every contact: a mirror shows the mirrored forces and derivatives") {
  const std::vector<AnyContact> seen = every_contact(), shown = every_contact(true);
  REQUIRE(seen.size() == shown.size());
  std::mt19937 random(17);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (std::size_t c = 0; c < seen.size(); ++c)
    for (std::size_t n = 0; n < seen[c].near.size(); ++n)
      for (const ContactMode& mode : all_modes_for(seen[c])) {
        INFO(seen[c].name << " near " << seen[c].near[n].x() << ", " << seen[c].near[n].y());
        Model model;
        const BodyId a = model.add({.name = "a", .mass = 0.09, .inertia = 3e-5});
        const BodyId b = model.add({.name = "b", .mass = 2.3, .inertia = 3e-3});
        const Vec2 at = seen[c].touching(seen[c].near[n], 2.7e-5);
        Scene scene, image;
        scene.element = seen[c].build(model, a, b, at, mode.law);
        image.element = shown[c].build(model, a, b, Vec2(at.x(), -at.y()), mode.law);
        for (int i = 0; i < 5; ++i) {
          Row6 v{};
          for (double& x : v) x = uniform(random);
          scene.set({}, v);
          if (scene.channel_values()[1] < 0.0)
            for (double& x : v) x = -x;
          scene.memory = image.memory = {};
          scene.set({}, v), image.set({}, mirrored(v));
          scene.touch(), image.touch();
          scene.z = 1e-5, image.z = -1e-5;
          scene.memory.phase = image.memory.phase = mode.phase;
          scene.memory.largest_penetration = image.memory.largest_penetration = 3e-5;
          const Row6 Q = scene.Q();
          const double F = scene.channel_values()[2];
          CHECK(F > 0.0);
          CHECK(largest_difference(image.Q(), mirrored(Q)) < 1e-9 * F);
          Square6 slopes{}, shown_slopes{}, rates{}, shown_rates{};
          scene.element->evaluate(scene.input(), {.dQ_dq = slopes.data(), .dQ_dv = rates.data()});
          image.element->evaluate(image.input(),
                                  {.dQ_dq = shown_slopes.data(), .dQ_dv = shown_rates.data()});
          double off_q = 0.0, off_v = 0.0;
          for (std::size_t k = 0; k < 36; ++k) {
            const double sign = ((k / 6) % 3 == 0) == (k % 3 == 0) ? 1.0 : -1.0;
            off_q = std::max(off_q, std::abs(shown_slopes[k] - sign * slopes[k]));
            off_v = std::max(off_v, std::abs(shown_rates[k] - sign * rates[k]));
          }
          CHECK(off_q < 1e-8 * largest_of(slopes));
          CHECK(off_v <= 1e-8 * largest_of(rates));
          const auto values = scene.channel_values(), shown_values = image.channel_values();
          CHECK(shown_values[6] == Approx(-values[6]).epsilon(1e-9));
          const bool edge = std::isinf(values[7]);
          CHECK((edge
                     ? shown_values[7] == values[7]
                     : std::abs(shown_values[7] - values[7]) < 1e-9 * (1.0 + std::abs(values[7]))));
        }
      }
}

TEST_CASE("discs and walls that cannot be are refused by name") {
  Model model;
  const BodyId ball = model.add({.name = "ball", .mass = 1.0, .inertia = 1e-3});
  const ContactLaw law{per_mm(49140, 1.10)};
  const auto refusal = [&](const auto& description) {
    return message_of([&] { model.add(description); });
  };
  const Curve floor = straight_line({0.0, 0.0}, {1.0, 0.0});
  CHECK(contains(refusal(DiscOnCurve{.name = "floor",
                                     .disc = {ball, {0.0, 0.1}, -1.0},
                                     .body = ground,
                                     .curve = floor,
                                     .law = law}),
                 "contact 'floor': radius of the disc = -1 m must be finite and at least 0 m"));
  CHECK(contains(refusal(DiscInHole{.name = "bearing",
                                    .disc = {ball, {0.0, 0.0}, 0.02},
                                    .hole = {ground, {0.0, 0.0}, 0.01},
                                    .law = law}),
                 "radius of the disc = 0.02 m must be less than the 0.01 m of the hole"));
  CHECK(contains(refusal(DiscOnCurve{.name = "box",
                                     .disc = {ball, {0.05, 0.05}, 0.01},
                                     .body = ground,
                                     .curve = polyline({{0.0, 0.0}, {0.1, 0.0}, {0.1, 0.1}}),
                                     .law = law}),
                 "contact 'box': into the corner behind piece 1"));
  const Curve valley =
      circular_arc({.center = {0.0, 0.0}, .radius = 0.05, .start = -0.5 * pi - 1.0, .angle = 2.0});
  CHECK(contains(refusal(DiscOnCurve{.name = "valley",
                                     .disc = {ball, {0.0, 0.0}, 0.06},
                                     .body = ground,
                                     .curve = valley,
                                     .law = law}),
                 "its radius is 0.05 m, not greater than the 0.06 m of the disc"));
}
