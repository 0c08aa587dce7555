// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A force element of your own, from its law alone. Push on the bodies in a template over the
// scalar; generalised forces and all derivatives follow by automatic differentiation:
//
//   // A spring that hardens: F = k d + k3 d^3 between two centres, d = distance - rest [m].
//   class HardeningSpring : public AutoForce<HardeningSpring, 2> {
//    public:
//     HardeningSpring(std::string name, BodyId a, BodyId b) : AutoForce(std::move(name), {a, b}) {}
//     template <class T>
//     void apply(AutoBody<T>& a, AutoBody<T>& b, AutoElement<T>& e) const {
//       const Eigen::Vector2<T> d = b.position() - a.position();
//       const T stretch = d.norm() - rest;
//       const T tension = k * stretch + k3 * pow(stretch, 3);
//       a.add_force(d.normalized() * tension, a.position());
//       b.add_force(d.normalized() * -tension, b.position());
//       e.potential += k / 2 * pow(stretch, 2) + k3 / 4 * pow(stretch, 4);
//     }
//   };
//   model.add(HardeningSpring("spring", crank, slider));
//
// apply takes one AutoBody per body, in the order given, and what belongs to the element itself:
// time, own states, parameters, energies. An element with powers also overrides dissipates() or
// supplies(); one with states lists them in states(); one with parameters in parameters().
//
//   Q_k = (sum F, sum (p - r) x F + torques);   derivatives by the 6k + States variables (q, v, z)
#pragma once

#include <array>
#include <memory>
#include <string>
#include <tuple>
#include <utility>

#include <yoke/core/auto_scalar.hpp>
#include <yoke/core/force.hpp>

namespace yoke {

/// A body that moves and can be pushed.
template <class T>
struct AutoBody : AutoPose<T> {
  T vx, vy, omega;         // [m/s, m/s, rad/s]
  T fx{}, fy{}, moment{};  // [N, N, N m] collected so far, about the centre of mass

  /// [m/s] of the centre of mass, global.
  Eigen::Vector2<T> velocity() const { return {vx, vy}; }
  /// Global velocity of a body-fixed point [m/s].
  template <class V>
  Eigen::Vector2<T> point_velocity(const V& local) const {
    const Eigen::Vector2<T> d = this->to_global(local);
    return {vx - omega * d[1], vy + omega * d[0]};
  }
  /// Adds a force [N], global axes, at a global point [m].
  template <class F, class P>
  void add_force(const Eigen::MatrixBase<F>& force, const Eigen::MatrixBase<P>& point) {
    const Eigen::Vector2<T> f = force.template cast<T>();
    fx += f[0];
    fy += f[1];
    moment += (point[0] - this->x) * f[1] - (point[1] - this->y) * f[0];
  }
  /// Adds a torque [N m], positive counter-clockwise.
  void add_torque(const T& torque) { moment += torque; }
};

/// What belongs to the element itself. Energies start at zero, as does z_dot.
template <class T, int States = 0>
struct AutoElement {
  double t = 0.0;                          // [s]
  const double* parameters = nullptr;      // in the order of parameters()
  std::array<T, States> z{};               // states, as states() names them
  std::array<T, States> z_dot{};           // their rates, to be set
  T potential{}, stored{};                 // [J]
  T dissipated_power{}, supplied_power{};  // [W]
};

template <class Self, int Bodies, int States = 0>
class AutoForce : public ForceElement {
 public:
  /// The element is its own description: model.add(Self(...)).
  std::unique_ptr<ForceElement> build(const Model& /*model*/) const {
    return std::make_unique<Self>(self());
  }

  void evaluate(const ForceInput& in, const ForceRequest& out) const final {
    const bool derivatives = out.dQ_dq != nullptr || out.dQ_dv != nullptr || out.dQ_dz != nullptr ||
                             out.dz_dq != nullptr || out.dz_dv != nullptr || out.dz_dz != nullptr;
    if (derivatives)
      run<Variable>(in, out, [](int i, double x) { return auto_variable<Variable>(x, i); });
    else
      run<double>(in, out, [](int, double x) { return x; });
  }

