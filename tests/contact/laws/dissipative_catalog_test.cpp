// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The dissipative laws by name: force against the formula of the paper, derivatives, energy, what
// they refuse, what they answer to any finite input, calibration.
#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <yoke/contact/laws/catalog/calibrated.hpp>
#include <yoke/contact/laws/catalog/dissipative_catalog.hpp>
#include <yoke/contact/laws/catalog/elastic_catalog.hpp>
#include <yoke/contact/laws/elastic/hertz.hpp>
#include <yoke/contact/laws/elastic/johnson.hpp>
#include <yoke/contact/laws/elastic/power_law.hpp>
#include <yoke/contact/laws/forms/proportional_damping.hpp>
#include <yoke/core/error.hpp>
#include <yoke/core/types.hpp>

using namespace yoke;
using doctest::Approx;

namespace {

constexpr double K_linear = 3.1e7, K_hertz = 2.7e9;
const PowerLaw linear{K_linear, 1.0};
const PowerLaw hertzian{K_hertz, 1.5};
const Johnson logarithmic{1.137e11, 60.1e-3, 10e-3};
constexpr double m_r = 0.83, v_i = 0.173;  // [kg], [m/s]
const std::vector<double> asked_for = {0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 1.0};

constexpr double d_m = 3.7e-5;  // [m] at the end of compression

bool refused(const std::string& name, double e) {
  return name == "marhefka-orin-simplified" && e < 0.34;
}

ContactMemory memory_of(const ContactLaw& law, ContactPhase phase) {
  ContactMemory memory{.phase = phase, .approach_velocity = v_i, .effective_mass = m_r};
  if (phase == ContactPhase::restituting) memory.largest_penetration = d_m;
  memory.permanent_set = law.dissipation.permanent_set(memory, law.elastic);
  return memory;
}

using Formula = std::function<double(double d, double v, double e)>;

/// The formulas of the paper with n = 3/2 (n = 1 where it has K d), corrected where misprinted.
std::map<std::string, Formula> formulas(ContactPhase phase) {
  const auto chi_type = [](double (*chi_v)(double)) -> Formula {
    return [=](double d, double v, double e) {
      return K_hertz * std::pow(d, 1.5) * (1.0 + chi_v(e) * v / v_i);
    };
  };
  const auto xi = [](double e) { return std::sqrt(1.0 / (1.0 + std::pow(pi / std::log(e), 2))); };
  std::map<std::string, Formula> all;
  all["none"] = chi_type([](double) { return 0.0; });
  all["hunt-crossley"] = chi_type([](double e) { return 1.5 * (1.0 - e); });
  all["herbert-mcwhannell"] =
      chi_type([](double e) { return 6.0 * (1.0 - e) / (std::pow(2.0 * e - 1.0, 2) + 3.0); });
  all["lee-wang-1"] = chi_type([](double e) { return 0.75 * (1.0 - e); });
  all["khulief-shabana"] = chi_type([](double e) { return 0.75 * (1.0 - e * e); });
  all["lankarani-nikravesh"] = all["khulief-shabana"];
  all["marhefka-orin"] =
      chi_type([](double e) { return 3.0 * (1.0 - e * e) / (2.0 * (1.0 + e * e * e)); });
  all["marhefka-orin-simplified"] =
      chi_type([](double e) { return 3.0 * (1.0 - e * e) / (2.0 * (3.0 * e - 1.0)); });
  all["flores"] = chi_type([](double e) { return 8.0 * (1.0 - e) / (5.0 * e); });
  all["gharib-hurmuzlu"] = chi_type([](double e) { return 1.0 / e; });
  all["hu-guo"] = chi_type([](double e) { return 3.0 * (1.0 - e) / (2.0 * e); });
  all["carvalho-martins"] =
      chi_type([](double e) { return 3.0 * (1.0 - e) * (11.0 - e) / (2.0 * (1.0 + 9.0 * e)); });
  // d_G by bisection of (1 + d_G/e)/(1 - d_G) = exp(d_G (1 + 1/e)) from the root at zero upwards.
  all["gonthier"] = chi_type([](double e) {
    double low = 1e-9, high = 1.0;
    for (int i = 0; i < 200 && e < 1.0; ++i) {
      const double g = 0.5 * (low + high);
      ((1.0 + g / e) < (1.0 - g) * std::exp(g * (1.0 + 1.0 / e)) ? low : high) = g;
    }
    return e < 1.0 ? low / e : 0.0;
  });
  all["zhang-sharf"] = all["gonthier"];
  all["tsuji"] = all["exact-restitution"] = [=](double d, double v, double e) {
    const double chi = e < 1.0 ? std::sqrt(5.0) * xi(e) : 0.0;
    return K_hertz * std::pow(d, 1.5) + chi * std::sqrt(m_r * K_hertz) * std::pow(d, 0.25) * v;
  };
  const auto damper = [=](double e) {
    return e < 1.0 ? 2.0 * xi(e) * std::sqrt(m_r * K_linear) : 0.0;
  };
  all["kelvin-voigt"] = [=](double d, double v, double e) { return K_linear * d + damper(e) * v; };
  all["lee-wang-2"] = [=](double d, double v, double e) {
    const double eps = 0.1 * v_i * std::sqrt(m_r / K_linear);
    const double T = std::exp(((d - eps) - std::abs(d - eps)) * 3.0 / eps);
    return K_linear * d + damper(e) * T * v;
  };
  all["lankarani-nikravesh-1994"] = [=](double d, double, double e) {
    if (phase == ContactPhase::compressing) return K_hertz * std::pow(d, 1.5);
    const double d_p = d_m * (1.0 - e * e), above = (d - d_p) / (d_m - d_p);
    const double size = K_hertz * std::pow(d_m, 1.5) * std::pow(std::abs(above), 1.5);
    return above < 0.0 ? -size : size;  // below the set, where the contact has ended: odd
  };
  all["gharib-hurmuzlu-2"] = all["lankarani-nikravesh-1994"];
  return all;
}

}  // namespace

