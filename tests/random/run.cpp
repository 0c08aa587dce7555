// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/tests/random/run.hpp>

#include <algorithm>
#include <cmath>

#include <yoke/core/assembly.hpp>
#include <yoke/core/error.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/tests/random/build.hpp>
#include <yoke/tests/random/numbers.hpp>

namespace yoke::tests::random {

namespace {

/// The consistent start nearest to one moved at random.
State perturbed(const Model& model, const Description& d, double size) {
  State s = assemble(model);
  Random r(d.seed * 8 + 2000);
  for (Eigen::Index i = 0; i < s.q.size(); ++i) {
    const double unit = i % 3 == 2 ? 1.0 : d.size * d.units.length;
    s.q[i] += size * unit * r.between(-1.0, 1.0);
    s.v[i] += size * unit / d.units.time * r.between(-1.0, 1.0);
  }
  return assemble(model, s, {});
}

/// Positions and rates of the samples, back in the frame and the units of the original.
void read_motion(const Result& result, const Changed& changed, const Description& original,
                 Run& run) {
  const auto rows = static_cast<Eigen::Index>(result.samples.rows());
  const auto bodies = static_cast<Eigen::Index>(original.bodies.size());
  const Units& u = changed.d.units;
  run.q.resize(rows, 3 * bodies);
  run.v.resize(rows, 3 * bodies);
  run.t = result["t_s"] / u.time;
  run.balance = (result["stored_J"] + result["dissipated_J"] - result["work_J"]) / u.energy();
  const std::vector<double>& data = result.samples.data();
  const std::size_t width = result.samples.names().size();
  for (Eigen::Index k = 0; k < bodies; ++k) {
    const std::size_t column =
        result.samples.index(original.bodies[static_cast<std::size_t>(k)].name + ".x_m");
    for (Eigen::Index i = 0; i < rows; ++i) {
      const double* at = &data[static_cast<std::size_t>(i) * width + column];
      const Vec2 p = changed.point_back(Vec2(at[0], at[1]) / u.length);
      const Vec2 w = changed.vector_back(Vec2(at[3], at[4]) / u.speed());
      run.q.block<1, 3>(i, 3 * k) << p.x(), p.y(), changed.angle_back(at[2]);
      run.v.block<1, 3>(i, 3 * k) << w.x(), w.y(), changed.rate_back(at[5]) * u.time;
    }
  }
}

/// Motion of all bodies of the changed model, in its own frame and units, at a sample.
Eigen::VectorXd own_row(const Result& result, const Description& d, Eigen::Index row, int first) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(3 * d.bodies.size()));
  const std::vector<double>& data = result.samples.data();
  const std::size_t width = result.samples.names().size();
  for (std::size_t k = 0; k < d.bodies.size(); ++k) {
    const std::size_t column = result.samples.index(d.bodies[k].name + ".x_m");
    for (std::size_t c = 0; c < 3; ++c)
      values[static_cast<Eigen::Index>(3 * k + c)] =
          data[static_cast<std::size_t>(row) * width + column + static_cast<std::size_t>(first) +
               c];
  }
  return values;
}

void measure_violation(const Result& result, const Model& model, const Description& d, Run& run) {
  const Summary& s = run.summary;
  for (Eigen::Index i = 0; i < run.q.rows(); ++i) {
    const Violation now = violation(model, own_row(result, d, i, 0), own_row(result, d, i, 3),
                                    result["t_s"][i], s.length_scale, s.time_scale);
    run.position_violation = std::max(run.position_violation, now.position);
    run.velocity_violation = std::max(run.velocity_violation, now.velocity);
  }
}

/// The ledger with kinetic and potential energies of our own, and the scale of its error.
void measure_energy(const Description& original, Run& run) {
  for (Eigen::Index i = 0; i < run.q.rows(); ++i)
    run.balance[i] += mechanical_energy(original, run.q.row(i), run.v.row(i));
  if (run.balance.size() > 0) run.balance.array() -= double(run.balance[0]);
  for (Eigen::Index i = 0; i < run.q.rows(); ++i)
    run.energy_scale =
        std::max(run.energy_scale,
                 energy_per_error(original, run.q.row(i), run.v.row(i), run.length, run.time));
  // Work and dissipation are integrated with a weight of their own.
  const bool integrals =
      !original.slots.empty() ||
      std::ranges::any_of(original.joints,
                          [](const JointData& j) { return is_driver(j) || j.friction > 0.0; }) ||
      std::ranges::any_of(original.forces, [](const ForceData& f) {
        return f.damping > 0.0 || f.kind == ForceKind::load || f.kind == ForceKind::torque;
      });
  double heaviest = 0.0;
  for (const BodyData& b : original.bodies) heaviest = std::max(heaviest, b.mass);
  constexpr double of_what_rests = 1e-6;  // at rest there is rounding only
  run.energy_scale +=
      (integrals ? 1.0 : of_what_rests) * heaviest * std::pow(run.length / run.time, 2);
}

/// The bodies that are there in every change, in the order of the original.
Description original_of(const Changed& changed) {
  Description d = changed.original ? *changed.original : changed.d;
  d.units = {};
  return d;
}

}  // namespace

Run run(const Changed& changed, const RunOptions& options) {
  const Description original = original_of(changed);
  Run run;
  try {
    const Model model = build(changed.d);
    SimulationOptions o;
    o.until = changed.d.duration * changed.d.units.time;
    o.relative_tolerance = options.tolerance;
    o.formulation = options.formulation;
    o.samples = rows_of_a_run;
    o.observer = [&](const Progress& p) { return p.steps < options.most_steps; };
    const Result result =
        options.perturbation > 0.0
            ? simulate(model, perturbed(model, changed.d, options.perturbation), o)
            : simulate(model, o);
    run.summary = result.summary;
    run.end = result.final;
    run.length = result.summary.length_scale / changed.d.units.length;
    run.time = result.summary.time_scale / changed.d.units.time;
    read_motion(result, changed, original, run);
    measure_violation(result, model, changed.d, run);
    measure_energy(original, run);
  } catch (const ModelError& error) {
    run.refusal = error.what();
  }
  return run;
}

Eigen::VectorXd difference(const Run& a, const Run& b, bool rates) {
  const Eigen::Index rows = std::min(a.q.rows(), b.q.rows());
  Eigen::VectorXd worst = Eigen::VectorXd::Zero(rows);
  for (Eigen::Index i = 0; i < rows; ++i)
    for (Eigen::Index j = 0; j < a.q.cols(); ++j) {
      const double unit = j % 3 == 2 ? 1.0 : a.length;
      const double apart = std::abs(a.q(i, j) - b.q(i, j)) / unit;
      const double faster = rates ? std::abs(a.v(i, j) - b.v(i, j)) * a.time / unit : 0.0;
      worst[i] = std::max({worst[i], apart, faster});
      if (!std::isfinite(apart + faster)) worst[i] = std::numeric_limits<double>::infinity();
    }
  return worst;
}

}  // namespace yoke::tests::random
