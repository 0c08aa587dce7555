// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The cases with clearance against small integrations of their own equations, against closed forms
// without clearance, and in several formulations.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include <yoke/cases/case.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/tests/cases/clearance/own_contact.hpp>
#include <yoke/tests/messages.hpp>

namespace {

using namespace yoke;
using namespace yoke::cases;
using namespace yoke::tests;
using Complex = std::complex<double>;
using State4 = Eigen::Vector4d;

struct CaseOptions {
  double until = 0.0;  // [s] 0: of the case
  std::string formulation = "automatic";
  double rtol = 1e-10;
  int samples = 401;
};

/// A run of a case under its base law; its checks are within their tolerances.
Result run_of(const char* name, const std::vector<std::string>& settings,
              const CaseOptions& o = {}) {
  const Case& c = find_case(name);
  const Parameters p(c.parameters, settings);
  const Model m = make_model(c, p);
  Result r = simulate(m, {.until = o.until > 0.0 ? o.until : c.duration(p),
                          .relative_tolerance = o.rtol,
                          .formulation = o.formulation,
                          .samples = o.samples});
  REQUIRE_MESSAGE(r.summary.ok(), r.summary.reason);
  const std::vector<Check> checks = c.checks(p, m, r);
  CHECK(checks.size() >= 2);
  for (const Check& check : checks) CHECK_MESSAGE(check.within(), text_of(check));
  return r;
}

std::vector<double> onsets_of(const Result& run, std::string_view element) {
  std::vector<double> times;
  for (const EventRecord& e : run.events)
    if (e.element == element && e.kind == "onset") times.push_back(e.t);
  return times;
}

std::string refusal(const char* name, const std::vector<std::string>& settings) {
  const Case& c = find_case(name);
  return message_of([&] { make_model(c, Parameters(c.parameters, settings)); });
}

Vec2 direction(double angle) { return {std::cos(angle), std::sin(angle)}; }
Vec2 left_of(const Vec2& v) { return {-v.y(), v.x()}; }

// ---- slider-crank with clearance at the slider's pin

/// y = (angle of the rod, x of the slider, their rates); the crank turns at constant speed.
struct OwnSliderCrank {
  static constexpr double r = 0.05, l = 0.12, omega = 5000.0 * pi / 30.0, c = 0.5e-3;
  static constexpr double rod_mass = 0.21, rod_inertia = 2.5e-5, slider_mass = 0.14;
  OwnContact contact{hertz_stiffness(0.010 * 0.0105 / 0.0005), 0.9};