TEST_CASE("every dissipative law has the force its formula says") {
  for (const ContactPhase phase : {ContactPhase::compressing, ContactPhase::restituting}) {
    const auto all = formulas(phase);
    for (const DissipativeNote& note : dissipative_catalog()) {
      REQUIRE(all.count(note.name) == 1);
      for (const double e : asked_for) {
        if (refused(note.name, e)) continue;
        const ContactLaw law{note.linear_only ? linear : hertzian,
                             make_dissipative(note.name, {.restitution = e})};
        const ContactMemory memory = memory_of(law, phase);
        for (const double d : {1.3e-7, 1.1e-5, 3.6e-5}) {
          for (const double v : {0.151, -0.097}) {
            INFO(note.name, " e = ", e, " d = ", d, " v = ", v);
            CHECK(law.evaluate({d, v, memory}).force ==
                  Approx(all.at(note.name)(d, v, e)).epsilon(1e-9));
          }
        }
      }
    }
  }
}

TEST_CASE("every dissipative law's derivatives and energies agree with its force") {
  for (const DissipativeNote& note : dissipative_catalog()) {
    for (const double e : asked_for) {
      if (refused(note.name, e)) continue;
      for (const ElasticLaw& elastic :
           {ElasticLaw(linear), ElasticLaw(hertzian), ElasticLaw(logarithmic)}) {
        if (note.linear_only && elastic.response(1.0e-5).force != linear(1.0e-5).force) continue;
        const ContactLaw law{elastic, make_dissipative(note.name, {.restitution = e})};
        for (const ContactPhase phase : {ContactPhase::compressing, ContactPhase::restituting}) {
          const ContactMemory memory = memory_of(law, phase);
          for (const double d : {1.1e-6, 2.29e-5, 3.6e-5, -2.3e-6}) {
            for (const double v : {0.131, -0.117}) {
              INFO(note.name, " with ", elastic.name(), " e = ", e, " d = ", d, " v = ", v);
              const double h = 1e-11, u = 1e-6;
              const ContactOutput at = law.evaluate({d, v, memory});
              const ContactOutput up = law.evaluate({d + h, v, memory});
              const ContactOutput down = law.evaluate({d - h, v, memory});
              const double stiff = (up.force - down.force) / (2.0 * h);
              CHECK(at.dforce_dpenetration == Approx(stiff).epsilon(2e-5).scale(1e3));
              const double faster = law.evaluate({d, v + u, memory}).force;
              const double slower = law.evaluate({d, v - u, memory}).force;
              CHECK(at.dforce_drate ==
                    Approx((faster - slower) / (2.0 * u)).epsilon(1e-5).scale(1.0));
              // F d' = dS/dt + D, S a function of d alone; D never negative while it approaches.
              const double dS_dt = (up.stored_energy - down.stored_energy) / (2.0 * h) * v;
              CHECK(at.force * v == Approx(dS_dt + at.dissipated_power).epsilon(2e-5).scale(1e-2));
              if (d > 0.0 && v > 0.0) CHECK(at.dissipated_power >= 0.0);
            }
          }
        }
      }
    }
  }
}

