// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What generality costs: the paper's scotch-yoke (Johnson's column of Table 11) run by Yoke beside
// the same mechanism derived by hand with one degree of freedom, on the same integrator with the
// same tolerance, events and end time. Unknown of the hand-made model: slider position x and
// velocity v; the crank angle is a known function of time, so its reactions and torque are not
// computed at all. Both are run in turn; the counters are medians:
//   step_ratio        time per accepted step, Yoke / by hand (aim: 4)
//   revolution_ratio  time per revolution, Yoke / by hand
#include <arkode/arkode_erkstep.h>
#include <benchmark/benchmark.h>
#include <idas/idas.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <yoke/integrators/sundials/compatibility.hpp>
#include <yoke/integrators/sundials/context.hpp>
#include <yoke/tests/bench/chain.hpp>
#include <yoke/tests/integrators/mechanisms.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace {

using namespace yoke;
using namespace yoke::bench;
constexpr double revolutions = 2.0;

// ---- the mechanism by hand
// -----------------------------------------------------------------------

struct HandMade {
  static constexpr double r = 0.045, R = 0.060, clearance = 1e-4, mass = 2.353;
  static constexpr double omega = 24.0 * pi, start = -31.0 * pi / 180.0, alpha = 0.32;
  // N/m^n of inner and outer wall (Table 11 in N/mm^n times 1000^n), n = 1.1
  const std::array<double, 2> K{4.914e4 * std::pow(1000.0, 1.1), 4.907e4 * std::pow(1000.0, 1.1)};
  int wall = -1;  // -1 apart, 0 inner, 1 outer
  long steps = 0;

  struct Gap {
    double penetration, rate, nx;  // nx: d(penetration)/dx
    int wall;
  };
  Gap gap(double t, double x, double v, int on) const {
    const double phi = start + omega * t;
    const double px = r * std::cos(phi), py = r * std::sin(phi);
    const double dx = px - x, rho = std::sqrt(dx * dx + py * py);
    const double rho_dot = (dx * (-omega * py - v) + py * omega * px) / rho;
    const int side = on >= 0 ? on : (rho > R ? 1 : 0);
    const double sign = side == 1 ? 1.0 : -1.0;
    return {sign * (rho - R) - clearance, sign * rho_dot, -sign * dx / rho, side};
  }
  double acceleration(double t, double x, double v) const {
    if (wall < 0) return 0.0;
    const Gap g = gap(t, x, v, wall);
    const double elastic = std::copysign(
        K[static_cast<std::size_t>(wall)] * std::pow(std::abs(g.penetration), 1.1), g.penetration);
    return -elastic * (1.0 + 1.5 * alpha * g.rate) * g.nx / mass;
  }
  double event(double t, double x, double v) const {
    const Gap g = gap(t, x, v, wall);
    return wall < 0 ? g.penetration : -g.penetration;
  }
  void switch_contact(double t, double x, double v) {
    wall = wall < 0 ? gap(t, x, v, -1).wall : -1;
  }
  static std::array<double, 2> initial() {
    const double root = std::sqrt(R * R - std::pow(r * std::sin(start), 2));
    return {r * std::cos(start) + root,
            -r * std::sin(start) * (1.0 + r * std::cos(start) / root) * omega};
  }
  static double end() { return revolutions * 2.0 * pi / omega; }
};

double weight_of_position(double rtol) { return rtol * 5e-4; }
double weight_of_velocity(double rtol) { return rtol * 0.047 / 0.0133; }

