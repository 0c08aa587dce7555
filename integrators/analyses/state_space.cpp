// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/analyses/state_space.hpp>

#include <algorithm>
#include <cmath>

#include <yoke/core/equations/dynamics.hpp>
#include <yoke/core/result.hpp>
#include <yoke/integrators/run/recorder.hpp>

namespace yoke {

namespace {

constexpr double small_change = 6e-6;  // cube root of rounding: balances it with what is not linear

/// Forces and outputs of a mechanism at states beside one.
class Neighbourhood {
 public:
  Neighbourhood(const Model& model, const Linearisation& about)
      : dynamics_(model), about_(about), recorder_(dynamics_, result_, 1) {
    dynamics_.system().set_scales({.length = dynamics_.system().natural_length(), .time = 1.0});
    State start = about.state;
    if (const Outcome outcome = dynamics_.assemble(start); !outcome) throw ModelError(outcome.why);
  }

  std::size_t column(const std::string& name) const { return result_.samples.index(name); }

  /// N^T Q and z' [f + nz].
  Eigen::VectorXd forces(State state) {
    System& system = dynamics_.system();
    system.bind(state);
    system.set_motion(state.t, state.q.data(), state.v.data());
    Eigen::VectorXd Q = Eigen::VectorXd::Zero(system.dofs() + 1);
    Eigen::VectorXd z_dot = Eigen::VectorXd::Zero(system.states());
    system.add_forces(Q.data(), z_dot.data(), nullptr);
    Eigen::VectorXd all(about_.freedom + system.states());
    all << about_.basis.transpose() * Q.head(system.dofs()), z_dot;
    return all;
  }

  Eigen::VectorXd outputs(State state, const std::vector<std::size_t>& columns) {
    if (!dynamics_.project(state))
      throw ModelError("state space: the constraints cannot be met beside the state");
    result_.samples.keep(0);
    recorder_.record(state);
    Eigen::VectorXd y(static_cast<Eigen::Index>(columns.size()));
    for (std::size_t i = 0; i < columns.size(); ++i)
      y[static_cast<Eigen::Index>(i)] = result_.samples.value(0, columns[i]);
    return y;
  }

  /// The state beside by `h` in component i of x.
  State beside(Eigen::Index i, double h) const {
    State state = about_.state;
    const Eigen::Index f = about_.freedom;
    if (i < f) {
      state.q += h * about_.basis.col(i);
      state.v += h * about_.basis_rate.col(i);
    } else if (i < 2 * f) {
      state.v += h * about_.basis.col(i - f);
    } else {
      state.z[i - 2 * f] += h;
    }
    return state;
  }

  /// A change of component i of x that is small beside the mechanism.
  double change(Eigen::Index i) const {
    const Eigen::Index f = about_.freedom;
    if (i >= 2 * f) return small_change * std::max(1.0, std::abs(about_.state.z[i - 2 * f]));
    const double length = dynamics_.system().natural_length();
    const auto column = about_.basis.col(i % f);
    double largest = 0.0;  // motion for a unit of p, in lengths or rad
    for (Eigen::Index k = 0; k < column.size(); ++k)
      largest = std::max(largest, std::abs(column[k]) / (k % 3 == 2 ? 1.0 : length));
    return small_change / largest;
  }

 private:
  Dynamics dynamics_;
  const Linearisation& about_;
  Result result_;
  Recorder recorder_;
};

}  // namespace

StateSpace state_space(const Model& model, const State& state,
                       const std::vector<std::string>& inputs,
                       const std::vector<std::string>& outputs) {
  StateSpace s;
  s.about = linearise(model, state);
  s.A = s.about.A;
  Neighbourhood near(model, s.about);
  std::vector<std::size_t> columns;
  for (const std::string& name : outputs) columns.push_back(near.column(name));
  const Eigen::Index size = s.A.rows(), f = s.about.freedom;
  const auto n_in = static_cast<Eigen::Index>(inputs.size());
  const auto n_out = static_cast<Eigen::Index>(outputs.size());
  s.B.setZero(size, n_in);
  s.C.setZero(n_out, size);
  s.D.setZero(n_out, n_in);
  for (Eigen::Index i = 0; n_out > 0 && i < size; ++i) {
    const double h = near.change(i);
    s.C.col(i) =
        (near.outputs(near.beside(i, h), columns) - near.outputs(near.beside(i, -h), columns)) /
        (2.0 * h);
  }
  for (Eigen::Index i = 0; i < n_in; ++i) {
    const std::string& input = inputs[static_cast<std::size_t>(i)];
    const std::size_t index = model.find_parameter(input);
    if (model.parameters()[index].of_constraint)
      throw ModelError(fmt::format(
          "state space: input '{}' sets a motion; inputs are loads and parameters of forces",
          input));
    const auto beside = [&](double h) {
      State there = s.about.state;
      there.parameters[index] += h;
      return there;
    };
    const double value = std::abs(s.about.state.parameters[index]);
    const double h = small_change * (value > 0.0 ? value : 1.0);
    const Eigen::VectorXd slope = (near.forces(beside(h)) - near.forces(beside(-h))) / (2.0 * h);
    s.B.col(i).segment(f, f) = slope.head(f);
    s.B.col(i).tail(size - 2 * f) = slope.tail(size - 2 * f);
    if (n_out > 0)
      s.D.col(i) =
          (near.outputs(beside(h), columns) - near.outputs(beside(-h), columns)) / (2.0 * h);
  }
  return s;
}

}  // namespace yoke
