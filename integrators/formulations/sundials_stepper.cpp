// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/formulations/sundials_stepper.hpp>

#include <algorithm>
#include <cmath>

namespace yoke {

namespace {
constexpr std::size_t longest_message = 512;  // failures are not to allocate
constexpr double far = 1e-3;                  // rounding of a displacement, of its tolerance
}  // namespace

SundialsStepper::SundialsStepper(Dynamics& dynamics, const Tolerances& tolerances, int energies,
                                 const RoundingFloor::Noise& noise)
    : dynamics_(dynamics),
      tolerances_(tolerances),
      guard_(dynamics),
      n_(dynamics.system().dofs()),
      nz_(dynamics.system().states()),
      quadratures_(dynamics.system().quadratures()),
      energies_(energies),
      size_(energies + quadratures_),
      floor_(dynamics, tolerances, noise),
      context_(failure_),
      groups_{.dofs = n_, .states = nz_, .energies = quadratures_},
      y_(size_, context_, &groups_),
      weights_(size_, context_, &groups_) {
  failure_.text.reserve(longest_message);
  found_.assign(static_cast<std::size_t>(guard_.count()), 0);
  q_start_.assign(static_cast<std::size_t>(n_), 0.0);
  q_ = q_low_ = q_start_;
}

double* SundialsStepper::q_of(const double* y) {
  for (std::size_t i = 0; i < q_.size(); ++i) q_[i] = q_start_[i] + (q_low_[i] + y[i]);
  return q_.data();
}

bool SundialsStepper::is_far_from_base() const {
  const double* displacement = y();
  for (int i = 0; i < n_; ++i)
    if (rounding_of(displacement[i]) > far * tolerances_.q[i]) return true;
  return false;
}

// The sum of base and displacement in two parts, exactly (Knuth, The Art of Computer Programming 2,
// 4.2.2).
void SundialsStepper::move_base() {
  for (std::size_t i = 0; i < q_start_.size(); ++i) {
    const double a = q_start_[i], b = q_low_[i] + y()[i], sum = a + b, part = sum - a;
    q_low_[i] = (a - (sum - part)) + (b - part);
    q_start_[i] = sum;
    y()[i] = 0.0;
  }
}

void SundialsStepper::pack(const State& state) {
  std::copy_n(state.q.data(), n_, q_start_.begin());
  floor_.start();
  std::ranges::fill(q_low_, 0.0);
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

void SundialsStepper::set_weights() {
  double* w = weights_.data();
  for (int i = 0; i < n_; ++i) {
    w[i] = 1.0 / tolerances_.q[i];
    w[n_ + i] = 1.0 / tolerances_.v[i];
  }
  for (int i = 0; i < nz_; ++i) w[2 * n_ + i] = 1.0 / tolerances_.z[i];
  std::fill_n(w + energies_, quadratures_, 1.0 / tolerances_.energy);
}

int SundialsStepper::calc_weights(N_Vector y_vector, N_Vector weights, void* user_data) {
  auto& me = *static_cast<SundialsStepper*>(user_data);
  N_VScale(1.0, me.weights_, weights);
  const double* y = NV_DATA_S(y_vector);
  double* w = NV_DATA_S(weights);
  me.floor_.apply(me.q_of(y), me.v_of(y), w, w + me.n_);
  const auto bound = [&](int first, int count) {
    for (int i = first; i < first + count; ++i)
      if (const double rounding = rounding_of(y[i]); rounding * w[i] > 1.0) w[i] = 1.0 / rounding;
  };
  bound(2 * me.n_, me.nz_);
  bound(me.energies_, me.quadratures_);
  return 0;
}

void SundialsStepper::report_failed_projection() {
  failure_.text =
      fmt::format("positions cannot be projected on the constraints; worst equation '{}'",
                  dynamics_.system().equation_name(dynamics_.worst_row()));
}

}  // namespace yoke
