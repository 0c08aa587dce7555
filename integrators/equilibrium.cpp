// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/equilibrium.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>

#include <yoke/core/recorder.hpp>
#include <yoke/integrators/kinsol.hpp>
#include <yoke/integrators/linearise_at.hpp>
#include <yoke/integrators/start_checks.hpp>
#include <yoke/integrators/tangent.hpp>

namespace yoke {

namespace {

constexpr double newton_tolerance = 1e-13;  // of F, scaled, as KINSOL sees it
constexpr double good_residual = 1e-7;      // of F, scaled: what rounding of a stiff contact leaves
constexpr double good_step = 1e-10;         // of the last Newton step in length scales or rad
constexpr double largest_step = 1.0;        // scaled, on average of all unknowns, in one iteration
constexpr double first_load = 0.1, smallest_load = 1e-4;
constexpr double largest_move = 0.2;  // length scales or rad in one step of a relaxation
constexpr int relaxation_steps = 3000;
constexpr double lost = 100.0;           // length scales from the start: nothing holds it
constexpr double neutral_below = 1e-12;  // of the largest stiffness
constexpr double regularisation = 1e-9;  // scaled, where the derivative is singular

using Vector = Eigen::VectorXd;

std::size_t at(Eigen::Index i) { return static_cast<std::size_t>(i); }

/// The equations of rest, scaled: positions in length scales, forces in `force_`.
class Statics {
 public:
  Statics(const Model& model, const State& start, const EquilibriumOptions& options)
      : dynamics_(model), system_(dynamics_.system()), state_(start) {
    state_.t = options.t;
    state_.v.setZero();
    if (const Outcome outcome = dynamics_.assemble(state_); !outcome) throw ModelError(outcome.why);
    // Multipliers of the pose let go: with none at all the derivative of a pendulum is singular.
    state_.v.setZero();
    dynamics_.calc_accelerations(state_);
    state_.a.setZero();
    n_ = system_.dofs(), nz_ = system_.states(), rows_ = system_.rows();
    length_ = system_.natural_length();
    system_.set_scales({.length = length_, .time = 1.0});
    choose_loads(model, options);
    start_ = state_.q;
    choose_force();
  }

  Dynamics& dynamics() { return dynamics_; }
  const State& state() const { return state_; }
  bool has_loads() const { return std::ranges::find(is_load_, true) != is_load_.end(); }
  void set_load(double share) {
    for (std::size_t i = 0; i < share_.size(); ++i) share_[i] = is_load_[i] ? share : 1.0;
  }

  Vector unknowns() const {
    Vector x(n_ + nz_ + rows_);
    for (Eigen::Index i = 0; i < n_; ++i) x[i] = (state_.q[i] - start_[i]) / size(i);
    x.segment(n_, nz_) = state_.z;
    for (Eigen::Index i = 0; i < rows_; ++i)
      x[n_ + nz_ + i] = state_.lambda[i] * measure(i) / (force_ * length_);
    return x;
  }
  void set(const Vector& x) {
    for (Eigen::Index i = 0; i < n_; ++i) state_.q[i] = start_[i] + size(i) * x[i];
    state_.z = x.segment(n_, nz_);
    for (Eigen::Index i = 0; i < rows_; ++i)
      state_.lambda[i] = x[n_ + nz_ + i] * (force_ * length_) / measure(i);
    system_.bind(state_);
    system_.set_motion(state_.t, state_.q.data(), state_.v.data());
    find_contacts([](const double*) { return 1.0; }, true);
  }

  /// F at x; false if it is not finite or a contact is beyond its law.
  bool residual(const Vector& x, Vector& F) {
    if (!x.allFinite()) return false;
    set(x);
    if (beyond_law_) return false;
    F = Vector::Zero(n_ + nz_ + rows_ + 1);  // the last entry is the ground's
    Vector force = Vector::Zero(n_ + 1), z_dot = Vector::Zero(nz_);
    add_forces(force, z_dot);
    Vector phi = Vector::Zero(rows_);
    system_.calc_position_level(phi.data());
    Vector lambda = state_.lambda;
    for (const int row : system_.dropped_rows()) lambda[row] = 0.0;
    system_.subtract_constraint_forces(lambda.data(), force.data());
    for (Eigen::Index i = 0; i < n_; ++i) F[i] = force[i] * size(i) / (force_ * length_);
    F.segment(n_, nz_) = z_dot;
    for (Eigen::Index i = 0; i < rows_; ++i)
      F[n_ + nz_ + i] =
          system_.is_dropped(static_cast<int>(i)) ? x[n_ + nz_ + i] : phi[i] / measure(i);
    F.conservativeResize(n_ + nz_ + rows_);
    return F.allFinite();
  }

