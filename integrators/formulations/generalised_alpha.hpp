// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Generalised-alpha directly on the index-3 equations (M. Arnold, O. Bruels, Multibody Syst. Dyn.
// 18 (2007) 185-202, eqs. (9)-(13)), with variable steps and local error control.
//
//   q1 = q + h v + h^2 (1/2 - beta) a + h^2 beta a1
//   v1 = v + h (1 - gamma) a + h gamma a1
//   (1 - alpha_m) a1 + alpha_m a = (1 - alpha_f) v1' + alpha_f v'
//   M v1' + G^T lambda1 = Q(q1, v1, z1),   Phi(q1) = 0
//
// a is the algorithmic acceleration, close to v' at t + theta h, theta = alpha_m - alpha_f. Element
// states take the lines of v and a with z for v (first-order generalised-alpha).
//
// What a variable step needs (after M. Arnold, O. Bruels, A. Cardona, Numer. Math. 129 (2015)
// 149-179, who say it of the start):
//
// * a belongs to a step size: a = v' + h b, and b is what one step hands to the next. b = theta v''
//   at the start.
// * Expanding q1 gives a local error C h^3 v'', C = 1/6 - beta - theta/2, but Phi(q1) = 0 leaves
//   none across the constraints. So a1 and lambda1 would have to make up for it, by an error of
//   order h, unless v leaves the constraints by C h^2 times the part of v'' across them. That part
//   depends on h, so every step projects the velocity of the last one and then shifts it.
//
// Forces that depend on reactions, as friction of joints, do not see lambda1, which is known to the rounding of
// positions over h^2 only: that would be noise in Q. They see lambda of the acceleration level at the ends of
// the last two steps, continued; what that errs by is of order h^2, as lambda1 does.
//
// Newton's unknowns are q1, z1, lambda1, with
//
//        q                                          z             lambda
//   R_q  b' M + K(lambda) - Q_q - g' Q_v            -Q_z          G^T
//   R_z  -f_q - g' f_v                              c' I - f_z    .
//   R_p  G                                          .             .
//
//   b' = dv1'/dq1 = (1 - alpha_m)/((1 - alpha_f) beta h^2),   g' = dv1/dq1 = gamma/(beta h)
//   c' = dz1'/dz1 = (1 - alpha_m)/((1 - alpha_f) gamma h)
//
// Friction that holds has the row beta h/gamma (G v1 + Phi_t) = 0 in place of Phi, whose derivative is
// G + beta h/gamma H; such rows need no shift of velocities. The matrix is
// scaled by time in units of b'^(-1/2), i.e. equations and multipliers by beta h^2 as proposed by
// C. Bottasso, O. Bauchau, A. Cardona (SIAM J. Sci. Comput. 29 (2007) 397-414): the condition of
// the matrix does not depend on h.
#pragma once

#include <string>
#include <vector>

#include <yoke/integrators/formulations/equations/iteration_matrix.hpp>
#include <yoke/integrators/formulations/event_guard.hpp>
#include <yoke/integrators/formulations/formulation.hpp>
#include <yoke/integrators/formulations/rounding_floor.hpp>

namespace yoke {

/// For tests of the method itself.
struct AlphaOptions {
  std::vector<double> steps{};  // [s] taken in turn, without error control; empty: controlled
  bool plain = false;           // a = v' at the start, nothing rescaled, shifted or projected
};

class GeneralisedAlpha final : public Formulation {
 public:
  GeneralisedAlpha(Dynamics& dynamics, const Tolerances& tolerances, AlphaOptions options = {});

  void start(const State& state) override;
  Step step(double t_stop) override;
  double time() const override { return t_; }
  double last_step() const override { return h_last_; }
  void interpolate(double t, State& state) override;
  const std::vector<int>& fired() const override { return guard_.fired(); }
  const std::vector<int>& passed() const override { return guard_.passed(); }
  StepCounters counters() const override;
  std::string failure() const override { return failure_; }

  /// Newton's matrix.
  const IterationMatrix& matrix() const { return matrix_; }
  /// The method's own multipliers at the end of the last step; results report those of the
  /// acceleration level instead.
  const std::vector<double>& own_multipliers() const { return lambda_; }

 private:
  using Vector = std::vector<double>;
  struct Node {  // a consistent state; v' and what goes with it from the acceleration level
    double t = 0.0;
    Vector u, v, a, z, z_dot, energy, power, lambda;  // u: displacement from the last restart
  };
  struct Coefficients {
    explicit Coefficients(double spectral_radius);
    double alpha_m, alpha_f, gamma, beta, theta, C;
  };

  static MatrixLayout layout(const System& system);
  void allocate(Node& node) const;
  double* absolute(const Vector& u);
  bool calc_rates(Node& node);
  void begin(double t_stop);
  void calc_jerk(const Node& before, const Node& now, const Node* after);
  void calc_normal_jerk();
  double first_length(double span, double delta) const;
  bool take_controlled_step(double t_stop);
  bool advance(double t_new);
  void predict(double h);
  bool solve_stage(double h, double t);
  bool calc_residual(double h, double t);
  void calc_matrix(double h, double t);
  double correct(double h);
  bool finish(double t);
  double calc_error() const;
  double integrate_energy();
  void accept();
  double find_root();
  double find_root_between(double from, double to);
  double fastest_turn() const;
  double calc_event(std::size_t slot, double t);
  bool finish_at_event();
  void step_to_root(double t_root);
  void calc_interpolant(const Node& from, const Node& to, double t);
  void choose_allowed();
  void weigh();
  double extent(int i) const;
  double rounding(int i) const;
  Step fail(const char* why);

  Dynamics& dynamics_;
  System& system_;
  Tolerances tolerances_;
  AlphaOptions options_;
  Coefficients c_;
  int n_, nz_, rows_, quadratures_;
  double allowed_ = 1.0, least_allowed_ = 1.0;  // of the error weights, in one step
  IterationMatrix matrix_;
  MultiplierMask mask_;
  EventGuard guard_;
  RoundingFloor floor_;
  Vector q_start_, q_;          // q_: absolute positions, scratch
  Vector rounding_;             // of each coordinate
  Vector weight_q_, weight_v_;  // one over what a step may err by
  Node begin_, end_, new_;      // the last step, and the end of the one being tried
  Vector b_, b_z_;              // (a - v')/h, and the same of z, at the end of the last step
  Vector jerk_;                 // v'' there, [n]
  Vector jerk_normal_;          // its part across the constraints, in the metric of the masses
  Vector lambda_rate_;
  Vector v_old_, a_old_, w_old_;               // what the step being tried starts from
  Vector load_;                                // multipliers that forces see in it
  Vector v_, a_, rate_, w_, z_rate_, lambda_;  // its iterates; positions and z are in new_
  Vector x_, force_;                           // Newton's right-hand side and correction
  Vector rates_;                               // G v + Phi_t
  Vector second_, second_old_;                 // second divided differences of the powers
  double k_old_ = 0.0;                         // [s] length of the step before the last
  bool third_known_ = false;                   // so third differences can be formed
  Vector dense_u_, dense_v_, dense_z_, dense_energy_;
  Vector g_from_, g_to_, g_low_, g_high_, g_;
  std::vector<int> found_;
  double t_ = 0.0, h_last_ = 0.0, h_next_ = 0.0;
  bool started_ = false;
  std::size_t turn_ = 0;  // in AlphaOptions::steps
  StepCounters counters_;
  std::string failure_;
};

}  // namespace yoke
