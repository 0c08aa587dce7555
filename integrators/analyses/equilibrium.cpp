// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/analyses/equilibrium.hpp>

#include <algorithm>
#include <cmath>

#include <yoke/integrators/analyses/details/descent.hpp>
#include <yoke/integrators/analyses/details/rest_equations.hpp>
#include <yoke/integrators/analyses/details/stiffness.hpp>
#include <yoke/integrators/run/recorder.hpp>
#include <yoke/integrators/run/start/start_checks.hpp>
#include <yoke/integrators/sundials/newton.hpp>

namespace yoke {

namespace {

constexpr double newton_tolerance = 1e-13;  // of F, scaled, as KINSOL sees it
constexpr double good_residual = 1e-7;      // of F, scaled: what rounding of a stiff contact leaves
constexpr double good_step = 1e-10;         // of the last Newton step in length scales or rad
constexpr double largest_step = 1.0;        // scaled, on average of all unknowns, in one iteration
constexpr double first_load = 0.1, smallest_load = 1e-4;
constexpr double largest_move = 0.2;  // length scales or rad in one step of a relaxation
constexpr int relaxation_steps = 3000;
constexpr double lost = 100.0;       // length scales from the start: nothing holds it
constexpr double stands_on = 0.05;   // length scales or rad: the start is on the equilibrium
constexpr double off_saddle = 0.01;  // the same
constexpr int max_saddles = 20;

using Vector = Eigen::VectorXd;

std::size_t at(Eigen::Index i) { return static_cast<std::size_t>(i); }

class Solver {
 public:
  Solver(const Model& model, const State& start, const EquilibriumOptions& options)
      : options_(options), statics_(model, start, options) {}

  // The first that is stable counts. One that is not is taken if the start stands on it, or if
  // nothing better is found.
  Equilibrium solve() {
    const Vector start = statics_.unknowns();
    Vector x = start;
    bool found = newton(x);
    if (found && (is_stable(x) || statics_.move(x - start) < stands_on)) return report(x, true);
    Vector unstable = x;
    EquilibriumRoute route = e_.route;
    if (statics_.has_loads()) {
      e_.route = EquilibriumRoute::load_steps;
      x = start;
      const bool loaded = bring_on_loads(x);
      if (loaded && is_stable(x)) return report(x, true);
      if (loaded && !found) unstable = x, found = true, route = e_.route;
    }
    e_.route = EquilibriumRoute::relaxation;
    statics_.set_load(1.0);
    if (descend_from(start, x)) return report(x, true);
    const Vector reached = x;
    if (!found && relax(x)) return report(x, true);
    if (!found) return report(reached, false);
    e_.route = route;
    return report(unstable, true);
  }

 private:
  /// KINSOL, then Newton's iteration to rounding. x is the solution, or as it was.
  bool newton(Vector& x) {
    Vector y = x;
    const NonlinearOutcome outcome =
        solve_nonlinear(statics_.problem(), y, newton_tolerance,
                        largest_step * std::sqrt(static_cast<double>(y.size())));
    e_.iterations += outcome.iterations;
    return settle(y) && (x = y, true);
  }

  /// Newton's iteration from close by to rounding. x is the solution, or as it was.
  bool settle(Vector& x) {
    Vector y = x, F;
    if (!statics_.residual(y, F)) return false;
    double norm = F.cwiseAbs().maxCoeff();
    for (int i = 0; i < 12; ++i) {
      if (!(norm < 1e-2)) return false;
      // Where some motions cost nothing the matrix is singular, and no step is wanted.
      if (!statics_.factorise(y)) return statics_.is_rounding(y, F) && (x = y, true);
      Vector step = -F;
      if (!statics_.solve(step)) return false;
      const Vector next = y + step;
      Vector F_next;
      const bool better = statics_.residual(next, F_next) && F_next.cwiseAbs().maxCoeff() < norm;
      const double moved = statics_.move(step);
      if (better) {
        y = next;
        F = F_next;
        norm = F.cwiseAbs().maxCoeff();
      }
      if ((norm < good_residual && moved < good_step) || (!better && statics_.is_rounding(y, F))) {
        x = y;
        return true;
      }
      if (!better) return false;
    }
    return false;
  }

  bool bring_on_loads(Vector& x) {
    double load = 0.0, step = first_load;
    while (load < 1.0 && e_.load_steps < options_.load_steps) {
      const double next = std::min(1.0, load + step);
      statics_.set_load(next);
      ++e_.load_steps;
      if (newton(x)) {
        load = next;
        step = std::min(2.0 * step, 0.25);
      } else if ((step *= 0.5) < smallest_load) {
        break;
      }
    }
    e_.load = load;
    return load >= 1.0;
  }

