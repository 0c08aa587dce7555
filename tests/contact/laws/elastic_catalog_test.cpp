// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The catalog of elastic laws: names, readings, what each formula gives against its implicit form
// written out here, and properties of every law for random parameters.
#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>

#include <yoke/contact/laws/catalog/elastic_catalog.hpp>
#include <yoke/core/error.hpp>
#include <yoke/core/types.hpp>
#include <yoke/tests/messages.hpp>

using namespace yoke;
using namespace yoke::tests;
using doctest::Approx;

namespace {

/// A pin of 7 mm in a bore of 11 mm or on a wheel of it, 3 mm long.
ElasticArguments some(Conformity conformity, Reading reading) {
  return {.pin = steel,
          .wall = aluminium,
          .pin_radius = 7e-3,
          .wall_radius = 11e-3,
          .conformity = conformity,
          .length = 3e-3,
          .reading = reading};
}

/// Table 1 with its own symbols, in newton and millimetre: h with or without pi.
struct Symbols {
  double E = composite_modulus(steel, aluminium) * 1e-6;  // [N/mm^2]
  double L = 3.0, Ri = 11.0, Rj = 7.0;
  double DR, R;
  explicit Symbols(Conformity c) : DR(c == Conformity::internal ? 4.0 : 18.0), R(77.0 / DR) {}
};

/// Checks the law at 25 N against d [mm] of F [N].
void check_implicit(const char* name, Conformity conformity, Reading reading,
                    const std::function<double(double, const Symbols&)>& penetration,
                    double force = 25.0) {
  CAPTURE(name);
  CAPTURE(name_of(reading));
  CAPTURE(conformity == Conformity::internal);
  const ElasticLaw law = make_elastic(name, some(conformity, reading));
  const double d = penetration(force, Symbols(conformity)) * 1e-3;
  CHECK(law.response(d).force == Approx(force).epsilon(1e-13));
  CHECK(law.name() == name);
}

}  // namespace

TEST_CASE("every law and reading solves its formula") {
  using R = Reading;
  for (const Conformity c : {Conformity::internal, Conformity::external}) {
    for (const Reading r : {R::consistent, R::printed, R::tabulated}) {
      check_implicit("johnson", c, r, [](double F, const Symbols& s) {
        const double W = F / s.L;
        return W / (pi * s.E) * (std::log(4.0 * pi * s.E * s.DR / W) - 1.0);
      });
      const double squared = r == R::tabulated ? 1.6 * 1.6 : 2.0 * 1.6 * 1.6;
      check_implicit("radzimovsky", c, r, [=](double F, const Symbols& s) {
        const double W = F / s.L, b = std::sqrt(squared * W * s.R / s.E);
        return W / (pi * s.E) * (2.0 / 3.0 + std::log(4.0 * s.Ri / b) + std::log(4.0 * s.Rj / b));
      });
      const double h = r == R::consistent ? 1.0 / pi : 1.0;
      check_implicit("esdu-78035", c, r, [=](double F, const Symbols& s) {
        const double W = F / s.L, H = h / s.E, DR = r == R::consistent ? s.DR : s.Ri - s.Rj;
        return W * H * (std::log(4.0 * s.L * DR / (F * H)) + 1.0);
      });
      check_implicit("lankarani-nikravesh", c, r, [=](double F, const Symbols& s) {
        const double E = r == R::tabulated ? pi * s.E * s.L / 10.0 : s.E;
        return std::pow(3.0 * F / (4.0 * E * std::sqrt(s.R)), 1.0 / 1.5);
      });
    }
    check_implicit("hertz", c, R::consistent, [](double F, const Symbols& s) {
      return std::pow(3.0 * F / (4.0 * s.E * std::sqrt(s.R)), 1.0 / 1.5);
    });
    check_implicit("goldsmith", c, R::consistent, [](double F, const Symbols& s) {
      const double H = 1.0 / (pi * s.E);
      return F / s.L * H * (std::log(std::pow(s.L, 3) / (F * s.R * H)) + 1.0);
    });
    check_implicit("goldsmith", c, R::printed, [](double F, const Symbols& s) {
      return F / s.L / s.E * (std::log(s.L / (F * s.R / s.E)) + 1.0);
    });
    check_implicit("goldsmith", c, R::tabulated, [](double F, const Symbols& s) {
      const double W = F / s.L;
      return W / (pi * s.E) * (std::log(1e8 * pi * s.E / (W * s.R)) + 1.0);
    });
    check_implicit("dubowsky-freudenstein", c, R::printed, [](double F, const Symbols& s) {
      const double a = 0.5 * s.L, h = 1.0 / s.E;
      return pi * h / (2.0 * a) *
             (std::log((s.Ri - s.Rj) * 8.0 * a * a * a / (F * s.Ri * s.Rj * pi * h)) + 1.0) * F;
    });
    check_implicit("dubowsky-freudenstein", c, R::consistent, [](double F, const Symbols& s) {
      const double H = 1.0 / (pi * s.E);
      return H / s.L * (std::log(std::pow(s.L, 3) / (F * s.R * H)) + 1.0) * F;
    });
    for (const Reading r : {R::consistent, R::printed}) {
      check_implicit("pereira-2015", c, r, [=](double F, const Symbols& s) {
        const bool in = c == Conformity::internal;
        const double n = in ? (0.0151 * s.DR + 1.151) * std::pow(s.DR, -0.005) : 1.094;
        const double a = in ? 0.965 : 0.39, b = in ? 0.0965 : 0.85;
        return std::pow(F / ((a * s.DR + b) * s.L * s.E / s.DR), 1.0 / n);
      });
    }
  }
  for (const Reading r : {R::consistent, R::printed})
    check_implicit("pereira-2011", Conformity::internal, r, [=](double F, const Symbols& s) {
      const double n =
          (0.0028 * s.DR + (r == R::printed ? 1.1083 : 1.083)) * std::pow(s.DR, -0.005);
      return std::pow(F / ((0.49 * s.DR + 0.10) * s.L * s.E / s.DR), 1.0 / n);
    });
}

