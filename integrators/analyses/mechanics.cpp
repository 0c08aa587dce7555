// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/analyses/mechanics.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <yoke/core/equations/dynamics.hpp>
#include <yoke/core/equations/least_change.hpp>
#include <yoke/core/error.hpp>
#include <yoke/integrators/analyses/reduction/allowed_motions.hpp>

namespace yoke {

struct Mechanics::Equations {
  explicit Equations(const Model& model);
  void require_known() const {
    if (!known) throw ModelError("mechanics: call at() first");
  }
  void evaluate();

  Dynamics dynamics;
  std::optional<SparseLU> lu;  // of the same matrix: Dynamics solves for its own forces alone
  State state;
  bool known = false, has_null_space = false;
  int n, rows, freedom = 0;
  Eigen::VectorXd mass, metric, phi, off, gamma, Q, unloaded, collected, b, x;
  Eigen::MatrixXd G, N;
  AllowedMotions allowed;
};

Mechanics::Equations::Equations(const Model& model)
    : dynamics(model),
      state(model.start_state()),
      n(dynamics.system().dofs()),
      rows(dynamics.system().rows()),
      allowed(n, rows) {
  if (const Outcome outcome = dynamics.assemble(state); !outcome) throw ModelError(outcome.why);
  const System& system = dynamics.system();
  freedom = n - rows + static_cast<int>(system.dropped_rows().size());
  lu.emplace(dynamics.matrix());
  mass = Eigen::Map<const Eigen::VectorXd>(system.mass().data(), n);
  const std::vector<double> w = metric_of_masses(system);
  metric = Eigen::Map<const Eigen::VectorXd>(w.data(), n);
  phi.setZero(rows);
  off.setZero(rows);
  gamma.setZero(rows);
  Q.setZero(n);
  unloaded.setZero(n + 1);  // the last entry collects the ground
  collected.setZero(n + 1);
  b.setZero(n + rows + 1);
  x.setZero(n + rows + 1);
  G.setZero(rows, n);
  N.setZero(n, freedom);
}

void Mechanics::Equations::evaluate() {
  System& system = dynamics.system();
  system.calc_position_level(phi.data());
  system.calc_velocity_residual(off.data());
  G.setZero();
  for (const ConstraintSlot& c : system.constraints()) {
    system.evaluate(c, {.gamma = gamma.data() + c.row});
    for (int i = 0; i < c.rows; ++i)
      for (int j = 0; j < c.columns; ++j)
        if (const int dof = system.dof()[static_cast<std::size_t>(c.dofs + j)]; dof >= 0)
          G(c.row + i, dof) += system.G()[c.block + i * c.columns + j];
  }
  unloaded.setZero();
  system.add_unloaded_forces(unloaded.data(), nullptr, nullptr);
  collected = unloaded;
  system.set_multipliers(state.lambda.data());
  system.add_loaded_forces(collected.data(), nullptr, nullptr);
  system.set_multipliers(nullptr);
  Q = collected.head(n);
}

Mechanics::Mechanics(const Model& model) : equations_(std::make_unique<Equations>(model)) {}
Mechanics::~Mechanics() = default;
Mechanics::Mechanics(Mechanics&&) noexcept = default;
Mechanics& Mechanics::operator=(Mechanics&&) noexcept = default;

int Mechanics::coordinates() const { return equations_->n; }
int Mechanics::equations() const { return equations_->rows; }
int Mechanics::freedom() const { return equations_->freedom; }

void Mechanics::at(const State& state) {
  Equations& e = *equations_;
  const auto same = [&](auto given, auto own, const char* what) {
    if (given != own)
      throw ModelError(
          fmt::format("mechanics: the state has {} {}, the model {}", given, what, own));
  };
  same(state.q.size(), e.state.q.size(), "positions");
  same(state.v.size(), e.state.v.size(), "velocities");
  same(state.z.size(), e.state.z.size(), "element states");
  same(state.parameters.size(), e.state.parameters.size(), "parameters");
  same(state.contacts.size(), e.state.contacts.size(), "contacts");
  e.known = e.has_null_space = false;
  e.state.t = state.t;
  e.state.q = state.q;
  e.state.v = state.v;
  e.state.z = state.z;
  e.state.parameters = state.parameters;
  e.state.contacts = state.contacts;
  for (ContactMemory& memory : e.state.contacts)
    if (rests(memory.grip)) memory.grip = Grip::none;
  if (!e.dynamics.calc_accelerations(e.state) || !e.lu->factorise(e.dynamics.matrix()))
    throw ModelError(fmt::format(
        "mechanics: at t = {:.9g} s the constraints are dependent or a value is not finite{}",
        state.t,
        e.dynamics.system().not_finite().empty() ? ""
                                                 : ": '" + e.dynamics.system().not_finite() + "'"));
  e.evaluate();
  e.known = true;
}

const Eigen::VectorXd& Mechanics::mass_matrix() const { return equations_->mass; }

const Eigen::MatrixXd& Mechanics::constraint_jacobian() const {
  equations_->require_known();
  return equations_->G;
}

const Eigen::VectorXd& Mechanics::positions_off() const {
  equations_->require_known();
  return equations_->phi;
}

const Eigen::VectorXd& Mechanics::velocities_off() const {
  equations_->require_known();
  return equations_->off;
}

const Eigen::VectorXd& Mechanics::gamma() const {
  equations_->require_known();
  return equations_->gamma;
}

const Eigen::VectorXd& Mechanics::forces() const {
  equations_->require_known();
  return equations_->Q;
}

void Mechanics::accelerations(const Eigen::VectorXd& F, Eigen::VectorXd& a,
                              Eigen::VectorXd& lambda) {
  Equations& e = *equations_;
  e.require_known();
  const auto sized = [](Eigen::Index given, int own, const char* what) {
    if (given != own)
      throw ModelError(
          fmt::format("mechanics: {} has {} entries, it must have {}", what, given, own));
  };
  sized(F.size(), e.n, "F");
  sized(a.size(), e.n, "a");
  sized(lambda.size(), e.rows, "lambda");
  e.b.head(e.n) = e.unloaded.head(e.n) + F;
  e.b.segment(e.n, e.rows) = e.gamma;
  for (const int row : e.dynamics.system().dropped_rows()) e.b[e.n + row] = 0.0;
  e.x = e.b;
  e.lu->solve(e.x.data());
  if (!e.dynamics.add_loaded_forces(e.b.data(), e.x.data()))
    throw ModelError(fmt::format("mechanics: at t = {:.9g} s the friction of '{}' wedges",
                                 e.state.t, e.dynamics.system().not_finite()));
  e.dynamics.system().set_multipliers(nullptr);
  a = e.x.head(e.n);
  lambda = e.x.segment(e.n, e.rows);
}

const Eigen::MatrixXd& Mechanics::null_space() {
  Equations& e = *equations_;
  e.require_known();
  if (e.has_null_space) return e.N;
  Eigen::MatrixXd& scaled = e.allowed.transpose();
  for (int i = 0; i < e.n; ++i) scaled.row(i) = e.G.col(i).transpose() / std::sqrt(e.metric[i]);
  for (const int row : e.dynamics.system().dropped_rows()) scaled.col(row).setZero();
  e.allowed.factorise();
  e.allowed.write_basis(e.N);
  for (int i = 0; i < e.n; ++i) e.N.row(i) /= std::sqrt(e.metric[i]);
  e.has_null_space = true;
  return e.N;
}

double Mechanics::effective_mass(BodyId body, const Vec2& at, const Vec2& direction) {
  Equations& e = *equations_;
  e.require_known();
  if (body == ground) throw ModelError("effective mass: the ground does not move");
  const std::string& name = e.dynamics.system().model().body(body).name;
  if (!(direction.norm() > 0.0) || !direction.allFinite() || !at.allFinite())
    throw ModelError(
        fmt::format("effective mass of '{}': direction = ({:g}, {:g}) must be finite and "
                    "have a length",
                    name, direction.x(), direction.y()));
  const Vec2 u = direction.normalized();
  const BodyMotion& b = e.dynamics.system().motion()[body];
  const Eigen::Index first = 3 * (body.index - 1);
  const Eigen::Vector3d d(u.x(), u.y(), cross(at - b.position(), u));
  e.b.setZero();
  e.b.segment<3>(first) = d;
  e.lu->solve(e.b.data());
  double terms =
      0.0;  // the mobility of the body alone; what the joints leave of it may be rounding
  for (int i = 0; i < 3; ++i)
    if (const double mass = e.mass[first + i]; mass > 0.0) terms += d[i] * d[i] / mass;
  const double mobility = d.dot(e.b.segment<3>(first));
  return mobility > 64.0 * std::numeric_limits<double>::epsilon() * terms
             ? 1.0 / mobility
             : std::numeric_limits<double>::infinity();
}

}  // namespace yoke