TEST_CASE("no dissipative law answers any finite input with a NaN") {
  std::mt19937_64 random(20260101);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const auto size = [&](double least, double most) {
    return std::exp(std::log(least) + uniform(random) * (std::log(most) - std::log(least)));
  };
  const auto either = [&](double value) { return uniform(random) < 0.5 ? -value : value; };
  const auto& notes = dissipative_catalog();
  long cases = 0, bad = 0;
  for (int i = 0; i < 120000; ++i) {
    const DissipativeNote& note = notes[static_cast<std::size_t>(i) % notes.size()];
    const bool simplified = note.name == "marhefka-orin-simplified";
    DissipativeArguments arguments;
    arguments.restitution =
        simplified ? 0.334 + 0.666 * uniform(random) : least_restitution + 0.999 * uniform(random);
    arguments.slowest_approach = size(1e-9, 1.0);
    arguments.q = size(0.1, 100.0);
    arguments.epsilon = size(1e-6, 1.0);
    arguments.empirical = uniform(random) < 0.5;
    if (uniform(random) < 0.3) arguments.alpha = size(1e-6, 1e3);
    if (uniform(random) < 0.5) arguments.tensile = TensilePhase::clamp;
    const ContactLaw law{PowerLaw{size(1e2, 1e14), uniform(random) < 0.3 ? 1.0 : size(1.0, 4.0)},
                         make_dissipative(note.name, arguments)};
    ContactMemory memory{
        .phase = uniform(random) < 0.5 ? ContactPhase::compressing : ContactPhase::restituting,
        .approach_velocity = uniform(random) < 0.1 ? 0.0 : size(1e-15, 1e4),
        .effective_mass = uniform(random) < 0.05 ? 0.0 : size(1e-9, 1e9)};
    if (memory.phase == ContactPhase::restituting) memory.largest_penetration = size(1e-15, 1.0);
    memory.permanent_set = law.dissipation.permanent_set(memory, law.elastic);
    const double d = uniform(random) < 0.05 ? 0.0 : either(size(1e-320, 1.0));
    const double v = uniform(random) < 0.05 ? 0.0 : either(size(1e-320, 1e4));
    const ContactOutput at = law.evaluate({d, v, memory});
    const bool finite = std::isfinite(at.force) && std::isfinite(at.dforce_drate) &&
                        std::isfinite(at.dforce_dpenetration) && std::isfinite(at.stored_energy) &&
                        std::isfinite(at.dissipated_power);
    ++cases;
    if (!finite && ++bad < 10) {
      FAIL_CHECK(note.name, " d = ", d, " v = ", v, " e = ", arguments.restitution,
                 " m = ", memory.effective_mass, ": ", at.force, " ", at.dforce_dpenetration, " ",
                 at.dforce_drate, " ", at.stored_energy, " ", at.dissipated_power);
    }
  }
  CHECK(cases >= 100000);
  CHECK(bad == 0);
}

