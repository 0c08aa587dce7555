// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/tests/random/checks.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <limits>

#include <yoke/core/equations/dynamics.hpp>
#include <yoke/integrators/analyses/equilibrium.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/tests/random/build.hpp>
#include <yoke/tests/random/held.hpp>
#include <yoke/tests/random/numbers.hpp>
#include <yoke/tests/random/run.hpp>

namespace yoke::tests::random {

namespace {

constexpr double tolerance = 1e-9, tolerance_of_low_order = 1e-7;
constexpr const char* first_formulation = "arkode-projection";
constexpr double tightest = 1e-13;         // that simulate accepts
constexpr double margin = 3.0;             // of bounds; see checks.hpp
constexpr long steps_of_low_order = 1000;  // its steps err by less than the tolerance
constexpr double incomparable = 1e-2;      // differences of that size say nothing
constexpr double rounding = 1e-11;         // of constraints in results, in lengths or rad
constexpr double drift = 1000.0;           // times the tolerance, before projection
constexpr double singular = 1e-2;          // of singular values, relative to the start
constexpr double nearly_singular = 5e-2;   // the same, where the run says so itself
constexpr double small_move = 1e-7, large_move = 1e-5;
constexpr double much_rounding = 1000.0;  // times the tolerance
constexpr long most_steps = 20000;

class Judge {
 public:
  Judge(const Description& d, std::string only) : d_(d), only_(std::move(only)) {
    verdict_.seed = d.seed;
  }

  Verdict verdict() {
    if (wanted("equilibrium")) judge_equilibrium();
    if (only_.starts_with("equilibrium")) return verdict_;
    const bool good = run_first();
    if (!good || only_.starts_with("run ")) return verdict_;
    measure_growth();
    const std::string other = other_formulation();
    if (wanted(other)) compare(other, unchanged(d_), options(other, 2 * most_steps));
    if (only_.starts_with("tight") && d_.seed / 10 % 4 == 0) compare_tight();
    for (const Change change : all_changes())
      if (wanted(name_of(change))) compare_change(name_of(change), changed(d_, change));
    return verdict_;
  }

  Verdict verdict_on(const std::string& name, const Changed& other) {
    if (!run_first()) return verdict_;
    measure_growth();
    compare_change(name, other);
    return verdict_;
  }

 private:
  bool run_first() {
    first_ = run(unchanged(d_), {.tolerance = tolerance, .most_steps = most_steps});
    verdict_.steps = first_.summary.steps;
    return judge("run", unchanged(d_), first_, tolerance);
  }
  void compare_change(const std::string& name, const Changed& other) {
    compare(name, other, {.tolerance = tolerance, .most_steps = 4 * first_.summary.steps + 1000});
  }

  RunOptions options(const std::string& check, long steps) const {
    const Method method = method_of(d_, check);
    return {.formulation = method.formulation, .tolerance = method.tolerance, .most_steps = steps};
  }
  /// The tightest tolerance accepted must be reached.
  void compare_tight() {
    compare("tight", unchanged(d_), options("tight", 50 * first_.summary.steps + 50000));
  }

  bool wanted(const std::string& check) const {
    return only_.empty() || only_.starts_with(check + " ");
  }
  void fault(const std::string& check, const char* what, const std::string& detail) {
    verdict_.faults.push_back({check + " " + what, detail});
  }
  /// Notes a measure over its bound; true if it is within.
  bool within(const std::string& check, const char* what, double value, double bound) {
    const double ratio = !std::isfinite(value) ? 1e300 : value > 0.0 ? value / bound : 0.0;
    double& worst = verdict_.measures[check + " " + what];
    worst = std::max(worst, ratio);
    if (ratio <= 1.0) return true;
    fault(check, what, fmt::format("{:.2e}, allowed {:.2e}", value, bound));
    return false;
  }

  std::string other_formulation() const {
    std::vector<std::string> others;
    for (const FormulationNote& f : formulations())
      if (f.name != first_formulation) others.emplace_back(f.name);
    return others[d_.seed / 10 % others.size()];
  }