double by_hand_arkode(double rtol, long& steps) {
  HandMade model;
  CallbackFailure failure;
  SundialsContext context(failure);
  N_Vector y = N_VNew_Serial(2, context), w = N_VClone(y);
  const auto y0 = HandMade::initial();
  NV_Ith_S(y, 0) = y0[0];
  NV_Ith_S(y, 1) = y0[1];
  NV_Ith_S(w, 0) = weight_of_position(rtol);
  NV_Ith_S(w, 1) = weight_of_velocity(rtol);
  const auto f = [](sunrealtype t, N_Vector u, N_Vector du, void* data) {
    NV_Ith_S(du, 0) = NV_Ith_S(u, 1);
    NV_Ith_S(du, 1) = static_cast<HandMade*>(data)->acceleration(t, NV_Ith_S(u, 0), NV_Ith_S(u, 1));
    return 0;
  };
  const auto root = [](sunrealtype t, N_Vector u, sunrealtype* g, void* data) {
    g[0] = static_cast<HandMade*>(data)->event(t, NV_Ith_S(u, 0), NV_Ith_S(u, 1));
    return 0;
  };
  void* memory = ERKStepCreate(f, 0.0, y, context);
  ARKodeSetUserData(memory, &model);
  ERKStepSetTableNum(memory, ARKODE_DORMAND_PRINCE_7_4_5);
  ARKodeSVtolerances(memory, 0.0, w);
  ARKodeSetMaxNumSteps(memory, -1);
  ARKodeRootInit(memory, 1, root);
  int upwards = 1;
  ARKodeSetRootDirection(memory, &upwards);
  const auto begin = Clock::now();
  double t = 0.0;
  long before = 0, now = 0;
  while (t < HandMade::end()) {
    ARKodeSetStopTime(memory, HandMade::end());
    const int flag = ARKodeEvolve(memory, HandMade::end(), y, &t, ARK_NORMAL);
    if (flag < 0) break;
    ARKodeGetNumSteps(memory, &now);
    if (flag != ARK_ROOT_RETURN) break;
    before += now;
    model.switch_contact(t, NV_Ith_S(y, 0), NV_Ith_S(y, 1));
    ERKStepReInit(memory, f, t, y);
    now = 0;
  }
  const double seconds = seconds_since(begin);
  steps = before + now;
  ARKodeFree(&memory);
  N_VDestroy(y);
  N_VDestroy(w);
  return seconds;
}

double by_hand_ida(double rtol, long& steps) {
  HandMade model;
  CallbackFailure failure;
  SundialsContext context(failure);
  N_Vector y = N_VNew_Serial(2, context), dy = N_VClone(y), w = N_VClone(y);
  const auto y0 = HandMade::initial();
  NV_Ith_S(y, 0) = y0[0];
  NV_Ith_S(y, 1) = y0[1];
  NV_Ith_S(w, 0) = weight_of_position(rtol);
  NV_Ith_S(w, 1) = weight_of_velocity(rtol);
  const auto residual = [](sunrealtype t, N_Vector u, N_Vector du, N_Vector r, void* data) {
    NV_Ith_S(r, 0) = NV_Ith_S(du, 0) - NV_Ith_S(u, 1);
    NV_Ith_S(r, 1) = NV_Ith_S(du, 1) -
                     static_cast<HandMade*>(data)->acceleration(t, NV_Ith_S(u, 0), NV_Ith_S(u, 1));
    return 0;
  };
  // Exact up to the small change of direction of the normal.
  const auto jacobian = [](sunrealtype t, sunrealtype c, N_Vector u, N_Vector, N_Vector,
                           SUNMatrix J, void* data, N_Vector, N_Vector, N_Vector) {
    const auto& m = *static_cast<HandMade*>(data);
    double by_x = 0.0, by_v = 0.0;
    if (m.wall >= 0) {
      const HandMade::Gap g = m.gap(t, NV_Ith_S(u, 0), NV_Ith_S(u, 1), m.wall);
      const double d = std::abs(g.penetration), K = m.K[static_cast<std::size_t>(m.wall)];
      const double force = K * std::pow(d, 1.1);
      by_x = d > 0.0 ? -1.1 * force / d * (1.0 + 1.5 * HandMade::alpha * g.rate) * g.nx * g.nx /
                           HandMade::mass
                     : 0.0;
      by_v = -force * 1.5 * HandMade::alpha * g.nx * g.nx / HandMade::mass;
    }
    SM_ELEMENT_D(J, 0, 0) = c;
    SM_ELEMENT_D(J, 0, 1) = -1.0;
    SM_ELEMENT_D(J, 1, 0) = -by_x;
    SM_ELEMENT_D(J, 1, 1) = c - by_v;
    return 0;
  };
  const auto root = [](sunrealtype t, N_Vector u, N_Vector, sunrealtype* g, void* data) {
    g[0] = static_cast<HandMade*>(data)->event(t, NV_Ith_S(u, 0), NV_Ith_S(u, 1));
    return 0;
  };
  const auto start_rates = [&](double t) {
    NV_Ith_S(dy, 0) = NV_Ith_S(y, 1);
    NV_Ith_S(dy, 1) = model.acceleration(t, NV_Ith_S(y, 0), NV_Ith_S(y, 1));
  };
  start_rates(0.0);
  void* memory = IDACreate(context);
  IDAInit(memory, residual, 0.0, y, dy);
  IDASetUserData(memory, &model);
  IDASVtolerances(memory, 0.0, w);
  SUNMatrix matrix = SUNDenseMatrix(2, 2, context);
  SUNLinearSolver solver = SUNLinSol_Dense(y, matrix, context);
  IDASetLinearSolver(memory, solver, matrix);
  IDASetJacFn(memory, jacobian);
  IDASetMaxNumSteps(memory, -1);
  IDARootInit(memory, 1, root);
  int upwards = 1;
  IDASetRootDirection(memory, &upwards);
  const auto begin = Clock::now();
  double t = 0.0;
  long before = 0, now = 0;
  while (t < HandMade::end()) {
    IDASetStopTime(memory, HandMade::end());
    const int flag = IDASolve(memory, HandMade::end(), &t, y, dy, IDA_NORMAL);
    if (flag < 0) break;
    IDAGetNumSteps(memory, &now);
    if (flag != IDA_ROOT_RETURN) break;
    before += now;
    model.switch_contact(t, NV_Ith_S(y, 0), NV_Ith_S(y, 1));
    start_rates(t);
    IDAReInit(memory, t, y, dy);
    now = 0;
  }
  const double seconds = seconds_since(begin);
  steps = before + now;
  IDAFree(&memory);
  SUNLinSolFree(solver);
  SUNMatDestroy(matrix);
  for (N_Vector vector : {y, dy, w}) N_VDestroy(vector);
  return seconds;
}

