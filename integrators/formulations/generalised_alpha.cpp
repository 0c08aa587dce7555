// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/formulations/generalised_alpha.hpp>

#include <algorithm>
#include <array>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <limits>
#include <utility>

#include <yoke/core/equations/index.hpp>

namespace yoke {

namespace {

constexpr int max_newton_iterations = 10;
constexpr double newton_share = 1e-3;  // of the error allowed in a step
constexpr double slow = 0.2;           // Newton converging worse than this gets a new matrix
constexpr double safety = 0.9, least_factor = 0.2, largest_factor = 2.0;
constexpr double deadband = 1.1;  // a step is not made longer by less
constexpr double first_over_delta = 100.0;
constexpr double noise = 4.0;
constexpr int max_root_steps = 20;
constexpr double largest_turn = 0.25;  // [rad] of a body in a step, where there are events
constexpr double parts_per_radian = 16.0;
constexpr double root_accuracy = 1e-9;  // of the step

enum Factor { plus, minus, mass_factor, minus_velocity, state_factor };

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
                         {Block::dropped, lambda, lambda, plus}},
          .rows = {{Unit::force, q, 2}, {Unit::state, z, 1}, {Unit::equation, lambda}},
          .columns = {{Unit::coordinate, q}, {Unit::state, z}, {Unit::multiplier, lambda, 2}}};
}

GeneralisedAlpha::GeneralisedAlpha(Dynamics& dynamics, const Tolerances& tolerances,
                                   AlphaOptions options)
    : dynamics_(dynamics),
      system_(dynamics.system()),
      tolerances_(tolerances),
      options_(std::move(options)),
      c_(tolerances.spectral_radius),
      n_(system_.dofs()),
      nz_(system_.states()),
      rows_(system_.rows()),
      quadratures_(system_.quadratures()),
      matrix_(system_, layout(system_)),
      mask_(system_),
      guard_(dynamics) {
  for (Node* node : {&begin_, &end_, &new_}) allocate(*node);
  for (Vector* x : {&q_start_, &q_, &rounding_, &b_, &jerk_, &jerk_normal_, &v_old_, &a_old_, &v_,
                    &a_, &rate_, &dense_u_, &dense_v_})
    x->assign(at(n_), 0.0);
  for (Vector* x : {&b_z_, &w_old_, &w_, &z_rate_, &dense_z_}) x->assign(at(nz_), 0.0);
  for (Vector* x : {&lambda_, &lambda_rate_}) x->assign(at(rows_), 0.0);
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
  allowed_ = std::max(allowed_, noise * rounding_of(1.0) / tolerances_.relative);
  for (int i = 0; i < n_; ++i)
    allowed_ = std::max(allowed_, noise * rounding_of(extent(i)) / tolerances_.q[i]);
  least_allowed_ = allowed_;
}

/// How large a coordinate is, and not less than the model.
double GeneralisedAlpha::extent(int i) const {
  return std::abs(q_start_[at(i)]) + (i % 3 == 2 ? 1.0 : system_.scales().length);
}

/// What rounding of the positions leaves unknown of a coordinate: an angle is only as good as the
/// positions of joints, at about the radius of gyration from the centre.
double GeneralisedAlpha::rounding(int i) const {
  const double own = rounding_of(extent(i));
  if (i % 3 != 2) return own;
  const double gyration = std::sqrt(system_.mass()[at(i)] / system_.mass()[at(i - 1)]);
  const double position = std::max(std::abs(q_start_[at(i - 2)]), std::abs(q_start_[at(i - 1)]));
  return std::max(own, rounding_of(position) / gyration);
}

bool GeneralisedAlpha::calc_rates(Node& node) {
  return dynamics_.calc_accelerations(
      node.t, absolute(node.u), node.v.data(), node.z.data(), node.a.data(), node.lambda.data(),
      nz_ > 0 ? node.z_dot.data() : nullptr, quadratures_ > 0 ? node.power.data() : nullptr);
}

void GeneralisedAlpha::start(const State& state) {
  end_.t = t_ = state.t;
  std::copy_n(state.q.data(), n_, q_start_.begin());
  std::ranges::fill(end_.u, 0.0);
  std::copy_n(state.v.data(), n_, end_.v.begin());
  std::copy_n(state.z.data(), nz_, end_.z.begin());
  std::copy_n(state.energy.data(), quadratures_, end_.energy.begin());
  choose_allowed();
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
  if (!dynamics_.project_velocities(end_.t, absolute(end_.u), v_.data())) return;
  for (std::size_t i = 0; i < v_.size(); ++i) jerk_normal_[i] = (v_old_[i] - v_[i]) / s;
}

