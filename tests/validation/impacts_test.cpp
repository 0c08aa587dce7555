// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Central impacts through the engine against closed forms and quadratures: every dissipative law x
// every elastic law that fits x restitution x both integrators, in four geometries. And how the
// error falls as the tolerance is tightened.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include <yoke/tests/validation/impact_matrix.hpp>

namespace {

using namespace yoke;
using namespace yoke::cases;
using namespace yoke::reference;

void check_all(CentralImpact::Setup setup, bool clamp) {
  Worst worst;
  for (const DissipativeNote& note : dissipative_catalog()) {
    if (clamp && !pulls(note.name)) continue;
    for (const Spring& spring : springs()) {
      if (note.linear_only && spring.n != 1.0) continue;
      for (const double e : asked) {
        if (note.name == "none" && e != asked[0]) continue;
        const auto expected = expected_of(note.name, spring, e, clamp);
        if (!expected) continue;
        for (const char* formulation : integrators)
          check_impact(note.name, spring, e, *expected, clamp, setup, formulation, worst);
      }
    }
  }
  report(name_of(setup), worst);
}

}  // namespace

TEST_CASE("every law, two free bodies") { check_all(CentralImpact::Setup::two_bodies, false); }
TEST_CASE("every law, a ball on a fixed wall") { check_all(CentralImpact::Setup::wall, false); }
TEST_CASE("every law, a pin on the wall of a free slot") {
  check_all(CentralImpact::Setup::slot, false);
}
TEST_CASE("every law, a physical pendulum on a stop") {
  check_all(CentralImpact::Setup::pendulum, false);
}
TEST_CASE("laws that pull, let go where the force vanishes") {
  for (const CentralImpact::Setup setup : all_setups) check_all(setup, true);
}

TEST_CASE("lee-wang-2 let go where the force vanishes presses again, whatever its transition") {
  Worst worst;
  const double K = 1e8;
  for (const double q : {0.5, 2.0, 3.0, 4.0, 8.0})
    for (const double share : {0.02, 0.1, 0.5})
      for (const double e : asked) {
        const Expected expected = lee_wang_2(K, e, q, share, true);
        const ContactLaw law{
            make_elastic("power:K=1e8,n=1", {}),
            make_dissipative(
                "lee-wang-2",
                {.restitution = e, .q = q, .epsilon = share, .tensile = TensilePhase::clamp})};
        for (const std::string formulation : integrators) {
          INFO("q = ", q, " epsilon = ", share, " e = ", e, " ", formulation);
          const ImpactOutcome x =
              simulate_impact({.law = law, .speed = v, .mass = m, .formulation = formulation});
          const double error = std::abs(x.restitution / expected.restitution - 1.0);
          worst.restitution = std::max(worst.restitution, error);
          CHECK(error <= promise);
          ++worst.impacts;
        }
      }
  report("lee-wang-2", worst);
}

namespace {

/// Slope of log y over log x by least squares.
double slope(const std::vector<double>& x, const std::vector<double>& y) {
  const double count = static_cast<double>(x.size());
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double a = std::log(x[i]), b = std::log(y[i]);
    sx += a, sy += b, sxx += a * a, sxy += a * b;
  }
  return (count * sxy - sx * sy) / (count * sxx - sx * sx);
}

}  // namespace

// The error of the restitution over the number of steps is the order of the method, over the
// tolerance the proportionality that the tolerance promises (slope 1).
TEST_CASE("the error of an impact falls with the order of the method, and with the tolerance") {
  const double e = 0.7;
  for (const std::string law : {"hunt-crossley", "tsuji", "lankarani-nikravesh-1994", "lee-wang-2"})
    for (const auto& [formulation, wanted] : {std::pair<std::string, int>{"arkode-projection", 5},
                                              {"arkode-projection", 7},
                                              {"ida-ggl", 0}}) {
      const Spring spring = springs()[law == "lee-wang-2" ? 0 : 1];
      const double exact = expected_of(law, spring, e, false)->restitution;
      const ContactLaw contact{make_elastic(spring.specification, {}),
                               make_dissipative(law, {.restitution = e})};
      std::vector<double> tolerances, errors, steps;
      for (double rtol = 1e-5; rtol > 0.9e-10; rtol /= std::sqrt(10.0)) {
        const ImpactOutcome x = simulate_impact({.law = contact,
                                                 .speed = v,
                                                 .mass = m,
                                                 .relative_tolerance = rtol,
                                                 .formulation = formulation,
                                                 .order = wanted});
        const double error = std::abs(x.restitution / exact - 1.0);
        if (error < 1e-13) continue;  // rounding
        tolerances.push_back(rtol);
        errors.push_back(error);
        steps.push_back(static_cast<double>(x.steps));
      }
      const double order = -slope(steps, errors), share = slope(tolerances, errors);
      MESSAGE(law << ", " << formulation << " " << wanted << ": order " << order
                  << ", error over tolerance " << share << ", errors " << errors.front() << " to "
                  << errors.back());
      // BDF up to order 5, whose error goes with the tolerance to 5/6.
      CHECK(order > (wanted == 7 ? 6.5 : 4.5));
      CHECK(share > 0.7);
      CHECK(share < 1.4);
    }
}
