// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A hundred revolutions of the scotch-yoke: how far the constraints are violated. `violation` is
// what results contain, after projection; `drift` is what the integrator had before it, at 20 000
// samples and every event. The pin as part of the crank (centre of mass beside the pivot, so the
// pivot is nonlinear) and as a roller of its own.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include <yoke/cases/case.hpp>
#include <yoke/cases/scotch_yoke.hpp>
#include <yoke/integrators/simulate.hpp>

namespace {

using namespace yoke;
using namespace yoke::cases;

constexpr double position_limit = 1e-10;                        // [m], [rad]
constexpr double velocity_limit = 1e-8;                         // [m/s], [rad/s]
constexpr double rounding = 16.0 * 2.2e-16 * 100.0 * 2.0 * pi;  // [rad] of the angle in the end

Model mechanism(const std::string& pin) {
  const Case& c = find_case("scotch_yoke");
  return make_model(c, Parameters(c.parameters, {"pin=" + pin}), "table11-johnson");
}

Summary turn(const Model& model, const std::string& formulation, double rtol, int revolutions) {
  const double until = revolutions * 2.0 * pi / scotch_yoke_data::speed;
  const Result run = simulate(model, {.until = until,
                                      .relative_tolerance = rtol,
                                      .formulation = formulation,
                                      .samples = 200 * revolutions + 1});
  REQUIRE(run.summary.ok());
  const Summary& s = run.summary;
  MESSAGE(
      fmt::format("{} rtol {:g}, {} revolutions: violation {:.1e} m {:.1e} m/s, drift {:.1e} m "
                  "{:.1e} m/s, {} steps, {} events, {:.2f} s",
                  formulation, rtol, revolutions, s.position_violation, s.velocity_violation,
                  s.position_drift, s.velocity_drift, s.steps, s.events, s.wall_time));
  CHECK(s.position_violation < position_limit);
  CHECK(s.velocity_violation < velocity_limit);
  CHECK(s.fresh_factorisations <= 4);
  return s;
}

}  // namespace

TEST_CASE("100 revolutions with projection stay on the constraints at any tolerance") {
  for (const std::string pin : {"fixed", "rolling"}) {
    const Model model = mechanism(pin);
    for (const double rtol : {1e-4, 1e-6, 1e-8}) {
      INFO(pin, " ", rtol);
      const Summary s = turn(model, "arkode-projection", rtol, 100);
      // Before the projection of a sample there is the error of the dense output between two
      // projected steps. It depends on the tolerance, not on how long the run has been; what does
      // grow is the rounding of the crank's angle, to which positions are projected.
      const Summary start = turn(model, "arkode-projection", rtol, 10);
      CHECK(s.position_drift < 5.0 * start.position_drift + rounding);
      // A rounded angle turns the velocity of the pin by as much.
      const double pin_speed = scotch_yoke_data::speed * 0.045;  // [m/s]
      CHECK(s.velocity_drift < 5.0 * start.velocity_drift + rounding * pin_speed);
    }
  }
}

TEST_CASE("100 revolutions with the stabilised index-2 form stay on the constraints at 1e-11") {
  const Summary s = turn(mechanism("fixed"), "ida-ggl", 1e-11, 100);
  CHECK(s.position_drift < position_limit);
  CHECK(s.velocity_drift < velocity_limit);
}

TEST_CASE("100 revolutions of the stabilised index-2 form are projected in results at any rtol") {
  const Model model = mechanism("rolling");
  for (const double rtol : {1e-4, 1e-6, 1e-8}) turn(model, "ida-ggl", rtol, 100);
}

TEST_CASE("100 revolutions with Baumgarte's stabilisation drift, which is printed, not judged") {
  const Model model = mechanism("rolling");
  for (const double rtol : {1e-4, 1e-6, 1e-8}) turn(model, "arkode-baumgarte", rtol, 100);
}