// ---- side by side
// --------------------------------------------------------------------------------

void scotch_yoke(benchmark::State& bench, const std::string& formulation,
                 double (*by_hand)(double, long&)) {
  const double rtol = std::pow(10.0, -static_cast<double>(bench.range(0)));
  const Model model = tests::scotch_yoke();
  const SimulationOptions options{.until = HandMade::end(),
                                  .relative_tolerance = rtol,
                                  .formulation = formulation,
                                  .samples = 0};
  std::vector<double> per_step, per_revolution;
  long steps = 0, hand_steps = 0;
  double seconds = 0.0;
  for (auto _ : bench) {
    const auto begin = Clock::now();
    const Result run = simulate(model, options);
    seconds = seconds_since(begin);
    if (!run.summary.ok()) {
      bench.SkipWithError(run.summary.reason.c_str());
      return;
    }
    steps = run.summary.steps;
    const double hand_seconds = by_hand(rtol, hand_steps);
    bench.SetIterationTime(seconds);
    per_revolution.push_back(seconds / hand_seconds);
    per_step.push_back(seconds / static_cast<double>(steps) /
                       (hand_seconds / static_cast<double>(hand_steps)));
  }
  bench.counters["step_ratio"] = median(per_step);
  bench.counters["revolution_ratio"] = median(per_revolution);
  bench.counters["us_per_step"] = 1e6 * seconds / static_cast<double>(steps);
  bench.counters["steps"] = static_cast<double>(steps);
  bench.counters["steps_by_hand"] = static_cast<double>(hand_steps);
}

BENCHMARK_CAPTURE(scotch_yoke, arkode, "arkode-projection", by_hand_arkode)
    ->Arg(6)
    ->Arg(8)
    ->Iterations(30)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(scotch_yoke, ida, "ida-ggl", by_hand_ida)
    ->Arg(6)
    ->Arg(8)
    ->Iterations(30)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
