// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Newton's cradle: equal discs hang side by side; one or more are pulled away and let go.
//
//     o   o   o   o   o      pivots, 2 r + gap apart
//    /    |   |   |   |      L  to the centre of each disc; the rods have no mass
//   /     |   |   |   |      g = 9.81 m/s^2 down
// (o)    (o) (o) (o) (o)     contact law F between neighbours
//
// The strike is over so soon that the discs do not leave their places: a collinear chain,
//   m x_i'' = F(d_(i-1)) - F(d_i),   d_i = x_i - x_(i+1) - gap
// Two discs exchange their velocities. In a longer chain that touches, all move at once, and the
// velocities behind the strike depend on the exponent n of F = K d^n alone, not on m, K or v: with
// n = 1.5 the last of five discs leaves with 0.9888 v and the others are not at rest. With a gap
// the impacts come one behind the other, and only the last disc leaves. Here the chain is
// integrated by Runge and Kutta's method, for any law without loss.
#include <algorithm>
#include <cmath>

#include <yoke/cases/impacts/impact_laws.hpp>
#include <yoke/cases/impacts/newtons_cradle.hpp>
#include <yoke/contact/disc_on_curve.hpp>
#include <yoke/core/units.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/revolute.hpp>

namespace yoke::cases {

// ---- the collinear chain

namespace {

struct ChainState {
  std::vector<double> x, v;
};

/// y + h dy
ChainState moved(const ChainState& y, double h, const ChainState& dy) {
  ChainState sum = y;
  for (std::size_t i = 0; i < y.x.size(); ++i) {
    sum.x[i] += h * dy.x[i];
    sum.v[i] += h * dy.v[i];
  }
  return sum;
}

ChainState derivative(const CollinearChain& c, const ChainState& y) {
  ChainState dy{y.v, std::vector<double>(y.v.size(), 0.0)};
  for (std::size_t i = 0; i + 1 < y.x.size(); ++i) {
    const double d = y.x[i] - y.x[i + 1] - c.gap;
    if (!(d > 0.0)) continue;
    const double a = c.law.response(d).force / c.mass;
    dy.v[i] -= a;
    dy.v[i + 1] += a;
  }
  return dy;
}

/// Discs that rest behind the strike do so within the error of the steps, `slack` [m/s].
bool apart_for_good(const CollinearChain& c, const ChainState& y, double slack) {
  for (std::size_t i = 0; i + 1 < y.x.size(); ++i)
    if (y.x[i] - y.x[i + 1] > c.gap || y.v[i] > y.v[i + 1] + slack) return false;
  return true;
}

/// [s] about the duration of an impact of two: 3 times the largest penetration over the speed.
double duration_of_impact(const CollinearChain& c, double speed) {
  const double energy = 0.25 * c.mass * speed * speed;
  double low = 0.0, high = 1e-9;
  while (c.law.response(high).energy < energy && high < 1.0) high *= 2.0;
  for (int i = 0; i < 60; ++i) {
    const double d = 0.5 * (low + high);
    (c.law.response(d).energy < energy ? low : high) = d;
  }
  return 3.0 * high / speed;
}

}  // namespace

std::vector<double> velocities_behind_strike(const CollinearChain& c,
                                             const std::vector<double>& v) {
  // From their places at rest, where the last of those that strike meets the next.
  ChainState y{std::vector<double>(v.size(), 0.0), v};
  for (std::size_t i = 0; i < v.size(); ++i)
    if (v[i] != 0.0) y.x[i] = c.gap;
  const double fastest = *std::ranges::max_element(v);
  const double h = duration_of_impact(c, fastest) / 1000.0;
  constexpr long most = 4000000;
  for (long step = 0; step < most; ++step) {
    const ChainState k1 = derivative(c, y), k2 = derivative(c, moved(y, 0.5 * h, k1)),
                     k3 = derivative(c, moved(y, 0.5 * h, k2)), k4 = derivative(c, moved(y, h, k3));
    y = moved(moved(moved(moved(y, h / 6.0, k1), h / 3.0, k2), h / 3.0, k3), h / 6.0, k4);
    if (apart_for_good(c, y, 1e-7 * fastest)) return y.v;
  }
  return {};
}

// ---- the cradle

namespace {

using namespace yoke::literals;

struct NewtonsCradle {
  static constexpr double gravity = 9.81;  // [m/s^2]
  int discs, pulled;
  double radius, length, gap;  // [m]
  double mass;                 // [kg]
  double angle;                // [rad]

