// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/analyses/inverse_dynamics.hpp>

#include <Eigen/SparseQR>
#include <algorithm>
#include <cmath>

#include <yoke/integrators/analyses/details/driven_motion.hpp>
#include <yoke/integrators/analyses/details/stored_rows.hpp>
#include <yoke/integrators/analyses/kinematics.hpp>
#include <yoke/integrators/run/recorder.hpp>
#include <yoke/integrators/run/start/start_checks.hpp>
#include <yoke/integrators/simulate.hpp>

namespace yoke {

namespace {

constexpr const char* name = "inverse dynamics";
constexpr double history_tolerance = 1e-10;  // for forces with a memory
// Of the best independence met: below this the powers of drives are lost to rounding, which grows
// as its power -3/2.
constexpr double lost_below = 1e-6;
constexpr double allowed_in_motion = 1e-6;  // of a given motion, in length scales or rad
constexpr double allowed_imbalance = 1e-6;  // of the forces, in parts of the largest

void check_samples(int samples) {
  if (samples < 2)
    throw ModelError(
        fmt::format("{}: samples = {} must be at least 2, the two ends", name, samples));
}

bool has_memory(const Model& model) {
  return std::ranges::any_of(model.forces(), [](const auto& force) {
    return force->contacts() > 0 || !force->states().empty();
  });
}

/// Energies along a driven motion, from their rates at three points within each step.
class EnergyIntegral {
 public:
  explicit EnergyIntegral(DrivenMotion& motion)
      : motion_(motion),
        rates_(Eigen::VectorXd::Zero(motion.dynamics().system().quadratures())),
        total_(rates_) {}

  /// False if a state within the step cannot be found.
  bool add(const State& before, const State& after) {
    if (rates_.size() == 0) return true;
    const double h = after.t - before.t, offset = std::sqrt(0.15);
    at_ = before;
    for (const auto& [place, weight] :
         {std::pair{0.5 - offset, 5.0 / 18.0}, {0.5, 8.0 / 18.0}, {0.5 + offset, 5.0 / 18.0}}) {
      next_ = at_;
      if (!motion_.solve_near(at_, before.t + place * h, next_)) return false;
      std::swap(at_, next_);
      if (!calc_rates(at_)) return false;
      total_ += weight * h * rates_;
    }
    return true;
  }
  bool calc_rates(State& state) {
    motion_.dynamics().system().bind(state);
    return motion_.dynamics().calc_accelerations(state.t, state.q.data(), state.v.data(),
                                                 state.z.data(), state.a.data(),
                                                 state.lambda.data(), nullptr, rates_.data());
  }
  const Eigen::VectorXd& rates() const { return rates_; }
  const Eigen::VectorXd& total() const { return total_; }
  void add(const Eigen::VectorXd& energy) { total_ += energy; }

 private:
  DrivenMotion& motion_;
  Eigen::VectorXd rates_, total_;
  State at_, next_;
};

/// Rates of energy through a stretch of the motion where they cannot be evaluated, by the
/// polynomial through those before and after it.
class Bridge {
 public:
  void add(double t, const Eigen::VectorXd& rates) { nodes_.push_back({t, rates}); }
  Eigen::VectorXd rates(double t) const {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(nodes_.front().rates.size());
    for (const Node& node : nodes_) {
      double weight = 1.0;  // Lagrange's
      for (const Node& other : nodes_)
        if (&other != &node) weight *= (t - other.t) / (node.t - other.t);
      sum += weight * node.rates;
    }
    return sum;
  }
  /// Exact for the polynomial, of degree 3 or less.
  Eigen::VectorXd integral(double from, double to) const {
    const double h = to - from, offset = std::sqrt(1.0 / 12.0);
    return 0.5 * h * (rates(from + (0.5 - offset) * h) + rates(from + (0.5 + offset) * h));
  }

 private:
  struct Node {
    double t;
    Eigen::VectorXd rates;
  };
  std::vector<Node> nodes_;
};

/// "motor.work" is fed by "motor.power".
std::string power_name(const std::string& quadrature) {
  return quadrature.ends_with(".work") ? quadrature.substr(0, quadrature.size() - 4) + "power"
                                       : quadrature + "_power";
}

/// Rows of a Recorder with columns added behind.
class WideTable {
 public:
  WideTable(Dynamics& dynamics, Result& result)
      : result_(result), recorder_(dynamics, narrow_, 0) {}
  void keep(std::size_t first, std::size_t count) {
    for (std::size_t i = first; i < first + count; ++i) {
      result_.samples.add_column(narrow_.samples.names()[i], "");
      kept_.push_back(i);
    }
  }
  void start(const State& state) { recorder_.start(state); }
  /// A row with room for what is added; returns where that begins.
  double* record(const State& state) {
    recorder_.record(state);
    double* row = result_.samples.append();
    for (const std::size_t column : kept_)
      *row++ = narrow_.samples.value(narrow_.samples.rows() - 1, column);
    return row;
  }
  const Table& narrow() const { return narrow_.samples; }
  const Summary& summary() const { return narrow_.summary; }

