// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <yoke/contact/laws/catalog/table11.hpp>
#include <yoke/contact/laws/elastic/hertz.hpp>
#include <yoke/contact/laws/elastic/johnson.hpp>
#include <yoke/contact/laws/elastic/power_law.hpp>
#include <yoke/core/error.hpp>
#include <yoke/core/types.hpp>
#include <yoke/tests/messages.hpp>

using namespace yoke;
using namespace yoke::tests;
using doctest::Approx;

namespace {

/// Johnson's law as he gives it: penetration of force.
double johnson_penetration(double force, const Johnson& law) {
  const double w = force / law.length;
  return w / (pi * law.modulus) *
         (std::log(4.0 * pi * law.modulus * law.radius_difference / w) - 1.0);
}

void check_derivatives(const ElasticLaw& law, double d) {
  CAPTURE(law.name());
  CAPTURE(d);
  const double h = 1e-6 * d;
  const ElasticResponse at = law.response(d), up = law.response(d + h), down = law.response(d - h);
  CHECK(at.stiffness == Approx((up.force - down.force) / (2.0 * h)).epsilon(1e-7));
  CHECK(at.force == Approx((up.energy - down.energy) / (2.0 * h)).epsilon(1e-7));
}

const Johnson cap_johnson{113736.26e6, 0.1e-3, 10e-3};

}  // namespace

TEST_CASE("stiffness and energy of the elastic laws belong to their force") {
  const RoundPair bore{.pin_radius = 7.9e-3,
                       .wall_radius = 68e-3,
                       .conformity = Conformity::internal,
                       .wall = aluminium};
  for (const ElasticLaw& law :
       {ElasticLaw(PowerLaw{3.7e8, 1.043}), ElasticLaw(per_mm(49070, 1.10)),
        ElasticLaw(hertz(bore)), ElasticLaw(johnson(bore, 3.3e-3)), ElasticLaw(cap_johnson)})
    for (const double d : {1.7e-9, 3.1e-7, 2.3e-6, 4.9e-5}) check_derivatives(law, d);
}

TEST_CASE("a user's own function is an elastic law") {
  const ElasticLaw law = [](double d) {
    return ElasticResponse{7.0 * d + 3.0 * d * d, 7.0 + 6.0 * d, 3.5 * d * d + d * d * d};
  };
  check_derivatives(law, 0.37);
  CHECK(std::isinf(law.limit()));
  CHECK(law.response(-0.37).force == -law.response(0.37).force);
}

TEST_CASE("an elastic law continues oddly below zero, without NaN") {
  for (const ElasticLaw& law : {ElasticLaw(per_mm(17430, 1.04)), ElasticLaw(cap_johnson)}) {
    const ElasticResponse plus = law.response(3.3e-6), minus = law.response(-3.3e-6);
    CHECK(minus.force == -plus.force);
    CHECK(minus.stiffness == plus.stiffness);
    CHECK(minus.energy == plus.energy);
    for (const double tiny : {0.0, -0.0, 1e-320, -1e-320, 1e-200}) {
      CAPTURE(tiny);
      CHECK(std::abs(law.response(tiny).force) < 1e-190);
      CHECK(std::isfinite(law.response(tiny).stiffness));
      CHECK(law.response(tiny).energy >= 0.0);
    }
  }
}

TEST_CASE("a constant in newton per millimetre^n gives the force of a penetration in millimetres") {
  // Table 11, Johnson, outer wall, at 0.03 mm: by hand 4.907e4 * 0.03^1.10 N.
  CHECK(ElasticLaw(per_mm(4.907e4, 1.10)).response(0.03e-3).force ==
        Approx(4.907e4 * std::pow(0.03, 1.10)));
  CHECK(per_mm(1.220e5, 1.5).K == Approx(1.220e5 * 31622.7766016838));
}

TEST_CASE("Johnson's law is inverted to rounding over its whole range") {
  double worst = 0.0;
  for (double share = 1e-12; share < 1.0; share = share < 0.5 ? share * 1.13 : share + 0.003) {
    const double d = share * cap_johnson.limit();
    const double back = johnson_penetration(cap_johnson(d).force, cap_johnson);
    worst = std::max(worst, std::abs(back / d - 1.0));
  }
  CHECK(worst < 4e-15);
}

