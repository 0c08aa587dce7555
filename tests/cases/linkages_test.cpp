// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The linkages among the cases against references that share no code with them.
#include <doctest/doctest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>

#include <yoke/cases/case.hpp>
#include <yoke/integrators/analyses/kinematics.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/tests/messages.hpp>

namespace {

using namespace yoke;
using namespace yoke::cases;
using yoke::tests::contains;
using yoke::tests::message_of;
using Complex = std::complex<double>;

struct CaseRun {
  Parameters parameters;
  Model model;
  Result result;
};

CaseRun run_of(const char* name, const std::vector<std::string>& settings, int samples = 401,
               double rtol = 1e-9) {
  const Case& c = find_case(name);
  Parameters p(c.parameters, settings);
  Model m = make_model(c, p);
  Result r = simulate(m, {.until = c.duration(p), .relative_tolerance = rtol, .samples = samples});
  REQUIRE_MESSAGE(r.summary.ok(), r.summary.reason);
  for (const Check& check : c.checks(p, m, r)) CHECK_MESSAGE(check.within(), text_of(check));
  return {std::move(p), std::move(m), std::move(r)};
}

// ---- Jansen's leg: Newton's method on the ten lengths, from the drawing of the leg

/// Foot for a crank at `angle`, in Jansen's units, continued from the joints before.
struct DrawnLeg {
  // D, E, G, H, F; roughly as the leg is drawn with the crank to the right.
  Eigen::Matrix<double, 10, 1> joints =
      (Eigen::Matrix<double, 10, 1>() << -30, 32, -73, 12, -33, -47, -67, -37, -43, -92).finished();

