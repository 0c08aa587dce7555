// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/analyses/inverse_dynamics.hpp>

#include <algorithm>
#include <cmath>

#include <yoke/integrators/analyses/details/drive_solver.hpp>
#include <yoke/integrators/analyses/details/driven_motion.hpp>
#include <yoke/integrators/analyses/details/energy_rows.hpp>
#include <yoke/integrators/analyses/details/stored_rows.hpp>
#include <yoke/integrators/analyses/kinematics.hpp>
#include <yoke/integrators/run/constraint_summary.hpp>
#include <yoke/integrators/run/recorder.hpp>
#include <yoke/integrators/run/rows/sampling.hpp>
#include <yoke/integrators/run/start/start_checks.hpp>
#include <yoke/integrators/simulate.hpp>

namespace yoke {

namespace {

constexpr double history_tolerance = 1e-10;  // for forces with a memory

void check_samples(int samples) {
  if (samples < 2)
    throw ModelError(fmt::format("{}: samples = {} must be at least 2, the two ends",
                                 inverse_dynamics_name, samples));
}

bool has_memory(const Model& model) {
  return std::ranges::any_of(model.forces(), [](const auto& force) {
    return force->contacts() > 0 || !force->states().empty();
  });
}

Result along_drivers(const Model& model, const InverseDynamicsOptions& options) {
  DrivenMotion motion(model, inverse_dynamics_name, options.until);
  System& system = motion.dynamics().system();
  Result result;
  Summary& summary = result.summary;
  note_constraints(motion.dynamics(), summary);
  summary.formulation = inverse_dynamics_name;
  summary.formulation_reason = "fully driven, no force has a memory";
  summary.length_scale = system.scales().length;
  summary.t_start = motion.state().t;
  summary.t_asked = options.until;
  WideTable table(motion.dynamics(), result);
  table.keep(0, table.narrow().names().size());
  for (const std::string& quadrature : system.quadrature_names())
    result.samples.add_column(power_name(quadrature), "W");
  result.samples.reserve(static_cast<std::size_t>(options.samples));
  EnergyRows rows(motion, table);

  bool ok = true;
  for (long i = 0; i < options.samples && ok; ++i) {
    bool integrated = true;
    ok = motion.advance(sample_time(i, options.samples, summary.t_start, options.until),
                        [&](const State& before, const State& after) {
                          return integrated = rows.step(before, after);
                        });
    const State& state = motion.state();
    summary.reason = integrated ? motion.failure() : "energies within a step cannot be found";
    if (!ok && (state.t <= summary.t_end && i > 0)) break;
    if (!rows.row(state)) {
      ok = false;
      summary.reason = fmt::format("forces at t = {:.9g} s are not finite", state.t);
      break;
    }
    summary.t_end = state.t;
  }
  if (!rows.finish() && ok) {
    ok = false;
    summary.reason = "energies next to a singular position cannot be found";
  }
  result.final = rows.last();
  summary.singular_positions = rows.singular_positions();
  summary.stop = ok ? Stop::completed : Stop::failed;
  if (ok) summary.reason = "reached the end time";
  summary.steps = motion.steps();
  summary.evaluations = motion.dynamics().evaluations();
  copy_violations(table.summary(), summary);
  summary.energy_balance = table.summary().energy_balance;
  summary.energy_exchanged = table.summary().energy_exchanged;
  return result;
}

std::string drive_name(const Drive& d) {
  const char* coordinate = d.coordinate == Coordinate::x   ? "x"
                           : d.coordinate == Coordinate::y ? "y"
                                                           : "angle";
  return fmt::format("{}.{}.drive", d.body, coordinate);
}

/// The rows of a motion, one by one, into a Result.
class GivenMotion {
 public:
  GivenMotion(Dynamics& dynamics, const std::vector<Drive>& drives)
      : system_(dynamics.system()),
        drives_(drives),
        solver_(dynamics, drives),
        table_(dynamics, result_) {
    const std::size_t all = table_.narrow().names().size();
    const std::size_t quadratures = static_cast<std::size_t>(system_.quadratures());
    table_.keep(0, all - 6 - quadratures);
    table_.keep(all - 6, 3);  // kinetic, potential, stored
    for (const Drive& d : drives) {
      result_.samples.add_column(drive_name(d), d.coordinate == Coordinate::angle ? "N m" : "N");
      result_.samples.add_column(drive_name(d) + "_power", "W");
    }
    note_constraints(dynamics, result_.summary);
    result_.summary.formulation = inverse_dynamics_name;
    result_.summary.formulation_reason = "motion given";
    result_.summary.length_scale = system_.scales().length;
  }

  void add(State state) {
    solver_.solve(state, u_);
    if (result_.samples.rows() == 0) {
      table_.start(state);
      result_.summary.t_start = state.t;
    }
    double* row = table_.record(state);
    for (std::size_t k = 0; k < drives_.size(); ++k) {
      const double u = u_[static_cast<Eigen::Index>(k)];
      *row++ = u;
      *row++ = solver_.power(k, u, state);
    }
    result_.summary.t_end = result_.summary.t_asked = state.t;
    result_.final = std::move(state);
  }

  Result finish() {
    result_.summary.stop = Stop::completed;
    result_.summary.reason = "reached the end of the motion";
    copy_violations(table_.summary(), result_.summary);
    return std::move(result_);
  }

 private:
  System& system_;
  const std::vector<Drive>& drives_;
  DriveSolver solver_;
  Result result_;
  WideTable table_;
  Eigen::VectorXd u_;
};

}  // namespace

Result inverse_dynamics(const Model& model, const InverseDynamicsOptions& options) {
  check_samples(options.samples);
  if (!has_memory(model)) return along_drivers(model, options);
  const DrivenMotion motion(model, inverse_dynamics_name,
                            options.until);  // its errors are those of this analysis
  Result result = simulate(model, {.until = options.until,
                                   .relative_tolerance = history_tolerance,
                                   .samples = options.samples});
  result.summary.formulation_reason +=
      "; integrated, because a force has a memory (a contact or states of its own)";
  return result;
}

Result inverse_dynamics(const Model& model, const Table& motion, const std::vector<Drive>& drives) {
  check_model(model);
  Dynamics dynamics(model);
  prepare_for_rows(dynamics, model.start_state());
  const StoredRows rows(dynamics, motion);
  GivenMotion given(dynamics, drives);
  State state = model.start_state();
  for (std::size_t i = 0; i < rows.count(); ++i) {
    rows.read(i, state);
    given.add(state);
  }
  return given.finish();
}

Result inverse_dynamics(const Model& model, const MotionFunction& motion,
                        const std::vector<Drive>& drives, const InverseDynamicsOptions& options) {
  check_model(model);
  check_samples(options.samples);
  require_positive(inverse_dynamics_name, "until", options.until, "s");
  for (const auto& force : model.forces())
    if (force->contacts() > 0)
      throw ModelError(
          fmt::format("{}: what contact '{}' remembers does not follow from a given motion",
                      inverse_dynamics_name, force->name()));
  Dynamics dynamics(model);
  prepare_for_rows(dynamics, model.start_state());
  GivenMotion given(dynamics, drives);
  for (long i = 0; i < options.samples; ++i) {
    const double t = sample_time(i, options.samples, 0.0, options.until);
    State state = motion(t);
    state.t = t;
    check_state(model, state);
    given.add(std::move(state));
  }
  return given.finish();
}

}  // namespace yoke