  /// dF/dx at x, with `inertia` [scaled] taken off the diagonal of the forces.
  bool factorise(const Vector& x, double inertia = 0.0) {
    set(x);
    const Tangent t = calc_tangent(system_, state_, share_);
    std::vector<Eigen::Triplet<double>> entries;
    const auto add = [&](const Tangent::Matrix& m, Eigen::Index row, Eigen::Index column,
                         const auto& factor, bool transpose = false) {
      for (int k = 0; k < m.outerSize(); ++k)
        for (Tangent::Matrix::InnerIterator it(m, k); it; ++it) {
          const Eigen::Index i = transpose ? it.col() : it.row(),
                             j = transpose ? it.row() : it.col();
          entries.emplace_back(static_cast<int>(row + i), static_cast<int>(column + j),
                               it.value() * factor(i, j));
        }
    };
    const double unit = 1.0 / (force_ * length_);
    const Eigen::Index l = n_ + nz_;
    const auto stiffness = [&](auto i, auto j) { return unit * size(i) * size(j); };
    add(t.Q_q, 0, 0, stiffness);
    add(t.K_lambda, 0, 0, [&](auto i, auto j) { return -stiffness(i, j); });
    add(t.Q_z, 0, n_, [&](auto i, auto) { return unit * size(i); });
    add(t.z_q, n_, 0, [&](auto, auto j) { return size(j); });
    add(t.z_z, n_, n_, [](auto, auto) { return 1.0; });
    add(t.G, l, 0, [&](auto i, auto j) { return size(j) / measure(i); });
    add(
        t.G, 0, l, [&](auto i, auto j) { return -size(i) / measure(j); }, true);
    for (const int row : system_.dropped_rows())
      entries.emplace_back(static_cast<int>(l) + row, static_cast<int>(l) + row, 1.0);
    matrix_.resize(l + rows_, l + rows_);
    matrix_.setFromTriplets(entries.begin(), entries.end());
    if (inertia > 0.0) add_inertia(inertia);
    lu_.compute(matrix_);
    if (lu_.info() == Eigen::Success) return true;
    add_inertia(regularisation);
    lu_.compute(matrix_);
    return lu_.info() == Eigen::Success;
  }
  bool solve(Vector& b) {
    b = lu_.solve(b).eval();
    return b.allFinite();
  }
  void multiply(const Vector& x, Vector& Jx) const { Jx = matrix_ * x; }

  NonlinearProblem problem() {
    return {.residual = [this](const Vector& x, Vector& F) { return residual(x, F); },
            .factorise = [this](const Vector& x) { return factorise(x); },
            .solve = [this](Vector& b) { return solve(b); },
            .multiply = [this](const Vector& x, Vector& Jx) { multiply(x, Jx); }};
  }

  /// Positions only, in length scales or rad.
  double move(const Vector& dx) const { return n_ > 0 ? dx.head(n_).cwiseAbs().maxCoeff() : 0.0; }

  /// The body or equation with the largest residual.
  void blame(const Vector& F, Equilibrium& e) const {
    Eigen::Index worst = 0;
    if (F.size() == 0) return;
    F.cwiseAbs().maxCoeff(&worst);
    const double value = F[worst];
    if (worst < n_) {
      e.worst = system_.model().bodies()[at(worst / 3 + 1)].name;
      e.residual = value * force_ * length_ / size(worst);
      e.unit = worst % 3 == 2 ? "N m" : "N";
    } else if (worst < n_ + nz_) {
      for (const ForceSlot& f : system_.forces())
        if (worst - n_ >= f.z && worst - n_ < f.z + f.states) e.worst = f.element->name();
      e.residual = value;
      e.unit = "1/s";
    } else {
      const int row = static_cast<int>(worst - n_ - nz_);
      e.worst = system_.equation_name(row);
      e.residual = value * measure(row);
      e.unit = system_.measure(row) == Measure::length ? "m" : "rad";
    }
  }

  const std::string& farthest_body() const {
    Eigen::Index worst = 0;
    (state_.q - start_).cwiseAbs().maxCoeff(&worst);
    return system_.model().bodies()[at(worst / 3 + 1)].name;
  }

  /// The state at rest, ready for a run; contacts as a run would find them.
  State finish() {
    State state = state_;
    dynamics_.calc_accelerations(state);  // factors, for the effective masses
    system_.bind(state_);
    find_contacts(nullptr, false);
    state_.a.setZero();
    return state_;
  }
  std::vector<std::string> touching() const {
    std::vector<std::string> names;
    for (const ForceSlot& f : system_.forces())
      for (int i = 0; i < f.element->contacts(); ++i)
        if (state_.contacts[at(f.contacts + i)].phase != ContactPhase::apart)
          names.push_back(f.element->name());
    return names;
  }