  Vec2 foot(double angle) {
    const Vec2 B(-38.0, -7.8), C = 15.0 * Vec2(std::cos(angle), std::sin(angle));
    for (int i = 0; i < 60; ++i) {
      Eigen::Matrix<double, 10, 1> error;
      Eigen::Matrix<double, 10, 10> slope = Eigen::Matrix<double, 10, 10>::Zero();
      int row = 0;
      // from = -1: a point that is given.
      const auto rod = [&](int to, int from, const Vec2& start, double length) {
        const Vec2 way = joints.segment<2>(2 * to) - start;
        error[row] = way.squaredNorm() - length * length;
        slope.block<1, 2>(row, 2 * to) = 2.0 * way.transpose();
        if (from >= 0) slope.block<1, 2>(row, 2 * from) = -2.0 * way.transpose();
        ++row;
      };
      const auto at = [&](int joint) { return Vec2(joints.segment<2>(2 * joint)); };
      enum { D, E, G, H, F };
      rod(D, -1, C, 50.0);
      rod(D, -1, B, 41.5);
      rod(E, -1, B, 40.1);
      rod(E, D, at(D), 55.8);
      rod(G, -1, C, 61.9);
      rod(G, -1, B, 39.3);
      rod(H, E, at(E), 39.4);
      rod(H, G, at(G), 36.7);
      rod(F, G, at(G), 49.0);
      rod(F, H, at(H), 65.7);
      const Eigen::Matrix<double, 10, 1> step = slope.fullPivLu().solve(error);
      joints -= step;
      if (step.norm() < 1e-13) break;
    }
    return joints.segment<2>(8);
  }
};

TEST_SUITE("linkages") {
  TEST_CASE("Jansen's leg: the foot is where ten lengths put it, all the way round") {
    const CaseRun run = run_of("jansen_leg", {"unit=2mm", "speed=90"}, 721);
    CHECK(run.model.body_count() == 12);  // eleven links and the foot
    const Eigen::VectorXd t = run.result["t_s"], x = run.result["foot.x_m"],
                          y = run.result["foot.y_m"];
    DrawnLeg leg;
    double worst = 0.0;
    for (Eigen::Index i = 0; i < t.size(); ++i) {
      const Vec2 foot = 2e-3 * leg.foot(3.0 * pi * t[i]);
      worst = std::max(worst, (foot - Vec2(x[i], y[i])).norm());
    }
    CHECK(worst < 1e-12);

    // It walks: for 47 % of the turn the foot is within a 50th of the stride from the ground.
    const double stride = x.maxCoeff() - x.minCoeff();
    CHECK(stride > 0.1);
    long near = 0;
    for (const double height : y) near += height - y.minCoeff() < 0.02 * stride ? 1 : 0;
    CHECK(static_cast<double>(near) / static_cast<double>(y.size()) ==
          doctest::Approx(0.467).epsilon(0.01));
  }

  TEST_CASE("Jansen's leg: over a turn the motor does no work") {
    const CaseRun run = run_of("jansen_leg", {"turns=1"});
    const Eigen::VectorXd work = run.result["work_J"];
    CHECK(work.cwiseAbs().maxCoeff() > 1.0);
    CHECK(std::abs(work.tail(1)[0]) < 1e-7);
  }

  TEST_CASE("quick return: the loop closes in complex numbers") {
    const CaseRun run = run_of("quick_return", {"crank=80mm", "distance=210mm", "speed=90"}, 801);
    const Eigen::VectorXd t = run.result["t_s"], lever = run.result["lever.angle_rad"],
                          ram = run.result["ram.x_m"];
    const double beta = std::asin(80.0 / 210.0), height = 0.25 * (1.0 + std::cos(beta));
    for (Eigen::Index i = 0; i < t.size(); ++i) {
      const Complex pin =
          Complex(0.0, 0.21) + 0.08 * std::exp(Complex(0.0, pi / 2.0 + 3.0 * pi * t[i]));
      const Complex tip = 0.5 * pin / std::abs(pin);
      CHECK(std::abs(lever[i] - std::arg(pin)) < 1e-12);
      CHECK(std::abs(std::abs(tip - Complex(ram[i], height)) - 0.3) < 1e-12);  // the link's length
      CHECK(ram[i] < tip.real());
    }
  }

  TEST_CASE("quick return: the ram works longer than it returns") {
    const CaseRun run = run_of("quick_return", {}, 4001);
    // beta = 30 deg: 240 deg of work, 120 deg of return; counted by rows of the first turn.
    const Eigen::VectorXd v = run.result["ram.vx_m_per_s"];
    const long work =
        std::count_if(v.begin(), v.begin() + 2000, [](double at) { return at < 0.0; });
    CHECK(std::abs(static_cast<double>(work) / 2000.0 - 240.0 / 360.0) < 1e-3);
    const Eigen::VectorXd x = run.result["ram.x_m"];
    CHECK(x.maxCoeff() - x.minCoeff() == doctest::Approx(0.5).epsilon(1e-5));
  }

  TEST_CASE("quick return: a steep link turns the ram back before the lever") {
    // 2 lever sin(beta) = 900 mm; by the way back of the ram the short link makes it longer.
    const auto stroke = [](const CaseRun& run) {
      const Eigen::VectorXd x = run.result["ram.x_m"];
      return x.maxCoeff() - x.minCoeff();
    };
    CHECK(stroke(run_of("quick_return", {"crank=180mm", "link=800mm"}, 4001)) ==
          doctest::Approx(0.9).epsilon(1e-4));
    CHECK(stroke(run_of("quick_return", {"crank=180mm"}, 4001)) > 0.9001);
  }

  TEST_CASE("quick return: dimensions that do not fit are refused") {
    const auto refused = [](const std::vector<std::string>& settings) {
      const Case& c = find_case("quick_return");
      return message_of([&] { make_model(c, Parameters(c.parameters, settings)); });
    };
    CHECK(contains(refused({"crank=200mm"}), "crank = 200 mm must be shorter than 0.99 times"));
    CHECK(contains(refused({"lever=290mm"}), "lever = 290 mm must be longer than crank and"));
    CHECK(contains(refused({"link=20mm"}), "link = 20 mm must be longer than the tip rises"));
  }

  TEST_CASE("platform: height and the cylinder's force from energies differentiated by time") {
    // Cycloidal over 1.5 s from 20 to 60 deg, 3 linkages, 120 kg on arms of 0.8 m.
    const double arm = 0.8, T = 1.5, low = pi / 9.0, high = pi / 3.0;
    const CaseRun run = run_of("scott_russell_platform",
                               {"arm=800mm", "linkages=3", "low=20deg", "high=60deg", "time=1.5s",
                                "load=120", "law=cycloidal"},
                               901, 1e-11);
    const auto slide = [&](double t) {
      const double u = t / T, from = arm * std::cos(low), to = arm * std::cos(high);
      return from + (to - from) * (u - std::sin(2.0 * pi * u) / (2.0 * pi));
    };
    const auto angle = [&](double t) { return std::acos(slide(t) / arm); };
    const double h = 1e-4;
    const auto rate = [&](const auto& f, double t) {
      return (8.0 * (f(t + h) - f(t - h)) - (f(t + 2 * h) - f(t - 2 * h))) / (12.0 * h);
    };
    // All moving parts by the rods' angle: rods turn about M, which moves on a circle as cranks do.
    const auto energy = [&](double t) {
      const double w = rate(angle, t), a = angle(t), v = rate(slide, t);
      const double up = arm * std::cos(a) * w, middle = 0.5 * arm * w;
      const double rod = 0.5 * 8.0 * middle * middle + 0.5 * 8.0 * arm * arm / 12.0 * w * w;
      const double crank = 0.5 * (4.0 * 0.25 * arm * arm / 3.0) * w * w;
      const double height = arm * std::sin(a);
      return 0.5 * 120.0 * up * up + 0.5 * 10.0 * v * v + 3.0 * (rod + crank) +
             9.81 * height * (120.0 + 3.0 * (0.5 * 8.0 + 0.25 * 4.0));
    };
    const Eigen::VectorXd t = run.result["t_s"], y = run.result["platform.y_m"],
                          force = run.result["cylinder.fx_N"];
    int rows = 0;
    for (Eigen::Index i = 0; i < t.size(); ++i) {
      if (t[i] < 0.2 || t[i] > T - 0.2) continue;
      CHECK(std::abs(y[i] - arm * std::sin(angle(t[i]))) < 1e-12);
      const double expected = rate(energy, t[i]) / rate(slide, t[i]);
      CHECK(std::abs(force[i] - expected) < 1e-5 * std::abs(expected));
      ++rows;
    }
    CHECK(rows > 200);
    CHECK(run.result.summary.redundant_equations.size() == 5);
  }

  TEST_CASE("platform: one linkage or many, the same motion and pull") {
    const CaseRun one = run_of("scott_russell_platform", {"linkages=1"});
    const CaseRun four = run_of("scott_russell_platform", {"linkages=4"});
    CHECK((one.result["platform.y_m"] - four.result["platform.y_m"]).cwiseAbs().maxCoeff() < 1e-12);
    CHECK(one.result.summary.redundant_equations.size() == 1);
    CHECK(four.result.summary.redundant_equations.size() == 7);
    const Case& c = find_case("scott_russell_platform");
    const std::string message = message_of([&] {
      make_model(c, Parameters(c.parameters, {"low=50deg", "high=40deg"}));
    });
    CHECK(contains(message, "low = 50 deg must be less than high, 40 deg"));
  }
}

TEST_CASE(
    "a linkage that only comes near a singular position keeps its formulation at long steps") {
  // The least independence is a tenth of the largest. A crossing factorises more often than it evaluates.
  const Summary run = run_of("quick_return", {}, 51, 1e-4).result.summary;
  CHECK(run.steps < 100);
  CHECK(run.refactorisations < run.evaluations + run.recording_evaluations);
}

}  // namespace
