// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What generality costs the implicit formulations: a chain of 10 links run by Yoke, beside the same
// chain derived by hand in minimal coordinates. By hand: unknowns are the absolute angles and their
// rates, CVODE's BDF with Newton's iteration and the exact dense Jacobian, the tolerances of Yoke's
// angles, the same time. Both are run in turn; counters:
//   step_ratio  time per accepted step, Yoke / by hand, the fastest run of each (aim for IDA: 3)
//   same_vectors_ratio  the same with Yoke's loops for SUNDIALS' vectors lent to the one by hand
//   difference  of the angles at the end [rad]: it is the same problem
//   jacobian_error  of the Jacobian by hand against differences
#include <cvodes/cvodes.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <Eigen/Cholesky>

#include <yoke/integrators/formulations/formulation.hpp>
#include <yoke/integrators/run/start/error_weights.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/integrators/sundials/context.hpp>
#include <yoke/integrators/sundials/vector.hpp>
#include <yoke/tests/bench/chain.hpp>

#include <limits>

namespace {

using namespace yoke;
using namespace yoke::bench;

constexpr int links = 10;
constexpr double end = 1.0;  // [s]
constexpr double infinity = std::numeric_limits<double>::infinity();

using Angles = Eigen::Matrix<double, links, 1>;
using Square = Eigen::Matrix<double, links, links>;

/// Links of length 1 m, mass 1 kg and inertia 1/12 kg m^2 in absolute angles theta from the x axis:
///
///   sum_j m_ij cos(theta_i - theta_j) alpha_j
///       = -g_i cos(theta_i) - sum_j m_ij sin(theta_i - theta_j) omega_j^2
///
///   m_ij = m l^2 (number of links beyond the later of i and j + 1/2),  i != j
///   m_ii = m l^2 (number of links beyond i + 1/4) + inertia
///   g_i  = m g l (number of links beyond i + 1/2)
class ByHand {
 public:
  ByHand() {
    for (int i = 0; i < links; ++i) {
      weight_[i] = 9.81 * (links - 1 - i + 0.5);
      for (int j = 0; j < links; ++j) m_(i, j) = links - 1 - std::max(i, j) + 0.5;
      m_(i, i) = links - 1 - i + 0.25 + 1.0 / 12.0;
    }
  }

  Angles accelerations(const Angles& theta, const Angles& omega) {
    prepare(theta);
    const Angles force = -weight_.cwiseProduct(cos_) - mass_sin_ * omega.cwiseProduct(omega).eval();
    factors_.compute(mass_cos_);
    return factors_.solve(force);
  }

  /// d(alpha)/d(theta) and d(alpha)/d(omega).
  void jacobian(const Angles& theta, const Angles& omega, Square& by_theta, Square& by_omega) {
    const Angles alpha = accelerations(theta, omega);
    const Angles omega2 = omega.cwiseProduct(omega);
    by_theta = mass_cos_ * omega2.asDiagonal();
    by_theta -= mass_sin_ * alpha.asDiagonal();
    by_theta.diagonal().setZero();
    const Angles rest = by_theta.rowwise().sum();
    by_theta.diagonal() = weight_.cwiseProduct(sin_) - rest;
    factors_.solveInPlace(by_theta);
    by_omega = -2.0 * mass_sin_ * omega.asDiagonal();
    factors_.solveInPlace(by_omega);
  }

 private:
  void prepare(const Angles& theta) {
    for (int i = 0; i < links; ++i) {
      cos_[i] = std::cos(theta[i]);
      sin_[i] = std::sin(theta[i]);
    }
    mass_cos_ = m_.cwiseProduct(cos_ * cos_.transpose() + sin_ * sin_.transpose());
    mass_sin_ = m_.cwiseProduct(sin_ * cos_.transpose() - cos_ * sin_.transpose());
  }