 private:
  double size(Eigen::Index i) const { return i % 3 == 2 ? 1.0 : length_; }
  double measure(Eigen::Index row) const {
    return system_.measure(static_cast<int>(row)) == Measure::length ? length_ : 1.0;
  }

  void choose_loads(const Model& model, const EquilibriumOptions& options) {
    for (const std::string& name : options.loads)
      if (std::ranges::none_of(model.forces(), [&](const auto& f) { return f->name() == name; }))
        throw ModelError(fmt::format("equilibrium: there is no force '{}' to be a load", name));
    for (const ForceSlot& f : system_.forces()) {
      const Dependence d = f.element->dependence();
      const bool by_nature = f.element->supplies() || (!d.position && !d.velocity && f.states == 0);
      is_load_.push_back(options.loads.empty()
                             ? by_nature
                             : std::ranges::find(options.loads, f.element->name()) !=
                                   options.loads.end());
    }
    share_.assign(is_load_.size(), 1.0);
  }

  // The largest force at the start, contacts apart: the loads, and springs that are stretched.
  void choose_force() {
    system_.bind(state_);
    system_.set_motion(state_.t, state_.q.data(), state_.v.data());
    for (ContactMemory& memory : state_.contacts) memory = {};
    force_ = 0.0;
    std::vector<double> local;
    for (const ForceSlot& f : system_.forces()) {
      local.assign(at(f.columns), 0.0);
      f.element->evaluate(system_.force_input(f), {.Q = local.data()});
      for (Eigen::Index j = 0; j < f.columns; ++j) {
        const double value = std::abs(local[at(j)]) / (j % 3 == 2 ? length_ : 1.0);
        if (std::isfinite(value)) force_ = std::max(force_, value);
      }
    }
    if (!(force_ > 0.0)) force_ = 1.0;
  }

  void add_forces(Vector& Q, Vector& z_dot) {
    std::vector<double> local;
    for (std::size_t k = 0; k < system_.forces().size(); ++k) {
      const ForceSlot& f = system_.forces()[k];
      local.assign(at(f.columns), 0.0);
      f.element->evaluate(
          system_.force_input(f),
          {.Q = local.data(), .z_dot = f.states > 0 ? z_dot.data() + f.z : nullptr});
      for (Eigen::Index j = 0; j < f.columns; ++j) {
        const int dof = system_.dof()[at(f.dofs + j)];
        Q[dof < 0 ? n_ : dof] += share_[k] * local[at(j)];
      }
    }
  }

  void add_inertia(double inertia) {
    const double mean = mean_mass();
    for (Eigen::Index i = 0; i < n_; ++i)
      matrix_.coeffRef(i, i) -=
          inertia * system_.mass()[at(i)] * size(i) * size(i) / (mean * length_ * length_);
    matrix_.makeCompressed();
  }
  double mean_mass() const {
    double total = 0.0;
    for (Eigen::Index i = 0; i < n_; i += 3) total += system_.mass()[at(i)];
    return total / std::max<double>(1.0, static_cast<double>(n_ / 3));
  }

  /// Which contacts press at the pose set, at rest. `loading`: where a law knows an unloading
  /// branch, the loading one is meant.
  void find_contacts(const std::function<double(const double*)>& effective_mass, bool loading) {
    beyond_law_ = false;
    for (const ForceSlot& f : system_.forces()) {
      if (f.element->contacts() == 0) continue;
      for (int i = 0; i < f.element->contacts(); ++i) state_.contacts[at(f.contacts + i)] = {};
      std::vector<double> still(at(f.columns), 0.0);
      EventContext context{
          .input = system_.force_input(f),
          .contact = state_.contacts.data() + f.contacts,
          .effective_mass =
              effective_mass
                  ? effective_mass
                  : [this, &f](const double* d) { return dynamics_.effective_mass(f, d); },
          .acceleration = still.data(),
          .fail = [this](const std::string&) { beyond_law_ = true; }};
      f.element->initialise_contacts(context);
      if (!loading) continue;
      for (int i = 0; i < f.element->contacts(); ++i) {
        ContactMemory& memory = state_.contacts[at(f.contacts + i)];
        if (memory.phase == ContactPhase::restituting) memory.phase = ContactPhase::compressing;
      }
    }
  }