  // ---- a run by itself

  /// True if it can be compared with others.
  bool judge(const std::string& check, const Changed& c, const Run& r, double rtol) {
    const bool is_first = check == "run";
    const auto ends = [&](const char* outcome) {
      if (is_first) verdict_.outcome = outcome;
      return false;
    };
    if (!r.ran()) {
      fault(check, "refused", r.refusal);
      return ends("refused");
    }
    if (r.summary.stop == Stop::interrupted) {
      const bool excused = is_change(check) && (is_out_of_reach(r) || follows_rounding(c, r));
      if ((is_change(check) && !excused) || check == "tight")
        fault(check, "steps",
              fmt::format("{} until {:.3g} of {:.3g} s, {} in the first run", r.summary.steps,
                          r.summary.t_end, r.summary.t_asked, first_.summary.steps));
      return ends("long");
    }
    if (!r.ok()) {
      if (r.summary.reason.find("where the law") != std::string::npos) return ends("law limit");
      if (r.summary.reason.find("wedges") != std::string::npos) return ends("wedged");
      const double left = independence(c, r.end, r.length);
      const double bound = r.summary.reason.starts_with("dead point") ? nearly_singular : singular;
      if (left < bound && std::ranges::any_of(c.d.joints, is_driver)) return ends("dead point");
      fault(check, "failed",
            fmt::format("{} [independence {:.1e}, {} steps]", r.summary.reason, left,
                        r.summary.steps));
      return ends("failed");
    }
    const std::size_t before = verdict_.faults.size();
    judge_crossings(check, c, r);
    if (check != "bystanders")
      within(check, "energy", r.balance.cwiseAbs().maxCoeff(),
             (std::max(allowance(r), 10.0 * rounding) + fold(r)) * r.energy_scale);
    within(check, "violation", r.position_violation, rounding);
    within(check, "violation of rates", r.velocity_violation, 100.0 * rounding);
    const Summary& s = r.summary;
    within(check, "drift", s.position_drift / s.length_scale,
           std::max(drift * rtol, 100.0 * rounding) + fold(r));
    return verdict_.faults.size() == before;
  }

  /// Does the run say itself that rounding hides much more than the tolerance? Its steps follow noise.
  static bool is_out_of_reach(const Run& r) {
    const std::string before = "out of reach up to ";
    return std::ranges::any_of(r.summary.notes, [&](const std::string& note) {
      const std::size_t at = note.find(before);
      return note.starts_with("rounding:") && at != std::string::npos &&
             std::stod(note.substr(at + before.size())) > much_rounding;
    });
  }

  /// Does one unit in the last place of the coordinates change velocities by more than the tolerance within
  /// a step as the first run makes them? A run is interrupted where its steps are short.
  bool follows_rounding(const Changed& c, const Run& r) const {
    constexpr int tries = 20;
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const Model model = build(c.d);
    Dynamics dynamics(model);
    State there = r.end;
    if (!dynamics.calc_accelerations(there)) return false;
    const Summary& s = r.summary;
    Random random(d_.seed * 8 + 3000);
    double noise = 0.0;
    for (int k = 0; k < tries; ++k) {
      State beside = there;
      for (double& q : beside.q) q = std::nextafter(q, random.chance(0.5) ? infinity : -infinity);
      if (!dynamics.calc_accelerations(beside)) return false;
      for (Eigen::Index i = 0; i < there.a.size(); ++i)
        noise = std::max(noise,
                         std::abs(beside.a[i] - there.a[i]) * (i % 3 == 2 ? s.length_scale : 1.0));
    }
    const double step = c.d.units.time * first_.summary.t_end /
                        static_cast<double>(std::max(first_.summary.steps, 1L));
    return noise * step > s.relative_tolerance * s.length_scale / s.time_scale;
  }

  /// What the errors of all steps add up to, each within the tolerance.
  static double allowance(const Run& r) {
    const double rtol = r.summary.relative_tolerance;
    const long steps =
        rtol > tolerance ? std::min(r.summary.steps, steps_of_low_order) : r.summary.steps;
    return margin * rtol * static_cast<double>(std::max(steps, 30L));
  }

