// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Newton's cradle against a collinear chain integrated with 34 digits.
#include <doctest/doctest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>

#include <yoke/cases/impacts/newtons_cradle.hpp>
#include <yoke/contact/laws/elastic/power_law.hpp>
#include <yoke/tests/cases/impacts/impact_case.hpp>
#include <yoke/tests/messages.hpp>

namespace {

using namespace yoke;
using namespace yoke::cases;
using yoke::tests::contains;
using yoke::tests::impact_run;
using yoke::tests::message_of;
using Quad = boost::multiprecision::number<boost::multiprecision::cpp_bin_float_quad::backend_type,
                                           boost::multiprecision::et_off>;
using Row = std::vector<Quad>;

/// m = K = 1, n = 3/2, `struck` of the discs come with 1: scaled, as the velocities behind depend on
/// nothing else. Runge and Kutta's method; its error is that of the steps over d^(3/2) at 0, about
/// (1/1000)^2.5.
std::vector<double> chain_in_quad(std::size_t discs, std::size_t struck, const Quad& gap) {
  Row x(discs, Quad(0)), v(discs, Quad(0));
  for (std::size_t i = 0; i < struck; ++i) x[i] = gap, v[i] = 1;
  const auto forces = [&](const Row& at) {
    Row a(discs, Quad(0));
    for (std::size_t i = 0; i + 1 < discs; ++i) {
      const Quad d = at[i] - at[i + 1] - gap;
      if (d <= 0) continue;
      const Quad f = d * sqrt(d);
      a[i] -= f;
      a[i + 1] += f;
    }
    return a;
  };
  const auto shifted = [&](const Row& y, const Quad& h, const Row& dy) {
    Row sum = y;
    for (std::size_t i = 0; i < discs; ++i) sum[i] += h * dy[i];
    return sum;
  };
  const Quad h = Quad(1) / 400;  // an impact of two lasts about 3
  for (int step = 0; step < 100000; ++step) {
    const Row a1 = forces(x), x2 = shifted(x, h / 2, v), v2 = shifted(v, h / 2, a1),
              a2 = forces(x2), x3 = shifted(x, h / 2, v2), v3 = shifted(v, h / 2, a2),
              a3 = forces(x3), x4 = shifted(x, h, v3), v4 = shifted(v, h, a3), a4 = forces(x4);
    bool over = true;
    for (std::size_t i = 0; i < discs; ++i) {
      x[i] += h / 6 * (v[i] + 2 * v2[i] + 2 * v3[i] + v4[i]);
      v[i] += h / 6 * (a1[i] + 2 * a2[i] + 2 * a3[i] + a4[i]);
    }
    for (std::size_t i = 0; i + 1 < discs; ++i)
      over = over && x[i] - x[i + 1] <= gap && v[i] <= v[i + 1];
    if (over) break;
  }
  std::vector<double> end;
  for (const Quad& w : v) end.push_back(w.convert_to<double>());
  return end;
}

TEST_CASE("newton's cradle: the chain it is compared with, by itself") {
  // Five discs that touch: the velocities behind the strike in parts of that before.
  const std::vector<double> quad = chain_in_quad(5, 1, 0);
  CHECK(quad.back() == doctest::Approx(0.98877).epsilon(1e-4));
  const CollinearChain chain{PowerLaw{3e8, 1.5}, 0.7};
  const std::vector<double> found = velocities_behind_strike(chain, {2.0, 0.0, 0.0, 0.0, 0.0});
  REQUIRE(found.size() == 5);
  for (std::size_t i = 0; i < 5; ++i) CHECK(std::abs(found[i] / 2.0 - quad[i]) < 1e-7);
  // Two exchange their velocities; apart, only the last leaves.
  const std::vector<double> two = velocities_behind_strike(chain, {1.0, 0.0});
  REQUIRE(two.size() == 2);
  CHECK(std::abs(two[0]) < 1e-9);
  CHECK(two[1] == doctest::Approx(1.0).epsilon(1e-9));
  const std::vector<double> wide =
      velocities_behind_strike({PowerLaw{3e8, 1.5}, 0.7, 1e-3}, {1.0, 0.0, 0.0, 0.0});
  REQUIRE(wide.size() == 4);
  CHECK(wide.back() == doctest::Approx(1.0).epsilon(1e-8));
}

TEST_CASE("newton's cradle: the strike is that of a chain") {
  struct Variant {
    std::size_t discs, pulled;
  };
  for (const Variant& x : {Variant{2, 1}, {3, 1}, {5, 1}, {5, 2}, {10, 1}}) {
    CAPTURE(x.discs);
    // Long pendulums and stiff discs: they do not leave their places during the strike.
    const double duration = 1.61;  // a quarter of the period is 1.59 s
    const auto run =
        impact_run("newtons_cradle",
                   {fmt::format("discs={}", x.discs), fmt::format("pulled={}", x.pulled),
                    "length=10m", "angle=10deg", "stiffness=1e12"},
                   "elastic", {.until = duration, .samples = 4001});
    const std::vector<double> quad = chain_in_quad(x.discs, x.pulled, 0);
    const Eigen::Index last = static_cast<Eigen::Index>(run.result.samples.rows()) - 1;
    const double w = std::sqrt(9.81 / 10.0), v = 2.0 * w * 10.0 * std::sin(0.5 * 10.0 * pi / 180.0);
    double begin = duration;
    for (const EventRecord& e : run.result.events)
      if (e.kind == "onset" && e.t > 1.0) begin = std::min(begin, e.t);
    const double swing = w * (duration - begin);
    CHECK(swing < 0.05);
    for (std::size_t i = 0; i < x.discs; ++i) {
      // Each pendulum has gone on for `swing`: its velocity along the circle is cos(swing) of that
      // behind the strike, but for the fourth order and the disc's inertia (2e-6 of w^2).
      const std::string disc = fmt::format("disc {}", i + 1);
      const double along = run.result[disc + ".omega_rad_per_s"][last] * 10.0;
      CHECK(std::abs(along / v / std::cos(swing) - quad[i]) < 1e-5);
    }
  }
}

TEST_CASE("newton's cradle: energy stays without loss, the discs end together with loss") {
  const auto elastic = impact_run("newtons_cradle", {"duration=4s"});
  CHECK(elastic.result["dissipated_J"].cwiseAbs().maxCoeff() == 0.0);
  const auto lossy =
      impact_run("newtons_cradle", {"restitution=0.6", "discs=3", "duration=12s"}, "restitution");
  const Eigen::VectorXd first = lossy.result["disc 1.omega_rad_per_s"],
                        last = lossy.result["disc 3.omega_rad_per_s"];
  const Eigen::Index n = first.size();
  CHECK((first - last).tail(n / 10).cwiseAbs().maxCoeff() <
        0.05 * last.head(n / 10 * 3).maxCoeff());
  CHECK(last.tail(n / 10).maxCoeff() > 0.1);
}

TEST_CASE("newton's cradle: what does not fit is refused") {
  const Case& c = find_case("newtons_cradle");
  const auto refusal = [&](const std::vector<std::string>& settings) {
    return message_of([&] { make_model(c, Parameters(c.parameters, settings)); });
  };
  CHECK(contains(refusal({"discs=3", "pulled=3"}), "pulled = 3 must be from 1 to 2"));
  CHECK(contains(refusal({"gap=11mm"}), "gap = 11 mm must be from 0 to 10 mm"));
  CHECK(contains(refusal({"radius=300mm"}), "radius = 300 mm must be less than length = 200 mm"));
}

}  // namespace