Step GeneralisedAlpha::step(double t_stop) {
  if (!started_) begin(t_stop);
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

void GeneralisedAlpha::predict(double h) {
  const double rescaled = options_.plain ? h_last_ : h;
  const double am = (1.0 - c_.alpha_m) / (1.0 - c_.alpha_f);
  for (std::size_t i = 0; i < v_.size(); ++i) {
    const double v = end_.v[i] + c_.C * h * h * jerk_normal_[i];
    const double a = end_.a[i] + rescaled * b_[i];
    a_[i] = end_.a[i] + (1.0 + c_.theta) * h * jerk_[i];
    new_.u[i] = end_.u[i] + h * (v + h * ((0.5 - c_.beta) * a + c_.beta * a_[i]));
    v_[i] = v + h * ((1.0 - c_.gamma) * a + c_.gamma * a_[i]);
    rate_[i] = am * a_[i] + (c_.alpha_m * a - c_.alpha_f * end_.a[i]) / (1.0 - c_.alpha_f);
  }
  for (std::size_t i = 0; i < w_.size(); ++i) {
    const double w = end_.z_dot[i] + rescaled * b_z_[i];
    w_[i] = end_.z_dot[i];
    new_.z[i] = end_.z[i] + h * ((1.0 - c_.gamma) * w + c_.gamma * w_[i]);
    z_rate_[i] = am * w_[i] + (c_.alpha_m * w - c_.alpha_f * end_.z_dot[i]) / (1.0 - c_.alpha_f);
  }
  for (std::size_t i = 0; i < lambda_.size(); ++i)
    lambda_[i] = end_.lambda[i] + h * lambda_rate_[i];
}

bool GeneralisedAlpha::solve_stage(double h, double t) {
  bool renew = true;
  double last = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < max_newton_iterations; ++iteration) {
    if (renew) {
      calc_matrix(h, t);
      const double am = (1.0 - c_.alpha_m) / (1.0 - c_.alpha_f);
      if (!matrix_.factorise(std::sqrt(am / c_.beta) / h)) return false;
    }
    if (!calc_residual(t)) return false;
    matrix_.solve(x_.data());
    const double norm = correct(h);
    if (!std::isfinite(norm)) return false;
    if (norm < 1.0) return true;
    if (iteration > 1 && norm > 0.5 * last && norm * allowed_ < 1.0)
      return true;  // as well as positions are known there; the error test has the last word
    if (iteration > 1 && norm > 2.0 * last) return false;
    renew = norm > slow * last;
    last = norm;
  }
  return false;
}

/// -R into x_.
bool GeneralisedAlpha::calc_residual(double t) {
  ++counters_.evaluations;
  system_.set_motion(t, absolute(new_.u), v_.data());
  system_.set_states(new_.z.data());
  double* r_q = x_.data();
  double* r_z = r_q + n_;
  double* r_p = r_z + nz_;
  system_.calc_position_level(r_p);
  std::ranges::fill(force_, 0.0);
  system_.add_forces(force_.data(), nz_ > 0 ? r_z : nullptr, nullptr);
  system_.subtract_constraint_forces(mask_.kept(lambda_.data()), force_.data());
  double sum = 0.0;
  for (int i = 0; i < n_; ++i) r_q[i] = force_[at(i)] - system_.mass()[at(i)] * rate_[at(i)];
  for (int i = 0; i < nz_; ++i) r_z[i] -= z_rate_[at(i)];
  for (int i = 0; i < rows_; ++i) r_p[i] = -r_p[i];
  for (const int i : system_.dropped_rows()) r_p[i] = -lambda_[at(i)];
  for (const double r : x_) sum += r;
  if (!std::isfinite(sum)) system_.blame_not_finite();
  return std::isfinite(sum);
}

void GeneralisedAlpha::calc_matrix(double h, double t) {
  ++counters_.jacobians;
  const double am = (1.0 - c_.alpha_m) / (1.0 - c_.alpha_f);
  matrix_.evaluate({.t = t,
                    .q = absolute(new_.u),
                    .v = v_.data(),
                    .z = new_.z.data(),
                    .lambda = mask_.kept(lambda_.data())},
                   std::array{1.0, -1.0, am / (c_.beta * h * h), -c_.gamma / (c_.beta * h),
                              am / (c_.gamma * h)});
}