  /// Of rates at each sample, where a truly singular position was crossed: at a distance s from it the
  /// constraints hold the position across the motion to rounding / s only, which turns the velocity by
  /// that over s again. s^2 is what the smallest singular value squared says.
  Eigen::VectorXd rounding_of_rates(const Changed& c) const {
    Eigen::VectorXd rounded = Eigen::VectorXd::Zero(first_.q.rows());
    if (first_.summary.singular_positions.empty() || !d_.slots.empty()) return rounded;
    for (Eigen::Index i = 0; i < rounded.size(); ++i) {
      State there;
      there.t = first_.t[i];
      there.q = first_.q.row(i);
      const double left = independence(unchanged(d_), there, first_.length);
      rounded[i] = 2.2e-16 * (1.0 + c.offset.norm() / d_.size) / (left * left);
    }
    return rounded;
  }

  /// Beside a truly singular position the motion depends on the root of what rounding does to the
  /// lengths of the links.
  static double fold(const Run& r) {
    return r.summary.singular_positions.empty() ? 0.0 : std::sqrt(2.2e-16);
  }

  static bool is_change(const std::string& check) {
    return std::ranges::any_of(all_changes(), [&](Change x) { return name_of(x) == check; });
  }

  /// The smallest singular value of the constraints at a state over that at the start, those left
  /// out that vanish at the start.
  static double independence(const Changed& c, const State& state, double length) {
    const Model model = build(c.d);
    const double own_length = length * c.d.units.length;
    const State start = model.start_state();
    const Eigen::VectorXd then = relative_singular_values(model, start.q, 0.0, own_length);
    const int smallest = rank(then) - 1;
    if (smallest < 0 || state.q.size() != start.q.size() || !state.q.allFinite()) return 1.0;
    const Eigen::VectorXd now = relative_singular_values(model, state.q, state.t, own_length);
    return now[smallest] / then[smallest];
  }

  void judge_crossings(const std::string& check, const Changed& c, const Run& r) {
    for (const SingularPosition& p : r.summary.singular_positions) {
      Description until = c.d;
      until.duration = p.t / c.d.units.time;
      if (until.duration <= 0.0) continue;
      const Changed part{.d = until,
                         .mirrored = c.mirrored,
                         .angle = c.angle,
                         .offset = c.offset,
                         .original = c.original};
      const Run there = run(
          part, {.formulation = r.summary.formulation, .tolerance = r.summary.relative_tolerance});
      if (!there.ran()) continue;
      const double left = independence(c, there.end, r.length);
      if (left > singular)
        fault(check, "crossing",
              fmt::format("of '{}' at {:.9g} s, where the constraints are independent ({:.1e}); "
                          "energy {:.9g} J before, {:.9g} J after",
                          p.equation, p.t, left, p.energy_before, p.energy_after));
    }
  }

  // ---- against the first

  /// How much a difference has grown at each sample since any earlier one.
  Eigen::VectorXd growth(double size) {
    const Run moved = run(unchanged(d_), {.tolerance = tolerance,
                                          .most_steps = 4 * first_.summary.steps + 1000,
                                          .perturbation = size});
    judge("moved", unchanged(d_), moved, tolerance);
    const Eigen::VectorXd apart = difference(first_, moved, d_.slots.empty());
    Eigen::VectorXd grown = Eigen::VectorXd::Ones(first_.q.rows());
    if (apart.size() < grown.size()) return grown * 1e12;  // it did not get to the end
    double least = size, most = 1.0;
    for (Eigen::Index i = 0; i < grown.size(); ++i) {
      least = std::min(least, std::max(apart[i], 0.03 * size));
      most = std::max(most, apart[i] / least);
      grown[i] = most;
    }
    return grown;
  }

