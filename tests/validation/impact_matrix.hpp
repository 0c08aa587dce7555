// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// One impact through the engine against its reference. The whole matrix is in impacts_test.cpp
// (label validation), every law at least once in tests/cases/jobs/impacts_test.cpp.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include <yoke/cases/jobs/impact.hpp>
#include <yoke/contact/laws/catalog/dissipative_catalog.hpp>
#include <yoke/contact/laws/catalog/elastic_catalog.hpp>
#include <yoke/tests/validation/impact_reference.hpp>

namespace yoke::reference {

inline constexpr double promise = 1e-8;  // relative, at rtol 1e-12
inline constexpr const char* integrators[] = {"arkode-projection", "ida-ggl"};

/// Laws that pull at the end.
inline bool pulls(const std::string& law) {
  return law == "kelvin-voigt" || law == "tsuji" || law == "exact-restitution" ||
         law == "lee-wang-2";
}

/// What the impact must give; nothing where the law refuses.
inline std::optional<Expected> expected_of(const std::string& law, const Spring& spring, double e,
                                           bool clamp) {
  if (law == "marhefka-orin-simplified" && e < 0.34) return std::nullopt;
  if (law == "none") return indentation(spring, 1.0);
  if (law == "lankarani-nikravesh-1994" || law == "gharib-hurmuzlu-2")
    return indentation(spring, e);
  if (law == "lee-wang-2") return lee_wang_2(spring.K, e, 3.0, 0.1, clamp);
  if (pulls(law)) return oscillator(spring, e, clamp);
  const auto found = proportional.find(law);
  REQUIRE_MESSAGE(found != proportional.end(), law << " has no reference");
  return proportional_impact(spring, found->second(e));
}

/// Largest relative error of each number.
struct Worst {
  double restitution = 0.0, penetration = 0.0, force = 0.0, duration = 0.0, dissipated = 0.0,
         kinetic = 0.0, set = 0.0, momentum = 0.0;
  int impacts = 0;
};

inline void check_impact(const std::string& law, const Spring& spring, double e,
                         const Expected& expected, bool clamp, cases::CentralImpact::Setup setup,
                         const std::string& formulation, Worst& worst) {
  INFO(law, " ", spring.specification, " e = ", e, std::string(clamp ? " clamped " : " "),
       cases::name_of(setup), " ", formulation);
  const ContactLaw contact{
      make_elastic(spring.specification,
                   {.pin_radius = 7.9e-3, .wall_radius = 8e-3, .length = 10e-3}),
      make_dissipative(
          law, {.restitution = e, .tensile = clamp ? TensilePhase::clamp : TensilePhase::keep})};
  const cases::ImpactOutcome x = cases::simulate_impact(
      {.law = contact, .speed = v, .mass = m, .setup = setup, .formulation = formulation});
  const auto check = [](const char* what, double error, double limit, double& largest) {
    largest = std::max(largest, error);
    CHECK_MESSAGE(error <= limit, std::string(what));
  };
  const auto relative = [](double value, double reference) {
    return std::abs(value / reference - 1.0);
  };
  check("restitution", relative(x.restitution, expected.restitution), promise, worst.restitution);
  check("largest penetration", relative(x.max_penetration, expected.penetration), promise,
        worst.penetration);
  check("largest force", relative(x.max_force, expected.force), promise, worst.force);
  check("duration", relative(x.duration, expected.duration), promise, worst.duration);
  const double loss = energy * (1.0 - expected.restitution) * (1.0 + expected.restitution);
  check("dissipated", std::abs(x.dissipated - loss) / energy, promise, worst.dissipated);
  check("kinetic", std::abs(x.kinetic_loss - loss) / energy, promise, worst.kinetic);
  check("permanent set", std::abs(x.permanent_set - expected.set) / expected.penetration, promise,
        worst.set);
  // Two bodies on a line: to rounding. In a slot the normal is a computed direction.
  check("momentum", x.momentum_error, setup == cases::CentralImpact::Setup::slot ? 1e-12 : 1e-13,
        worst.momentum);
  ++worst.impacts;
}

inline void report(const std::string& what, const Worst& w) {
  MESSAGE(what << ": " << w.impacts << " impacts, largest relative errors: restitution "
               << w.restitution << ", penetration " << w.penetration << ", force " << w.force
               << ", duration " << w.duration << ", dissipated " << w.dissipated
               << ", kinetic loss " << w.kinetic << ", permanent set " << w.set << ", momentum "
               << w.momentum);
}

}  // namespace yoke::reference