/// Adds the correction x_; returns its size in units of what is allowed. Accelerations take their
/// share of it rather than being differences of positions, which would cost them their digits.
double GeneralisedAlpha::correct(double h) {
  const double am = (1.0 - c_.alpha_m) / (1.0 - c_.alpha_f);
  double norm = 0.0;
  for (int i = 0; i < n_; ++i) {
    const double dq = x_[at(i)], da = dq / (c_.beta * h * h);
    new_.u[at(i)] += dq;
    v_[at(i)] += c_.gamma * h * da;
    a_[at(i)] += da;
    rate_[at(i)] += am * da;
    const double r =
        std::abs(dq) / std::max(newton_share * allowed_ * tolerances_.q[i], rounding_[at(i)]);
    if (!(r <= norm)) norm = r;  // catches NaN
  }
  for (int i = 0; i < nz_; ++i) {
    const double dz = x_[at(n_ + i)], dw = dz / (c_.gamma * h);
    new_.z[at(i)] += dz;
    w_[at(i)] += dw;
    z_rate_[at(i)] += am * dw;
    const double r = std::abs(dz) / std::max(newton_share * allowed_ * tolerances_.z[i],
                                             rounding_of(tolerances_.z[i] / tolerances_.relative));
    if (!(r <= norm)) norm = r;
  }
  for (int i = 0; i < rows_; ++i) lambda_[at(i)] += x_[at(n_ + nz_ + i)];
  return norm;
}

/// The consistent state at the end of the step being tried.
bool GeneralisedAlpha::finish(double t) {
  new_.t = t;
  new_.v = v_;
  double* q = absolute(new_.u);
  if (!options_.plain) {
    if (!dynamics_.project(t, q, new_.v.data())) return false;
    for (std::size_t i = 0; i < q_.size(); ++i) new_.u[i] = q_[i] - q_start_[i];
  }
  if (!calc_rates(new_)) return false;
  if (options_.plain) new_.a = rate_;
  return guard_.count() == 0 ||
         guard_.evaluate(t, absolute(new_.u), new_.v.data(), new_.z.data(), g_to_.data());
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
    note(std::abs(new_.u[i] - end_.u[i] - du) / (allowed_ * tolerances_.q[j]));
    note(std::abs(new_.v[i] - end_.v[i] - dv) /
         std::max(allowed_ * tolerances_.v[j], noise * rounding_of(new_.v[i])));
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

/// The first root on the dense output of the step being tried, or infinity; marks in found_ who has
/// it. A long step is looked at in parts: what comes back within it is not seen at its end.
double GeneralisedAlpha::find_root() {
  if (g_to_.empty()) return std::numeric_limits<double>::infinity();
  const double h = new_.t - end_.t;
  const int parts = 1 + static_cast<int>(parts_per_radian * h * fastest_turn());
  double from = end_.t;
  g_low_ = g_from_;
  for (int part = 1; part <= parts; ++part) {
    const double to = part == parts ? new_.t : end_.t + h * part / parts;
    if (part == parts) {
      g_high_ = g_to_;
    } else {
      calc_event(0, to);
      g_high_ = g_;
    }
    const double root = find_root_between(from, to);
    if (root <= to) return root;
    from = to;
    std::swap(g_low_, g_high_);
  }
  return std::numeric_limits<double>::infinity();
}

double GeneralisedAlpha::find_root_between(double from, double to) {
  double t_root = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < g_low_.size(); ++i) {
    if (!(g_low_[i] < 0.0 && g_high_[i] >= 0.0)) continue;
    double root = to;
    if (g_high_[i] > 0.0) {
      std::uintmax_t iterations = 100;
      root = boost::math::tools::toms748_solve(
                 [&](double t) { return calc_event(i, t); }, from, to, g_low_[i], g_high_[i],
                 boost::math::tools::eps_tolerance<double>(std::numeric_limits<double>::digits),
                 iterations)
                 .second;
    }
    if (root < t_root) {
      t_root = root;
      std::ranges::fill(found_, 0);
    }
    if (root == t_root) found_[i] = 1;
  }
  return t_root;
}

/// [rad/s] of all bodies.
double GeneralisedAlpha::fastest_turn() const {
  double fastest = 0.0;
  for (std::size_t i = 2; i < end_.v.size(); i += 3)
    fastest = std::max(fastest, std::abs(end_.v[i]));
  return fastest;
}

double GeneralisedAlpha::calc_event(std::size_t slot, double t) {
  calc_interpolant(end_, new_, t);
  guard_.evaluate(t, absolute(dense_u_), dense_v_.data(), dense_z_.data(), g_.data());
  return g_[slot];
}

