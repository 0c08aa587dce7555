// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A leg of Theo Jansen's Strandbeest: eleven links, one of them the driven crank.
//
//              D                 O  crank pivot, origin         lengths in Jansen's units:
//            /  \ `.j            B  fixed, (-a, -l)               a 38    b 41.5  c 39.3  d 40.1
//         e /   b\   `.          C  tip of the crank m            e 55.8  f 39.4  g 36.7  h 65.7
//          /      \     C                                         i 49    j 50    k 61.9  l 7.8
//         E---d----B   /m                                         m 15
//         |       /|  O
//        f|     c/ .' k (C to G)         B D E and G H F are rigid triangles of three rods each,
//         |     / '                      b d e and g h i; j and k carry the crank to D and G.
//         H-g--G
//          \   |
//         h \  | i          Gravity acts; the ground does not touch the foot.
//            \ |
//              F foot
//
// What should happen. The foot goes round a path that is flat below: almost half of the time it
// moves along the ground, then it is lifted and swings back quickly.
#include <cmath>

#include <yoke/cases/case.hpp>
#include <yoke/cases/uniform_bar.hpp>
#include <yoke/core/units.hpp>
#include <yoke/joints/drivers/angle_driver.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/revolute.hpp>
#include <yoke/joints/weld.hpp>

namespace yoke::cases {

namespace {

using namespace yoke::literals;

/// Where the joints are [m].
struct Leg {
  Vec2 O{0.0, 0.0}, B, C, D, E, G, H, F;
};

/// The point at distance r from p and s from q, to the left of the way from p to q.
Vec2 apex(const Vec2& p, double r, const Vec2& q, double s) {
  const Vec2 way = q - p;
  const double w = way.norm(), along = (r * r - s * s + w * w) / (2.0 * w);
  return p + (along * way + std::sqrt(r * r - along * along) * perp(way)) / w;
}

/// The leg for a crank at `angle`; u is the length of one of Jansen's units [m].
Leg leg_at(double angle, double u) {
  Leg leg;
  leg.B = Vec2(-38.0 * u, -7.8 * u);
  leg.C = rotate(angle, {15.0 * u, 0.0});
  leg.D = apex(leg.B, 41.5 * u, leg.C, 50.0 * u);
  leg.G = apex(leg.C, 61.9 * u, leg.B, 39.3 * u);
  leg.E = apex(leg.B, 40.1 * u, leg.D, 55.8 * u);
  leg.H = apex(leg.G, 36.7 * u, leg.E, 39.4 * u);
  leg.F = apex(leg.G, 49.0 * u, leg.H, 65.7 * u);
  return leg;
}

double leg_speed(const Parameters& p) { return p.number("speed") * pi / 30.0; }

Model leg_model(const Parameters& p) {
  const double u = p.number("unit"), density = p.number("rod_mass");
  const Leg at = leg_at(0.0, u);
  Model m;
  const auto rod = [&](const char* name, const Vec2& from, const Vec2& to) {
    const double mass = density * (to - from).norm();
    return m.add(uniform_bar({.name = name, .mass = mass, .from = from, .to = to}));
  };
  const BodyId crank = rod("crank", at.O, at.C), j = rod("j", at.C, at.D), k = rod("k", at.C, at.G);
  const BodyId b = rod("b", at.B, at.D), d = rod("d", at.B, at.E), e = rod("e", at.D, at.E);
  const BodyId c = rod("c", at.B, at.G), f = rod("f", at.E, at.H);
  const BodyId g = rod("g", at.G, at.H), h = rod("h", at.H, at.F), i = rod("i", at.G, at.F);
  const double foot_mass = 2.0 * density * u;  // of a rod as long as two units
  const BodyId foot = m.add(
      Body{.name = "foot", .mass = foot_mass, .inertia = foot_mass * u * u, .pose = {at.F, 0.0}});

  const auto pin = [&](const char* name, BodyId first, BodyId second, const Vec2& where) {
    m.add(Revolute{.name = name, .a = first, .b = second, .at = where});
  };
  pin("O", ground, crank, at.O);
  pin("Bb", ground, b, at.B);
  pin("Bc", ground, c, at.B);
  pin("Bd", ground, d, at.B);
  pin("Cj", crank, j, at.C);
  pin("Ck", crank, k, at.C);
  pin("Dj", b, j, at.D);
  pin("De", b, e, at.D);
  pin("Ee", d, e, at.E);
  pin("Ef", d, f, at.E);
  pin("Gk", c, k, at.G);
  pin("Gg", c, g, at.G);
  pin("Gi", c, i, at.G);
  pin("Hf", g, f, at.H);
  pin("Hh", g, h, at.H);
  pin("Fi", h, i, at.F);
  m.add(Weld{.name = "sole", .a = h, .b = foot, .at = at.F});
  m.add(Gravity{});
  m.add(AngleDriver{.name = "motor", .body = crank, .angle = constant_speed(0.0, leg_speed(p))});
  return m;
}

std::vector<Check> leg_checks(const Parameters& p, const Model&, const Result& run) {
  const double u = p.number("unit"), omega = leg_speed(p);
  const Eigen::VectorXd t = run["t_s"];
  const auto foot = [&](std::size_t i) {
    return leg_at(omega * t[static_cast<Eigen::Index>(i)], u).F;
  };
  return {deviation_check("x of the foot off by", run, "foot.x_m", "m", "intersections of circles",
                          [&](std::size_t i) { return foot(i).x(); }),
          deviation_check("y of the foot off by", run, "foot.y_m", "m", "intersections of circles",
                          [&](std::size_t i) { return foot(i).y(); }),
          energy_check(run)};
}

}  // namespace

Case jansen_leg_case() {
  return {
      .name = "jansen_leg",
      .group = "linkages",
      .description = "a leg of Theo Jansen's Strandbeest: eleven links and a foot that walks",
      .parameters = {{.name = "unit",
                      .quantity = Quantity::length,
                      .default_text = "10mm",
                      .low = 0.1_mm,
                      .high = 1000.0_mm,
                      .description = "length of one of Jansen's units; the crank has 15"},
                     {.name = "speed",
                      .quantity = Quantity::number,
                      .default_text = "30",
                      .low = 1e-3,
                      .high = 1e4,
                      .description = "of the crank, in revolutions per minute"},
                     {.name = "turns",
                      .quantity = Quantity::number,
                      .default_text = "2",
                      .low = 0.01,
                      .high = 1000.0,
                      .description = "of the crank"},
                     {.name = "rod_mass",
                      .quantity = Quantity::number,
                      .default_text = "0.5",
                      .low = 1e-6,
                      .high = 1e3,
                      .description = "of all links, in kg per metre"}},
      .default_output = "results/jansen_leg",
      .model = [](const Parameters& p, const WallLaws&) { return leg_model(p); },
      .duration = [](const Parameters& p) { return p.number("turns") * 60.0 / p.number("speed"); },
      .checks = leg_checks,
      .paths = {"foot", "g", "e", "crank"}};
}

}  // namespace yoke::cases