 private:
  Result& result_;
  Result narrow_;
  Recorder recorder_;
  std::vector<std::size_t> kept_;
};

/// The rows of a driven motion with their energies. Next to a singular position multipliers, and
/// with them the powers of drives, are lost to rounding, though the powers stay finite: they are
/// the rates of all other energies. There the rates are bridged between two states before and two
/// behind, and rows wait until they are known.
class EnergyRows {
 public:
  EnergyRows(DrivenMotion& motion, WideTable& table)
      : motion_(motion),
        table_(table),
        energies_(motion),
        watch_(motion, KinematicsOptions{}.warn_below) {
    is_lost(motion.state());
    table_.start(motion.state());
  }

  /// A step accepted; false if energies within it cannot be found.
  bool step(const State& before, const State& after) {
    if (is_lost(after)) return open(before);
    if (open_ && behind_++ == 0) {
      first_behind_ = after;
      return true;
    }
    if (open_ && !close(&after)) return false;
    earlier_ = before;
    has_earlier_ = true;
    return energies_.add(before, after);
  }
  /// A row at the state reached; false if its forces are not finite.
  bool row(State state) {
    if (open_) {
      waiting_.push_back(std::move(state));
      return true;
    }
    state.energy = energies_.total();
    if (!energies_.calc_rates(state)) return false;
    record(state, energies_.rates());
    return true;
  }
  /// No step comes any more. False as for a step.
  bool finish() {
    watch_.finish();
    return !open_ || close(nullptr);
  }
  const std::vector<SingularPosition>& singular_positions() const { return watch_.found(); }
  const State& last() const { return last_; }

 private:
  bool is_lost(const State& state) {
    watch_.see(state);
    best_ = std::max(best_, watch_.last());
    return watch_.last() < lost_below * best_;
  }
  bool open(const State& before) {
    behind_ = 0;
    if (open_) return true;
    open_ = true;
    entry_ = before;
    bridge_ = {};
    return (!has_earlier_ || add_node(earlier_)) && add_node(before);
  }
  bool add_node(State state) {
    if (!energies_.calc_rates(state)) return false;
    bridge_.add(state.t, energies_.rates());
    return true;
  }
  // With the second state behind, if there is one.
  bool close(const State* second) {
    if (behind_ > 0 && !add_node(first_behind_)) return false;
    if (second != nullptr && !add_node(*second)) return false;
    for (State& state : waiting_) {
      state.energy = energies_.total() + bridge_.integral(entry_.t, state.t);
      record(state, bridge_.rates(state.t));
    }
    if (behind_ > 0) energies_.add(bridge_.integral(entry_.t, first_behind_.t));
    waiting_.clear();
    open_ = false;
    return true;
  }
  void record(const State& state, const Eigen::VectorXd& rates) {
    motion_.dynamics().system().bind(state);
    std::ranges::copy(rates, table_.record(state));
    last_ = state;
  }

  DrivenMotion& motion_;
  WideTable& table_;
  EnergyIntegral energies_;
  SingularityWatch watch_;
  double best_ = 0.0;  // independence seen
  bool open_ = false, has_earlier_ = false;
  int behind_ = 0;  // states behind the stretch
  State earlier_, entry_, first_behind_, last_;
  Bridge bridge_;
  std::vector<State> waiting_;
};

Result along_drivers(const Model& model, const InverseDynamicsOptions& options) {
  DrivenMotion motion(model, name, options.until);
  System& system = motion.dynamics().system();
  Result result;
  Summary& summary = result.summary;
  note_constraints(motion.dynamics(), summary);
  summary.formulation = name;
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
  summary.position_violation = table.summary().position_violation;
  summary.velocity_violation = table.summary().velocity_violation;
  summary.energy_balance = table.summary().energy_balance;
  summary.energy_exchanged = table.summary().energy_exchanged;
  return result;
}

/// The drives of a motion that is given: M a - Q = B u - G^T lambda for u and lambda.
class DriveSolver {
 public:
  DriveSolver(Dynamics& dynamics, const std::vector<Drive>& drives)
      : dynamics_(dynamics), drives_(drives) {
    const System& system = dynamics.system();
    const Redundancy& redundancy = dynamics.redundancy();
    const int dofs = system.dofs() - (redundancy.here.rank > 0 ? redundancy.rank : system.rows());
    if (static_cast<int>(drives.size()) != dofs)
      throw ModelError(fmt::format("{}: {} drives are given for {} degrees of freedom", name,
                                   drives.size(), dofs));
    for (const Drive& d : drives) columns_.push_back({column(d.body, d), column(d.against, d)});
    for (int i = 0; i < system.rows(); ++i)
      if (!system.is_dropped(i)) kept_.push_back(i);
  }

