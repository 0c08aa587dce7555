// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A joint of your own, from its equation alone. Write Phi once as a template over the scalar and
// have G, Phi_t, gamma, H and K exact by automatic differentiation:
//
//   // The pin stays on a circle about a point of the other body: |p - c| - R = 0 [m].
//   class PointOnCircle : public AutoConstraint<PointOnCircle, 1, 2> {
//    public:
//     PointOnCircle(const std::string& name, BodyId pin, BodyId disc, double radius)
//         : AutoConstraint(name, {pin, disc}, {{"radial", Measure::length}}),
//           radius_(radius) {}
//     template <class T>
//     T phi(const AutoPose<T>& pin, const AutoPose<T>& disc, const T& /*t*/) const {
//       return (pin.position() - disc.position()).norm() - radius_;
//     }
//    private:
//     double radius_;
//   };
//   model.add(PointOnCircle("ring", pin, disc, 0.060));
//
// phi takes one pose per body, in the order given, and the time; it returns Eigen::Vector<T, Rows>,
// or a T when Rows is 1. Its derivatives must exist where the mechanism goes. A driver also
// overrides rheonomic(). auto_scalar.hpp explains how to write the arithmetic.
//
// How: with q the 3k coordinates, the inner scalar carries the derivatives by (q, t), the outer one
// the derivative along a direction d.
//   d = (v, 1):  Phi' = G v + Phi_t, its inner derivatives by q are H, by t d(G v + Phi_t)/dt
//   d = e_i:     column i of the second derivatives of Phi, for K = sum lambda_r d2 Phi_r / dq2
#pragma once

#include <array>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <yoke/core/auto_scalar.hpp>
#include <yoke/core/constraint.hpp>
#include <yoke/core/error.hpp>

namespace yoke {

template <class Self, int Rows, int Bodies>
class AutoConstraint : public Constraint {
 public:
  /// The element is its own description: model.add(Self(...)).
  std::unique_ptr<Constraint> build(const Model& /*model*/) const {
    return std::make_unique<Self>(self());
  }

  void evaluate(const Motion& motion, const ConstraintRequest& out) const final {
    if (out.gamma != nullptr || out.H != nullptr)
      evaluate_along_motion(motion, out);
    else if (out.G != nullptr || out.phi_t != nullptr)
      evaluate_first(motion, out);
    else if (out.phi != nullptr)
      evaluate_phi(motion, out);
    if (out.K != nullptr) add_stiffness(motion, out);
  }

 protected:
  /// One equation for each row; `pattern` as in Constraint: true where G can be non-zero,
  /// row-major; empty: everywhere.
  AutoConstraint(const std::string& name, std::array<BodyId, Bodies> bodies,
                 std::vector<Equation> equations, std::vector<bool> pattern = {})
      : Constraint(name, {bodies.begin(), bodies.end()}, std::move(equations), std::move(pattern)) {
    if (rows() != Rows)
      throw ModelError(fmt::format("joint '{}': {} equations are named for the {} rows of phi",
                                   name, rows(), Rows));
  }

 private:
  static constexpr int columns_ = 3 * Bodies;
  using First = Dual<double, columns_ + 1>;  // by (q, t)
  using Second = Dual2<columns_ + 1>;

  const Self& self() const { return static_cast<const Self&>(*this); }

  const BodyMotion& body(const Motion& motion, int k) const {
    return motion[bodies()[static_cast<std::size_t>(k)]];
  }

  /// Phi for scalars made by coordinate(index, value), index = 3k for the time.
  template <class T, class Coordinate>
  Eigen::Vector<T, Rows> call(const Motion& motion, const Coordinate& coordinate) const {
    std::array<AutoPose<T>, Bodies> pose;
    for (int k = 0; k < Bodies; ++k) {
      const BodyMotion& b = body(motion, k);
      AutoPose<T>& p = pose[static_cast<std::size_t>(k)];
      p.x = coordinate(3 * k, b.x);
      p.y = coordinate(3 * k + 1, b.y);
      p.angle = coordinate(3 * k + 2, b.angle);
      std::tie(p.c, p.s) = auto_cos_sin(p.angle, b.c, b.s);
    }
    const T t = coordinate(columns_, motion.t);
    return [&]<std::size_t... k>(std::index_sequence<k...>) {
      return Eigen::Vector<T, Rows>(self().phi(pose[k]..., t));
    }
    (std::make_index_sequence<static_cast<std::size_t>(Bodies)>{});
  }

  void evaluate_phi(const Motion& motion, const ConstraintRequest& out) const {
    const auto phi = call<double>(motion, [](int, double x) { return x; });
    for (int r = 0; r < Rows; ++r) out.phi[r] = phi[r];
  }

  void evaluate_first(const Motion& motion, const ConstraintRequest& out) const {
    const auto phi = call<First>(motion, auto_variable_at);
    for (int r = 0; r < Rows; ++r) write_first(phi[r], r, out);
  }

  static First auto_variable_at(int i, double x) { return auto_variable<First>(x, i); }

  static void write_first(const First& phi, int r, const ConstraintRequest& out) {
    if (out.phi != nullptr) out.phi[r] = phi.value();
    if (out.phi_t != nullptr) out.phi_t[r] = phi.gradient()[columns_];
    if (out.G != nullptr)
      for (int i = 0; i < columns_; ++i) out.G[r * columns_ + i] = phi.gradient()[i];
  }

  std::array<double, columns_> velocity(const Motion& motion) const {
    std::array<double, columns_> v;
    for (int k = 0; k < Bodies; ++k) {
      const BodyMotion& b = body(motion, k);
      v[static_cast<std::size_t>(3 * k)] = b.vx;
      v[static_cast<std::size_t>(3 * k + 1)] = b.vy;
      v[static_cast<std::size_t>(3 * k + 2)] = b.omega;
    }
    return v;
  }

  void evaluate_along_motion(const Motion& motion, const ConstraintRequest& out) const {
    const auto v = velocity(motion);
    const auto phi = call<Second>(motion, [&](int i, double x) {
      const double rate = i < columns_ ? v[static_cast<std::size_t>(i)] : 1.0;
      return Second(auto_variable<First>(x, i), typename Second::Gradient(First(rate)));
    });
    for (int r = 0; r < Rows; ++r) {
      write_first(phi[r].value(), r, out);
      const auto& second = phi[r].gradient()[0].gradient();  // of G v + Phi_t by (q, t)
      double along = second[columns_];
      for (int i = 0; i < columns_; ++i) {
        along += second[i] * v[static_cast<std::size_t>(i)];
        if (out.H != nullptr) out.H[r * columns_ + i] = second[i];
      }
      if (out.gamma != nullptr) out.gamma[r] = -along;
    }
  }

  void add_stiffness(const Motion& motion, const ConstraintRequest& out) const {
    for (int i = 0; i < columns_; ++i) {
      const auto phi = call<Second>(motion, [i](int j, double x) {
        return Second(auto_variable<First>(x, j),
                      typename Second::Gradient(First(i == j ? 1.0 : 0.0)));
      });
      for (int r = 0; r < Rows; ++r)
        for (int j = 0; j < columns_; ++j)
          out.K[i * columns_ + j] += out.lambda[r] * phi[r].gradient()[0].gradient()[j];
    }
  }
};

}  // namespace yoke
