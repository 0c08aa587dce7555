// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include <yoke/cases/case.hpp>
#include <yoke/cases/jobs/law_run.hpp>
#include <yoke/cases/program/request.hpp>
#include <yoke/cases/scotch_yoke.hpp>
#include <yoke/core/error.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/tests/messages.hpp>

namespace {

using namespace yoke;
using namespace yoke::cases;
using namespace yoke::literals;
using Settings = std::vector<std::string>;

ScotchYoke choices_with(const Settings& settings) {
  return ScotchYoke(Parameters(find_case("scotch_yoke").parameters, settings));
}

RunRequest request_with(const Settings& settings, int samples) {
  const Case& c = find_case("scotch_yoke");
  RequestOptions options;
  options.settings = settings;
  options.samples = samples;
  return make_request(c, options);
}

std::string refusal(const Settings& settings) {
  return yoke::tests::message_of([&] { choices_with(settings); });
}

TEST_SUITE("scotch-yoke") {
  TEST_CASE("wrong parameters are explained") {
    CHECK(refusal({"crank_lenght=50mm"})
              .starts_with("unknown parameter 'crank_lenght'; did you mean 'crank_length'? Known: "
                           "'crank_length', "));
    CHECK(refusal({"crank_length=60mm"}) ==
          "crank_length: 60 mm is out of range; accepted: 1 mm to 51.9 mm");
    CHECK(refusal({"pin_offset=-0.11mm"}) ==
          "pin_offset: -0.11 mm is out of range; accepted: -0.1 mm to 0.1 mm");
    CHECK(refusal({"pin=sliding"}) == "pin: 'sliding' is not one of fixed or rolling");
    CHECK(refusal({"contact_length=printed"}) ==
          "contact_length: 'printed' does not start with a finite number");
    CHECK(refusal({"alpha"}) == "--set alpha: expected name=value");
    CHECK(refusal({"spin_up=1s"}).starts_with("spin_up: during 1 s the crank turns 6 revol"));
    CHECK(refusal({"pin_offset=0.1mm", "walls=one", "contact_length=10mm"}) == "no error");
  }

  TEST_CASE("unknown laws and cases are explained") {
    const Case& c = find_case("scotch_yoke");
    CHECK_THROWS_WITH_AS(
        choose_laws(c, Parameters(c.parameters), {"jonson"}),
        doctest::Contains("unknown law 'jonson'; did you mean 'johnson'? Known: 'table11-"),
        ModelError);
    CHECK_THROWS_WITH_AS(find_case("scotchyoke"),
                         doctest::Contains("unknown case 'scotchyoke'; did you mean 'scotch_yoke'"),
                         ModelError);
    const std::vector<std::string> chosen{"table11-johnson", "johnson"};
    CHECK(choose_laws(c, Parameters(c.parameters), {"johnson", "table11-johnson", "johnson"}) ==
          chosen);
    CHECK(choose_laws(c, Parameters(c.parameters), {}).size() == 8);
  }

  // The pin's centre, put at radius R + offset from the arc's centre by the closed form, must be
  // seen by the slot at a penetration of -(gap -+ offset), whatever the crank length and the angle.
  TEST_CASE("the start pose agrees with the closed form") {
    for (const char* r : {"30mm", "45mm", "51.9mm"}) {
      for (const char* angle : {"-149deg", "-31deg", "7deg", "90deg", "200deg"}) {
        for (const double offset : {-0.07, 0.0, 0.04}) {
          const ScotchYoke choices =
              choices_with({fmt::format("crank_length={}", r), fmt::format("start_angle={}", angle),
                            fmt::format("pin_offset={}mm", offset)});
          const Model model = scotch_yoke(choices, scotch_yoke_laws(choices, "johnson"));
          const Result run = simulate(model, {.until = 1e-9, .samples = 2});
          CHECK(run["slot.penetration_m"][0] ==
                doctest::Approx(1e-3 * std::abs(offset) - 1e-4).epsilon(1e-9));
          CHECK(std::abs(run["slot.penetration_rate_m_per_s"][0]) < 1e-12);
          const double x = run["slider.x_m"][0] + arc_centre_offset(model, choices);
          const double R = 60.0_mm + 1e-3 * offset;
          const double phi = choices.start_angle, s = choices.crank_length * std::sin(phi);
          CHECK(x ==
                doctest::Approx(choices.crank_length * std::cos(phi) + std::sqrt(R * R - s * s))
                    .epsilon(1e-13));
        }
      }
    }
  }

  // Road: central differences of the position.
  TEST_CASE("velocity and acceleration of the closed form are derivatives of its position") {
    const double r = 0.0437, omega = 71.3, h = 1e-4;
    for (double phi = -3.0; phi < 3.0; phi += 0.37) {
      const auto x = [&](double angle) { return ideal_scotch_yoke(r, angle, omega).x; };
      const IdealMotion m = ideal_scotch_yoke(r, phi, omega);
      CHECK(m.v == doctest::Approx(omega * (x(phi + h) - x(phi - h)) / (2 * h)).epsilon(1e-6));
      const double second = omega * omega * (x(phi + h) - 2 * x(phi) + x(phi - h)) / (h * h);
      CHECK(std::abs(m.a - second) < 1e-3);
    }
  }

  TEST_CASE("masses: the moving mass is 2.353 kg, whoever carries the pin weighs it") {
    const ScotchYoke fixed = choices_with({}), rolling = choices_with({"pin=rolling"});
    const Model a = scotch_yoke(fixed, scotch_yoke_laws(fixed, "johnson"));
    const Model b = scotch_yoke(rolling, scotch_yoke_laws(rolling, "johnson"));
    CHECK(a.body(a.find_body("slider")).mass == doctest::Approx(2.353));
    CHECK(a.body(a.find_body("crank")).mass == doctest::Approx(0.105));
    CHECK(b.body(b.find_body("crank")).mass == doctest::Approx(0.090));
    CHECK(b.body(b.find_body("pin")).mass == doctest::Approx(0.015));
  }

  TEST_CASE("contact length multiplies the table and lengthens Johnson's cylinder") {
    const auto force = [](const Settings& settings, std::string_view law) {
      const ScotchYoke choices = choices_with(settings);
      return scotch_yoke_laws(choices, law).outer->elastic.response(20.0_um).force;
    };
    const double fit = force({}, "table11-johnson"), exact = force({}, "johnson");
    CHECK(fit == doctest::Approx(4.907e4 * std::pow(0.020, 1.10)));
    CHECK(force({"contact_length=1mm"}, "table11-johnson") == doctest::Approx(fit));
    CHECK(force({"contact_length=10mm"}, "table11-johnson") == doctest::Approx(10.0 * fit));
    CHECK(force({}, "table11-johnson-10mm") == doctest::Approx(10.0 * fit));
    CHECK(force({"contact_length=3mm"}, "johnson") == doctest::Approx(3.0 * exact));
    CHECK(force({}, "johnson-10mm") == doctest::Approx(10.0 * exact));
    CHECK(fit == doctest::Approx(exact).epsilon(0.02));
  }

  TEST_CASE("walls=one gives the inner wall the law of the outer") {
    const ScotchYoke choices = choices_with({"walls=one"});
    const SlotLaws laws = scotch_yoke_laws(choices, "table11-lankarani-nikravesh");
    const double d = 33.0_um;
    CHECK(laws.inner->elastic.response(d).force == laws.outer->elastic.response(d).force);
    CHECK(laws.cap->elastic.response(d).force > 2.0 * laws.outer->elastic.response(d).force);
  }

  // The slider stays within the gap and the penetration: at the closed form's slope of the arc, the
  // gap shows in x as gap / cos(psi), at most 1.52 gap for this crank.
  TEST_CASE("the slider follows the mechanism without clearance") {
    const RunRequest request = request_with({"revolutions=1"}, 401);
    const ScotchYoke choices(request.parameters);
    const LawRun run = run_law(find_case("scotch_yoke"), request, "table11-johnson", {});
    REQUIRE(run.summary.ok());
    const auto angle = run.history["crank_angle_rad"], x = run.history["slider_x_m"];
    double worst = 0.0;
    for (Eigen::Index i = 0; i < x.size(); ++i)
      worst = std::max(worst, std::abs(x[i] - ideal_scotch_yoke(45.0_mm, angle[i], 0.0).x));
    CHECK(worst > 0.9 * 0.1_mm);
    CHECK(worst < 1.52 * (0.1_mm + run.largest_penetration()));
    CHECK(angle[0] == doctest::Approx(-31.0_deg));
    CHECK(angle[angle.size() - 1] == doctest::Approx(329.0_deg));
    CHECK(run.onsets() > 10);
  }

  TEST_CASE("errata: not only Goldsmith separates between 120 and 300 deg") {
    for (const char* law : {"table11-goldsmith", "table11-johnson", "table11-radzimovsky",
                            "table11-esdu-78035", "table11-lankarani-nikravesh"}) {
      INFO(law);
      const RunRequest request = request_with({"revolutions=2"}, 2);
      const ScotchYoke choices(request.parameters);
      const LawRun run = run_law(find_case("scotch_yoke"), request, law, {});
      REQUIRE(run.summary.ok());
      const double start = choices.last_revolution_start();
      const long separations =
          std::count_if(run.events.begin(), run.events.end(), [&](const EventRecord& event) {
            const double angle = (event.t - start) * scotch_yoke_data::speed;  // since the start
            return event.kind == "release" && angle > 120.0_deg && angle < 300.0_deg;
          });
      CHECK(separations >= 3);
    }
  }

  // Without clearance the force changes its side at 94.6 deg of relative crank angle; the pin then
  // needs 12 to 14 deg to cross the gap.
  TEST_CASE("the pin crosses the gap near 100 deg, lands and lets go again") {
    const RunRequest request = request_with({"revolutions=0.5"}, 401);
    const ScotchYoke choices(request.parameters);
    const LawRun run = run_law(find_case("scotch_yoke"), request, "johnson", {});
    const auto all = flights(run);
    const auto crossing = std::ranges::find_if(all, &Flight::crosses);
    REQUIRE(crossing != all.end());
    const double degrees = scotch_yoke_data::speed * 180.0 / pi;
    CHECK(crossing->from * degrees < 99.0);
    CHECK(crossing->to * degrees > 104.0);
    CHECK(crossing->to * degrees < 109.0);
    CHECK(crossing->landing_speed == doctest::Approx(0.18).epsilon(0.15));

    const auto spells = contact_spells(run, run.all(), 0.0, choices.end_time());
    CHECK(spells.front().region == "outer");
    CHECK(!spells.front().crossed);
    const auto inner = std::ranges::find(spells, "inner", &ContactSpell::region);
    REQUIRE(inner != spells.end());
    CHECK(inner->crossed);
    CHECK(inner->last - inner->first > 50);
    const auto force = run.all()["slot.normal_force_N"];
    const auto last = static_cast<Eigen::Index>(inner->last) - 1;  // just before the release
    for (auto row = static_cast<Eigen::Index>(inner->first); row < last; ++row)
      CHECK(force[row] > 0.0);
    CHECK(force[last] == doctest::Approx(0.0).scale(run.peak_force()).epsilon(1e-9));
  }

  TEST_CASE("after many turns BDF at a tight tolerance takes steps of high order") {
    // Noise in the history would bring it to order 1.
    const Case& c = find_case("scotch_yoke");
    const Model model = make_model(c, Parameters(c.parameters, {}), "table11-johnson");
    for (const char* formulation : {"cvode-projection", "ida-ggl", "ida-baumgarte"}) {
      INFO(formulation);
      const Result run = simulate(model, {.until = 10.0 * 2.0 * pi / scotch_yoke_data::speed,
                                          .relative_tolerance = 1e-11,
                                          .formulation = formulation});
      REQUIRE(run.summary.ok());
      CHECK(run.summary.steps < 10 * 20'000);
    }
  }

  TEST_CASE("a pin that rolls changes nothing, without friction") {
    const RunRequest fixed = request_with({"revolutions=0.25"}, 101);
    const RunRequest rolling = request_with({"revolutions=0.25", "pin=rolling"}, 101);
    const LawRun a = run_law(find_case("scotch_yoke"), fixed, "johnson", {});
    const LawRun b = run_law(find_case("scotch_yoke"), rolling, "johnson", {});
    CHECK((a.samples["slider.x_m"] - b.samples["slider.x_m"]).cwiseAbs().maxCoeff() < 1e-9);
    CHECK(b.history["pin_speed_rad_per_s"].cwiseAbs().maxCoeff() < 1e-9);
  }
}

}  // namespace
