// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What is measured of a state: independence of the equations, effective mass, violations, event
// functions, what friction at rest bears.
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

#include <yoke/core/equations/dynamics.hpp>
#include <yoke/core/equations/linear/index.hpp>

namespace yoke {

namespace {

constexpr double least_limit = 1e-6;  // of the largest: a smaller holding force counts as this
constexpr double least_ratio = 1e-6;
constexpr int most_shares = 100;
constexpr double same_share = 1e-14;  // of the largest

}  // namespace

double Dynamics::independence(double t, const double* q, int iterations) {
  const int n = system_.dofs(), rows = system_.rows();
  if (!same_as_factorised(t, q)) {
    system_.set_motion(t, q, zero_.data());
    system_.calc_position_level(phi_.data());
    factorised_ = false;  // G changed under the factors
  }
  if (!lengths_) lengths_.emplace(system_, length_metric_, std::vector<char>(), dropped_marks());
  if (weakest_.empty()) {  // no direction yet
    weakest_.resize(at(rows));
    for (int i = 0; i < rows; ++i) weakest_[at(i)] = std::cos(1.0 + 2.4 * i);
    iterations = std::max(iterations, 6);
  }
  if (!lengths_->factorise(0.0)) return 0.0;
  const auto counts = [&](int row) {
    return !system_.is_left_out(row) && !system_.is_of_velocity_level(row);
  };
  double eigenvalue = 0.0;
  for (int round = 0; round < iterations; ++round) {
    double before = 0.0, after = 0.0;
    std::fill_n(b_.begin(), n, 0.0);
    for (int i = 0; i < rows; ++i) {
      // A little of everything, or a direction the last one has no part in would stay unseen.
      const double w = counts(i) ? weakest_[at(i)] + 1e-3 * std::cos(2.0 + 1.7 * i) : 0.0;
      b_[at(n + i)] = w;
      before += w * w;
    }
    lengths_->solve(b_.data());
    for (int i = 0; i < rows; ++i) {
      weakest_[at(i)] = counts(i) ? b_[at(n + i)] : 0.0;
      after += weakest_[at(i)] * weakest_[at(i)];
    }
    if (!(after > 0.0) || !std::isfinite(after)) return after == 0.0 ? 1.0 : 0.0;
    eigenvalue = std::sqrt(before / after);
    double largest = 0.0;
    for (int i = 0; i < rows; ++i) {
      weakest_[at(i)] /= std::sqrt(after);
      if (std::abs(weakest_[at(i)]) <= largest) continue;
      largest = std::abs(weakest_[at(i)]);
      weakest_row_ = i;
    }
  }
  return eigenvalue;
}

std::vector<char> Dynamics::dropped_marks() const {
  std::vector<char> marks(at(system_.rows()), 0);
  for (const int row : system_.left_out_rows()) marks[at(row)] = 1;
  return marks;
}

double Dynamics::mobility(const ForceSlot& slot, const double* direction, double& alone) {
  std::fill(b_.begin(), b_.end(), 0.0);
  for (int j = 0; j < slot.columns; ++j)
    if (const int dof = system_.dof()[at(slot.dofs + j)]; dof >= 0) b_[at(dof)] += direction[j];
  saddle_->solve(b_.data());
  double mobility = 0.0;
  alone = 0.0;
  for (int j = 0; j < slot.columns; ++j)
    if (const int dof = system_.dof()[at(slot.dofs + j)]; dof >= 0) {
      mobility += direction[j] * b_[at(dof)];
      if (const double mass = system_.mass()[at(dof)]; mass > 0.0)
        alone += direction[j] * direction[j] / mass;
    }
  return mobility;
}

double Dynamics::effective_mass(const ForceSlot& slot, const double* direction) {
  double alone = 0.0;
  const double mobile = mobility(slot, direction, alone);
  // What drivers leave of the mobility of the bodies alone may be rounding.
  return mobile > 64.0 * machine_epsilon * alone ? 1.0 / mobile
                                                 : std::numeric_limits<double>::infinity();
}

double Dynamics::mobility(int dof) {
  std::fill(b_.begin(), b_.end(), 0.0);
  b_[at(dof)] = 1.0;
  saddle_->solve(b_.data());
  return std::max(0.0, b_[at(dof)]);
}

Violation Dynamics::largest_of(const std::vector<double>& residual) const {
  Violation worst;
  for (int i = 0; i < system_.rows(); ++i) {
    double& figure = system_.measure(i) == Measure::length ? worst.length : worst.angle;
    figure = std::max(figure, std::abs(residual[at(i)]));
  }
  return worst;
}

Violation Dynamics::position_violation(const State& state) {
  system_.set_motion(state.t, state.q.data(), state.v.data());
  system_.calc_position_level(phi_.data());
  worst_residual_ = system_.norm(phi_.data(), &worst_row_);
  factorised_ = false;  // G changed under the factors
  return largest_of(phi_);
}

Violation Dynamics::velocity_violation(const State& state) {
  system_.set_motion(state.t, state.q.data(), state.v.data());
  system_.calc_position_level(phi_.data());
  system_.calc_velocity_residual(residual_.data());
  factorised_ = false;
  return largest_of(residual_);
}

bool Dynamics::calc_events(const Instant& instant, double* g) {
  if (system_.any_grip()) {
    a_there_.resize(system_.dofs());
    lambda_there_.resize(system_.rows());
    if (!calc_accelerations(instant, {.a = a_there_.data(), .lambda = lambda_there_.data()}))
      return false;
    share_hold_forces(lambda_there_.data());
  } else {
    system_.set_motion(instant.t, instant.q, instant.v);
    system_.set_states(instant.z);
  }
  system_.calc_events(g);
  return true;
}

void Dynamics::share_hold_forces(const double* lambda) {
  const auto holds = system_.holds();
  const auto grip = [&](std::size_t i) { return system_.grip_memory(holds[i]).grip; };
  std::copy_n(lambda, system_.rows(), shared_.begin());
  held_.clear();
  carried_.clear();
  for (std::size_t i = 0; i < holds.size(); ++i) {
    if (grip(i) == Grip::carried) carried_.push_back(i);
    if (grip(i) == Grip::held) held_.push_back(i);
  }
  system_.set_multipliers(shared_.data());
  if (!carried_.empty()) share_with_carried(lambda);
  hold_forces_.assign(holds.size(), 0.0);
  for (const std::vector<std::size_t>* resting : {&held_, &carried_})
    for (const std::size_t i : *resting) hold_forces_[i] = shared_[at(holds[i].row)];
  system_.set_hold_forces(hold_forces_.data());
}

/// What a force of 1 N at a carried row does to the multipliers [rows]: it makes no acceleration.
Eigen::VectorXd Dynamics::response_to(std::size_t hold) {
  const int n = system_.dofs();
  const ForceSlot& f = system_.forces()[at(system_.holds()[hold].hold)];
  std::vector<double> s(at(f.columns), 0.0);
  f.element->calc_hold(system_.force_input(f), {.G = s.data()});
  std::fill(b_.begin(), b_.end(), 0.0);
  for (int j = 0; j < f.columns; ++j)
    if (const int dof = system_.dof()[at(f.dofs + j)]; dof >= 0) b_[at(dof)] -= s[at(j)];
  saddle_->solve(b_.data());
  Eigen::VectorXd response = Eigen::Map<const Eigen::VectorXd>(b_.data() + n, system_.rows());
  response[f.row] = 1.0;
  return response;
}

// With the forces x of the carried rows, those T of all that rest are T_0 + rho x; the sum of c T^2/limit
// shall be least, c the ratio of the sliding at a row to that at the held ones. Where there is one way to
// move, T/limit is then the same everywhere, and all break at once. Limits that depend on reactions depend
// on x: again until they agree.
void Dynamics::share_with_carried(const double* lambda) {
  const Eigen::Index rows = system_.rows(), carried = static_cast<Eigen::Index>(carried_.size());
  const Eigen::Map<const Eigen::VectorXd> alone(lambda, rows);
  Eigen::Map<Eigen::VectorXd> shared(shared_.data(), rows);
  Eigen::MatrixXd response(rows, carried);
  for (Eigen::Index k = 0; k < carried; ++k)
    response.col(k) = response_to(carried_[static_cast<std::size_t>(k)]);

  std::vector<std::size_t> resting = held_;
  resting.insert(resting.end(), carried_.begin(), carried_.end());
  const auto count = static_cast<Eigen::Index>(resting.size());
  Eigen::MatrixXd rho(count, carried);
  Eigen::VectorXd T(count), limit(count), ratio = Eigen::VectorXd::Ones(count);
  Eigen::VectorXd x, last = Eigen::VectorXd::Zero(carried);
  for (Eigen::Index i = 0; i < count; ++i) {
    const int row = system_.holds()[resting[static_cast<std::size_t>(i)]].row;
    rho.row(i) = response.row(row);
    T[i] = alone[row];
  }
  const auto held = static_cast<Eigen::Index>(held_.size());
  for (Eigen::Index k = 0; k < carried; ++k)
    ratio[held + k] = std::max(rho.col(k).head(held).norm(), least_ratio);
  for (int round = 0; round < most_shares; ++round) {
    for (Eigen::Index i = 0; i < count; ++i) {
      const ForceSlot& f =
          system_.forces()[at(system_.holds()[resting[static_cast<std::size_t>(i)]].hold)];
      limit[i] = f.element->holding_force(system_.force_input(f));
    }
    // What can bear next to nothing has little weight, not none: it would drown the others.
    const double largest = std::max(limit.maxCoeff(), std::numeric_limits<double>::min());
    const Eigen::VectorXd weight =
        (ratio.array() * largest / limit.array().max(least_limit * largest)).sqrt();
    const Eigen::MatrixXd A = weight.asDiagonal() * rho;
    x = A.householderQr().solve(-(weight.asDiagonal() * T));
    if (!x.allFinite()) return;
    shared = alone + response * x;
    if (system_.loaded().empty()) return;
    if ((x - last).cwiseAbs().maxCoeff() <= same_share * x.cwiseAbs().maxCoeff()) return;
    last = x;
  }
}

}  // namespace yoke