  /// Multipliers into `state`, the drives [N, N m] into u.
  void solve(State& state, Eigen::VectorXd& u) {
    System& system = dynamics_.system();
    system.bind(state);
    system.set_motion(state.t, state.q.data(), state.v.data());
    check_motion(state);
    const int n = system.dofs(), m = static_cast<int>(kept_.size());
    Eigen::VectorXd b = Eigen::VectorXd::Zero(n + 1);
    system.add_forces(b.data(), nullptr, nullptr);
    Eigen::VectorXd size = b.head(n).cwiseAbs();
    for (int i = 0; i < n; ++i) {
      const double inertia = system.mass()[static_cast<std::size_t>(i)] * state.a[i];
      size[i] += std::abs(inertia);
      b[i] -= inertia;
    }
    if (!b.allFinite())
      throw ModelError(fmt::format("{}: forces at t = {:.9g} s are not finite", name, state.t));
    const Eigen::SparseMatrix<double> A = matrix(n, m);
    qr_.compute(A);
    if (qr_.rank() < A.cols())
      throw ModelError(fmt::format(
          "{}: at t = {:.9g} s the drives cannot act on all degrees of freedom", name, state.t));
    // Q - M a = G^T lambda - B u
    const Eigen::VectorXd x = qr_.solve(Eigen::VectorXd(b.head(n)));
    const double left = (A * x - b.head(n)).cwiseAbs().maxCoeff();
    if (left > allowed_imbalance * (size.maxCoeff() + 1e-300))
      throw ModelError(fmt::format(
          "{}: at t = {:.9g} s the accelerations given are not those of the joints: {:g} N or N m "
          "are left over",
          name, state.t, left));
    state.lambda.setZero();
    for (int i = 0; i < m; ++i) state.lambda[kept_[static_cast<std::size_t>(i)]] = x[i];
    u = x.tail(static_cast<Eigen::Index>(drives_.size()));
  }

  /// [W] of drive i at a state.
  double power(std::size_t i, double u, const State& state) const {
    const auto [at, against] = columns_[i];
    return u * ((at >= 0 ? state.v[at] : 0.0) - (against >= 0 ? state.v[against] : 0.0));
  }

 private:
  int column(const std::string& body, const Drive& d) const {
    if (body.empty()) return -1;
    const BodyId id = dynamics_.system().model().find_body(body);
    return id == ground ? -1 : 3 * (id.index - 1) + static_cast<int>(d.coordinate);
  }

  void check_motion(const State& state) {
    System& system = dynamics_.system();
    std::vector<double> phi(static_cast<std::size_t>(system.rows()));
    system.calc_position_level(phi.data());
    int worst = 0;
    if (system.norm(phi.data(), &worst) <= allowed_in_motion) return;
    throw ModelError(fmt::format("{}: the motion given violates '{}' by {:g} {} at t = {:.9g} s",
                                 name, system.equation_name(worst),
                                 phi[static_cast<std::size_t>(worst)],
                                 system.measure(worst) == Measure::length ? "m" : "rad", state.t));
  }

  Eigen::SparseMatrix<double> matrix(int n, int m) const {
    const System& system = dynamics_.system();
    std::vector<int> place(static_cast<std::size_t>(system.rows()), -1);
    for (int i = 0; i < m; ++i)
      place[static_cast<std::size_t>(kept_[static_cast<std::size_t>(i)])] = i;
    std::vector<Eigen::Triplet<double>> entries;
    for (const ConstraintSlot& c : system.constraints())
      for (int i = 0; i < c.rows; ++i)
        for (int j = 0; j < c.columns; ++j) {
          const int dof = system.dof()[static_cast<std::size_t>(c.dofs + j)];
          const int equation = place[static_cast<std::size_t>(c.row + i)];
          if (dof >= 0 && equation >= 0)
            entries.emplace_back(dof, equation, system.G()[c.block + i * c.columns + j]);
        }
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      const int drive = m + static_cast<int>(k);
      if (columns_[k].at >= 0) entries.emplace_back(columns_[k].at, drive, -1.0);
      if (columns_[k].against >= 0) entries.emplace_back(columns_[k].against, drive, 1.0);
    }
    Eigen::SparseMatrix<double> A(n, m + static_cast<int>(columns_.size()));
    A.setFromTriplets(entries.begin(), entries.end());
    A.makeCompressed();
    return A;
  }

  struct Columns {
    int at, against;
  };
  Dynamics& dynamics_;
  const std::vector<Drive>& drives_;
  std::vector<Columns> columns_;
  std::vector<int> kept_;
  Eigen::SparseQR<Eigen::SparseMatrix<double>, Eigen::COLAMDOrdering<int>> qr_;
};

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
    result_.summary.formulation = name;
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
    result_.summary.position_violation = table_.summary().position_violation;
    result_.summary.velocity_violation = table_.summary().velocity_violation;
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
  const DrivenMotion motion(model, name, options.until);  // its errors are those of this analysis
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
  require_positive(name, "until", options.until, "s");
  for (const auto& force : model.forces())
    if (force->contacts() > 0)
      throw ModelError(
          fmt::format("{}: what contact '{}' remembers does not follow from a given motion", name,
                      force->name()));
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