  struct Seen {
    Vec2 normal;
    double depth, rate;
  };
  Seen see(double t, const State4& y) const {
    const Vec2 crank = direction(omega * t), rod = direction(y[0]);
    const Vec2 way = Vec2(y[1], 0.0) - r * crank - l * rod;
    const Vec2 speed = Vec2(y[3], 0.0) - r * omega * left_of(crank) - l * y[2] * left_of(rod);
    const Vec2 n = way.norm() > 0.0 ? Vec2(way.normalized()) : Vec2(1.0, 0.0);
    return {n, way.norm() - c, n.dot(speed)};
  }
  State4 rates(double t, const State4& y) const {
    const Seen now = see(t, y);
    const double F = contact.force(now.depth, now.rate);
    const Vec2 pin = -r * omega * omega * direction(omega * t), across = left_of(direction(y[0]));
    const double turn = (-rod_mass * 0.5 * l * across.dot(pin) + l * across.dot(F * now.normal)) /
                        (rod_inertia + 0.25 * rod_mass * l * l);
    return {y[2], y[3], turn, -F * now.normal.x() / slider_mass};
  }
  State4 run(double until, double h) {
    State4 y(0.0, r + l, -omega * r / l, 0.0);
    for (long i = 0; i < std::lround(until / h); ++i) {
      const double t = static_cast<double>(i) * h;
      y = rk4<4>([&](double s, const State4& at) { return rates(s, at); }, t, h, y);
      const Seen now = see(t + h, y);
      contact.note(t + h, h, now.depth, now.rate);
    }
    return y;
  }
};

TEST_SUITE("clearance cases") {
  TEST_CASE("slider-crank with clearance: flights and impacts of an integration of its own") {
    OwnSliderCrank own;
    const double until = 1.2e-3;
    const State4 end = own.run(until, 2e-8);
    const Result run = run_of("slider_crank_clearance", {}, {.until = until, .samples = 2001});
    const std::vector<double> onsets = onsets_of(run, "slider pin");
    REQUIRE(own.contact.onsets.size() >= 4);
    REQUIRE(onsets.size() == own.contact.onsets.size());
    for (std::size_t i = 0; i < onsets.size(); ++i)
      CHECK(std::abs(onsets[i] - own.contact.onsets[i]) < 1e-8);
    CHECK(std::abs(run["slider.x_m"](2000) - end[1]) < 1e-8);
    CHECK(std::abs(run["rod.angle_rad"](2000) - end[0]) < 1e-7);
  }

  TEST_CASE("slider-crank without clearance: positions, reactions and torque in many digits") {
    // In quadruple precision, at 8 ms.
    const Result run = run_of("slider_crank_clearance", {"clearance=ideal", "turns=1"},
                              {.until = 8e-3, .samples = 2});
    CHECK(std::abs(run["slider.x_m"](1) - 0.086915146427996957) < 1e-11);
    CHECK(std::abs(run["slider.ax_m_per_s2"](1) - 9686.7864565433991) < 1e-6);
    CHECK(std::abs(std::abs(run["slider pin.fx_N"](1)) - 1356.1501039160759) < 1e-6);
    CHECK(std::abs(std::abs(run["slider pin.fy_N"](1)) - 259.96882742344159) < 1e-6);
    CHECK(std::abs(std::abs(run["motor.moment_N_m"](1)) - 96.266067931333914) < 1e-7);
  }

  TEST_CASE("slider-crank with clearance: formulations agree through the first impacts") {
    const Result a = run_of("slider_crank_clearance", {}, {.until = 2e-3});
    for (const std::string other : {"ida-ggl", "cvode-projection", "adams-baumgarte"}) {
      INFO(other);
      const Result b = run_of("slider_crank_clearance", {}, {.until = 2e-3, .formulation = other});
      CHECK(onsets_of(a, "slider pin").size() == onsets_of(b, "slider pin").size());
      CHECK((a["slider.x_m"] - b["slider.x_m"]).cwiseAbs().maxCoeff() < 1e-7);
    }
  }

  // ---- slider in a guide with clearance

  TEST_CASE("slider in a guide: a double pendulum with a tip that bounces between two walls") {
    // y = (angles of crank and rod, their rates). Without spin both corners of a side touch at once.
    const double l1 = 0.153, l2 = 0.306, m1 = 0.038, m2 = 0.038, m3 = 0.076, g = 9.81;
    const double A = 7.4e-5 + 0.25 * m1 * l1 * l1 + (m2 + m3) * l1 * l1,
                 B = 5.9e-4 + 0.25 * m2 * l2 * l2 + m3 * l2 * l2, C = (0.5 * m2 + m3) * l1 * l2;
    OwnContact upper{2.0 * hertz_stiffness(1e-3 * 1.0 / 1.001), 0.9}, lower = upper;
    const auto tip = [&](const State4& y) { return l1 * std::sin(y[0]) + l2 * std::sin(y[1]); };
    const auto speed = [&](const State4& y) {
      return l1 * std::cos(y[0]) * y[2] + l2 * std::cos(y[1]) * y[3];
    };
    const auto rates = [&](double, const State4& y) {
      const double c = std::cos(y[0] - y[1]), s = std::sin(y[0] - y[1]);
      const double F =
          lower.force(-tip(y) - 1e-3, -speed(y)) - upper.force(tip(y) - 1e-3, speed(y));
      const double p = -C * s * y[3] * y[3] - (0.5 * m1 + m2 + m3) * g * l1 * std::cos(y[0]) +
                       F * l1 * std::cos(y[0]);
      const double q =
          C * s * y[2] * y[2] - (0.5 * m2 + m3) * g * l2 * std::cos(y[1]) + F * l2 * std::cos(y[1]);
      const double D = A * B - C * C * c * c;
      return State4(y[2], y[3], (B * p - C * c * q) / D, (A * q - C * c * p) / D);
    };
    State4 y(0.0, 0.0, 150.0, -75.0);
    const double h = 2e-7, until = 0.03;
    for (long i = 0; i < std::lround(until / h); ++i) {
      const double t = static_cast<double>(i) * h;
      y = rk4<4>(rates, t, h, y);
      upper.note(t + h, h, tip(y) - 1e-3, speed(y));
      lower.note(t + h, h, -tip(y) - 1e-3, -speed(y));
    }
    const Result run = run_of("slider_guide_clearance", {"spin=0"}, {.until = until});
    CHECK(onsets_of(run, "guide front left").front() == doctest::Approx(2.69e-3).epsilon(2e-3));
    for (const std::pair<const char*, const OwnContact*>& side :
         {std::pair<const char*, const OwnContact*>{"guide front left", &upper},
          {"guide back left", &upper},
          {"guide front right", &lower},
          {"guide back right", &lower}}) {
      const char* element = side.first;
      const OwnContact* own = side.second;
      const std::vector<double> onsets = onsets_of(run, element);
      INFO(element);
      REQUIRE(onsets.size() == own->onsets.size());
      for (std::size_t i = 0; i < onsets.size(); ++i)
        CHECK(std::abs(onsets[i] - own->onsets[i]) < 1e-8);
    }
    CHECK(upper.onsets.size() + lower.onsets.size() >= 3);
    CHECK(std::abs(run["crank.angle_rad"](400) - y[0]) < 1e-7);
    CHECK(std::abs(run["slider.y_m"](400) - tip(y)) < 1e-8);
    CHECK(run["slider.angle_rad"].cwiseAbs().maxCoeff() < 1e-9);
  }

  TEST_CASE("slider in a guide: one that spins rattles on single corners; ideal it follows") {
    const Result run = run_of("slider_guide_clearance", {}, {.until = 0.03});
    // Until it lands the slider turns freely: 0.2 rad/s lift the corner by 12.2 um.
    const std::vector<double> front = onsets_of(run, "guide front left"),
                              back = onsets_of(run, "guide back left");
    REQUIRE(!front.empty());
    REQUIRE(!back.empty());
    CHECK(front[0] < 2.6925e-3);
    CHECK(back[0] > front[0] + 1e-6);
    CHECK(run["slider.angle_rad"].cwiseAbs().maxCoeff() > 5e-3);
    run_of("slider_guide_clearance", {"clearance=ideal", "spin=0"});
    CHECK(contains(refusal("slider_guide_clearance", {"clearance=ideal", "spin=1"}),
                   "spin = 1 rad/s must be 0 with an ideal guide"));
  }

  // ---- four-bar

  TEST_CASE("four-bar without clearance: the loop closes in complex numbers") {
    const Result run = run_of("four_bar_clearance", {"clearance=ideal", "crank=45mm"});
    const Eigen::VectorXd crank = run["crank.angle_rad"], coupler = run["coupler.angle_rad"],
                          rocker = run["rocker.angle_rad"];
    const auto arm = [](double length, double angle) {
      return length * std::exp(Complex(0.0, angle));
    };
    for (Eigen::Index i = 0; i < crank.size(); ++i)
      CHECK(std::abs(arm(0.045, crank[i]) + arm(0.12, coupler[i]) - 0.11 - arm(0.09, rocker[i])) <
            1e-12);
  }

  TEST_CASE("four-bar: the smaller the clearance, the nearer the ideal one") {
    const auto rocker = [](const char* clearance) {
      return Eigen::VectorXd(run_of("four_bar_clearance",
                                    {std::string("clearance=") + clearance, "bearings=one"},
                                    {.until = 0.02})["rocker.angle_rad"]);
    };
    const Eigen::VectorXd ideal = rocker("ideal");
    // The rocker's end leaves its circle by clearance and penetration, seen under the transmission
    // angle: at least 40 deg here.
    const double wide = (rocker("0.1mm") - ideal).cwiseAbs().maxCoeff(),
                 narrow = (rocker("0.01mm") - ideal).cwiseAbs().maxCoeff();
    const double steep = 0.09 * std::sin(40.0 * pi / 180.0);
    CHECK(wide < 0.11e-3 / steep);
    CHECK(wide > 0.5 * 0.1e-3 / 0.09);  // it does use its play
    CHECK(narrow < 0.02e-3 / steep);
    const Result three = run_of("four_bar_clearance", {"turns=0.2"});
    CHECK(three.summary.degrees_of_freedom == 6);
    CHECK(contains(refusal("four_bar_clearance", {"rocker=20mm"}), "coupler + rocker"));
    CHECK(contains(refusal("four_bar_clearance", {"coupler=300mm"}), "|coupler - rocker|"));
  }

  // ---- the quick return's slot

  TEST_CASE("quick return with a real slot: the lever follows within the clearance") {
    for (const char* clearance : {"0.05mm", "0.5mm"}) {
      const Result run =
          run_of("quick_return", {std::string("clearance=") + clearance, "turns=0.5"});
      CHECK(run.summary.degrees_of_freedom == 1);
      CHECK(onsets_of(run, "slot").size() > 2);
      // From the top through the return to the ram's far side: ideal lever by the pin's place.
      const Eigen::VectorXd t = run["t_s"], lever = run["lever.angle_rad"];
      double worst = 0.0;
      for (Eigen::Index i = 0; i < t.size(); ++i) {
        const Complex pin =
            Complex(0.0, 0.2) + 0.1 * std::exp(Complex(0.0, pi / 2.0 + 2.0 * pi * t[i]));
        worst = std::max(worst, std::abs(pin) * std::abs(std::sin(lever[i] - std::arg(pin))));
      }
      const double c = std::stod(clearance) * 1e-3;
      CHECK(worst > 0.99 * c);
      CHECK(worst < c + 0.05e-3);
    }
  }

  TEST_CASE(
      "scotch-yoke: a spline's slot does what the arc's does, the ideal one the closed form") {
    const Result arc = run_of("scotch_yoke", {}, {.until = 0.02}),
                 spline = run_of("scotch_yoke", {"slot=spline"}, {.until = 0.02});
    const std::vector<double> a = onsets_of(arc, "slot"), b = onsets_of(spline, "slot");
    REQUIRE(a.size() == b.size());
    CHECK(a.size() >= 2);
    for (std::size_t i = 0; i < a.size(); ++i) CHECK(std::abs(a[i] - b[i]) < 1e-7);
    CHECK((arc["slider.x_m"] - spline["slider.x_m"]).cwiseAbs().maxCoeff() < 1e-8);

    const Result ideal = run_of("scotch_yoke", {"slot=ideal", "crank_length=50mm"});
    run_of("scotch_yoke", {"slot=ideal", "pin=rolling"});
    // F = m X'' R / root with root = sqrt(R^2 - r^2 sin^2), by differences of the closed form.
    const double r = 0.05, R = 0.06, w = 24.0 * pi;
    const auto x = [&](double phi) {
      return r * std::cos(phi) + std::sqrt(R * R - r * r * std::sin(phi) * std::sin(phi));
    };
    const Eigen::VectorXd phi = ideal["crank.angle_rad"], fx = ideal["slot.fx_N"],
                          fy = ideal["slot.fy_N"];
    double worst = 0.0;
    for (Eigen::Index i = 0; i < phi.size(); ++i) {
      const double h = 1e-4, bend = (x(phi[i] + h) - 2.0 * x(phi[i]) + x(phi[i] - h)) / (h * h);
      const double root = x(phi[i]) - r * std::cos(phi[i]);
      worst = std::max(
          worst, std::abs(std::hypot(fx[i], fy[i]) - std::abs(2.353 * w * w * bend * R / root)));
    }
    CHECK(worst < 1e-3);  // [N] of 2 kN, the error of the differences
    CHECK(contains(refusal("scotch_yoke", {"slot=ideal", "pin_offset=0.1mm"}),
                   "pin_offset = 0.1 mm must be 0 mm with slot=ideal"));
  }
}

}  // namespace