 protected:
  /// `dependence`: what the force depends on; the default is always correct, less is faster.
  AutoForce(std::string name, std::array<BodyId, Bodies> bodies, Dependence dependence = {})
      : ForceElement(std::move(name), {bodies.begin(), bodies.end()}, dependence) {}

 private:
  static constexpr int columns_ = 3 * Bodies;
  using Variable = Dual<double, 2 * columns_ + States>;  // by (q, v, z)

  const Self& self() const { return static_cast<const Self&>(*this); }

  template <class T, class Coordinate>
  void run(const ForceInput& in, const ForceRequest& out, const Coordinate& coordinate) const {
    std::array<AutoBody<T>, Bodies> bodies;
    for (int k = 0; k < Bodies; ++k)
      read(in.motion[own_bodies()[static_cast<std::size_t>(k)]], 3 * k, coordinate,
           bodies[static_cast<std::size_t>(k)]);
    AutoElement<T, States> element;
    element.t = in.motion.t;
    element.parameters = in.parameters;
    for (int i = 0; i < States; ++i)
      element.z[static_cast<std::size_t>(i)] = coordinate(2 * columns_ + i, in.z[i]);
    [&]<std::size_t... k>(std::index_sequence<k...>) { self().apply(bodies[k]..., element); }
    (std::make_index_sequence<static_cast<std::size_t>(Bodies)>{});
    write(bodies, element, out);
  }

  template <class T, class Coordinate>
  static void read(const BodyMotion& b, int i, const Coordinate& coordinate, AutoBody<T>& body) {
    body.x = coordinate(i, b.x);
    body.y = coordinate(i + 1, b.y);
    body.angle = coordinate(i + 2, b.angle);
    std::tie(body.c, body.s) = auto_cos_sin(body.angle, b.c, b.s);
    body.vx = coordinate(columns_ + i, b.vx);
    body.vy = coordinate(columns_ + i + 1, b.vy);
    body.omega = coordinate(columns_ + i + 2, b.omega);
  }

  template <class T>
  static void write(const std::array<AutoBody<T>, Bodies>& bodies,
                    const AutoElement<T, States>& element, const ForceRequest& out) {
    for (int k = 0; k < Bodies; ++k) {
      const AutoBody<T>& body = bodies[static_cast<std::size_t>(k)];
      write_row(body.fx, 3 * k, out.Q, out.dQ_dq, out.dQ_dv, out.dQ_dz);
      write_row(body.fy, 3 * k + 1, out.Q, out.dQ_dq, out.dQ_dv, out.dQ_dz);
      write_row(body.moment, 3 * k + 2, out.Q, out.dQ_dq, out.dQ_dv, out.dQ_dz);
    }
    for (int i = 0; i < States; ++i)
      write_row(element.z_dot[static_cast<std::size_t>(i)], i, out.z_dot, out.dz_dq, out.dz_dv,
                out.dz_dz);
    if (out.energy != nullptr)
      *out.energy = {.potential = auto_value(element.potential),
                     .stored = auto_value(element.stored),
                     .dissipated_power = auto_value(element.dissipated_power),
                     .supplied_power = auto_value(element.supplied_power)};
  }

  template <class T>
  static void write_row(const T& f, int row, double* value, double* by_q, double* by_v,
                        double* by_z) {
    if (value != nullptr) value[row] = auto_value(f);
    if constexpr (std::is_same_v<T, Variable>) {
      const auto& g = f.gradient();
      for (int i = 0; i < columns_; ++i) {
        if (by_q != nullptr) by_q[row * columns_ + i] = g[i];
        if (by_v != nullptr) by_v[row * columns_ + i] = g[columns_ + i];
      }
      if (by_z != nullptr)
        for (int i = 0; i < States; ++i) by_z[row * States + i] = g[2 * columns_ + i];
    }
  }
};

}  // namespace yoke