  void measure_growth() {
    growth_ = growth(small_move).cwiseMin(growth(large_move));
    verdict_.measures["amplification"] = growth_.maxCoeff();
    if (growth_.maxCoeff() * 2.0 * allowance(first_) > incomparable) verdict_.outcome = "sensitive";
  }

  void compare(const std::string& check, const Changed& c, const RunOptions& options) {
    const Run other = run(c, options);
    if (!judge(check, c, other, options.tolerance)) return;
    const Eigen::VectorXd apart = difference(first_, other, d_.slots.empty());
    double worst = 0.0, value = 0.0, bound = 1.0;
    Eigen::Index place = 0;
    const double folded = 10.0 * fold(first_) * std::sqrt(1.0 + c.offset.norm() / d_.size);
    const Eigen::VectorXd rounded = rounding_of_rates(c);
    for (Eigen::Index i = 0; i < apart.size(); ++i) {
      const double allowed =
          (allowance(first_) + allowance(other) + folded) * growth_[i] + 10.0 * rounded[i];
      if (rounded[i] > incomparable) continue;  // the sample is at the position itself
      if (allowed > incomparable) break;
      if (apart[i] / allowed >= worst) {
        worst = apart[i] / allowed;
        value = apart[i];
        bound = allowed;
        place = i;
      }
    }
    if (!within(check, "differs", value, bound))
      verdict_.faults.back().detail +=
          fmt::format(" at {:.4g} s, where a difference has grown {:.2g} times", first_.t[place],
                      growth_[place]);
  }

  // ---- statics

  void judge_equilibrium() {
    const Description held = make_held(d_);
    Equilibrium e;
    const Model model = build(held);
    try {
      e = equilibrium(model, {.allow_neutral = true});
    } catch (const ModelError& error) {
      return fault("equilibrium", "refused", error.what());
    }
    if (!e.found) return fault("equilibrium", "none", e.reason);
    Result at_rest;
    try {
      at_rest = simulate(model, e.state, {.until = e.state.t + 1e-6 * held.duration, .samples = 2});
    } catch (const ModelError& error) {
      return fault("equilibrium", "state refused", error.what());
    }
    double scale = energy_per_error(held, e.state.q, 0.0 * e.state.q, held.size, 1.0);
    for (const ForceData& f : held.forces)  // springs that are relaxed but for rounding
      scale += 1e-3 * f.stiffness * (f.kind == ForceKind::spring ? std::pow(held.size, 2) : 1.0);
    double unrest = 0.0;
    for (const BodyData& b : held.bodies) {
      const std::string n = b.name;
      const double force =
          b.mass * std::hypot(at_rest[n + ".ax_m_per_s2"][0], at_rest[n + ".ay_m_per_s2"][0]);
      const double torque = b.inertia * std::abs(at_rest[n + ".alpha_rad_per_s2"][0]);
      unrest = std::max({unrest, force * held.size, torque});
    }
    if (scale > 0.0) within("equilibrium", "unrest", unrest, 1e-7 * scale);
  }

  const Description& d_;
  std::string only_;
  Verdict verdict_;
  Run first_;
  Eigen::VectorXd growth_;
};

}  // namespace

Method method_of(const Description& d, const std::string& check) {
  if (check == "tight") return {d.seed / 40 % 2 == 1 ? "ida-ggl" : first_formulation, tightest};
  for (const FormulationNote& f : formulations())
    if (f.name == check) return {check, f.order < 4 ? tolerance_of_low_order : tolerance};
  return {first_formulation, tolerance};
}

Verdict compare_changed(const Description& d, const std::string& name, const Changed& other) {
  return Judge(d, name + " differs").verdict_on(name, other);
}

Verdict check(const Description& d, const std::string& kind) {
  const auto began = std::chrono::steady_clock::now();
  Verdict verdict;
  try {
    verdict = Judge(d, kind).verdict();
  } catch (const std::exception& error) {
    verdict.seed = d.seed;
    verdict.outcome = "failed";
    verdict.faults.push_back({"exception thrown", error.what()});
  }
  verdict.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  return verdict;
}

}  // namespace yoke::tests::random