/// Accepts the step being tried, or if an event function crosses zero in it a shorter one that ends
/// there: dense output would err by h^2 in v, most of all in a contact.
bool GeneralisedAlpha::finish_at_event() {
  const double t_root = find_root();
  const bool event = t_root <= new_.t;
  if (event) step_to_root(t_root);
  integrate_energy();
  accept();
  t_ = end_.t;
  std::swap(g_from_, g_to_);
  if (!event) {
    guard_.accept(t_, absolute(end_.u), end_.v.data(), end_.z.data());
    return false;
  }
  guard_.collect(t_, absolute(end_.u), end_.v.data(), end_.z.data(), found_);
  for (const int slot : guard_.fired()) {
    double& g = g_from_[at(slot)];
    g = std::max(g, 0.0);  // not again if the caller goes on
  }
  return true;
}

/// Steps of the method to where its own solution has the root, by secants that begin at the root of
/// the dense output. Ends where the function is not negative: elements expect it to have crossed
/// zero.
void GeneralisedAlpha::step_to_root(double t_root) {
  const auto slot = static_cast<std::size_t>(std::ranges::find(found_, 1) - found_.begin());
  const double close =
      std::max(root_accuracy * (new_.t - end_.t), 4.0 * machine_epsilon * std::abs(new_.t));
  double low = end_.t + close;  // the root is between low and high
  double high = std::min(new_.t, t_root + 0.05 * (new_.t - end_.t));
  double t = std::max(t_root, low);
  if (t >= high) return;
  const double aside = t - 1e3 * close;
  double slope = (calc_event(slot, t) - calc_event(slot, aside)) / (t - aside);
  double t_last = t, g_last = 0.0;
  for (int i = 0; i < max_root_steps && high - low > close; ++i) {
    if (!advance(t)) break;
    const double g = g_to_[slot];
    (g < 0.0 ? low : high) = t;
    if (i > 0 && t != t_last) slope = (g - g_last) / (t - t_last);
    t_last = t;
    g_last = g;
    double next = t - g / slope;
    if (g >= 0.0 && !(t - next > close)) return;
    if (g < 0.0 && next - t < close) next = t + close;
    t = next > low && next < high ? next : 0.5 * (low + high);
  }
  advance(high);
}

/// Quintic Hermite from positions, velocities and accelerations, cubic from the others.
void GeneralisedAlpha::calc_interpolant(const Node& from, const Node& to, double t) {
  if (t == to.t) {
    dense_u_ = to.u;
    dense_v_ = to.v;
    dense_z_ = to.z;
    dense_energy_ = to.energy;
    return;
  }
  const double h = to.t - from.t, s = (t - from.t) / h;
  for (std::size_t i = 0; i < dense_u_.size(); ++i) {
    const double v = h * from.v[i], a = h * h * from.a[i];
    const double D = to.u[i] - from.u[i] - v - 0.5 * a;
    const double V = h * (to.v[i] - from.v[i]) - a;
    const double A = h * h * (to.a[i] - from.a[i]);
    const double c3 = 10.0 * D - 4.0 * V + 0.5 * A;
    const double c4 = -15.0 * D + 7.0 * V - A;
    const double c5 = 6.0 * D - 3.0 * V + 0.5 * A;
    dense_u_[i] = from.u[i] + s * (v + s * (0.5 * a + s * (c3 + s * (c4 + s * c5))));
    dense_v_[i] = (v + s * (a + s * (3.0 * c3 + s * (4.0 * c4 + s * 5.0 * c5)))) / h;
  }
  const auto cubic = [h, s](const Vector& x0, const Vector& x1, const Vector& f0, const Vector& f1,
                            Vector& out) {
    for (std::size_t i = 0; i < out.size(); ++i) {
      const double D = x1[i] - x0[i] - h * f0[i], F = h * (f1[i] - f0[i]);
      out[i] = x0[i] + s * (h * f0[i] + s * (3.0 * D - F + s * (F - 2.0 * D)));
    }
  };
  cubic(from.z, to.z, from.z_dot, to.z_dot, dense_z_);
  cubic(from.energy, to.energy, from.power, to.power, dense_energy_);
}

void GeneralisedAlpha::interpolate(double t, State& state) {
  calc_interpolant(begin_, end_, t);
  state.t = t;
  std::copy_n(absolute(dense_u_), n_, state.q.data());
  std::copy_n(dense_v_.data(), n_, state.v.data());
  std::copy_n(dense_z_.data(), nz_, state.z.data());
  std::copy_n(dense_energy_.data(), quadratures_, state.energy.data());
}

StepCounters GeneralisedAlpha::counters() const {
  StepCounters total = counters_;
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
