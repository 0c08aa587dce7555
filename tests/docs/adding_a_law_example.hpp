// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The code printed in docs/adding_a_law.md, block by block. documentation_test.cpp compares and
// runs it. The last part stands in for the catalogs, which are inside the library.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <yoke/contact/geometry/arc_slot.hpp>
#include <yoke/contact/laws/law.hpp>
#include <yoke/contact/pin_in_slot.hpp>
#include <yoke/core/error.hpp>
#include <yoke/core/units.hpp>
#include <yoke/integrators/simulate.hpp>

// clang-format off
#include <yoke/contact/laws/catalog/dissipative_catalog.hpp>
#include <yoke/contact/laws/catalog/elastic_catalog.hpp>
#include <yoke/contact/laws/forms/proportional_damping.hpp>
// clang-format on

namespace adding_a_law {

using namespace yoke;
using namespace yoke::literals;

// Palmgren's law of a steel roller on a raceway: d = 3.84e-5 F^0.9/L^0.8 (N, mm), so that
//   F = K d^(10/9),  K = (L^0.8/3.84e-5)^(10/9) N/mm^(10/9)
//   dF/dd = n F/d,   U = F d/(n + 1)
struct Palmgren {
  double length = 0.0;     // [m] of the roller, > 0
  double limit_ = 0.1_mm;  // [m], > 0: not meant for more

  static constexpr double n = 10.0 / 9.0;

  ElasticResponse operator()(double d) const {
    const double L = 1e3 * length, d_mm = 1e3 * d;             // the law's own units
    const double K = std::pow(std::pow(L, 0.8) / 3.84e-5, n);  // N/mm^n
    const double secant = K * std::pow(d_mm, n - 1.0);         // N/mm, zero at d = 0
    const double force = secant * d_mm;
    return {.force = force, .stiffness = 1e3 * n * secant, .energy = force * d / (n + 1.0)};
  }
  double limit() const { return limit_; }
  std::string name() const { return "palmgren"; }
  void check() const {
    require_positive("law 'palmgren'", "length", length, "m");
    require_positive("law 'palmgren'", "limit", limit_, "m");
  }
};

// Zhiying and Qishao 2006: F = F_e (1 + X d'/v_i), X = 3/4 (1 - e^2) exp(2 (1 - e)), as later
// literature quotes it; the original was not at hand.
struct ZhiyingQishao {
  double e = 1.0;                  // 0 <= e <= 1
  double slowest_approach = 1e-3;  // [m/s] > 0, floor of v_i: a contact may begin at rest

  double damping() const { return 0.75 * (1.0 - e * e) * std::exp(2.0 * (1.0 - e)); }  // X

