// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A lifting platform on Scott-Russell linkages side by side, all alike: over-closed.
//
//      B1                 B2
//   ===(o)================(o)===  platform     O  pivot of a crank, on the base
//      |  \                |  \                A  foot of a rod, on the slide that joins all feet
//    --     \            --     \              M  crank's tip and middle of the rod:
//       M1 (o)              M2 (o)                O M = A M = B M = arm / 2
//        /    \              /    \            B  head of the rod, straight above O
//      O1      \           O2      \           alpha  angle of a rod from the horizontal
//      (+)------(o)========(+)======(o)  slide, pulled by the cylinder
//
// Thales: B is above O at h = arm sin(alpha), the foot beside it at s = arm cos(alpha), so
// h^2 + s^2 = arm^2. The slide follows a law of motion: up, rest, down, rest.
//
//   height        h = sqrt(arm^2 - s^2)
//   force at rest F = (dV/dh) s / h,  dV/dh = g (load + n (rod / 2 + crank / 4))
//
// One linkage carries the platform, and its guide alone keeps it level; of n linkages with both
// slides guided, 2 n - 1 equations follow from the others. They are found and left out. Motion and
// the cylinder's force are not touched by that; how the load is shared between the linkages is one
// possibility of many.
//
// What should happen. The pull of the cylinder falls while the platform rises, because the rods get
// steeper; at rest it is the closed form.
#include <cmath>

#include <yoke/cases/case.hpp>
#include <yoke/core/motion_laws.hpp>
#include <yoke/core/units.hpp>
#include <yoke/joints/drivers/displacement_driver.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/prismatic.hpp>
#include <yoke/joints/revolute.hpp>

namespace yoke::cases {

namespace {

using namespace yoke::literals;

constexpr double lift_rod = 8.0, lift_crank = 4.0, lift_slide = 10.0;  // [kg]

struct Lift {
  double arm, low, high, time, load;
  int linkages;
  std::string law;

  explicit Lift(const Parameters& p)
      : arm(p.number("arm")),
        low(p.number("low")),
        high(p.number("high")),
        time(p.number("time")),
        load(p.number("load")),
        linkages(p.whole("linkages")),
        law(p.word("law")) {
    if (!(low < high))
      throw ModelError(
          fmt::format("scott_russell_platform: low = {:g} deg must be less than high, "
                      "{:g} deg",
                      low * 180.0 / pi, high * 180.0 / pi));
  }

  double spacing() const { return 1.5 * arm; }  // from one linkage to the next
  double end() const { return 3.0 * time; }

