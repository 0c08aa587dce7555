// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What generality could cost at most: the problems as equations of their own in minimal coordinates, on
// ARKODE's pair of Dormand and Prince with located events.
#include <arkode/arkode_erkstep.h>
#include <nvector/nvector_serial.h>

#include <Eigen/Cholesky>
#include <array>
#include <utility>

#include <yoke/integrators/sundials/compatibility.hpp>
#include <yoke/integrators/sundials/context.hpp>
#include <yoke/tests/bench/clock.hpp>
#include <yoke/tests/bench/peer/problems.hpp>

namespace yoke::bench::peer {

namespace {

/// Integrates a Problem: rates(t, y, dy), take(y, values), events (0 or 1), event(t, y), cross(t, y).
template <class Problem>
class Explicit {
 public:
  Explicit(Problem& problem, const typename Problem::Vector& start,
           const typename Problem::Vector& weights)
      : context_(failure_) {
    y_ = N_VNew_Serial(Problem::size, context_);
    N_Vector w = N_VClone(y_);
    for (int i = 0; i < Problem::size; ++i) {
      NV_Ith_S(y_, i) = start[static_cast<std::size_t>(i)];
      NV_Ith_S(w, i) = weights[static_cast<std::size_t>(i)];
    }
    memory_ = ERKStepCreate(rates, 0.0, y_, context_);
    ARKodeSetUserData(memory_, &problem);
    ERKStepSetTableNum(memory_, ARKODE_DORMAND_PRINCE_7_4_5);
    ARKodeSVtolerances(memory_, 0.0, w);
    ARKodeSetMaxNumSteps(memory_, -1);
    if (Problem::events > 0) {
      ARKodeRootInit(memory_, 1, event);
      int upwards = 1;
      ARKodeSetRootDirection(memory_, &upwards);
    }
    N_VDestroy(w);
  }
  ~Explicit() {
    ARKodeFree(&memory_);
    N_VDestroy(y_);
  }
  Explicit(const Explicit&) = delete;
  Explicit& operator=(const Explicit&) = delete;

  /// False if it cannot get there.
  bool to(double end, Problem& problem) {
    double t = 0.0;
    while (true) {
      const int flag = ARKodeEvolve(memory_, end, y_, &t, ARK_NORMAL);
      if (flag < 0) return false;
      if (flag != ARK_ROOT_RETURN) return true;
      problem.cross(t, NV_DATA_S(y_));
      ERKStepReInit(memory_, rates, t, y_);
    }
  }
  const double* y() const { return NV_DATA_S(y_); }

 private:
  static int rates(sunrealtype t, N_Vector y, N_Vector dy, void* problem) {
    static_cast<Problem*>(problem)->rates(t, NV_DATA_S(y), NV_DATA_S(dy));
    return 0;
  }
  static int event(sunrealtype t, N_Vector y, sunrealtype* g, void* problem) {
    g[0] = static_cast<Problem*>(problem)->event(t, NV_DATA_S(y));
    return 0;
  }

  CallbackFailure failure_;
  SundialsContext context_;
  N_Vector y_ = nullptr;
  void* memory_ = nullptr;
};

template <class Problem>
Trajectory run_by_hand(Problem problem, const typename Problem::Vector& start,
                       const typename Problem::Vector& weights, double end) {
  const auto begin = Clock::now();
  Explicit<Problem> run(problem, start, weights);
  Trajectory trajectory;
  problem.take(start.data(), trajectory.values);
  for (int i = 1; i < samples; ++i) {
    if (!run.to(sample_time(i, end), problem)) return {};
    problem.take(run.y(), trajectory.values);
  }
  trajectory.seconds = seconds_since(begin);
  return trajectory;
}

/// Absolute angles and their rates; the equations are in tests/bench/chain_by_hand.cpp.
struct Chain {
  static constexpr int links = 10, size = 2 * links, events = 0;
  using Vector = std::array<double, size>;
  using Angles = Eigen::Matrix<double, links, 1>;
  using Square = Eigen::Matrix<double, links, links>;

