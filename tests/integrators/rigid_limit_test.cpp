// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The scotch-yoke without clearance: the pin stays on the arc of the slider by a constraint written
// outside the library, from its equation alone. With phi = start + omega t and ' = d/dphi:
//   X   = r c + s,               s = sqrt(R^2 - r^2 sin^2 phi), c = cos phi
//   X'  = -r sin phi + s',       s s' = -r^2 sin phi c
//   X'' = -r c + s'',            s s'' + s'^2 = -r^2 cos 2phi
//   T omega = d/dt (M X'^2 omega^2 / 2)   so   T = M X' X'' omega^2, the crank being balanced
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include <yoke/core/authoring/auto_constraint.hpp>
#include <yoke/tests/integrators/mechanisms.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;

/// A point of a stays on a circle about a point of b: |p - c| - R = 0 [m].
class PointOnArc : public AutoConstraint<PointOnArc, 1, 2> {
 public:
  PointOnArc(const std::string& name, BodyId a, const Vec2& pin, BodyId b, const Vec2& centre,
             double R)
      : AutoConstraint(name, {a, b}, {{"radial", Measure::length}}),
        pin_(pin),
        centre_(centre),
        R_(R) {}
  template <class T>
  T phi(const AutoPose<T>& a, const AutoPose<T>& b, const T&) const {
    return (a.point(pin_) - b.point(centre_)).norm() - R_;
  }

 private:
  Vec2 pin_, centre_;  // [m] in body axes
  double R_;
};

struct Rigid {
  double r = 45.0_mm, R = 60.0_mm, M = 2.353_kg, omega = 24.0 * pi, start = -31.0_deg;

  struct Point {
    double x, v, a, torque;
  };
  Point at(double t) const {
    const double phi = start + omega * t, sine = std::sin(phi), cosine = std::cos(phi);
    const double s = std::sqrt(R * R - r * r * sine * sine);
    const double s1 = -r * r * sine * cosine / s;
    const double s2 = -(r * r * std::cos(2.0 * phi) + s1 * s1) / s;
    const double X1 = -r * sine + s1, X2 = -r * cosine + s2;
    return {r * cosine + s, X1 * omega, X2 * omega * omega, M * X1 * X2 * omega * omega};
  }

  Model model() const {
    const Point p = at(0.0);
    Model m;
    const BodyId crank = m.add(Body{.name = "crank",
                                    .mass = 0.105_kg,
                                    .inertia = 30.40_kg_mm2,
                                    .pose = {{0.0, 0.0}, start},
                                    .twist = {{0.0, 0.0}, omega}});
    const BodyId slider = m.add(Body{.name = "slider",
                                     .mass = M,
                                     .inertia = 3495.6_kg_mm2,
                                     .pose = {{p.x, 0.0}, 0.0},
                                     .twist = {{p.v, 0.0}, 0.0}});
    m.add(Revolute{.name = "pivot", .a = ground, .b = crank, .at = {0.0, 0.0}});
    m.add(AngleDriver{.name = "motor", .body = crank, .angle = constant_speed(start, omega)});
    m.add(Prismatic{.name = "guide", .a = ground, .b = slider, .along = {1.0, 0.0}});
    m.add(PointOnArc("slot", crank, {r, 0.0}, slider, {0.0, 0.0}, R));
    return m;
  }
};

}  // namespace

TEST_CASE("without clearance motion and driving torque are the closed form to 1e-9 of the peak") {
  for (const double r : {45.0_mm, 50.0_mm}) {
    const Rigid rigid{.r = r};
    for (const std::string formulation : {"arkode-projection", "ida-ggl", "arkode-baumgarte"}) {
      INFO(formulation, " r = ", r);
      const Result run = simulate(rigid.model(), {.until = yoke_period,
                                                  .relative_tolerance = 1e-12,
                                                  .formulation = formulation,
                                                  .samples = 721});
      REQUIRE(run.summary.ok());
      Rigid::Point peak{}, worst{};
      const auto t = run["t_s"], x = run["slider.x_m"], v = run["slider.vx_m_per_s"],
                 a = run["slider.ax_m_per_s2"], torque = run["motor.moment_N_m"];
      for (Eigen::Index i = 0; i < t.size(); ++i) {
        const Rigid::Point exact = rigid.at(t(i));
        const auto note = [&](double Rigid::Point::*member, double value) {
          peak.*member = std::max(peak.*member, std::abs(exact.*member));
          worst.*member = std::max(worst.*member, std::abs(value - exact.*member));
        };
        note(&Rigid::Point::x, x(i));
        note(&Rigid::Point::v, v(i));
        note(&Rigid::Point::a, a(i));
        note(&Rigid::Point::torque, torque(i));
      }
      CHECK(worst.x < 1e-9 * peak.x);
      CHECK(worst.v < 1e-9 * peak.v);
      CHECK(worst.a < 1e-9 * peak.a);
      CHECK(worst.torque < 1e-9 * peak.torque);
      CHECK(peak.torque > 10.0);
      // Over whole revolutions the motor does no work on balance.
      CHECK(std::abs(run["motor.work_J"](t.size() - 1)) < 1e-8);
    }
  }
}
