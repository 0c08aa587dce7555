// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/formulations/sundials_stepper.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace yoke {

namespace {
constexpr std::size_t longest_message = 512;  // failures are not to allocate
constexpr double far = 1e-3;                  // rounding of a displacement, of its tolerance
constexpr int max_refinements = 6;
constexpr double probe_of_root = 1e-3;  // of the step: how far back its function is looked at
constexpr double refined = 1e-7;        // of the step: its square is nothing
constexpr double nearby = 0.1;          // of the step
constexpr double smooth = 0.1;          // misfit of a dense output, in tolerances
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
      weights_(size_, context_, &groups_),
      sensible_weights_(size_, context_, &groups_),
      own_step_(size_, [this](double t, const double* y,
                              double* y_dot) { return calc_rates(t, y, y_dot); }),
      error_(size_, context_, &groups_) {
  failure_.text.reserve(longest_message);
  found_.assign(static_cast<std::size_t>(guard_.count()), 0);
  q_start_.assign(static_cast<std::size_t>(n_), 0.0);
  q_ = q_low_ = q_start_;
  begin_.assign(static_cast<std::size_t>(size_), 0.0);
  end_ = shifted_ = refined_ = begin_;
  g_.assign(found_.size(), 0.0);
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
  N_VScale(1.0 / me.share_, me.weights_, weights);
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

void SundialsStepper::begin_step() {
  std::swap(begin_, end_);
  std::swap(t_begin_, t_end_);
  know_begin(nullptr);
}

void SundialsStepper::know_begin(const double* rates) {
  begin_rates_ = rates;
  own_step_.from(t_begin_, begin_.data(), rates);
}

void SundialsStepper::undo_step() { begin_step(); }

void SundialsStepper::end_step() {
  std::copy_n(y(), size_, end_.begin());
  t_end_ = t_;
}

double SundialsStepper::norm_of(const double* error) {
  std::copy_n(error, size_, error_.data());
  return N_VWrmsNorm(error_, sensible_weights_);
}

/// [s] From where y is `refined_` and changes at `rate`, along a straight line.
double SundialsStepper::time_to_root(int slot, const double* rate, double h) {
  const auto value = [&](double later) {
    for (std::size_t i = 0; i < shifted_.size(); ++i) shifted_[i] = refined_[i] + later * rate[i];
    return evaluate_events(t_ + later, shifted_.data(), g_.data())
               ? g_[static_cast<std::size_t>(slot)]
               : std::numeric_limits<double>::quiet_NaN();
  };
  const double back = probe_of_root * h, now = value(0.0), before = value(-back);
  return -now * back / (now - before);
}

void SundialsStepper::refine_event(double t_limit) { refine_event(t_limit, {}); }

void SundialsStepper::refine_event_if_rough(double t_limit, const double* slope) {
  double* misfit = shifted_.data();
  if (!calc_rates(t_, y(), misfit)) return;
  for (std::size_t i = 0; i < shifted_.size(); ++i)
    misfit[i] = (misfit[i] - slope[i]) * (t_ - t_begin_);
  if (norm_of(misfit) <= smooth) return;
  refine_event(t_limit, [this](const double* error) { return norm_of(error); });
}

// Newton steps from the root of the dense output.
void SundialsStepper::refine_event(double t_limit, const OwnStep::Norm& norm) {
  const auto slot = static_cast<int>(std::ranges::find(found_, 1) - found_.begin());
  if (slot == guard_.count()) return;
  const double t_found = t_, h = t_found - t_begin_;
  for (int i = 0; i < max_refinements; ++i) {
    own_step_.from(t_begin_, begin_.data(), begin_rates_);
    if (!(norm ? own_step_.to(t_, refined_.data(), norm) : own_step_.to(t_, refined_.data())))
      break;
    const double* rate = own_step_.rate(t_, refined_.data());
    if (rate == nullptr) break;
    const double later = time_to_root(slot, rate, h), t = t_ + later;
    if (!(std::abs(t - t_found) < nearby * h && t <= t_limit)) break;  // NaN too
    t_ = t;
    if (std::abs(later) > refined * h) continue;
    for (std::size_t k = 0; k < refined_.size(); ++k) y()[k] = refined_[k] + later * rate[k];
    return;
  }
  t_ = t_found;
}

void SundialsStepper::report_failed_projection() {
  failure_.text =
      fmt::format("positions cannot be projected on the constraints; worst equation '{}'",
                  dynamics_.system().equation_name(dynamics_.worst_row()));
}

}  // namespace yoke