TEST_CASE("Pereira's exponents: both are continuous where the pieces meet, not with the misprint") {
  const auto force = [](const char* name, double DR, Reading reading) {
    return make_elastic(name, {.pin_radius = 20e-3 - DR * 1e-3,
                               .wall_radius = 20e-3,
                               .length = 1e-3,
                               .reading = reading})
        .response(1e-6)
        .force;
  };
  const auto jump = [&](const char* name, double DR, Reading reading) {
    return std::abs(force(name, DR + 1e-9, reading) / force(name, DR - 1e-9, reading) - 1.0);
  };
  CHECK(jump("pereira-2011", 0.75, Reading::consistent) < 2e-3);
  CHECK(jump("pereira-2011", 0.75, Reading::printed) > 0.1);
  CHECK(jump("pereira-2015", 0.34954, Reading::consistent) < 2e-4);
  // The exponent of the small clearances, written out at DR = 0.1 mm.
  const auto exponent = [](const char* name) {
    const ElasticLaw law =
        make_elastic(name, {.pin_radius = 19.9e-3, .wall_radius = 20e-3, .length = 1e-3});
    const ElasticResponse at = law.response(1e-6);
    return at.stiffness * 1e-6 / at.force;
  };
  const double Y_factor = std::pow(0.1, -0.005);
  CHECK(exponent("pereira-2011") ==
        Approx(1.56 * std::pow(std::log(100.0), -0.192) * Y_factor).epsilon(1e-12));
  CHECK(exponent("pereira-2015") ==
        Approx(1.51 * std::pow(std::log(100.0), -0.151) * Y_factor).epsilon(1e-12));
  CHECK(force("pereira-2011", 0.005, Reading::consistent) > 0.0);
  CHECK(force("pereira-2011", 10.0, Reading::consistent) > 0.0);
}

TEST_CASE("Pereira's law of 2011 is a fit to Johnson's as corrected, not as printed") {
  for (const double DR : {0.75, 1.0, 2.0, 5.0, 10.0})
    for (const double load : {10.0, 100.0, 1000.0}) {
      CAPTURE(DR);
      CAPTURE(load);
      ElasticArguments given{.pin_radius = 20e-3 - DR * 1e-3, .wall_radius = 20e-3, .length = 1e-3};
      const double d = make_elastic("johnson", given).penetration_at(load);
      const double corrected = make_elastic("pereira-2011", given).response(d).force / load;
      given.reading = Reading::printed;
      const double printed = make_elastic("pereira-2011", given).response(d).force / load;
      CHECK(corrected > 0.82);
      CHECK(corrected < 1.05);
      CHECK(printed < 0.87);
    }
}