  explicit NewtonsCradle(const Parameters& p)
      : discs(p.whole("discs")),
        pulled(p.whole("pulled")),
        radius(p.number("radius")),
        length(p.number("length")),
        gap(p.number("gap")),
        mass(p.number("mass")),
        angle(p.number("angle")) {
    if (!(pulled < discs))
      throw ModelError(
          fmt::format("newtons_cradle: pulled = {} must be from 1 to {}, less than the discs",
                      pulled, discs - 1));
    if (!(radius < length))
      throw ModelError(
          fmt::format("newtons_cradle: radius = {:g} mm must be less than length = {:g} mm",
                      1e3 * radius, 1e3 * length));
    if (!(gap <= 0.5 * radius))
      throw ModelError(
          fmt::format("newtons_cradle: gap = {:g} mm must be from 0 to {:g} mm, half "
                      "the radius",
                      1e3 * gap, 5e2 * radius));
  }

  double inertia() const { return 0.5 * mass * radius * radius; }
  double mass_in_chain() const { return mass + inertia() / (length * length); }
  double rate() const { return std::sqrt(mass * gravity / (mass_in_chain() * length)); }  // [1/s]
  double speed() const { return 2.0 * rate() * length * std::sin(0.5 * angle); }  // at the strike
  double pitch() const { return 2.0 * radius + gap; }
};

/// Discs that push each other for long do so while they swing: no strike of a cradle.
void require_short_strikes(const NewtonsCradle& c, const ContactLaw& law) {
  const double one = duration_of_impact({law.elastic, c.mass_in_chain(), c.gap}, c.speed());
  const double quarter = 0.5 * pi / c.rate(), most = 0.02 * quarter;
  if (!(one < most))
    throw ModelError(fmt::format(
        "newtons_cradle: an impact of two discs at {:.3g} m/s would last about {:.3g} ms; accepted "
        "is less than {:.3g} ms, a fiftieth of a quarter swing: with a greater stiffness, a smaller "
        "mass or exponent, another law",
        c.speed(), 1e3 * one, 1e3 * most));
}

std::string disc_name(int i) { return fmt::format("disc {}", i + 1); }

Model newtons_cradle_model(const NewtonsCradle& c, const WallLaws& laws) {
  require_short_strikes(c, laws["discs"]);
  Model m;
  std::vector<BodyId> discs;
  std::vector<Vec2> centres;
  for (int i = 0; i < c.discs; ++i) {
    const Vec2 pivot(i * c.pitch(), c.length);
    const double angle = i < c.pulled ? -c.angle : 0.0;
    centres.push_back(pivot + rotate(angle, {0.0, -c.length}));
    discs.push_back(m.add(Body{.name = disc_name(i),
                               .mass = c.mass,
                               .inertia = c.inertia(),
                               .pose = {centres.back(), angle}}));
    m.add(Revolute{
        .name = fmt::format("pivot {}", i + 1), .a = ground, .b = discs.back(), .at = pivot});
  }
  for (std::size_t i = 0; i + 1 < discs.size(); ++i)
    m.add(DiscOnDisc{.name = fmt::format("contact {}-{}", i + 1, i + 2),
                     .disc = {discs[i], centres[i], c.radius},
                     .other = {discs[i + 1], centres[i + 1], c.radius},
                     .law = laws["discs"],
                     .reference_force = 100.0 * c.mass * NewtonsCradle::gravity});
  m.add(Gravity{.acceleration = {0.0, -NewtonsCradle::gravity}});
  return m;
}

/// The first strike: its beginning, and the first row after its last release.
struct Strike {
  bool found = false;
  double lasted = 0.0;  // [s] until that row
  Eigen::Index row = 0;
};
Strike first_strike(const NewtonsCradle& c, const Result& run) {
  const double quarter = 0.5 * pi / c.rate(), before = 0.5 * quarter;
  const std::string struck = fmt::format("contact {}-{}", c.pulled, c.pulled + 1);
  double begin = -1.0, end = -1.0;
  for (const EventRecord& e : run.events) {
    if (begin < 0.0 && e.kind == "onset" && e.element == struck && e.t > before) begin = e.t;
    if (begin >= 0.0 && e.kind == "release" && e.t < begin + 0.5 * quarter) end = e.t;
  }
  const Eigen::VectorXd t = run["t_s"];
  for (Eigen::Index i = 0; end >= 0.0 && i < t.size(); ++i)
    if (t[i] > end) return {true, t[i] - begin, i};
  return {};
}

std::vector<Check> newtons_cradle_checks(const Parameters& p, const WallLaws& laws,
                                         const Result& run) {
  const NewtonsCradle c(p);
  std::vector<Check> checks = {energy_check(run)};
  const Strike strike = first_strike(c, run);
  if (!strike.found) return checks;
  const double v = c.speed();
  // What the pendulums do during the strike, and how far from the vertical they meet.
  const double apart = c.gap * c.discs / c.length, swing = c.rate() * strike.lasted;
  const double tolerance = v * (swing * swing + apart * apart) + tolerance_of(run, v);
  std::vector<double> found, before;
  double momentum = 0.0;
  for (int i = 0; i < c.discs; ++i) {
    found.push_back(run[disc_name(i) + ".vx_m_per_s"][strike.row]);
    before.push_back(i < c.pulled ? v : 0.0);
    momentum += found.back();
  }
  checks.push_back({.what = "sum of the velocities behind the first strike",
                    .value = momentum,
                    .expected = c.pulled * v,
                    .unit = "m/s",
                    .tolerance = c.discs * tolerance,
                    .remark = "momentum"});
  if (!laws["discs"].dissipation.none()) return checks;
  const std::vector<double> expected =
      velocities_behind_strike({laws["discs"].elastic, c.mass_in_chain(), c.gap}, before);
  for (std::size_t i = 0; i < expected.size(); ++i)
    checks.push_back({.what = fmt::format("velocity of {}", disc_name(static_cast<int>(i))),
                      .value = found[i],
                      .expected = expected[i],
                      .unit = "m/s",
                      .tolerance = tolerance,
                      .remark = "collinear chain"});
  return checks;
}

std::vector<CaseParameter> newtons_cradle_parameters() {
  std::vector<CaseParameter> all = {
      {.name = "discs",
       .quantity = Quantity::number,
       .default_text = "5",
       .low = 2,
       .high = 10,
       .whole = true,
       .description = "in a row"},
      {.name = "pulled",
       .quantity = Quantity::number,
       .default_text = "1",
       .low = 1,
       .high = 9,
       .whole = true,
       .description = "discs that are let go, less than all"},
      {.name = "radius",
       .quantity = Quantity::length,
       .default_text = "20mm",
       .low = 0.1_mm,
       .high = 1000.0_mm,
       .description = "of the discs"},
      {.name = "length",
       .quantity = Quantity::length,
       .default_text = "200mm",
       .low = 1.0_mm,
       .high = 100000.0_mm,
       .description = "pivot to the centre of a disc"},
      {.name = "gap",
       .quantity = Quantity::length,
       .default_text = "0mm",
       .low = 0.0,
       .high = 500.0_mm,
       .description = "between discs that hang, at most half the radius"},
      mass_parameter("mass", "0.25", "of each disc, in kg"),
      {.name = "angle",
       .quantity = Quantity::angle,
       .default_text = "30deg",
       .low = 0.1_deg,
       .high = 89.0_deg,
       .description = "from which they are let go"},
      {.name = "duration",
       .quantity = Quantity::time,
       .default_text = "2s",
       .low = 1e-3,
       .high = 1000.0,
       .description = "of the run"}};
  for (CaseParameter& p : impact_parameters("1e9", "0.95")) all.push_back(std::move(p));
  return all;
}

/// Without loss unless the user asks for one.
ContactChoice cradle_laws() {
  ContactChoice contact = impact_laws([](const Parameters& p) {
    const double r = p.number("radius");
    return std::vector{
        Wall{.name = "discs", .pair = {.pin_radius = r, .wall_radius = r}, .length = 10.0_mm}};
  });
  contact.base = "elastic";
  std::rotate(contact.laws.begin(), contact.laws.end() - 1, contact.laws.end());
  return contact;
}

}  // namespace

Case newtons_cradle_case() {
  return {
      .name = "newtons_cradle",
      .group = "impacts",
      .description = "Newton's cradle: discs that hang side by side strike each other",
      .parameters = newtons_cradle_parameters(),
      .contact = cradle_laws(),
      .default_output = "results/newtons_cradle",
      .model = [](const Parameters& p,
                  const WallLaws& laws) { return newtons_cradle_model(NewtonsCradle(p), laws); },
      .duration = [](const Parameters& p) { return p.number("duration"); },
      .law_checks = newtons_cradle_checks};
}

}  // namespace yoke::cases