// Elastic laws with an end, in every reading: nothing up to the end may be a NaN, from the smallest
// subnormal penetration on and at any rate; where the law should rise, it rises.
TEST_CASE("no dissipative law on a law of cylinders answers any finite input with a NaN") {
  std::mt19937_64 random(20260202);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const auto size = [&](double least, double most) {
    return std::exp(std::log(least) + uniform(random) * (std::log(most) - std::log(least)));
  };
  std::vector<std::pair<std::string, Reading>> springs;
  for (const ElasticNote& note : elastic_catalog())
    if (note.name != "power")
      for (const Reading reading : note.readings) springs.emplace_back(note.name, reading);
  const auto& notes = dissipative_catalog();
  long cases = 0, bad = 0, falling = 0, gaining = 0;
  for (int i = 0; i < 12000; ++i) {
    const auto& [name, reading] = springs[static_cast<std::size_t>(i) % springs.size()];
    const DissipativeNote& note = notes[static_cast<std::size_t>(i) % notes.size()];
    const bool internal = name == "pereira-2011" || uniform(random) < 0.5;
    ElasticArguments given{.pin = {size(1e9, 5e11), 0.49 * uniform(random), "pin"},
                           .wall = {size(1e9, 5e11), 0.49 * uniform(random), "wall"},
                           .pin_radius = size(1e-3, 1.0),
                           .conformity = internal ? Conformity::internal : Conformity::external,
                           .length = size(1e-4, 1.0),
                           .reading = reading};
    given.wall_radius = internal ? given.pin_radius + size(6e-6, 9.9e-3) : size(1e-3, 1.0);
    if (reading != Reading::consistent && given.wall_radius <= given.pin_radius)
      given.wall_radius = 1.1 * given.pin_radius;  // their difference is taken in any contact
    const double e = note.name == "marhefka-orin-simplified"
                         ? 0.334 + 0.666 * uniform(random)
                         : least_restitution + 0.999 * uniform(random);
    const ContactLaw law{make_elastic(name, given),
                         make_dissipative(note.name, {.restitution = e,
                                                      .slowest_approach = size(1e-9, 1.0),
                                                      .q = size(0.1, 100.0),
                                                      .epsilon = size(1e-6, 1.0)})};
    const double end = std::min(law.penetration_limit(), 0.1);
    ContactMemory memory{
        .phase = uniform(random) < 0.5 ? ContactPhase::compressing : ContactPhase::restituting,
        .approach_velocity = uniform(random) < 0.1 ? 0.0 : size(1e-308, 1e10),
        .effective_mass = uniform(random) < 0.05 ? 0.0 : size(1e-12, 1e12)};
    if (memory.phase == ContactPhase::restituting) {
      memory.largest_penetration = end * size(1e-12, 1.0);
      memory.permanent_set = law.dissipation.permanent_set(memory, law.elastic);
    }
    const bool unloading = memory.phase == ContactPhase::restituting;
    const double deepest = unloading ? memory.largest_penetration : end;
    for (int k = 0; k < 10; ++k, ++cases) {
      const double d = k == 0   ? 0.0
                       : k == 1 ? 5e-324
                       : k == 2 ? deepest
                                : deepest * size(1e-300, 1.0) * (k == 3 ? -1.0 : 1.0);
      const double v = k == 4   ? 0.0
                       : k == 5 ? 5e-324
                                : size(1e-300, 1e10) * (uniform(random) < 0.5 ? -1.0 : 1.0);
      const ContactOutput at = law.evaluate({d, v, memory});
      const bool finite = !std::isnan(at.force) && !std::isnan(at.dforce_drate) &&
                          !std::isnan(at.dforce_dpenetration) && !std::isnan(at.stored_energy) &&
                          !std::isnan(at.dissipated_power);
      if (!finite && ++bad < 10)
        FAIL_CHECK(note.name, " on ", name, " (", name_of(reading), ") d = ", d, " v = ", v,
                   " end = ", end, ": ", at.force, " ", at.dforce_dpenetration, " ",
                   at.dforce_drate, " ", at.stored_energy, " ", at.dissipated_power);
      // While it approaches: the deeper and the faster, the more force; nothing is gained.
      if (d > 1e-300 && v > 1e-300 && v < 1e4 && !unloading) {
        const double deeper = std::min(end, d * 1.001);
        if (law.evaluate({deeper, v, memory}).force < at.force * (1.0 - 1e-12)) ++falling;
        if (law.evaluate({d, 1.001 * v, memory}).force < at.force * (1.0 - 1e-12)) ++falling;
        if (at.force < 0.0 || at.dissipated_power < 0.0) ++gaining;
      }
    }
  }
  CHECK(cases >= 100000);
  CHECK(bad == 0);
  CHECK(falling == 0);
  CHECK(gaining == 0);
}