TEST_CASE("ESDU with pi is Johnson's law plus 2 W/(pi E*), and Dubowsky-Freudenstein Goldsmith's") {
  const ElasticArguments given = some(Conformity::external, Reading::consistent);
  const ElasticLaw esdu = make_elastic("esdu-78035", given),
                   johnson = make_elastic("johnson", given);
  const double F = 137.0, extra = 2.0 * F / (pi * composite_modulus(steel, aluminium) * 3e-3);
  CHECK(esdu.penetration_at(F) - johnson.penetration_at(F) == Approx(extra).epsilon(1e-10));
  CHECK(make_elastic("goldsmith", given).response(1e-6).force ==
        Approx(make_elastic("dubowsky-freudenstein", given).response(1e-6).force).epsilon(1e-14));
}

TEST_CASE("the laws end where the closed forms say") {
  const auto limit = [](const char* name, Reading reading) {
    return make_elastic(name, some(Conformity::internal, reading)).limit();
  };
  const double e = std::numbers::e, DR = 4e-3, R = 77e-6 / DR;
  CHECK(limit("johnson", Reading::consistent) == Approx(4.0 / (e * e) * DR));
  CHECK(limit("radzimovsky", Reading::consistent) == Approx(0.7127 * DR).epsilon(1e-4));
  CHECK(limit("radzimovsky", Reading::tabulated) == Approx(1.4254 * DR).epsilon(1e-4));
  CHECK(limit("esdu-78035", Reading::printed) == Approx(4.0 * DR));
  CHECK(limit("goldsmith", Reading::consistent) == Approx(9e-6 / R));
  CHECK(limit("goldsmith", Reading::printed) == Approx(1e-6 / R));
  CHECK(limit("dubowsky-freudenstein", Reading::consistent) == Approx(9e-6 / R));
  CHECK(std::isinf(limit("pereira-2011", Reading::consistent)));
}

TEST_CASE("the catalog has the names of the contract and a complete note of each") {
  const char* names[] = {"hertz",     "lankarani-nikravesh",   "radzimovsky",
                         "goldsmith", "dubowsky-freudenstein", "esdu-78035",
                         "johnson",   "pereira-2011",          "pereira-2015",
                         "power"};
  REQUIRE(elastic_catalog().size() == std::size(names));
  for (std::size_t i = 0; i < std::size(names); ++i) {
    const ElasticNote& note = elastic_catalog()[i];
    CHECK(note.name == names[i]);
    CHECK(!note.title.empty());
    CHECK(!note.formula.empty());
    CHECK(!note.source.empty());
    CHECK(!note.validity.empty());
    CHECK(!note.caveats.empty());
    CHECK(!note.parameters.empty());
    CHECK(note.readings.front() == Reading::consistent);
    CHECK(&find_elastic(names[i]) == &find_elastic(names[i]));
    CHECK(elastic_warning(names[i], Reading::consistent).empty());
  }
  CHECK(contains(elastic_warning("goldsmith", Reading::tabulated), "1e8"));
  CHECK(contains(elastic_warning("esdu-78035", Reading::printed), "pi times too soft"));
  CHECK(elastic_warning("power:K=1e8,n=1.5", Reading::consistent).empty());
  for (const Reading reading : {Reading::consistent, Reading::printed, Reading::tabulated})
    CHECK(reading_named(name_of(reading)) == reading);
}

TEST_CASE("a power law is given by its constants") {
  const ElasticArguments none;
  CHECK(make_elastic("power:K=1e8,n=1.5", none).response(1e-4).force == Approx(100.0));
  CHECK(make_elastic("power:n=1.10,unit=mm,K=4.907e4", none).response(0.03e-3).force ==
        Approx(4.907e4 * std::pow(0.03, 1.10)));
}