  /// s [m]: up, half as long at rest, down, again at rest.
  MotionChain slide() const {
    const MotionLaw& by = law == "cycloidal"        ? cycloidal
                          : law == "polynomial_345" ? polynomial_345
                                                    : modified_sine;
    const double from = arm * std::cos(low), to = arm * std::cos(high);
    return motion({{by, time, to}, {dwell, 0.5 * time}, {by, time, from}, {dwell, 0.5 * time}},
                  {.start = from});
  }
};

Model lift_model(const Lift& lift) {
  const double a = lift.arm, s = a * std::cos(lift.low), h = a * std::sin(lift.low);
  const double width = lift.spacing() * (lift.linkages - 1) + a;
  Model m;
  const auto beam = [&](const char* name, double mass, const Vec2& left) {
    return m.add(Body{.name = name,
                      .mass = mass,
                      .inertia = mass * width * width / 12.0,
                      .pose = {left + Vec2(0.5 * width, 0.0), 0.0}});
  };
  const BodyId platform = beam("platform", lift.load, {0.0, h}),
               slide = beam("slide", lift_slide, {s, 0.0});
  for (int i = 1; i <= lift.linkages; ++i) {
    const std::string n = std::to_string(i);
    const Vec2 O((i - 1) * lift.spacing(), 0.0), A = O + Vec2(s, 0.0), B = O + Vec2(0.0, h),
                                                 M = 0.5 * (A + B);
    const BodyId crank = m.add(Body{.name = "crank " + n,
                                    .mass = lift_crank,
                                    .inertia = lift_crank * a * a / 48.0,
                                    .pose = {0.5 * (O + M), lift.low}});
    const BodyId rod = m.add(Body{.name = "rod " + n,
                                  .mass = lift_rod,
                                  .inertia = lift_rod * a * a / 12.0,
                                  .pose = {M, -lift.low}});
    m.add(Revolute{.name = "O" + n, .a = ground, .b = crank, .at = O});
    m.add(Revolute{.name = "M" + n, .a = crank, .b = rod, .at = M});
    m.add(Revolute{.name = "A" + n, .a = slide, .b = rod, .at = A});
    m.add(Revolute{.name = "B" + n, .a = platform, .b = rod, .at = B});
  }
  m.add(Prismatic{.name = "base", .a = ground, .b = slide, .along = {1.0, 0.0}});
  m.add(Prismatic{.name = "guide", .a = ground, .b = platform, .along = {0.0, 1.0}});
  m.add(DisplacementDriver{.name = "cylinder",
                           .body = slide,
                           .at = {s, 0.0},
                           .along = {1.0, 0.0},
                           .from = Vec2(0.0, 0.0),
                           .displacement = lift.slide()});
  m.add(Gravity{});
  return m;
}

std::vector<Check> lift_checks(const Lift& lift, const Result& run) {
  const Eigen::VectorXd t = run["t_s"], pull = run["cylinder.fx_N"];
  const MotionChain slide = lift.slide();
  std::vector<Check> checks = {deviation_check(
      "height of the platform off by", run, "platform.y_m", "m", "closed form", [&](std::size_t i) {
        const double s = slide(t[static_cast<Eigen::Index>(i)]).value;
        return std::sqrt(lift.arm * lift.arm - s * s);
      })};
  // In the middle of the rest above.
  for (Eigen::Index i = 0; i < t.size(); ++i) {
    if (t[i] < 1.25 * lift.time || t[i] > 1.5 * lift.time) continue;
    const double per_height =
        9.81 * (lift.load + lift.linkages * (0.5 * lift_rod + 0.25 * lift_crank));
    const double force = per_height / std::tan(lift.high);
    checks.push_back({.what = "pull of the cylinder at rest above",
                      .value = -pull[i],
                      .expected = force,
                      .unit = "N",
                      .tolerance = tolerance_of(run, force),
                      .remark = "virtual work"});
    break;
  }
  checks.push_back({.what = "equations left out",
                    .value = static_cast<double>(run.summary.redundant_equations.size()),
                    .expected = 2.0 * lift.linkages - 1.0,
                    .remark = "two for each linkage but one"});
  checks.push_back(energy_check(run));
  return checks;
}

}  // namespace

Case scott_russell_platform_case() {
  return {.name = "scott_russell_platform",
          .group = "linkages",
          .description = "a lifting platform on Scott-Russell linkages side by side: over-closed",
          .parameters = {{.name = "arm",
                          .quantity = Quantity::length,
                          .default_text = "1000mm",
                          .low = 10.0_mm,
                          .high = 20000.0_mm,
                          .description = "length of a rod, twice that of a crank"},
                         {.name = "linkages",
                          .quantity = Quantity::number,
                          .default_text = "2",
                          .low = 1.0,
                          .high = 30.0,
                          .whole = true,
                          .description = "side by side; one is enough"},
                         {.name = "low",
                          .quantity = Quantity::angle,
                          .default_text = "15deg",
                          .low = 3.0_deg,
                          .high = 80.0_deg,
                          .description = "angle of the rods below"},
                         {.name = "high",
                          .quantity = Quantity::angle,
                          .default_text = "65deg",
                          .low = 4.0_deg,
                          .high = 85.0_deg,
                          .description = "angle of the rods above"},
                         {.name = "time",
                          .quantity = Quantity::time,
                          .default_text = "2s",
                          .low = 0.01,
                          .high = 1000.0,
                          .description = "of the way up; as long down, half as long at rest"},
                         {.name = "law",
                          .default_text = "modified_sine",
                          .words = {"modified_sine", "cycloidal", "polynomial_345"},
                          .description = "law of motion of the slide"},
                         {.name = "load",
                          .quantity = Quantity::number,
                          .default_text = "200",
                          .low = 0.1,
                          .high = 1e6,
                          .description = "mass of the platform, in kg"}},
          .default_output = "results/scott_russell_platform",
          .model = [](const Parameters& p, const WallLaws&) { return lift_model(Lift(p)); },
          .duration = [](const Parameters& p) { return Lift(p).end(); },
          .checks = [](const Parameters& p, const Model&,
                       const Result& run) { return lift_checks(Lift(p), run); },
          .paths = {"rod 1", "platform", "slide"}};
}

}  // namespace yoke::cases