TEST_CASE("closed forms of the restitution delivered are those of the errata") {
  struct Row {
    const char* name;
    double delivered[6];  // asked 0.1, 0.3, 0.5, 0.7, 0.9, 0.99; -1 refused
  };
  const std::vector<Row> table = {
      {"hunt-crossley",
       {0.5158326164, 0.5812880418, 0.6629622000, 0.7679997891, 0.9090157413, 0.9900989128}},
      {"herbert-mcwhannell",
       {0.4906976596, 0.5199665549, 0.5936242600, 0.7226826491, 0.9008929857, 0.9900008999}},
      {"lee-wang-1",
       {0.6866634391, 0.7389953195, 0.7991987822, 0.8693431103, 0.9523701528, 0.9950248633}},
      {"lankarani-nikravesh",
       {0.6652654068, 0.6842246057, 0.7252411140, 0.7959725954, 0.9131766778, 0.9901479315}},
      {"khulief-shabana",
       {0.6652654068, 0.6842246057, 0.7252411140, 0.7959725954, 0.9131766778, 0.9901479315}},
      {"marhefka-orin",
       {0.4906976596, 0.5199665549, 0.5936242600, 0.7226826491, 0.9008929857, 0.9900008999}},
      {"marhefka-orin-simplified",
       {-1.0, -1.0, 0.3796463822, 0.6800489108, 0.8993692454, 0.9899993974}},
      {"gonthier", {0.1, 0.3, 0.5, 0.7, 0.9, 0.99}},
      {"flores",
       {0.0694442252, 0.2562079067, 0.4704447793, 0.6831841997, 0.8939206927, 0.9893403186}},
      {"gharib-hurmuzlu",
       {0.0999816248, 0.2818767230, 0.4107196861, 0.5007793429, 0.5668119748, 0.5910950282}},
      {"hu-guo",
       {0.0740735324, 0.2706584586, 0.4877412560, 0.6972969681, 0.8998999431, 0.9899999000}},
      {"tsuji", {0.1, 0.3, 0.5, 0.7, 0.9, 0.99}},
      {"lankarani-nikravesh-1994", {0.1, 0.3, 0.5, 0.7, 0.9, 0.99}},
      {"gharib-hurmuzlu-2", {0.1, 0.3, 0.5, 0.7, 0.9, 0.99}}};
  const double clamped[6] = {0.2527293796, 0.3971404999, 0.5502831696,
                             0.7182013610, 0.9020260687, 0.9900202642};
  for (std::size_t i = 0; i < 6; ++i) {
    const DissipativeArguments arguments{.restitution = asked_for[i]};
    for (const Row& row : table) {
      INFO(row.name, " e = ", asked_for[i]);
      if (row.delivered[i] < 0.0)
        CHECK_THROWS_AS(closed_form_restitution(row.name, arguments, 1.5, v_i), ModelError);
      else
        CHECK(closed_form_restitution(row.name, arguments, 1.5, v_i).value() ==
              Approx(row.delivered[i]).epsilon(1e-9));
    }
    const DissipativeArguments clamp{.restitution = asked_for[i], .tensile = TensilePhase::clamp};
    for (const char* name : {"tsuji", "exact-restitution", "kelvin-voigt"})
      CHECK(closed_form_restitution(name, clamp, 1.0, v_i).value() ==
            Approx(clamped[i]).epsilon(1e-9));
  }
  CHECK_FALSE(closed_form_restitution("lee-wang-2", {.restitution = 0.5}, 1.0, v_i));
  CHECK_FALSE(closed_form_restitution("kelvin-voigt", {.restitution = 0.5}, 1.5, v_i));
  // Below the floor the damping fades with the speed; constant alpha has none.
  const double slow = closed_form_restitution("flores", {.restitution = 0.5}, 1.5, 1e-5).value();
  CHECK(slow == Approx(1.0 - 2.0 / 3.0 * 0.016).epsilon(2e-4));
  CHECK(closed_form_restitution("hunt-crossley", {.alpha = 0.5 / v_i}, 1.5, v_i).value() ==
        Approx(0.6629622000).epsilon(1e-9));
}

