// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The cases of friction against closed forms; their own checks compare them with another integrator.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <yoke/cases/friction/friction_laws.hpp>
#include <yoke/core/error.hpp>
#include <yoke/tests/messages.hpp>

#include <yoke/tests/cases/impacts/impact_case.hpp>

using namespace yoke;
using namespace yoke::cases;
using namespace yoke::tests;
using doctest::Approx;

namespace {

constexpr double g = 9.81;

double last(const Eigen::VectorXd& column) { return column[column.size() - 1]; }

TEST_CASE("friction cases: every law and every formulation, as another integrator says") {
  for (const char* name : {"block_on_incline", "belt_oscillator", "rolling_disc", "slot_roller",
                           "leaning_rod", "painleve_rod"})
    for (const NamedLaw& law : find_case(name).contact.laws) {
      INFO(name << " " << law.name);
      impact_run(name, {}, law.name, {.relative_tolerance = 1e-9, .samples = 501});
    }
  for (const FormulationNote& f : formulations()) {
    INFO(f.name);
    for (const char* law : {"stribeck", "lugre"})
      impact_run("rolling_disc", {"threshold=0.01"}, law,
                 {.until = 0.08, .formulation = std::string(f.name), .samples = 201});
  }
}

TEST_CASE("block_on_incline: bristles hold it below the friction angle; above, it slides") {
  const std::vector<std::string> below = {"angle=16deg", "mu=0.3", "mu_static=0.3", "duration=5s"};
  const auto held = impact_run("block_on_incline", below, "lugre");
  const double way = last(held.result["block.x_m"]);
  CHECK(way > 0.0);
  CHECK(way < 0.3 * 2.0 * g / 1e5 * 50.0);  // some bristles' lengths
  const auto creeping =
      impact_run("block_on_incline", below, "regularised-coulomb", {.relative_tolerance = 1e-11});
  // N mu tanh(v/v_t) = m g sin a
  const double speed = 1e-3 * std::atanh(std::tan(16.0 * pi / 180.0) / 0.3);
  CHECK(last(creeping.result["block.vx_m_per_s"]) == Approx(speed).epsilon(1e-6));

  const auto slides = impact_run("block_on_incline", {"angle=30deg", "threshold=1e-4"},
                                 "regularised-coulomb", {.relative_tolerance = 1e-10});
  const double a = g * (std::sin(pi / 6.0) - 0.3 * std::cos(pi / 6.0));
  // Below the threshold there is less friction: it is ahead by no more than that speed.
  const double ahead = last(slides.result["block.x_m"]) - 0.5 * a * 4.0;
  CHECK(ahead > 0.0);
  CHECK(ahead < 1e-4 * 2.0);
}

TEST_CASE("leaning_rod: it holds above the critical angle and slides below, as a rigid one would") {
  for (const double mu : {0.2, 0.5, 0.7}) {
    const double critical = 90.0 - 2.0 * std::atan(mu) * 180.0 / pi;
    for (const double beside : {-0.5, 0.5}) {
      const std::vector<std::string> set = {fmt::format("angle={}deg", critical + beside),
                                            fmt::format("mu={}", mu),
                                            fmt::format("mu_static={}", mu), "duration=1s"};
      const auto run = impact_run("leaning_rod", set, "coulomb");
      const Eigen::VectorXd angle = run.result["rod.angle_rad"];
      const double turned = std::abs(last(angle) - angle[0]);
      INFO(mu << " " << beside);
      if (beside > 0.0)
        CHECK(turned < 1e-8);
      else
        CHECK(turned > 1e-3);
    }
  }
}

TEST_CASE("painleve_rod: the paradox is reported where it is, and the tip jams") {
  for (const char* mu : {"1.30", "1.34", "1.36", "1.8"}) {  // the limit is 1.347
    INFO(mu);
    const std::vector<std::string> set = {std::string("mu=") + mu, std::string("mu_static=") + mu};
    const auto run = impact_run("painleve_rod", set, "coulomb");  // its checks see the note
    const bool jams = std::ranges::any_of(run.result.events,
                                          [](const EventRecord& e) { return e.kind == "stick"; });
    if (std::stod(mu) > 1.347) CHECK(jams);
  }
  // The other way round there is no paradox.
  impact_run("painleve_rod", {"speed=-1", "mu=1.8", "mu_static=1.8"}, "coulomb");
}

TEST_CASE("rolling_disc: it ends rolling, a uniform disc with two thirds of its speed") {
  const auto run = impact_run("rolling_disc", {"stiffness=1e11", "threshold=1e-4"},
                              "regularised-coulomb", {.relative_tolerance = 1e-10});
  const double v = last(run.result["disc.vx_m_per_s"]);
  CHECK(v == Approx(2.0 / 3.0).epsilon(1e-5));  // the contact is 0.2 um deep
  const double depth = run.result["floor.penetration_m"][0];
  CHECK(v == Approx(-last(run.result["disc.omega_rad_per_s"]) * (0.05 - depth)).epsilon(1e-9));
  // It skids for v_0/(3 mu g), from there on the speed is constant.
  const Eigen::VectorXd t = run.result["t_s"],
                        slip = run.result["floor.tangential_velocity_m_per_s"];
  double until = 0.0;
  for (Eigen::Index i = 0; i < t.size(); ++i)
    if (slip[i] > 1e-2) until = t[i];
  CHECK(until == Approx(0.99 / (3.0 * 0.2 * g)).epsilon(2e-3));
}

TEST_CASE(
    "slot_roller: it rolls, skids, or first the one and then the other, as a rigid one would") {
  const auto events_of = [](const std::string& start, const std::string& mu,
                            const std::string& kind) {
    const auto run = impact_run(
        "slot_roller",
        {"start=" + start, "mu=" + mu, "mu_static=" + mu, "duration=0.3s", "stiffness=1e12"},
        "coulomb", {.relative_tolerance = 1e-9});
    return std::ranges::count(run.result.events, kind, &EventRecord::kind);
  };
  // kappa/(1 + kappa) = 1/3: it rolls where tan(start) < 3 mu, the more so lower down.
  CHECK(events_of("30deg", "0.2", "slip") == 0);
  CHECK(events_of("70deg", "0.2", "stick") == 1);
  CHECK(events_of("70deg", "0.01", "stick") == 0);
}

/// Largest distance of the last period from the middle.
double amplitude(const Result& run, double from) {
  const Eigen::VectorXd t = run["t_s"], x = run["block.x_m"];
  double low = 1e9, high = -1e9;
  for (Eigen::Index i = 0; i < t.size(); ++i)
    if (t[i] > from) low = std::min(low, x[i]), high = std::max(high, x[i]);
  return 0.5 * (high - low);
}

// Where the load passes the top of the curve at the rate k V, the sliding u beyond it obeys
// m u' = k V t + mu_s N (u/v_t)^2: it tears off a time of order v_t^(2/3) late, so that much above
// Coulomb's amplitude, less the creep while it sticks, which is of order v_t.
TEST_CASE("belt_oscillator: tends to Coulomb's stick-slip as the threshold to the power 2/3") {
  const double D = 0.15 * g / 100.0, w = 10.0, V = 0.1;
  const double closed = std::hypot(D, V / w);
  double before = 0.0, ratio = 1.35;
  for (const double threshold : {4e-3, 2e-3, 1e-3, 5e-4}) {
    // The steep fall of the curve multiplies errors: the checks of the case do not reckon with that.
    const Case& c = find_case("belt_oscillator");
    const Model model = make_model(
        c, Parameters(c.parameters),
        fmt::format("bengisu-akay:mu=0.25,mu_static=0.4,decay=20000,threshold={}", threshold));
    const Result run =
        simulate(model, {.until = 4.0, .relative_tolerance = 1e-9, .samples = 20001});
    REQUIRE(run.summary.ok());
    const double off = amplitude(run, 2.5) / closed - 1.0;
    INFO(threshold << ": " << off << " after " << before);
    CHECK(off > 0.0);
    CHECK(off < 0.03);
    if (before != 0.0) {
      CHECK(before / off > ratio);
      CHECK(before / off < std::pow(2.0, 2.0 / 3.0));
      ratio = before / off;
    }
    before = off;
  }
}

TEST_CASE("friction of every case: laws with arguments, wall by wall, and what is refused") {
  const Case& c = find_case("scotch_yoke");
  const Parameters p(c.parameters);
  const auto chosen = choose_laws(c, p, {"johnson"}, "dahl:mu=0.1,outer=none");
  REQUIRE(chosen.size() == 1);
  const WallLaws laws = make_laws(c.contact, p, chosen[0]);
  CHECK(laws.have_friction());
  CHECK(laws["outer"].friction.none());
  CHECK(laws["inner"].friction.name() == "dahl");
  const auto refusal = [&](const char* friction) {
    return message_of(
        [&] { make_laws(c.contact, p, choose_laws(c, p, {"johnson"}, friction)[0]); });
  };
  CHECK(contains(refusal("stribek:mu=0.1"),
                 "unknown friction law 'stribek'; did you mean 'stribeck'?"));
  CHECK(contains(refusal("stribeck:mu=-0.1"), "friction 'stribeck': mu = -0.1 must be"));
  CHECK(contains(refusal("stribeck:nu=0.1"), "law 'stribeck': unknown argument 'nu'"));
  CHECK(contains(refusal("stribeck"), "friction 'stribeck': mu is missing"));
  CHECK(contains(refusal("dahl:mu=0.1,iner=none"), "unknown"));
  const Case& ideal = find_case("slider_crank");
  CHECK(contains(
      message_of([&] { choose_laws(ideal, Parameters(ideal.parameters), {}, "dahl:mu=0.1"); }),
      "case 'slider_crank' has no contacts"));
}

}  // namespace
