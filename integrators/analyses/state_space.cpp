// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/analyses/state_space.hpp>

#include <algorithm>
#include <cmath>

#include <yoke/core/equations/dynamics.hpp>
#include <yoke/core/result.hpp>
#include <yoke/integrators/analyses/details/linearisation.hpp>
#include <yoke/integrators/analyses/reduction/reduction.hpp>
#include <yoke/integrators/run/recorder.hpp>
#include <yoke/integrators/run/start/start_checks.hpp>

namespace yoke {

namespace {
constexpr double small_change = 6e-6;  // cube root of rounding: balances it with what is not linear
}

/// Forces and outputs of a mechanism at states beside one.
class LinearPlant::Neighbourhood {
 public:
  Neighbourhood(const Model& model, const State& start, const std::vector<std::string>& inputs,
                const std::vector<std::string>& outputs);
  void at(const State& given);

  Dynamics dynamics;
  Reduction reduced;
  State state;
  Eigen::MatrixXd B, C, D;

 private:
  using Vector = Eigen::VectorXd;

  void take(const State& given);
  void compute_inputs();
  void compute_outputs();
  void move(Eigen::Index i, double h);
  double change(Eigen::Index i) const;
  void calc_forces(Vector& N_Q_z);
  void calc_outputs(Vector& y);