  void rates(double, const double* y, double* dy) {
    const Eigen::Map<const Angles> theta(y), omega(y + links);
    const Angles c = theta.array().cos(), s = theta.array().sin();
    Square mass, sines;
    for (int i = 0; i < links; ++i)
      for (int j = 0; j < links; ++j) {
        const double m =
            i == j ? links - 1 - i + 0.25 + 1.0 / 12.0 : links - 1 - std::max(i, j) + 0.5;
        mass(i, j) = m * (c[i] * c[j] + s[i] * s[j]);
        sines(i, j) = m * (s[i] * c[j] - c[i] * s[j]);
      }
    Angles force = -sines * omega.cwiseAbs2();
    for (int i = 0; i < links; ++i) force[i] -= 9.81 * (links - 1 - i + 0.5) * c[i];
    Eigen::Map<Angles> theta_dot(dy), omega_dot(dy + links);
    theta_dot = omega;
    omega_dot = mass.llt().solve(force);
  }
  static void take(const double* y, std::vector<double>& values) {
    double end = 0.0;
    for (int i = 0; i < links; ++i) values.push_back(end += std::sin(y[i]));
  }
  double event(double, const double*) const { return -1.0; }
  void cross(double, const double*) {}
};

/// Position and velocity of the slider; the crank's angle is a known function of time.
struct ScotchYoke {
  static constexpr int size = 2, events = 1;
  using Vector = std::array<double, size>;
  enum class Wall { none, inner, outer } wall = Wall::none;
  double inner = yoke_data::stiffness(false), outer = yoke_data::stiffness(true);

  struct Gap {
    double penetration, rate, by_x;  // by_x: d(penetration)/dx
    Wall wall;
  };
  Gap gap(double t, const double* y) const {
    const double phi = yoke_data::start + yoke_data::speed * t;
    const double px = yoke_data::crank * std::cos(phi), py = yoke_data::crank * std::sin(phi);
    const double dx = px - y[0], rho = std::sqrt(dx * dx + py * py);
    const double rho_dot =
        (dx * (-yoke_data::speed * py - y[1]) + py * yoke_data::speed * px) / rho;
    const Wall side = wall != Wall::none        ? wall
                      : rho > yoke_data::radius ? Wall::outer
                                                : Wall::inner;
    const double sign = side == Wall::outer ? 1.0 : -1.0;
    return {sign * (rho - yoke_data::radius) - yoke_data::clearance, sign * rho_dot,
            -sign * dx / rho, side};
  }
  void rates(double t, const double* y, double* dy) const {
    dy[0] = y[1];
    dy[1] = 0.0;
    if (wall == Wall::none) return;
    const Gap g = gap(t, y);
    const double elastic = std::copysign(
        (wall == Wall::outer ? outer : inner) * std::pow(std::abs(g.penetration), 1.1),
        g.penetration);
    dy[1] = -elastic * (1.0 + 1.5 * yoke_data::alpha * g.rate) * g.by_x / yoke_data::slider_mass;
  }
  static void take(const double* y, std::vector<double>& values) { values.push_back(y[0]); }
  double event(double t, const double* y) const {
    const double penetration = gap(t, y).penetration;
    return wall == Wall::none ? penetration : -penetration;
  }
  void cross(double t, const double* y) { wall = wall == Wall::none ? gap(t, y).wall : Wall::none; }
};

/// Height and velocity.
struct Disc {
  static constexpr int size = 2, events = 1;
  using Vector = std::array<double, size>;
  bool touches = false;

  void rates(double, const double* y, double* dy) const {
    namespace d = disc_data;
    dy[0] = y[1];
    dy[1] = -d::gravity;
    if (!touches) return;
    const double depth = d::radius - y[0];
    const double elastic = d::stiffness * depth * std::sqrt(std::abs(depth));
    dy[1] += elastic * (1.0 - 1.5 * d::alpha * y[1]) / d::mass;
  }
  static void take(const double* y, std::vector<double>& values) { values.push_back(y[0]); }
  double event(double, const double* y) const {
    const double depth = disc_data::radius - y[0];
    return touches ? -depth : depth;
  }
  void cross(double, const double*) { touches = !touches; }
};

}  // namespace

Trajectory chain_by_hand(double accuracy) {
  Chain::Vector start{}, weights{};
  for (std::size_t i = 0; i < Chain::size; ++i)
    weights[i] = i < Chain::links ? accuracy : 3.0 * accuracy;
  return run_by_hand(Chain{}, start, weights, chain_end);
}

Trajectory scotch_yoke_by_hand(double accuracy) {
  return run_by_hand(ScotchYoke{}, {yoke_data::slider_x(), yoke_data::slider_v()},
                     {accuracy * 5e-4, accuracy * 5e-4 / 1.33e-4}, yoke_data::end);
}

Trajectory disc_by_hand(double accuracy) {
  return run_by_hand(Disc{}, {disc_data::height, 0.0}, {accuracy * 1e-2, accuracy * 2.0},
                     disc_data::end);
}

}  // namespace yoke::bench::peer