  /// Downhill from `start` to a minimum: from a saddle it goes on along the way down.
  bool descend_from(const Vector& start, Vector& x) {
    x = start;
    for (int saddles = 0; saddles < max_saddles; ++saddles) {
      const DescentEnd end =
          descend(statics_, x, e_.iterations, [this](Vector& y) { return settle(y); });
      if (end == DescentEnd::lost) throw_lost(x);
      if (end == DescentEnd::stuck) return false;
      if (is_stable(x)) return true;
      Vector beside = x;
      statics_.displace(way_down_, off_saddle, beside);
      if (!statics_.project(beside)) return true;
      x = beside;
    }
    return false;
  }

  [[noreturn]] void throw_lost(const Vector& x) {
    statics_.set(x);
    throw ModelError(fmt::format("equilibrium: nothing holds '{}': it moves away without end",
                                 statics_.farthest_body()));
  }

  // dq/h^2 = F: the way of a body without momentum, in implicit steps that grow while it goes
  // well.
  bool relax(Vector& x) {
    double inertia = 10.0;
    Vector F, F_next;
    if (!statics_.residual(x, F)) return false;
    for (int i = 0; i < relaxation_steps; ++i) {
      const double norm = F.cwiseAbs().maxCoeff();
      if (norm < 1e-3 && newton(x)) return true;
      if (!statics_.factorise(x, inertia)) return false;
      Vector step = -F;
      const bool solved = statics_.solve(step);
      ++e_.iterations;
      const Vector next = x + step;
      if (!solved || statics_.move(step) > largest_move || !statics_.residual(next, F_next) ||
          F_next.cwiseAbs().maxCoeff() > 2.0 * norm + 1e-9) {
        inertia *= 4.0;
        if (inertia > 1e30) return false;
        continue;
      }
      x = next;
      F = F_next;
      inertia = std::max(0.5 * inertia, 1e-12);
      if (statics_.move(x) > lost) throw_lost(x);
    }
    return newton(x);
  }

  Equilibrium report(const Vector& x, bool found) {
    Vector F;
    e_.found = found;
    if (statics_.residual(x, F)) statics_.blame(F, e_);
    if (found) e_.load = 1.0;
    e_.state = statics_.finish();
    e_.touching = statics_.touching();
    Result result;
    Recorder recorder(statics_.dynamics(), result, 1);
    recorder.start(e_.state);
    statics_.dynamics().system().bind(e_.state);
    recorder.record(e_.state);
    e_.row = std::move(result.samples);
    if (!found) {
      e_.stable = false;
      e_.reason = fmt::format(
          "no equilibrium was found; at {:.3g} % of the loads '{}' is left with {:.3g} {}: is "
          "there "
          "one near the start? Try another start pose",
          100.0 * e_.load, e_.worst, e_.residual, e_.unit);
      return std::move(e_);
    }
    look_at_stiffness();
    const char* route[] = {"directly", "by load steps", "by relaxation"};
    e_.reason = fmt::format("found {}, {}", route[static_cast<int>(e_.route)],
                            e_.neutral  ? "with a motion that nothing holds"
                            : e_.stable ? "stable"
                                        : "unstable");
    return std::move(e_);
  }

  bool is_stable(const Vector& x) {
    statics_.set(x);
    const std::optional<Stiffness> s = stiffness_at(statics_, statics_.state());
    if (!s || !s->negative()) return true;
    way_down_ = s->way_down;
    return false;
  }

  void look_at_stiffness() {
    const std::optional<Stiffness> s = stiffness_at(statics_, e_.state);
    if (!s) return;
    e_.lowest_stiffness = s->lowest;
    e_.stable = !s->negative();
    e_.neutral = s->neutral;
    if (!e_.neutral || options_.allow_neutral) return;
    Eigen::Index which = 0;
    s->soft.cwiseAbs().maxCoeff(&which);
    throw ModelError(fmt::format(
        "equilibrium: nothing holds '{}': it can move ({}) without a force; hold it, or "
        "accept it: allow_neutral, --allow-neutral of the program",
        statics_.dynamics().system().model().bodies()[at(which / 3 + 1)].name,
        which % 3 == 2   ? "turn"
        : which % 3 == 0 ? "along x"
                         : "along y"));
  }

  Vector way_down_;
  const EquilibriumOptions& options_;
  Statics statics_;
  Equilibrium e_;
};

}  // namespace

Equilibrium equilibrium(const Model& model, const State& start, const EquilibriumOptions& options) {
  check_model(model);
  check_state(model, start);
  require_finite("equilibrium", "t", options.t);
  require_finite("equilibrium", "load_factor", options.load_factor);
  if (options.load_steps < 1)
    throw ModelError(
        fmt::format("equilibrium: load_steps = {} must be at least 1", options.load_steps));
  return Solver(model, start, options).solve();
}

Equilibrium equilibrium(const Model& model, const EquilibriumOptions& options) {
  return equilibrium(model, model.start_state(), options);
}

}  // namespace yoke