  Dynamics dynamics_;
  System& system_;
  State state_;
  Vector start_;
  Eigen::Index n_ = 0, nz_ = 0, rows_ = 0;
  double length_ = 1.0, force_ = 1.0;
  std::vector<bool> is_load_;
  std::vector<double> share_;
  bool beyond_law_ = false;
  Tangent::Matrix matrix_;
  Eigen::SparseLU<Tangent::Matrix, Eigen::COLAMDOrdering<int>> lu_;
};

class Solver {
 public:
  Solver(const Model& model, const State& start, const EquilibriumOptions& options)
      : options_(options), statics_(model, start, options) {}

  Equilibrium solve() {
    Vector x = statics_.unknowns();
    const Vector start = x;
    bool found = newton(x);
    if (!found && statics_.has_loads()) {
      e_.route = EquilibriumRoute::load_steps;
      x = start;
      found = bring_on_loads(x);
    }
    if (!found) {
      e_.route = EquilibriumRoute::relaxation;
      statics_.set_load(1.0);
      found = relax(x);
    }
    report(x, found);
    return std::move(e_);
  }

 private:
  /// KINSOL, then Newton's iteration to rounding. x is the solution, or as it was.
  bool newton(Vector& x) {
    Vector y = x, F;
    const NonlinearOutcome outcome =
        solve_nonlinear(statics_.problem(), y, newton_tolerance,
                        largest_step * std::sqrt(static_cast<double>(y.size())));
    e_.iterations += outcome.iterations;
    if (!statics_.residual(y, F)) return false;
    double norm = F.cwiseAbs().maxCoeff();
    for (int i = 0; i < 6; ++i) {
      if (!(norm < 1e-2) || !statics_.factorise(y)) return false;
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
      if (norm < good_residual && moved < good_step) {
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

  // M dq/h^2 = F: the way of a body without momentum, in implicit steps that grow while it goes
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
      if (statics_.move(x) > lost) {
        statics_.set(x);
        throw ModelError(fmt::format("equilibrium: nothing holds '{}': it moves away without end",
                                     statics_.farthest_body()));
      }
    }
    return newton(x);
  }

  void report(const Vector& x, bool found) {
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
      return;
    }
    look_at_stiffness();
    const char* route[] = {"directly", "by load steps", "by relaxation"};
    e_.reason = fmt::format("found {}, {}", route[static_cast<int>(e_.route)],
                            e_.neutral  ? "with a motion that nothing holds"
                            : e_.stable ? "stable"
                                        : "unstable");
  }

  void look_at_stiffness() {
    const System& system = statics_.dynamics().system();
    if (system.dofs() + system.states() > largest_linearisation) return;
    const Linearisation l = linearise_at(statics_.dynamics(), e_.state);
    if (l.degrees_of_freedom() == 0) return;
    Eigen::MatrixXd K = l.K_reduced;
    if (l.z_z.rows() > 0) {
      const Eigen::FullPivLU<Eigen::MatrixXd> own(Eigen::MatrixXd(l.z_z));
      K += l.basis.transpose() * (l.Q_z * own.solve(Eigen::MatrixXd(l.z_q * l.basis)));
    }
    const Eigen::EigenSolver<Eigen::MatrixXd> solver(K);
    const Vector values = solver.eigenvalues().real();
    Eigen::Index lowest = 0;
    e_.lowest_stiffness = values.minCoeff(&lowest);
    const double largest = std::max(solver.eigenvalues().cwiseAbs().maxCoeff(), 1e-12);
    e_.stable = values[lowest] > -neutral_below * largest;
    Eigen::Index softest = 0;
    e_.neutral = values.cwiseAbs().minCoeff(&softest) <= neutral_below * largest;
    if (!e_.neutral || options_.allow_neutral) return;
    Eigen::Index which = 0;
    (l.basis * solver.eigenvectors().col(softest).real()).cwiseAbs().maxCoeff(&which);
    throw ModelError(fmt::format(
        "equilibrium: nothing holds '{}': it can move ({}) without a force; hold it, or ask for "
        "allow_neutral",
        system.model().bodies()[at(which / 3 + 1)].name,
        which % 3 == 2   ? "turn"
        : which % 3 == 0 ? "along x"
                         : "along y"));
  }

  const EquilibriumOptions& options_;
  Statics statics_;
  Equilibrium e_;
};

}  // namespace

Equilibrium equilibrium(const Model& model, const State& start, const EquilibriumOptions& options) {
  check_model(model);
  check_state(model, start);
  require_finite("equilibrium", "t", options.t);
  if (options.load_steps < 1)
    throw ModelError(
        fmt::format("equilibrium: load_steps = {} must be at least 1", options.load_steps));
  return Solver(model, start, options).solve();
}

Equilibrium equilibrium(const Model& model, const EquilibriumOptions& options) {
  return equilibrium(model, model.start_state(), options);
}

}  // namespace yoke
