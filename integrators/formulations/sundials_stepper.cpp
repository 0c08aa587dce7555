// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/formulations/sundials_stepper.hpp>

#include <algorithm>

namespace yoke {

namespace {
constexpr std::size_t longest_message = 512;  // failures are not to allocate
}

SundialsStepper::SundialsStepper(Dynamics& dynamics, const Tolerances& tolerances, int energies)
    : dynamics_(dynamics),
      tolerances_(tolerances),
      guard_(dynamics),
      n_(dynamics.system().dofs()),
      nz_(dynamics.system().states()),
      quadratures_(dynamics.system().quadratures()),
      energies_(energies),
      size_(energies + quadratures_),
      context_(failure_),
      y_(size_, context_),
      weights_(size_, context_) {
  failure_.text.reserve(longest_message);
  found_.assign(static_cast<std::size_t>(guard_.count()), 0);
  q_start_.assign(static_cast<std::size_t>(n_), 0.0);
  q_ = q_start_;
}

double* SundialsStepper::q_of(const double* y) {
  for (std::size_t i = 0; i < q_.size(); ++i) q_[i] = q_start_[i] + y[i];
  return q_.data();
}

void SundialsStepper::pack(const State& state) {
  std::copy_n(state.q.data(), n_, q_start_.begin());
  std::fill_n(y(), n_, 0.0);
  std::copy_n(state.v.data(), n_, y() + n_);
  std::copy_n(state.z.data(), nz_, y() + 2 * n_);
  std::copy_n(state.energy.data(), quadratures_, y() + energies_);
}

void SundialsStepper::unpack(double t, State& state) {
  state.t = t;
  std::copy_n(q_of(y()), n_, state.q.data());
  std::copy_n(y() + n_, n_, state.v.data());
  std::copy_n(y() + 2 * n_, nz_, state.z.data());
  std::copy_n(y() + energies_, quadratures_, state.energy.data());
}

void SundialsStepper::set_weights(double share) {
  double* w = weights_.data();
  for (int i = 0; i < n_; ++i) {
    const double rounding = rounding_of(q_start_[static_cast<std::size_t>(i)]);
    w[i] = 1.0 / (share * std::max(tolerances_.q[i], rounding));
    w[n_ + i] = 1.0 / (share * tolerances_.v[i]);
  }
  for (int i = 0; i < nz_; ++i) w[2 * n_ + i] = 1.0 / (share * tolerances_.z[i]);
  std::fill_n(w + energies_, quadratures_, 1.0 / (share * tolerances_.energy));
}

void SundialsStepper::report_failed_projection() {
  failure_.text =
      fmt::format("positions cannot be projected on the constraints; worst equation '{}'",
                  dynamics_.system().equation_name(dynamics_.worst_row()));
}

int SundialsStepper::copy_weights(N_Vector, N_Vector weights, void* user_data) {
  N_VScale(1.0, static_cast<SundialsStepper*>(user_data)->weights_, weights);
  return 0;
}

}  // namespace yoke