  Result result_;
  Recorder recorder_;
  std::vector<std::size_t> columns_, parameters_;
  State beside_;
  Vector Q_, z_dot_;                     // [n + 1], [nz]
  Vector forces_ahead_, forces_behind_;  // [f + nz]
  Vector ahead_, behind_;                // [outputs]
};

LinearPlant::Neighbourhood::Neighbourhood(const Model& model, const State& start,
                                          const std::vector<std::string>& inputs,
                                          const std::vector<std::string>& outputs)
    : dynamics(model),
      reduced(dynamics.system()),
      state(start),
      recorder_(dynamics, result_, 1),
      Q_(dynamics.system().dofs() + 1),
      z_dot_(dynamics.system().states()) {
  System& system = dynamics.system();
  check_model(model);
  check_state(model, start);
  for (const std::string& input : inputs) {
    parameters_.push_back(model.find_parameter(input));
    if (model.parameters()[parameters_.back()].of_constraint)
      throw ModelError(fmt::format(
          "state space: input '{}' sets a motion; inputs are loads and parameters of forces",
          input));
  }
  for (const std::string& output : outputs) columns_.push_back(result_.samples.index(output));
  system.set_scales({.length = system.natural_length(), .time = 1.0});
  if (const Outcome outcome = dynamics.assemble(state); !outcome) throw ModelError(outcome.why);
  beside_ = state;
}

void LinearPlant::Neighbourhood::at(const State& given) {
  take(given);
  reduced.compute(dynamics.system(), state);
  const Eigen::Index size = reduced.A().rows();
  B.setZero(size, std::ssize(parameters_));
  C.setZero(std::ssize(columns_), size);
  D.setZero(std::ssize(columns_), std::ssize(parameters_));
  compute_inputs();
  if (!columns_.empty()) compute_outputs();
}

void LinearPlant::Neighbourhood::take(const State& given) {
  const auto same = [](auto other, auto own, const char* what) {
    if (other != own)
      throw ModelError(
          fmt::format("state space: the state has {} {}, the model {}", other, what, own));
  };
  same(given.q.size(), state.q.size(), "positions");
  same(given.v.size(), state.v.size(), "velocities");
  same(given.z.size(), state.z.size(), "element states");
  same(given.parameters.size(), state.parameters.size(), "parameters");
  same(given.contacts.size(), state.contacts.size(), "contacts");
  state.t = given.t;
  state.q = given.q;
  state.v = given.v;
  state.z = given.z;
  state.parameters = given.parameters;
  state.contacts = given.contacts;
  if (!dynamics.project(state))
    throw ModelError(fmt::format(
        "state space: at t = {:.9g} s the constraints cannot be met or a value is not finite{}",
        given.t,
        dynamics.system().not_finite().empty() ? ""
                                               : ": '" + dynamics.system().not_finite() + "'"));
}

void LinearPlant::Neighbourhood::compute_inputs() {
  const Eigen::Index f = reduced.basis().cols(), nz = state.z.size();
  for (Eigen::Index i = 0; i < B.cols(); ++i) {
    const std::size_t parameter = parameters_[static_cast<std::size_t>(i)];
    const double value = std::abs(state.parameters[parameter]);
    const double h = small_change * (value > 0.0 ? value : 1.0);
    const auto set = [&](double by) {
      beside_ = state;
      beside_.parameters[parameter] += by;
    };
    set(h);
    calc_forces(forces_ahead_);
    set(-h);
    calc_forces(forces_behind_);
    B.col(i).tail(f + nz) = (forces_ahead_ - forces_behind_) / (2.0 * h);
    if (columns_.empty()) continue;
    set(h);
    calc_outputs(ahead_);
    set(-h);
    calc_outputs(behind_);
    D.col(i) = (ahead_ - behind_) / (2.0 * h);
  }
}

void LinearPlant::Neighbourhood::compute_outputs() {
  for (Eigen::Index i = 0; i < C.cols(); ++i) {
    const double h = change(i);
    move(i, h);
    calc_outputs(ahead_);
    move(i, -h);
    calc_outputs(behind_);
    C.col(i) = (ahead_ - behind_) / (2.0 * h);
  }
}

/// Goes to the state beside by `h` in component i of x.
void LinearPlant::Neighbourhood::move(Eigen::Index i, double h) {
  const Eigen::Index f = reduced.basis().cols();
  beside_ = state;
  if (i < f) {
    beside_.q += h * reduced.basis().col(i);
    beside_.v += h * reduced.basis_rate().col(i);
  } else if (i < 2 * f) {
    beside_.v += h * reduced.basis().col(i - f);
  } else {
    beside_.z[i - 2 * f] += h;
  }
}

/// A change of component i of x that is small beside the mechanism.
double LinearPlant::Neighbourhood::change(Eigen::Index i) const {
  const Eigen::Index f = reduced.basis().cols();
  if (i >= 2 * f) return small_change * std::max(1.0, std::abs(state.z[i - 2 * f]));
  const double length = dynamics.system().natural_length();
  const auto column = reduced.basis().col(i % f);
  double largest = 0.0;  // motion for a unit of p, in lengths or rad
  for (Eigen::Index k = 0; k < column.size(); ++k)
    largest = std::max(largest, std::abs(column[k]) / (k % 3 == 2 ? 1.0 : length));
  return small_change / largest;
}

/// N^T Q and z' [f + nz].
void LinearPlant::Neighbourhood::calc_forces(Vector& N_Q_z) {
  System& system = dynamics.system();
  const Eigen::MatrixXd& N = reduced.basis();
  system.bind(beside_);
  system.set_motion(beside_.t, beside_.q.data(), beside_.v.data());
  Q_.setZero();  // the last entry collects the ground
  z_dot_.setZero();
  system.add_forces(Q_.data(), z_dot_.data(), nullptr);
  N_Q_z.resize(N.cols() + z_dot_.size());
  for (Eigen::Index j = 0; j < N.cols(); ++j) N_Q_z[j] = N.col(j).dot(Q_.head(N.rows()));
  N_Q_z.tail(z_dot_.size()) = z_dot_;
}

void LinearPlant::Neighbourhood::calc_outputs(Vector& y) {
  if (!dynamics.project(beside_))
    throw ModelError("state space: the constraints cannot be met beside the state");
  result_.samples.keep(0);
  recorder_.record(beside_);
  y.resize(std::ssize(columns_));
  for (std::size_t i = 0; i < columns_.size(); ++i)
    y[static_cast<Eigen::Index>(i)] = result_.samples.value(0, columns_[i]);
}

LinearPlant::LinearPlant(const Model& model, const State& start,
                         const std::vector<std::string>& inputs,
                         const std::vector<std::string>& outputs) {
  check_linearisable(model);
  near_ = std::make_unique<Neighbourhood>(model, start, inputs, outputs);
}
LinearPlant::LinearPlant(const Model& model, const std::vector<std::string>& inputs,
                         const std::vector<std::string>& outputs)
    : LinearPlant(model, model.start_state(), inputs, outputs) {}
LinearPlant::~LinearPlant() = default;
LinearPlant::LinearPlant(LinearPlant&&) noexcept = default;
LinearPlant& LinearPlant::operator=(LinearPlant&&) noexcept = default;

void LinearPlant::at(const State& state) { near_->at(state); }
const Eigen::MatrixXd& LinearPlant::A() const { return near_->reduced.A(); }
const Eigen::MatrixXd& LinearPlant::B() const { return near_->B; }
const Eigen::MatrixXd& LinearPlant::C() const { return near_->C; }
const Eigen::MatrixXd& LinearPlant::D() const { return near_->D; }
const Eigen::MatrixXd& LinearPlant::basis() const { return near_->reduced.basis(); }
const Eigen::MatrixXd& LinearPlant::basis_rate() const { return near_->reduced.basis_rate(); }
const State& LinearPlant::state() const { return near_->state; }

StateSpace state_space(const Model& model, const State& state,
                       const std::vector<std::string>& inputs,
                       const std::vector<std::string>& outputs) {
  LinearPlant plant(model, state, inputs, outputs);
  const State assembled = plant.state();
  plant.at(assembled);
  return {.A = plant.A(),
          .B = plant.B(),
          .C = plant.C(),
          .D = plant.D(),
          .about = linearise_at(plant.near_->dynamics, plant.state())};
}

}  // namespace yoke
