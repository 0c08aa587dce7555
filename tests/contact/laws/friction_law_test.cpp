// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Friction laws by themselves: their published curves, derivatives, energies, and what is refused.
#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <utility>

#include <yoke/contact/laws/catalog/friction_catalog.hpp>
#include <yoke/contact/laws/friction/ambrosio.hpp>
#include <yoke/contact/laws/friction/bengisu_akay.hpp>
#include <yoke/contact/laws/friction/brown_mcphee.hpp>
#include <yoke/contact/laws/friction/dahl.hpp>
#include <yoke/contact/laws/friction/lugre.hpp>
#include <yoke/contact/laws/friction/regularised_coulomb.hpp>
#include <yoke/contact/laws/friction/stribeck.hpp>
#include <yoke/contact/laws/friction/threlfall.hpp>
#include <yoke/tests/messages.hpp>

using namespace yoke;
using namespace yoke::tests;
using doctest::Approx;

namespace {

/// Every law of the catalogue, with all it can have.
std::vector<FrictionLaw> every_friction() {
  std::vector<FrictionLaw> laws;
  for (const FrictionNote& note : friction_catalog()) {
    std::vector<std::pair<std::string, double>> values{{"mu", 0.2}};
    for (const FrictionParameter& p : note.parameters) {
      if (p.name == "mu_static") values.emplace_back("mu_static", 0.3);
      if (p.name == "threshold") values.emplace_back("threshold", 0.02);
      if (p.name == "dead") values.emplace_back("dead", 0.004);
      if (p.name == "viscous") values.emplace_back("viscous", 1.7);
      if (p.name == "damping") values.emplace_back("damping", 300.0);
    }
    laws.push_back(make_friction(note.name, values));
  }
  return laws;
}

double force_at(const FrictionLaw& law, double N, double v) {
  return law.evaluate({.normal_force = N, .sliding = v}).force;
}

/// Where a law's curve is not smooth: sliding velocities.
bool near_corner(double v) {
  for (const double corner : {0.0, 0.004, 0.02})
    if (std::abs(std::abs(v) - corner) < 1e-5) return true;
  return false;
}

/// A random state: sometimes slow, sometimes fast, bristles bent beyond what they bear.
FrictionInput ugly(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const double size = std::pow(10.0, -3.0 * std::abs(uniform(random)));
  return {.normal_force = 60.0 * (1.01 + uniform(random)),
          .sliding = uniform(random) * size,
          .state = 3e-4 * uniform(random),
          .reference_force = 100.0};
}

TEST_CASE("friction laws: derivatives are exact, by normal force, sliding velocity and state") {
  std::mt19937 random(3);
  for (const FrictionLaw& law : every_friction()) {
    INFO(law.name());
    for (int i = 0; i < 2000; ++i) {
      const FrictionInput at = ugly(random);
      if (near_corner(at.sliding)) continue;
      const FrictionOutput out = law.evaluate(at);
      const auto slope = [&](double FrictionInput::*of, double step, double FrictionOutput::*what) {
        double sum = 0.0;
        for (const auto& [shift, weight] :
             {std::pair{1.0, 8.0}, {-1.0, -8.0}, {2.0, -1.0}, {-2.0, 1.0}}) {
          FrictionInput moved = at;
          moved.*of += shift * step;
          sum += weight * law.evaluate(moved).*what / (12.0 * step);
        }
        return sum;
      };
      const double N = 1e-4 * at.normal_force, v = 2e-6, z = 1e-7;
      const double size = std::abs(out.dforce_dsliding) + 100.0;
      CHECK(std::abs(slope(&FrictionInput::normal_force, N, &FrictionOutput::force) -
                     out.dforce_dnormal) < 1e-7 * (1.0 + std::abs(out.dforce_dnormal)));
      CHECK(std::abs(slope(&FrictionInput::sliding, v, &FrictionOutput::force) -
                     out.dforce_dsliding) < 1e-6 * size);
      if (!law.has_state()) continue;
      CHECK(slope(&FrictionInput::state, z, &FrictionOutput::force) ==
            Approx(out.dforce_dstate).epsilon(1e-8));
      CHECK(std::abs(slope(&FrictionInput::normal_force, N, &FrictionOutput::rate) -
                     out.drate_dnormal) < 1e-7 * (std::abs(out.drate_dnormal) + 1e-3));
      CHECK(std::abs(slope(&FrictionInput::sliding, v, &FrictionOutput::rate) -
                     out.drate_dsliding) < 1e-6 * (1.0 + std::abs(out.drate_dsliding)));
      CHECK(std::abs(slope(&FrictionInput::state, z, &FrictionOutput::rate) - out.drate_dstate) <
            1e-7 * (1.0 + std::abs(out.drate_dstate)));
    }
  }
}

TEST_CASE("friction laws: what the force takes is stored or dissipated, and never made") {
  std::mt19937 random(5);
  for (const FrictionLaw& law : every_friction()) {
    INFO(law.name());
    for (int i = 0; i < 5000; ++i) {
      const FrictionInput at = ugly(random);
      const FrictionOutput out = law.evaluate(at);
      FrictionInput moved = at;
      const double step = 1e-9;
      moved.state = at.state + step;
      const double above = law.evaluate(moved).stored_energy;
      moved.state = at.state - step;
      const double stored_rate =
          (above - law.evaluate(moved).stored_energy) / (2.0 * step) * out.rate;
      const double power = out.force * at.sliding;
      CHECK(std::abs(power - stored_rate - out.dissipated_power) <=
            1e-6 * (std::abs(power) + std::abs(stored_rate)));
      CHECK(out.dissipated_power >= 0.0);
      CHECK(out.stored_energy >= 0.0);
    }
  }
}

TEST_CASE("friction laws: the other way round everything changes its sign") {
  std::mt19937 random(7);
  for (const FrictionLaw& law : every_friction()) {
    INFO(law.name());
    for (int i = 0; i < 100; ++i) {
      FrictionInput at = ugly(random);
      const FrictionOutput there = law.evaluate(at);
      at.sliding = -at.sliding, at.state = -at.state;
      const FrictionOutput back = law.evaluate(at);
      CHECK(back.force == -there.force);
      CHECK(back.rate == -there.rate);
      CHECK(back.dissipated_power == there.dissipated_power);
    }
  }
}

TEST_CASE("friction laws: the curves are those of their papers") {
  const double N = 50.0;
  const RegularisedCoulomb regularised{.mu = 0.2, .threshold = 0.01};
  CHECK(force_at(regularised, N, 0.01) == Approx(10.0 * std::tanh(1.0)));
  CHECK(force_at(regularised, N, 1.0) == Approx(10.0));

  const Threlfall threlfall{.mu = 0.2, .threshold = 0.01};
  CHECK(force_at(threlfall, N, 0.005) == Approx(10.0 * (1.0 - std::exp(-1.5))));
  CHECK(force_at(threlfall, N, 3.0) == Approx(10.0 * 0.950212931632136));

  const Ambrosio ambrosio{.mu = 0.2, .dead = 0.01, .threshold = 0.03};
  CHECK(force_at(ambrosio, N, 0.009) == 0.0);
  CHECK(force_at(ambrosio, N, 0.015) == Approx(2.5));
  CHECK(force_at(ambrosio, N, -0.04) == Approx(-10.0));

  const BengisuAkay bengisu{.mu = 0.2, .mu_static = 0.3, .threshold = 0.01, .decay = 20.0};
  CHECK(force_at(bengisu, N, 0.01) == Approx(15.0));
  CHECK(force_at(bengisu, N, 0.005) == Approx(0.75 * 15.0));
  CHECK(force_at(bengisu, N, 0.06) == Approx(10.0 + 5.0 * std::exp(-1.0)));

  const BrownMcPhee brown{.mu = 0.2, .mu_static = 0.3, .threshold = 0.01};
  CHECK(force_at(brown, N, 0.01) == Approx(10.0 * std::tanh(4.0) + 5.0));
  CHECK(force_at(brown, N, 10.0) == Approx(10.0).epsilon(1e-7));
  const FrictionOutput top = brown({.normal_force = N, .sliding = 0.01});
  CHECK(std::abs(top.dforce_dsliding) < 6.0);  // its peak; the slope at zero is 4700 N s/m

  const Stribeck stribeck{
      .mu = 0.2, .mu_static = 0.3, .stribeck_velocity = 0.1, .threshold = 1e-4, .viscous = 2.0};
  CHECK(force_at(stribeck, N, 0.1) == Approx(10.0 + 5.0 * std::exp(-1.0) + 0.2));

  // Steady sliding: the bristles have come to rest.
  const LuGre lugre{.mu = 0.2, .mu_static = 0.3, .stribeck_velocity = 0.1, .viscous = 2.0};
  const double g = 0.2 + 0.1 * std::exp(-4.0);
  const FrictionOutput steady =
      lugre({.normal_force = N, .sliding = -0.2, .state = -N * g / lugre.stiffness});
  CHECK(std::abs(steady.rate) < 1e-15);
  CHECK(steady.force == Approx(-N * g - 0.4));
  CHECK(steady.dissipated_power == Approx(0.2 * (N * g + 0.4)));
}

/// z over a displacement x at constant speed, by the law's own z' in small steps.
double bent(const FrictionLaw& law, double N, double v, double z, double way) {
  const int steps = 20000;
  const double h = way / std::abs(v) / steps;
  const auto rate = [&](double at) {
    return law.evaluate({.normal_force = N, .sliding = v, .state = at}).rate;
  };
  for (int i = 0; i < steps; ++i) {
    const double a = rate(z), b = rate(z + 0.5 * h * a), c = rate(z + 0.5 * h * b),
                 d = rate(z + h * c);
    z += h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
  }
  return z;
}

TEST_CASE(
    "friction laws: presliding is a spring that yields, its hysteresis that of the closed form") {
  const double N = 50.0, mu = 0.2, k = 1e5, most = mu * N / k;
  for (const FrictionLaw& law :
       {FrictionLaw(Dahl{.mu = mu, .stiffness = k}),
        FrictionLaw(LuGre{.mu = mu, .mu_static = mu, .stiffness = k, .damping = 40.0})}) {
    INFO(law.name());
    const FrictionOutput rest = law.evaluate({.normal_force = N});
    CHECK(rest.dforce_dstate == k);  // the presliding stiffness
    CHECK(rest.drate_dsliding == 1.0);
    // dz/dx = 1 - z/z_m forwards and -(1 + z/z_m) backwards, whatever the speed.
    for (const double v : {1e-5, 1e-3}) {
      const double x = 0.7 * most;
      const double there = bent(law, N, v, 0.0, x);
      CHECK(there == Approx(most * (1.0 - std::exp(-x / most))).epsilon(1e-10));
      const double back = bent(law, N, -v, there, x);
      CHECK(back == Approx(-most + (there + most) * std::exp(-x / most)).epsilon(1e-10));
      CHECK(back < -1e-2 * most);
    }
    // Break-away: never more than the friction, which is reached.
    const double far = bent(law, N, 1e-4, 0.0, 30.0 * most);
    CHECK(k * far == Approx(mu * N).epsilon(1e-10));
  }
}

TEST_CASE("friction laws: what cannot be is refused by name, value and range") {
  const auto refusal = [](const char* name, std::vector<std::pair<std::string, double>> values) {
    return message_of([&] { make_friction(name, values); });
  };
  CHECK(
      contains(refusal("stribek", {{"mu", 0.1}}), "friction law 'stribek' is unknown; known are"));
  CHECK(contains(refusal("stribeck", {}), "friction 'stribeck': mu is missing"));
  CHECK(contains(refusal("dahl", {{"mu", 0.1}, {"threshold", 1.0}}),
                 "friction 'dahl': unknown parameter 'threshold'; it takes mu, stiffness"));
  CHECK(contains(refusal("regularised-coulomb", {{"mu", -0.1}}),
                 "friction 'regularised-coulomb': mu = -0.1 must be finite and at least 0"));
  CHECK(contains(refusal("brown-mcphee", {{"mu", 0.2}, {"mu_static", 0.1}}),
                 "friction 'brown-mcphee': mu_static = 0.1 must be at least mu = 0.2"));
  CHECK(contains(refusal("threlfall", {{"mu", 0.2}, {"threshold", 0.0}}),
                 "friction 'threlfall': threshold = 0 m/s must be"));
  CHECK(contains(refusal("ambrosio", {{"mu", 0.2}, {"dead", 2e-3}, {"threshold", 1e-3}}),
                 "threshold = 0.001 m/s must be greater than dead = 0.002 m/s"));
  CHECK(contains(refusal("lugre", {{"mu", 0.0}}), "friction 'lugre': mu = 0 must be"));
  CHECK(contains(refusal("stribeck", {{"mu", 0.1}, {"exponent", 0.5}}), "exponent = 0.5"));
}

TEST_CASE("friction laws: of the catalogue each is described, and mu_static is mu unless given") {
  CHECK(friction_catalog().size() == 9);
  for (const FrictionNote& note : friction_catalog()) {
    INFO(note.name);
    CHECK(!note.title.empty());
    CHECK(!note.formula.empty());
    CHECK(!note.source.empty());
    CHECK(make_friction(note.name, {{"mu", 0.1}}).name() == note.name);
    CHECK(find_friction(note.name).parameters.front().name == "mu");
  }
  const FrictionLaw plain = make_friction("brown-mcphee", {{"mu", 0.1}});
  CHECK(force_at(plain, 1.0, 1e-3) == Approx(0.1 * std::tanh(4.0)));
}

}  // namespace