TEST_CASE("Herbert and McWhannell's empirical restitution falls with the cube root of the speed") {
  // 1 - 0.026 * 10 at 1 m/s.
  const DissipativeLaw law = make_dissipative("herbert-mcwhannell", {.empirical = true});
  const DissipativeLaw fixed = make_dissipative("herbert-mcwhannell", {.restitution = 0.74});
  const ContactMemory memory{.phase = ContactPhase::compressing, .approach_velocity = 1.0};
  CHECK(law.evaluate({1e-5, 0.3, memory}, hertzian).force ==
        Approx(fixed.evaluate({1e-5, 0.3, memory}, hertzian).force).epsilon(1e-13));
  const ContactMemory bullet{.phase = ContactPhase::compressing, .approach_velocity = 100.0};
  CHECK(law.evaluate({1e-5, 30.0, bullet}, hertzian).force ==
        Approx(hertzian(1e-5).force * (1.0 + 1.5 * 0.3)));
}

TEST_CASE("a contact that begins at rest is damped as one that begins at the floor") {
  for (const DissipativeNote& note : dissipative_catalog()) {
    for (const double floor : {1e-3, 0.05}) {
      INFO(note.name, " floor = ", floor);
      const DissipativeLaw law =
          make_dissipative(note.name, {.restitution = 0.6, .slowest_approach = floor});
      ContactMemory memory{.phase = ContactPhase::compressing, .effective_mass = m_r};
      const double at_rest = law.evaluate({1e-6, 0.01, memory}, linear).force;
      CHECK(std::isfinite(at_rest));
      for (const double v : {0.1 * floor, floor}) {
        memory.approach_velocity = v;
        CHECK(law.evaluate({1e-6, 0.01, memory}, linear).force == at_rest);
      }
    }
  }
}

TEST_CASE("damping and restitution of the exact balance are each other's inverse") {
  CHECK(restitution_of_damping(0.0) == 1.0);
  CHECK(damping_for_restitution(1.0) == 0.0);
  for (const double e : {0.001, 0.02, 0.3, 0.77, 0.95, 0.9999, 0.9999999})
    CHECK(1.0 - restitution_of_damping(damping_for_restitution(e)) ==
          Approx(1.0 - e).epsilon(1e-8));
  for (const double X : {1e-12, 1e-9, 1e-6, 1e-3})  // 1 - 2/3 X + 4/9 X^2
    CHECK(1.0 - restitution_of_damping(X) == Approx(X * (2.0 / 3.0 - 4.0 / 9.0 * X)).epsilon(1e-3));
  CHECK(restitution_of_damping(1e9) == Approx(1e-9).epsilon(1e-14));
}