TEST_CASE("wrong names, readings and numbers are refused by name, value and range") {
  const auto refuses = [](const char* text, const ElasticArguments& given = {}) {
    return message_of([&] { make_elastic(text, given); });
  };
  CHECK(contains(refuses("hetz"), "unknown elastic law 'hetz'; there are hertz, lankarani"));
  CHECK(contains(refuses("power"), "power:K=1e8,n=1.5"));
  CHECK(contains(refuses("power:K=1e8"), "power:K=1e8,n=1.5"));
  CHECK(contains(refuses("power:K=1e8,m=2"), "'m' is not one of K, n, unit"));
  CHECK(contains(refuses("power:K=1e8x,n=2"), "K = '1e8x' must be a number"));
  CHECK(contains(refuses("power:K=1e8,n=0.5"), "n = 0.5 is outside the accepted range 1 to 10"));
  CHECK(contains(refuses("power:K=-1,n=2,unit=mm"), "K = -1 N/mm^n must be finite"));
  CHECK(contains(refuses("power:K=1,n=2,K=3"), "K is given twice"));
  CHECK(contains(refuses("power:K=1,n=2,unit=cm"), "unit = 'cm' must be m or mm"));
  CHECK(contains(refuses("johnson"), "law 'johnson': pin_radius = 0 m"));
  ElasticArguments given = some(Conformity::internal, Reading::consistent);
  given.length = -2.0;
  for (const char* name : {"radzimovsky", "goldsmith", "dubowsky-freudenstein", "esdu-78035",
                           "johnson", "pereira-2011", "pereira-2015"})
    CHECK(contains(refuses(name, given), fmt::format("law '{}': length = -2 m", name)));
  given.length = 1e-3;
  given.wall_radius = 18e-3;
  CHECK(contains(refuses("pereira-2011", given),
                 "law 'pereira-2011': radius_difference = 11 mm is outside the accepted range "
                 "0.005 to 10 mm"));
  given.conformity = Conformity::external;
  CHECK(contains(refuses("pereira-2011", given), "conformity = external must be internal"));
  given.wall_radius = given.pin_radius;
  given.reading = Reading::printed;
  CHECK(contains(refuses("esdu-78035", given), "wall_radius - pin_radius = 0 m must be"));
  CHECK(contains(refuses("hertz", given),
                 "law 'hertz': reading = printed does not exist; there is consistent"));
  given.reading = Reading::tabulated;
  CHECK(contains(refuses("dubowsky-freudenstein", given),
                 "reading = tabulated does not exist; there is consistent, printed"));
  CHECK(contains(message_of([] { reading_named("right"); }), "consistent, printed, tabulated"));
}

TEST_CASE("every law in every reading: monotone, zero at zero, its derivatives, no NaN") {
  std::mt19937_64 generator(20221022);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const auto between = [&](double low, double high) {  // evenly in the logarithm
    return low * std::pow(high / low, uniform(generator));
  };
  long cases = 0;
  int bad_nan = 0, bad_zero = 0, bad_monotone = 0, bad_stiffness = 0, bad_energy = 0;
  for (const ElasticNote& note : elastic_catalog()) {
    for (const Reading reading : note.readings) {
      for (int i = 0; i < 600; ++i) {
        const bool internal = note.name == "pereira-2011" || uniform(generator) < 0.5;
        ElasticArguments given{.pin = {between(1e9, 5e11), 0.49 * uniform(generator), "pin"},
                               .wall = {between(1e9, 5e11), 0.49 * uniform(generator), "wall"},
                               .pin_radius = between(1e-3, 1.0),
                               .conformity = internal ? Conformity::internal : Conformity::external,
                               .length = between(1e-4, 1.0),
                               .reading = reading};
        given.wall_radius =
            internal ? given.pin_radius + between(6e-6, 9.9e-3) : between(1e-3, 1.0);
        const std::string text =
            note.name == "power"
                ? fmt::format("power:K={},n={}", between(1e3, 1e13), 1.0 + 2.0 * uniform(generator))
                : note.name;
        const ElasticLaw law = make_elastic(text, given);
        const double end = std::min(law.limit(), 0.1);
        if (law.response(0.0).force != 0.0 || law.response(0.0).energy != 0.0) ++bad_zero;
        for (int k = 0; k < 10; ++k, ++cases) {
          const double d = k == 0   ? end
                           : k == 1 ? end * between(1e-300, 1e-6)
                           : k == 2 ? end * (1.0 - between(1e-16, 1e-3))
                                    : end * between(1e-9, 1.0);
          const ElasticResponse at = law.response(d);
          if (!std::isfinite(at.force) || std::isnan(at.stiffness) || !std::isfinite(at.energy) ||
              at.force < 0.0 || at.stiffness < 0.0 || at.energy < 0.0)
            ++bad_nan;
          if (!(law.response(std::nextafter(0.999 * d, 0.0)).force <= at.force)) ++bad_monotone;
          if (k < 3 || d > 0.9 * end) continue;  // differences need room on both sides
          const double h = 1e-5 * d;
          const ElasticResponse up = law.response(d + h), down = law.response(d - h);
          const double stiffness = (up.force - down.force) / (2.0 * h);
          const double force = (up.energy - down.energy) / (2.0 * h);
          if (!(std::abs(stiffness / at.stiffness - 1.0) < 2e-8)) ++bad_stiffness;
          if (!(std::abs(force / at.force - 1.0) < 2e-8)) ++bad_energy;
        }
      }
    }
  }
  CHECK(cases >= 100000);
  CHECK(bad_nan == 0);
  CHECK(bad_zero == 0);
  CHECK(bad_monotone == 0);
  CHECK(bad_stiffness == 0);
  CHECK(bad_energy == 0);
}
