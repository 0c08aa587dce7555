// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/formulations/generalised_alpha.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <yoke/core/equations/linear/index.hpp>

namespace yoke {

namespace {

constexpr double safety = 0.9, least_factor = 0.2, largest_factor = 2.0;
constexpr double deadband = 1.1;  // a step is not made longer by less
constexpr double first_over_delta = 100.0;
constexpr double noise = 32.0;
constexpr double largest_turn = 0.25;  // [rad] of a body in a step, where there are events

enum Factor { plus, minus, mass_factor, minus_velocity, state_factor, rate_factor };

/// The second divided difference of f over three times h apart (h, k: the later, the earlier).
double second_difference(double before, double now, double after, double k, double h) {
  return ((after - now) / h - (now - before) / k) / (h + k);
}

}  // namespace

GeneralisedAlpha::Coefficients::Coefficients(double rho)
    : alpha_m((2.0 * rho - 1.0) / (rho + 1.0)),
      alpha_f(rho / (rho + 1.0)),
      gamma(0.5 + alpha_f - alpha_m),
      beta(0.25 * (gamma + 0.5) * (gamma + 0.5)),
      theta(alpha_m - alpha_f),
      C(1.0 / 6.0 - beta - 0.5 * theta) {}

MatrixLayout GeneralisedAlpha::layout(const System& system) {
  const int q = 0, z = system.dofs(), lambda = z + system.states();
  return {.size = lambda + system.rows(),
          .placements = {{Block::mass, q, q, mass_factor},
                         {Block::K_lambda, q, q, plus},
                         {Block::Q_q, q, q, minus},
                         {Block::Q_v, q, q, minus_velocity},
                         {Block::Q_z, q, z, minus},
                         {Block::G_T, q, lambda, plus},
                         {Block::z_q, z, q, minus},
                         {Block::z_v, z, q, minus_velocity},
                         {Block::states, z, z, state_factor},
                         {Block::z_z, z, z, minus},
                         {Block::G, lambda, q, plus},
                         {Block::H_hold, lambda, q, rate_factor},
                         {Block::dropped, lambda, lambda, plus},
                         {Block::open, lambda, lambda, plus}},
          .rows = {{Unit::force, q, 2}, {Unit::state, z, 1}, {Unit::equation, lambda}},
          .columns = {{Unit::coordinate, q}, {Unit::state, z}, {Unit::multiplier, lambda, 2}}};
}

namespace {

// A step of order 2 resolves a contact as finely as rounding allows. Its velocities must not be asked
// for more, or steps follow rounding (three times as many were measured): the share of the
// tolerances that bodies in a contact have is taken from their positions alone, twice.
Tolerances by_positions(const System& system, Tolerances tolerances) {
  const Scales scales = system.scales();
  for (Eigen::Index i = 0; i < tolerances.q.size(); ++i) {
    const double size = i % 3 == 2 ? 1.0 : scales.length;
    const double all = tolerances.relative * size / scales.time;
    tolerances.q[i] *= std::min(1.0, tolerances.v[i] / all);
    tolerances.v[i] = all;
  }
  return tolerances;
}

}  // namespace

GeneralisedAlpha::GeneralisedAlpha(Dynamics& dynamics, const Tolerances& tolerances,
                                   AlphaOptions options)
    : dynamics_(dynamics),
      system_(dynamics.system()),
      tolerances_(by_positions(dynamics.system(), tolerances)),
      options_(std::move(options)),
      c_(tolerances.spectral_radius),
      n_(system_.dofs()),
      nz_(system_.states()),
      rows_(system_.rows()),
      quadratures_(system_.quadratures()),
      matrix_(system_, layout(system_)),
      mask_(system_),
      guard_(dynamics),
      floor_(dynamics, tolerances_, {.own = 8.0, .followed = 4.0 * noise}) {
  for (Node* node : {&begin_, &end_, &new_}) allocate(*node);
  for (Vector* x : {&q_start_, &weight_q_, &weight_v_, &q_, &rounding_, &b_, &jerk_, &jerk_normal_,
                    &v_old_, &a_old_, &v_, &a_, &rate_, &dense_u_, &dense_v_})
    x->assign(at(n_), 0.0);
  for (Vector* x : {&b_z_, &w_old_, &w_, &z_rate_, &dense_z_}) x->assign(at(nz_), 0.0);
  for (Vector* x : {&lambda_, &lambda_rate_, &load_, &rates_}) x->assign(at(rows_), 0.0);
  for (Vector* x : {&second_, &second_old_, &dense_energy_}) x->assign(at(quadratures_), 0.0);
  for (Vector* x : {&g_from_, &g_to_, &g_low_, &g_high_, &g_}) x->assign(at(guard_.count()), 0.0);
  x_.assign(at(matrix_.size()), 0.0);
  force_.assign(at(n_) + 1, 0.0);
  found_.assign(at(guard_.count()), 0);
}

void GeneralisedAlpha::allocate(Node& node) const {
  for (Vector* x : {&node.u, &node.v, &node.a}) x->assign(at(n_), 0.0);
  for (Vector* x : {&node.z, &node.z_dot}) x->assign(at(nz_), 0.0);
  for (Vector* x : {&node.energy, &node.power}) x->assign(at(quadratures_), 0.0);
  node.lambda.assign(at(rows_), 0.0);
}

double* GeneralisedAlpha::absolute(const Vector& u) {
  for (std::size_t i = 0; i < q_.size(); ++i) q_[i] = q_start_[i] + u[i];
  return q_.data();
}

// A method of order 2 whose steps err by the tolerance errs by its power 2/3 in the end. So a step
// may err by its power 3/2 only, and the error of a run is proportional to the tolerance
// (calibration after G. Soederlind, L. Wang, J. Comput. Appl. Math. 185 (2006) 244-260); at 1e-2
// nothing changes. Positions are known to rounding, and rounding of one gets into all velocities by
// way of the constraints: less than `noise` times that cannot be asked of a step, so that a
// tolerance below 1e-10 gains nothing.
void GeneralisedAlpha::choose_allowed() {
  allowed_ = std::sqrt(std::min(1.0, tolerances_.relative / 1e-2));
  allowed_ = std::max(allowed_, noise * machine_epsilon / tolerances_.relative);
  for (int i = 0; i < n_; ++i)
    allowed_ = std::max(allowed_, noise * machine_epsilon * extent(i) / tolerances_.q[i]);
  least_allowed_ = allowed_;
}

/// How large a coordinate is, and not less than the model.
double GeneralisedAlpha::extent(int i) const {
  return std::abs(q_start_[at(i)]) + (i % 3 == 2 ? 1.0 : system_.scales().length);
}

/// What a step may err by, in one coordinate, and not less than rounding leaves.
void GeneralisedAlpha::weigh() {
  for (int i = 0; i < n_; ++i) {
    weight_q_[at(i)] = 1.0 / (allowed_ * tolerances_.q[i]);
    weight_v_[at(i)] = 1.0 / (allowed_ * tolerances_.v[i]);
  }
  floor_.apply(absolute(end_.u), end_.v.data(), weight_q_.data(), weight_v_.data(), allowed_);
}

/// What rounding of the positions leaves unknown of a coordinate: an angle is only as good as the
/// positions of joints.
double GeneralisedAlpha::rounding(int i) const {
  const double own = rounding_of(extent(i));
  if (i % 3 != 2) return own * floor_.yielding(i);
  const double position = std::max(std::abs(q_start_[at(i - 2)]), std::abs(q_start_[at(i - 1)]));
  return std::max(own, rounding_of(position) / floor_.arm(i / 3)) * floor_.yielding(i);
}

bool GeneralisedAlpha::calc_rates(Node& node) {
  return dynamics_.calc_accelerations(
      {.t = node.t, .q = absolute(node.u), .v = node.v.data(), .z = node.z.data()},
      {.a = node.a.data(),
       .lambda = node.lambda.data(),
       .z_dot = nz_ > 0 ? node.z_dot.data() : nullptr,
       .quadrature_rates = quadratures_ > 0 ? node.power.data() : nullptr});
}

void GeneralisedAlpha::start(const State& state) {
  end_.t = t_ = state.t;
  std::copy_n(state.q.data(), n_, q_start_.begin());
  std::ranges::fill(end_.u, 0.0);
  std::copy_n(state.v.data(), n_, end_.v.begin());
  std::copy_n(state.z.data(), nz_, end_.z.begin());
  std::copy_n(state.energy.data(), quadratures_, end_.energy.begin());
  choose_allowed();
  floor_.start();
  for (int i = 0; i < n_; ++i) rounding_[at(i)] = rounding(i);
  guard_.start(state);
  if (guard_.count() > 0)
    guard_.evaluate(t_, state.q.data(), end_.v.data(), end_.z.data(), g_from_.data());
  started_ = false;
}

// v'' at the start is that of a short step forwards, written as a node before the start.
void GeneralisedAlpha::begin(double t_stop) {
  started_ = true;
  third_known_ = false;
  const double span = t_stop - end_.t;
  if (!calc_rates(end_)) return;  // the first step will tell
  double delta = 1e-3 * span;
  for (int i = 0; i < n_; ++i)
    if (end_.a[at(i)] != 0.0)
      delta = std::min(delta, std::sqrt(2.0 * tolerances_.q[i] / std::abs(end_.a[at(i)])));
  delta = std::max(delta, 64.0 * machine_epsilon * std::abs(end_.t));
  new_.t = end_.t + delta;
  for (std::size_t i = 0; i < end_.u.size(); ++i) {
    new_.u[i] = delta * (end_.v[i] + 0.5 * delta * end_.a[i]);
    new_.v[i] = end_.v[i] + delta * end_.a[i];
  }
  for (std::size_t i = 0; i < end_.z.size(); ++i) new_.z[i] = end_.z[i] + delta * end_.z_dot[i];
  const bool known = calc_rates(new_);
  begin_.t = end_.t - delta;
  const auto reflect = [known](Vector& before, const Vector& now, const Vector& after) {
    for (std::size_t i = 0; i < now.size(); ++i)
      before[i] = known ? 2.0 * now[i] - after[i] : now[i];
  };
  reflect(begin_.a, end_.a, new_.a);
  reflect(begin_.z_dot, end_.z_dot, new_.z_dot);
  reflect(begin_.power, end_.power, new_.power);
  reflect(begin_.lambda, end_.lambda, new_.lambda);
  k_old_ = h_last_ = delta;
  calc_jerk(begin_, end_, nullptr);
  for (std::size_t i = 0; i < b_.size(); ++i) b_[i] = options_.plain ? 0.0 : c_.theta * jerk_[i];
  for (std::size_t i = 0; i < b_z_.size(); ++i)
    b_z_[i] = options_.plain ? 0.0 : c_.theta * (end_.z_dot[i] - begin_.z_dot[i]) / delta;
  dynamics_.project_positions(end_.t, absolute(end_.u));  // brings G back
  calc_normal_jerk();
  h_next_ = first_length(span, delta);
}

double GeneralisedAlpha::first_length(double span, double delta) const {
  double h = std::min(span, first_over_delta * delta);
  for (int i = 0; i < n_; ++i)
    if (jerk_[at(i)] != 0.0)
      h = std::min(h, 0.5 * std::cbrt(allowed_ * tolerances_.q[i] / std::abs(c_.C * jerk_[at(i)])));
  return h;
}

/// v'' at `after` from three nodes, or at `now` from two; and the rate of the multipliers.
void GeneralisedAlpha::calc_jerk(const Node& before, const Node& now, const Node* after) {
  const double k = now.t - before.t, h = after != nullptr ? after->t - now.t : 0.0;
  for (std::size_t i = 0; i < jerk_.size(); ++i) {
    if (after == nullptr) {
      jerk_[i] = (now.a[i] - before.a[i]) / k;
    } else {
      const double second = second_difference(before.a[i], now.a[i], after->a[i], k, h);
      jerk_[i] = (after->a[i] - now.a[i]) / h + second * h;
    }
  }
  const Node& from = after != nullptr ? now : before;
  const Node& to = after != nullptr ? *after : now;
  for (std::size_t i = 0; i < lambda_rate_.size(); ++i)
    lambda_rate_[i] = (to.lambda[i] - from.lambda[i]) / (to.t - from.t);
}

/// What a projection takes from v + s v'' is the part of s v'' across the constraints. G must be
/// that of the end of the last step.
void GeneralisedAlpha::calc_normal_jerk() {
  std::ranges::fill(jerk_normal_, 0.0);
  if (options_.plain || rows_ == 0) return;
  double size = 0.0, speed = 0.0;
  for (int i = 0; i < n_; ++i) {
    size = std::max(size, std::abs(jerk_[at(i)]) / tolerances_.v[i]);
    speed = std::max(speed, std::abs(end_.v[at(i)]) / tolerances_.v[i]);
  }
  if (size == 0.0) return;
  const double s = std::max(speed, 1.0) / size;  // both of one size: least rounding
  for (std::size_t i = 0; i < v_.size(); ++i) v_old_[i] = v_[i] = end_.v[i] + s * jerk_[i];
  if (!dynamics_.project_velocities(end_.t, absolute(end_.u), v_.data(), Rows::of_positions))
    return;
  for (std::size_t i = 0; i < v_.size(); ++i) jerk_normal_[i] = (v_old_[i] - v_[i]) / s;
}

Step GeneralisedAlpha::step(double t_stop) {
  if (!started_) begin(t_stop);
  weigh();
  if (options_.steps.empty()) {
    if (!take_controlled_step(t_stop)) return Step::failed;
  } else {
    const double h = options_.steps[turn_++ % options_.steps.size()];
    if (!advance(h * (1.0 + 1e-9) >= t_stop - end_.t ? t_stop : end_.t + h))
      return fail("Newton's iteration does not converge");
  }
  return finish_at_event() ? Step::event : Step::advanced;
}

bool GeneralisedAlpha::take_controlled_step(double t_stop) {
  const double shortest =
      std::max(4.0 * machine_epsilon * std::abs(end_.t), 1e-18 * std::abs(t_stop));
  const char* why = "";
  double last_error = std::numeric_limits<double>::infinity(), last_h = 1.0, first_h = 0.0;
  for (int tries = 0;; ++tries) {
    if (!(h_next_ > shortest)) {
      fail(why);
      return false;
    }
    const double rest = t_stop - end_.t;
    h_next_ = std::min(h_next_, tolerances_.longest_step);
    if (guard_.count() > 0) h_next_ = std::min(h_next_, largest_turn / fastest_turn());
    const bool to_stop = h_next_ * (1.0 + 1e-9) >= rest;
    const double aim = !to_stop && 2.0 * h_next_ > rest ? 0.5 * rest : h_next_;
    const double t_new = to_stop ? t_stop : end_.t + aim, h = t_new - end_.t;
    if (tries == 0) first_h = h;
    if (!advance(t_new)) {
      ++counters_.rejected;
      why = "Newton's iteration does not converge with any step";
      h_next_ = 0.25 * h;
      continue;
    }
    const double motion = calc_error(), energy = integrate_energy();
    const double error = std::max(motion, energy);
    // Errors that do not fall with the step as those of the method do come from rounding (near a
    // singular position, for instance) or a kink. Then it is enough to meet the tolerance itself.
    const bool irregular =
        error > last_error * std::pow(h / last_h, 1.5) && motion * allowed_ <= 1.0 && energy <= 1.0;
    const double factor = safety / std::cbrt(error);
    if (error <= 1.0 || irregular) {
      if (irregular) {
        allowed_ = std::min(1.0, 4.0 * allowed_);
        h_next_ = first_h;  // rounding weighs less in longer steps
      } else if (factor < 1.0) {
        h_next_ = factor * h;
      } else if (tries == 0 && factor > deadband && aim == h_next_) {
        h_next_ = std::min(factor, largest_factor) * h;
      }
      return true;
    }
    ++counters_.rejected;
    why = "no step is short enough for the tolerance";
    const bool finite = std::isfinite(error);
    if (finite) last_error = error;
    last_h = h;
    h_next_ = h * std::clamp(finite ? factor : 0.0, least_factor, 0.9);
  }
}

/// Tries a step to t_new.
bool GeneralisedAlpha::advance(double t_new) {
  const double h = t_new - end_.t;
  predict(h);
  return solve_stage(h, t_new) && finish(t_new);
}

/// Against the integrals of the parabola through three accelerations: what the step has erred by,
/// to leading order, in units of what is allowed. Jumps of a driver are seen too.
double GeneralisedAlpha::calc_error() const {
  const double k = end_.t - begin_.t, h = new_.t - end_.t;
  double worst = 0.0;
  const auto note = [&worst](double error) {
    if (!(error <= worst)) worst = error;  // catches NaN
  };
  for (int j = 0; j < n_; ++j) {
    const std::size_t i = at(j);
    const double a0 = end_.a[i], a1 = new_.a[i];
    const double second = second_difference(begin_.a[i], a0, a1, k, h);
    const double dv = h * (0.5 * (a0 + a1) - second * h * h / 6.0);
    const double du = h * (end_.v[i] + h * (a0 / 3.0 + a1 / 6.0 - second * h * h / 12.0));
    note(std::abs(new_.u[i] - end_.u[i] - du) * weight_q_[i]);
    note(std::abs(new_.v[i] - end_.v[i] - dv) * weight_v_[i]);
  }
  for (int j = 0; j < nz_; ++j) {
    const std::size_t i = at(j);
    const double f0 = end_.z_dot[i], f1 = new_.z_dot[i];
    const double second = second_difference(begin_.z_dot[i], f0, f1, k, h);
    const double dz = h * (0.5 * (f0 + f1) - second * h * h / 6.0);
    note(std::abs(new_.z[i] - end_.z[i] - dz) / (allowed_ * tolerances_.z[j]));
  }
  return worst;
}

/// Energies by the integral of the polynomial through the last four powers (three in the first
/// step), which converges faster than the motion; the term of highest order is its error.
double GeneralisedAlpha::integrate_energy() {
  const double k = end_.t - begin_.t, h = new_.t - end_.t;
  double worst = 0.0;
  for (std::size_t i = 0; i < second_.size(); ++i) {
    second_[i] = second_difference(begin_.power[i], end_.power[i], new_.power[i], k, h);
    double last_term = -second_[i] * h * h * h / 6.0;
    double sum = 0.5 * h * (end_.power[i] + new_.power[i]) + last_term;
    if (third_known_) {
      const double third = (second_[i] - second_old_[i]) / (h + k + k_old_);
      last_term = -third * h * h * h * (h + 2.0 * k) / 12.0;
      sum += last_term;
    }
    new_.energy[i] = end_.energy[i] + sum;
    const double error = std::abs(last_term) / tolerances_.energy;
    if (!(error <= worst)) worst = error;
  }
  return worst;
}

void GeneralisedAlpha::accept() {
  ++counters_.steps;
  const double h = new_.t - end_.t;
  calc_jerk(begin_, end_, &new_);
  // A step cut short by an event says nothing about b but rounding: as at the start then.
  const bool fresh = !options_.plain && h < 1e-2 * h_last_;
  for (std::size_t i = 0; i < b_.size(); ++i)
    b_[i] = fresh ? c_.theta * jerk_[i] : (a_[i] - new_.a[i]) / h;
  for (std::size_t i = 0; i < b_z_.size(); ++i)
    b_z_[i] = fresh ? c_.theta * (new_.z_dot[i] - end_.z_dot[i]) / h : (w_[i] - new_.z_dot[i]) / h;
  std::swap(second_, second_old_);
  third_known_ = true;
  allowed_ = std::max(least_allowed_, 0.98 * allowed_);
  k_old_ = end_.t - begin_.t;
  h_last_ = h;
  std::swap(begin_, end_);
  std::swap(end_, new_);
  calc_normal_jerk();
}

StepCounters GeneralisedAlpha::counters() const {
  StepCounters total = counters_;
  total.raised = floor_.raised();
  total.factors = matrix_.counters();
  return total;
}

Step GeneralisedAlpha::fail(const char* why) {
  failure_ = why;
  t_ = end_.t;
  return Step::failed;
}

std::unique_ptr<Formulation> make_generalised_alpha(Dynamics& dynamics,
                                                    const Tolerances& tolerances) {
  return std::make_unique<GeneralisedAlpha>(dynamics, tolerances);
}

}  // namespace yoke