TEST_CASE("a law is calibrated by what it is asked for, or refused with what it can deliver") {
  for (const DissipativeNote& note : dissipative_catalog()) {
    if (note.name == "none" || note.name == "lee-wang-2") {
      CHECK_THROWS_AS(calibrated(note.name, 0.7), ModelError);
      continue;
    }
    const double e = note.name == "gharib-hurmuzlu" ? 0.4 : 0.8;
    INFO(note.name);
    const DissipativeArguments solved = calibrated_arguments(note.name, e);
    CHECK(closed_form_restitution(note.name, solved, 1.0, v_i).value() == Approx(e).epsilon(1e-13));
  }
  // With the right coefficient all proportional laws are the same.
  const ContactMemory memory{.phase = ContactPhase::compressing, .approach_velocity = v_i};
  const ContactInput in{1e-5, 0.1, memory};
  const double force = calibrated("gonthier", 0.8).evaluate(in, hertzian).force;
  for (const char* name : {"hunt-crossley", "lankarani-nikravesh", "flores", "hu-guo"})
    CHECK(calibrated(name, 0.8).evaluate(in, hertzian).force == Approx(force).epsilon(1e-12));

  CHECK_THROWS_WITH_AS(
      calibrated("lankarani-nikravesh", 0.5),
      "calibrated law 'lankarani-nikravesh': e = 0.5 is outside what it can deliver, 0.662962 to "
      "1, whatever its coefficient",
      ModelError);
  CHECK_THROWS_AS(calibrated("gharib-hurmuzlu", 0.9), ModelError);
  CHECK_THROWS_AS(calibrated("herbert-mcwhannell", 0.9, {.empirical = true}), ModelError);
  CHECK_THROWS_AS(calibrated("hunt-crossley", 0.9, {.alpha = 0.1}), ModelError);
  CHECK_THROWS_AS(calibrated("flores", 1.1), ModelError);
  CHECK_THROWS_AS(calibrated("flores", std::nan("")), ModelError);
  CHECK(closed_form_restitution("hunt-crossley", {.alpha = calibrated_alpha(0.4, v_i).alpha}, 1.5,
                                v_i)
            .value() == Approx(0.4).epsilon(1e-13));
}

TEST_CASE("the catalog knows every law and says what it takes") {
  for (const DissipativeNote& note : dissipative_catalog()) {
    INFO(note.name);
    CHECK(&find_dissipative(note.name) == &find_dissipative(note.name));
    CHECK(make_dissipative(note.name, {.restitution = 0.9}).name() != "dissipative law");
    for (const std::string& text : {note.title, note.formula, note.meant_for, note.delivers,
                                    note.separation, note.persistent})
      CHECK_FALSE(text.empty());
    if (note.name == "none") continue;
    CHECK_FALSE(note.source.empty());
    CHECK_FALSE(note.parameters.empty());
    for (const double e : {-0.1, 1.1, std::nan("")})
      CHECK_THROWS_AS(make_dissipative(note.name, {.restitution = e}), ModelError);
  }
  CHECK_THROWS_AS(find_dissipative("hertz"), ModelError);
  CHECK_THROWS_WITH_AS(make_dissipative("flores", {.restitution = 0.0}),
                       "law 'flores': e = 0 is outside the accepted range 0.001 to 1", ModelError);
  CHECK_THROWS_AS(make_dissipative("marhefka-orin-simplified", {.restitution = 1.0 / 3.0}),
                  ModelError);
  CHECK_THROWS_AS(make_dissipative("hu-guo", {.restitution = 0.5, .slowest_approach = 0.0}),
                  ModelError);
  CHECK_THROWS_AS(make_dissipative("lee-wang-2", {.restitution = 0.5, .epsilon = 0.0}), ModelError);
  CHECK_THROWS_AS(make_dissipative("lee-wang-2", {.restitution = 0.5, .q = 0.0}), ModelError);
  CHECK_THROWS_AS(make_dissipative("hunt-crossley", {.alpha = -1.0}), ModelError);
}

TEST_CASE("which laws let go where, and which need the largest penetration") {
  for (const DissipativeNote& note : dissipative_catalog()) {
    INFO(note.name);
    const DissipativeLaw keep = make_dissipative(note.name, {.restitution = 0.6});
    const DissipativeLaw clamp =
        make_dissipative(note.name, {.restitution = 0.6, .tensile = TensilePhase::clamp});
    const bool pulls = note.name == "kelvin-voigt" || note.name == "tsuji" ||
                       note.name == "lee-wang-2" || note.name == "exact-restitution";
    const bool dents = note.name == "lankarani-nikravesh-1994" || note.name == "gharib-hurmuzlu-2";
    CHECK((keep.release() == Release::at_zero_penetration) == pulls);
    CHECK(clamp.release() == Release::at_zero_force);
    CHECK(keep.needs_largest_penetration() == dents);
  }
}