  Square m_, mass_cos_, mass_sin_;
  Angles weight_, cos_, sin_;
  Eigen::LLT<Square> factors_;
};

using Map = Eigen::Map<Angles>;
using ConstMap = Eigen::Map<const Angles>;

/// Largest difference between the Jacobian by hand and central differences, relative.
double jacobian_error(ByHand& model, const Angles& theta, const Angles& omega) {
  Square by_theta, by_omega;
  model.jacobian(theta, omega, by_theta, by_omega);
  const double h = 1e-6;
  double error = 0.0;
  for (int k = 0; k < links; ++k) {
    const Angles step = h * Angles::Unit(k);
    const Angles dt =
        (model.accelerations(theta + step, omega) - model.accelerations(theta - step, omega)) /
        (2.0 * h);
    const Angles dw =
        (model.accelerations(theta, omega + step) - model.accelerations(theta, omega - step)) /
        (2.0 * h);
    error = std::max(error, (dt - by_theta.col(k)).norm() / by_theta.norm());
    error = std::max(error, (dw - by_omega.col(k)).norm() / by_omega.norm());
  }
  return error;
}

int rates(sunrealtype, N_Vector y, N_Vector y_dot, void* data) {
  const ConstMap theta(NV_DATA_S(y)), omega(NV_DATA_S(y) + links);
  Map(NV_DATA_S(y_dot)) = omega;
  Map(NV_DATA_S(y_dot) + links) = static_cast<ByHand*>(data)->accelerations(theta, omega);
  return 0;
}

int jacobian(sunrealtype, N_Vector y, N_Vector, SUNMatrix matrix, void* data, N_Vector, N_Vector,
             N_Vector) {
  const ConstMap theta(NV_DATA_S(y)), omega(NV_DATA_S(y) + links);
  Square by_theta, by_omega;
  static_cast<ByHand*>(data)->jacobian(theta, omega, by_theta, by_omega);
  Eigen::Map<Eigen::Matrix<double, 2 * links, 2 * links>> J(SM_DATA_D(matrix));
  J.topLeftCorner<links, links>().setZero();
  J.topRightCorner<links, links>().setIdentity();
  J.bottomLeftCorner<links, links>() = by_theta;
  J.bottomRightCorner<links, links>() = by_omega;
  return 0;
}

struct Run {
  double seconds = 0.0;  // of stepping
  long steps = 0;
  Angles theta = Angles::Zero();  // at the end
  double seconds_per_step() const { return seconds / static_cast<double>(steps); }
};

Run by_hand(ByHand& model, const State& start, double angle_weight, double rate_weight,
            bool vectors_of_yoke) {
  CallbackFailure failure;
  SundialsContext context(failure);
  N_Vector y = vectors_of_yoke ? new_vector(2 * links, context) : N_VNew_Serial(2 * links, context);
  N_Vector weights = N_VClone(y);
  for (int i = 0; i < links; ++i) {
    NV_Ith_S(y, i) = start.q[3 * i + 2];
    NV_Ith_S(y, links + i) = start.v[3 * i + 2];
    NV_Ith_S(weights, i) = angle_weight;
    NV_Ith_S(weights, links + i) = rate_weight;
  }
  void* memory = CVodeCreate(CV_BDF, context);
  CVodeInit(memory, rates, 0.0, y);
  CVodeSetUserData(memory, &model);
  CVodeSVtolerances(memory, 0.0, weights);
  SUNMatrix matrix = SUNDenseMatrix(2 * links, 2 * links, context);
  SUNLinearSolver solver = SUNLinSol_Dense(y, matrix, context);
  CVodeSetLinearSolver(memory, solver, matrix);
  CVodeSetJacFn(memory, jacobian);
  CVodeSetStopTime(memory, end);
  Run run;
  double t = 0.0;
  const auto begin = Clock::now();
  while (t < end)
    if (CVode(memory, end, y, &t, CV_ONE_STEP) < 0) break;
  run.seconds = seconds_since(begin);
  CVodeGetNumSteps(memory, &run.steps);
  run.theta = ConstMap(NV_DATA_S(y));
  CVodeFree(&memory);
  SUNLinSolFree(solver);
  SUNMatDestroy(matrix);
  N_VDestroy(y);
  N_VDestroy(weights);
  return run;
}

Run by_yoke(const FormulationEntry& entry, Dynamics& dynamics, const Tolerances& tolerances,
            const State& start) {
  const auto formulation = entry.make(dynamics, tolerances);
  formulation->start(start);
  Run run;
  const auto begin = Clock::now();
  while (formulation->time() < end)
    if (formulation->step(end) != Step::advanced) break;
  run.seconds = seconds_since(begin);
  run.steps = formulation->counters().steps;
  State state = start;
  formulation->interpolate(formulation->time(), state);
  for (int i = 0; i < links; ++i) run.theta[i] = state.q[3 * i + 2];
  return run;
}

void chain_of_ten(benchmark::State& bench, const std::string& name) {
  const double rtol = std::pow(10.0, -static_cast<double>(bench.range(0)));
  const Model model = chain(links);
  Dynamics dynamics(model);
  State start = model.start_state();
  if (!dynamics.assemble(start)) {
    bench.SkipWithError("the chain does not assemble");
    return;
  }
  const SimulationOptions options{.until = end, .relative_tolerance = rtol, .formulation = name};
  dynamics.system().set_scales(choose_scales(dynamics.system(), start, options));
  const Tolerances tolerances = choose_tolerances(dynamics.system(), options);
  const FormulationEntry& entry =
      *std::ranges::find(formulation_registry(), name, &FormulationEntry::name);
  ByHand minimal;
  double ours = infinity, theirs = infinity, same_vectors = infinity;  // [s] per step, least
  Run yoke, hand;
  for (auto _ : bench) {
    dynamics.reset();
    yoke = by_yoke(entry, dynamics, tolerances, start);
    hand = by_hand(minimal, start, tolerances.q[2], tolerances.v[2], false);
    const Run faster = by_hand(minimal, start, tolerances.q[2], tolerances.v[2], true);
    bench.SetIterationTime(yoke.seconds);
    ours = std::min(ours, yoke.seconds_per_step());
    theirs = std::min(theirs, hand.seconds_per_step());
    same_vectors = std::min(same_vectors, faster.seconds_per_step());
  }
  const double difference = (yoke.theta - hand.theta).cwiseAbs().maxCoeff();
  if (!(difference < 1e4 * rtol)) {
    bench.SkipWithError("not the same motion");
    return;
  }
  Angles theta, omega;
  for (int i = 0; i < links; ++i) theta[i] = std::sin(1.0 + 2.3 * i), omega[i] = std::cos(3.0 * i);
  bench.counters["step_ratio"] = ours / theirs;
  bench.counters["same_vectors_ratio"] = ours / same_vectors;
  bench.counters["us_per_step"] = 1e6 * ours;
  bench.counters["steps"] = static_cast<double>(yoke.steps);
  bench.counters["steps_by_hand"] = static_cast<double>(hand.steps);
  bench.counters["difference"] = difference;
  bench.counters["jacobian_error"] = jacobian_error(minimal, theta, omega);
}

void arguments(benchmark::internal::Benchmark* b) {
  b->Arg(6)->Arg(8)->Iterations(50)->UseManualTime()->Unit(benchmark::kMillisecond);
}
BENCHMARK_CAPTURE(chain_of_ten, ida_ggl, "ida-ggl")->Apply(arguments);
BENCHMARK_CAPTURE(chain_of_ten, ida_baumgarte, "ida-baumgarte")->Apply(arguments);
BENCHMARK_CAPTURE(chain_of_ten, cvode_projection, "cvode-projection")->Apply(arguments);

}  // namespace