  ContactOutput operator()(const ContactInput& in, const ElasticLaw& elastic) const {
    const double v_i = std::max(in.memory.approach_velocity, slowest_approach);
    return damped_in_proportion(elastic.response(in.penetration), damping() / v_i, in.rate);
  }
  std::string name() const { return "zhiying-qishao"; }
  void check() const {
    require_range("law 'zhiying-qishao'", "e", e, 0.0, 1.0);
    require_positive("law 'zhiying-qishao'", "slowest_approach", slowest_approach, "m/s");
  }
};

// Differences of the force and energy against what the laws say: the largest relative departure.
double departure(const ElasticLaw& elastic, const DissipativeLaw& law) {
  double worst = 0.0;
  const auto compare = [&](double a, double b) {
    worst = std::max(worst, std::abs(a - b) / std::max(std::abs(a), std::abs(b)));
  };
  const ContactMemory memory{
      .phase = ContactPhase::compressing, .approach_velocity = 0.4, .effective_mass = 1.3};
  for (const double d : {1e-7, 3e-6, 5e-5}) {
    const double h = 1e-4 * d, k = 1e-4;
    const ElasticResponse at = elastic.response(d), up = elastic.response(d + h),
                          down = elastic.response(d - h);
    compare(at.stiffness, (up.force - down.force) / (2.0 * h));
    compare(at.force, (up.energy - down.energy) / (2.0 * h));
    for (const double v : {0.3, -0.2}) {
      const auto F = [&](double x, double y) { return law.evaluate({x, y, memory}, elastic); };
      const ContactOutput out = F(d, v);
      compare(out.dforce_dpenetration, (F(d + h, v).force - F(d - h, v).force) / (2.0 * h));
      compare(out.dforce_drate, (F(d, v + k).force - F(d, v - k).force) / (2.0 * k));
      const double stored = (F(d + h, v).stored_energy - F(d - h, v).stored_energy) / (2.0 * h) * v;
      compare(out.force * v, stored + out.dissipated_power);  // the ledger
    }
  }
  return worst;
}

// A steel roller thrown at the wall of an arc slot that is fixed to the ground: what is left of its
// speed after one impact.
double restitution(const ContactLaw& law) {
  Model m;
  const BodyId roller = m.add({.name = "roller",
                               .mass = 0.050_kg,
                               .inertia = 1.0_kg_mm2,
                               .pose = {{60.0_mm, 0.0}, 0.0},
                               .twist = {{0.37, 0.0}, 0.0}});
  const Slot slot = arc_slot({.radius = 60.0_mm, .angle = 60.0_deg, .half_width = 8.1_mm});
  m.add(PinInSlot{
      .name = "slot", .pin = {roller, {60.0_mm, 0.0}, 8.0_mm}, .slot = {ground, slot}, .law = law});
  const Result result = simulate(m, {.until = 0.5e-3, .relative_tolerance = 1e-10});
  if (!result.summary.ok()) fmt::print("{}\n", result.summary.reason);
  return -result["roller.vx_m_per_s"].tail(1)[0] / 0.37;
}

double example() {
  const ElasticLaw elastic = Palmgren{.length = 10.0_mm};
  const DissipativeLaw dissipation = ZhiyingQishao{.e = 0.8};
  fmt::print("force at 10 um: {:.0f} N, derivatives and ledger within {:.0e}\n",
             elastic.response(10e-6).force, departure(elastic, dissipation));
  return restitution({elastic, dissipation});
}

// ---- the shape of contact/laws/catalog/elastic_catalog.cpp, compared by the test

namespace elastic_shape {

/// A law of the catalog: what is known of it, how it is made, what is odd about its readings.
struct ElasticEntry {
  ElasticNote note;
  ElasticLaw (*make)(const RoundPair& pair, double length, Reading reading);
  const char* printed_warning;
  const char* tabulated_warning;
};

inline std::vector<ElasticEntry> entries() {
  const std::vector<Reading> one{Reading::consistent};
  std::vector<ElasticEntry> list;
  // clang-format off
  list.push_back({{.name = "palmgren",
                   .title = "Palmgren, roller on a raceway",
                   .formula = "F = K d^(10/9), K = (L^0.8/3.84e-5)^(10/9) (N, mm)",
                   .source = "A. Palmgren, Ball and Roller Bearing Engineering, 1959",
                   .validity = "steel, 0 <= d <= 0.1 mm",
                   .caveats = {"Empirical; the radii and the materials do not enter."},
                   .parameters = {{"length", "m", "> 0"}},
                   .readings = one},
                  [](const RoundPair&, double length, Reading) {
                    return ElasticLaw(Palmgren{.length = length});
                  },
                  "",
                  ""});
  // clang-format on
  return list;
}

}  // namespace elastic_shape

// ---- the shape of contact/laws/catalog/dissipative_catalog.cpp, compared by the test

namespace dissipative_shape {

using Arguments = DissipativeArguments;

struct DissipativeEntry {
  DissipativeNote note;
  DissipativeLaw (*make)(const Arguments&);
  std::optional<double> (*delivers)(const Arguments&, double n, double approach_velocity);
};

constexpr const char *free_of_tension = "", *with_floor = "";

template <class Law>
DissipativeLaw proportional(const Arguments& a) {
  return Law{a.restitution, a.slowest_approach};
}
template <class Law>
std::optional<double> proportional_delivers(const Arguments& a, double, double) {
  return restitution_of_damping(Law{a.restitution}.damping());
}

inline std::vector<DissipativeEntry> entries() {
  return {
      // clang-format off
      {{.name = "zhiying-qishao",
        .title = "Zhiying and Qishao 2006",
        .formula = "F = F_e (1 + 3/4 (1 - e^2) exp(2 (1 - e)) d'/v_i)",
        .source = "Zhiying, Q.; Qishao, L. J. Dyn. Control 2006, 4, 294-298",
        .meant_for = "0 <= e <= 1",
        .delivers = "0.896 for 0.9, 0.483 for 0.5",
        .separation = free_of_tension,
        .persistent = with_floor,
        .caveats = {"as later literature quotes it; the original was not at hand"},
        .parameters = {{"restitution", "1, 0 to 1"}, {"slowest_approach", "m/s, > 0"}},
        .linear_only = false},
       proportional<ZhiyingQishao>,
       proportional_delivers<ZhiyingQishao>},
      // clang-format on
  };
}

}  // namespace dissipative_shape

}  // namespace adding_a_law