TEST_CASE("Johnson's law ends where its stiffness becomes infinite") {
  // Slot end of the scotch-yoke, 10 mm long: d = 0.0541 mm and F = 193 kN, 4 pi E* DR L/e^2.
  CHECK(cap_johnson.limit() == Approx(0.054134e-3).epsilon(1e-4));
  const ElasticLaw law = cap_johnson;
  CHECK(law.limit() == cap_johnson.limit());
  CHECK(law.response(law.limit()).force == Approx(193.44e3).epsilon(1e-4));
  CHECK(law.response(0.999999 * law.limit()).stiffness > 100.0 * law.response(1e-6).stiffness);
  CHECK(std::isnan(law.response(1.000001 * law.limit()).force));
  CHECK(std::isnan(law.response(-1.000001 * law.limit()).force));
}

TEST_CASE("the laws of a pin on a wall take the relative curvature from the radii") {
  CHECK(composite_modulus(steel, steel) == Approx(113736.26e6).epsilon(1e-7));
  CHECK(composite_modulus(aluminium, aluminium) == Approx(39277.30e6).epsilon(1e-7));
  RoundPair pair{.pin_radius = 7.9e-3, .wall_radius = 52e-3};
  CHECK(johnson(pair, 0.01).radius_difference == Approx(59.9e-3));
  pair.wall_radius = 68e-3;
  pair.conformity = Conformity::internal;
  CHECK(johnson(pair, 0.01).radius_difference == Approx(60.1e-3));
  // Hertz, 4/3 E* sqrt(R), R = 8.9384 mm: 453386 N/mm^1.5.
  CHECK(hertz(pair).K == Approx(per_mm(453386, 1.5).K).epsilon(1e-5));
}

TEST_CASE("Table 11 is what is printed, scaled by the caller") {
  CHECK(table11_names().size() == 5);
  const Table11 johnson_fit = table11("table11-johnson");
  CHECK(johnson_fit.inner.K == per_mm(49140, 1.10).K);
  CHECK(johnson_fit.cap.n == 1.28);
  CHECK(table11("table11-esdu-78035", 10.0).outer.K == Approx(per_mm(125400, 1.09).K));
  CHECK(ElasticLaw(johnson_fit.outer).name() == "table11-johnson");
  CHECK(contains(message_of([] { table11("table11-hertz"); }), "table11-goldsmith"));
}

TEST_CASE("penetration under a force inverts any law") {
  const ElasticLaw power = per_mm(49070, 1.10), exact = cap_johnson;
  CHECK(power.penetration_at(100.0) == Approx(1e-3 * std::pow(100.0 / 49070, 1.0 / 1.10)));
  CHECK(exact.response(exact.penetration_at(777.0)).force == Approx(777.0).epsilon(1e-9));
  CHECK(exact.penetration_at(1e9) == exact.limit());
}

TEST_CASE("wrong parameters of an elastic law are refused by name, value and range") {
  const auto refuses = [](const PowerLaw& law) { return message_of([&] { ElasticLaw{law}; }); };
  CHECK(contains(refuses({-3.0, 1.5}), "law 'power-law': K = -3 N/m^n must be finite and greater"));
  CHECK(contains(refuses({3e9, 0.9}), "n = 0.9"));
  CHECK(contains(refuses({3e9, std::numeric_limits<double>::quiet_NaN()}), "n = nan"));
  CHECK(contains(message_of([] {
                   ElasticLaw{Johnson{1e11, 0.0, 0.01}};
                 }),
                 "law 'johnson': radius_difference = 0 m"));
  RoundPair pair{.pin_radius = 8e-3, .wall_radius = 7.9e-3, .conformity = Conformity::internal};
  CHECK(message_of([&] { johnson(pair, 0.01); }) ==
        "law 'johnson': pin_radius = 0.008 m must be smaller than wall_radius = 0.0079 m for an "
        "internal contact");
  pair.conformity = Conformity::external;
  pair.pin = {.E = 2e11, .nu = 0.6, .name = "putty"};
  CHECK(contains(message_of([&] { hertz(pair); }), "material 'putty': nu = 0.6"));
}

TEST_CASE("a pin on a plane: Hertz' law knows it, laws of cylinders say what they need") {
  const RoundPair plane = pair_of(8e-3, 0.0), large = pair_of(8e-3, 1e-9);
  CHECK(plane.conformity == Conformity::external);
  CHECK(plane.relative_radius() == 8e-3);
  CHECK(hertz(plane).K == doctest::Approx(hertz(large).K).epsilon(1e-10));
  CHECK_NOTHROW(johnson(large, 10e-3));
  CHECK(yoke::tests::message_of([&] {
          johnson(plane, 10e-3);
        }).find("law 'johnson': wall_radius = inf m: on a plane") == 0);
  const RoundPair bore = pair_of(8e-3, -100.0);
  CHECK(bore.conformity == Conformity::internal);
  CHECK(bore.wall_radius == doctest::Approx(10e-3));
}
