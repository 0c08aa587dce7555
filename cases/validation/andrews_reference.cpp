// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/validation/andrews_reference.hpp>

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <vector>

#include <yoke/cases/andrews.hpp>
#include <yoke/core/authoring/auto_constraint.hpp>
#include <yoke/core/authoring/auto_force.hpp>
#include <yoke/joints/forces/applied_torque.hpp>

namespace yoke::cases {

using namespace andrews_data;

namespace {

/// Points of K2, K3, K4 and K6 are one: K2 - K3 = K2 - K4 = K2 - K6 = 0, the six equations of the
/// problem in its order.
class CommonPin : public AutoConstraint<CommonPin, 6, 4> {
 public:
  CommonPin(const std::string& name, const Model& model, const AndrewsBodies& b)
      : AutoConstraint(
            name, {b.k[2], b.k[3], b.k[4], b.k[6]},
            {{"x of K3"}, {"y of K3"}, {"x of K4"}, {"y of K4"}, {"x of K6"}, {"y of K6"}}),
        at_({model.to_local(b.k[2], b.E), model.to_local(b.k[3], b.E), model.to_local(b.k[4], b.E),
             model.to_local(b.k[6], b.E)}) {}

  template <class T>
  Eigen::Vector<T, 6> phi(const AutoPose<T>& k2, const AutoPose<T>& k3, const AutoPose<T>& k4,
                          const AutoPose<T>& k6, const T& /*t*/) const {
    const Eigen::Vector2<T> pin = k2.point(at_[0]);
    Eigen::Vector<T, 6> equations;
    equations << pin - k3.point(at_[1]), pin - k4.point(at_[2]), pin - k6.point(at_[3]);
    return equations;
  }

 private:
  std::array<Vec2, 4> at_;
};

/// A spring from a point of a body to C.
class SpringToC : public AutoForce<SpringToC, 1> {
 public:
  SpringToC(const std::string& name, const Model& model, BodyId body, const Vec2& at)
      : AutoForce(name, {body}), at_(model.to_local(body, at)) {}

  template <class T>
  void apply(AutoBody<T>& body, AutoElement<T>& element) const {
    const Eigen::Vector2<T> point = body.point(at_), span = C.cast<T>() - point;
    const T length = span.norm(), stretch = length - l0;
    body.add_force(span * (c0 * stretch / length), point);
    element.potential += 0.5 * c0 * stretch * stretch;
  }

 private:
  Vec2 at_;
};

/// The published equations.
template <class T>
Eigen::Vector<T, 6> closing_equations(const Eigen::Vector<T, 7>& p) {
  const T be = p[0], th = p[1], ga = p[2], ph = p[3], de = p[4], om = p[5], ep = p[6];
  const T x = rr * cos(be) - d * cos(be + th), y = rr * sin(be) - d * sin(be + th);
  Eigen::Vector<T, 6> g;
  g[0] = x - ss * sin(ga) - xb;
  g[1] = y + ss * cos(ga) - yb;
  g[2] = x - e * sin(ph + de) - zt * cos(de) - xa;
  g[3] = y + e * cos(ph + de) - zt * sin(de) - ya;
  g[4] = x - zf * cos(om + ep) - u * sin(ep) - xa;
  g[5] = y - zf * sin(om + ep) + u * cos(ep) - ya;
  return g;
}

using Vector7 = Eigen::Vector<double, 7>;

Eigen::Matrix<double, 7, 7> mass_matrix(const Vector7& p) {
  const double r4 = e - ea, r6 = zf - fa;
  const double cos_th = std::cos(p[1]), sin_ph = std::sin(p[3]), sin_om = std::sin(p[5]);
  Eigen::Matrix<double, 7, 7> M = Eigen::Matrix<double, 7, 7>::Zero();
  M(0, 0) = m1 * ra * ra + m2 * (rr * rr - 2.0 * da * rr * cos_th + da * da) + I1 + I2;
  M(1, 0) = M(0, 1) = m2 * (da * da - da * rr * cos_th) + I2;
  M(1, 1) = m2 * da * da + I2;
  M(2, 2) = m3 * (sa * sa + sb * sb) + I3;
  M(3, 3) = m4 * r4 * r4 + I4;
  M(4, 3) = M(3, 4) = m4 * (r4 * r4 + zt * r4 * sin_ph) + I4;
  M(4, 4) = m4 * (zt * zt + 2.0 * zt * r4 * sin_ph + r4 * r4) + m5 * (ta * ta + tb * tb) + I4 + I5;
  M(5, 5) = m6 * r6 * r6 + I6;
  M(6, 5) = M(5, 6) = m6 * (r6 * r6 - u * r6 * sin_om) + I6;
  M(6, 6) = m6 * (r6 * r6 - 2.0 * u * r6 * sin_om + u * u) + m7 * (ua * ua + ub * ub) + I6 + I7;
  return M;
}

Vector7 forces(const Vector7& p, const Vector7& v) {
  const double sg = std::sin(p[2]), cg = std::cos(p[2]);
  const Vec2 D(sd * cg + sc * sg + xb, sd * sg - sc * cg + yb);
  const double length = (D - C).norm();
  const Vec2 F = -c0 * (length - l0) / length * (D - C);
  const double r4 = zt * (e - ea) * m4 * std::cos(p[3]), r6 = u * (zf - fa) * m6 * std::cos(p[5]);
  const double r2 = m2 * da * rr * std::sin(p[1]);
  Vector7 f;
  f << mom - r2 * v[1] * (v[1] + 2.0 * v[0]), r2 * v[0] * v[0],
      F.x() * (sc * cg - sd * sg) + F.y() * (sd * cg + sc * sg), r4 * v[4] * v[4],
      -r4 * v[3] * (v[3] + 2.0 * v[4]), -r6 * v[6] * v[6], r6 * v[5] * (v[5] + 2.0 * v[6]);
  return f;
}

/// p'' and lambda from the accelerations' equations.
Eigen::Vector<double, 13> solve(const Vector7& p, const Vector7& v) {
  using First = Dual<double, 7>;
  using Along = Dual<First, 1>;  // and along the motion
  Eigen::Vector<Along, 7> x;
  for (int i = 0; i < 7; ++i)
    x[i] = Along(auto_variable<First>(p[i], i), Along::Gradient(First(v[i])));
  const Eigen::Vector<Along, 6> g = closing_equations<Along>(x);
  Eigen::Matrix<double, 13, 13> K = Eigen::Matrix<double, 13, 13>::Zero();
  Eigen::Vector<double, 13> b;
  K.topLeftCorner<7, 7>() = mass_matrix(p);
  b.head<7>() = forces(p, v);
  for (int r = 0; r < 6; ++r) {
    K.block<1, 7>(7 + r, 0) = g[r].value().gradient().transpose();
    K.block<7, 1>(0, 7 + r) = g[r].value().gradient();
    b[7 + r] = -g[r].gradient()[0].gradient().dot(v);
  }
  // Rows of moments of inertia of 1e-6 beside rows of lengths of 1e-2: pivots over the whole
  // matrix.
  return K.fullPivLu().solve(b);
}

}  // namespace

Model andrews_own_elements() {
  Model m;
  const AndrewsBodies b = add_andrews_bodies(m);
  m.add(CommonPin("E", m, b));
  add_andrews_joints(m, b);
  m.add(SpringToC("spring", m, b.k[3], b.D));
  m.add(applied_torque("motor", b.k[1], [](auto, const auto&) { return mom; }));
  return m;
}

AndrewsState andrews_end(const Result& run) {
  const auto row = static_cast<Eigen::Index>(run.samples.rows()) - 1;
  const auto of_bodies = [&](const char* column) {
    std::array<double, 8> x{};
    for (std::size_t i = 1; i <= 7; ++i) x[i] = run[fmt::format("K{}{}", i, column)](row);
    return std::array<double, 7>{x[1], x[2] - x[1], x[3], x[4] - x[5], x[5], x[6] - x[7], x[7]};
  };
  AndrewsState state{.p = of_bodies(".angle_rad"),
                     .v = of_bodies(".omega_rad_per_s"),
                     .a = of_bodies(".alpha_rad_per_s2")};
  if (run.samples.has("E3.fx_N")) {
    std::size_t i = 0;
    for (const char* joint : {"E3", "E4", "E6"})
      for (const char* force : {".fx_N", ".fy_N"})
        state.lambda[i++] = run[fmt::format("{}{}", joint, force)](row);
  } else {  // the first joint of the model
    for (std::size_t i = 0; i < 6; ++i)
      state.lambda[i] = run.final.lambda[static_cast<Eigen::Index>(i)];
  }
  return state;
}

const AndrewsState& andrews_published() {
  static const AndrewsState state{
      .p = {0.1581077119629904e2, -0.1575637105984298e2, 0.4082224013073101e-1, -0.5347301163226948,
            0.5244099658805304, 0.5347301163226948, 0.1048080741042263e1},
      .v = {0.1139920302151208e4, -0.1424379294994111e4, 0.1103291221937134e2, 0.1929337464421385e2,
            0.5735699284790808, -0.1929337464421385e2, 0.3231791658026955},
      .a = {-0.2463176316945196e5, 0.5185037701610329e5, 0.3241025686413781e6, 0.5667493645176213e6,
            0.1674362929479361e5, -0.5667493645176222e6, 0.9826520791458422e4},
      .lambda = {0.1991753333731910e3, -0.2975531228015052e2, 0.2306654119098399e2,
                 0.3145271365475927e2, 0.2264249232082739e2, 0.1161740700019673e2}};
  return state;
}

AndrewsState andrews_by_published_equations(double t) {
  namespace odeint = boost::numeric::odeint;
  using Row = std::vector<double>;
  const auto p_of = [](const Row& y) { return Vector7(Eigen::Map<const Vector7>(y.data())); };
  const auto v_of = [](const Row& y) { return Vector7(Eigen::Map<const Vector7>(y.data() + 7)); };
  Row y(14);
  std::copy(start.begin(), start.end(), y.begin());
  const auto rate = [&](const Row& at, Row& dy, double) {
    Eigen::Map<Vector7>(dy.data()) = v_of(at);
    Eigen::Map<Vector7>(dy.data() + 7) = solve(p_of(at), v_of(at)).head<7>();
  };
  odeint::integrate_adaptive(
      odeint::make_controlled<odeint::runge_kutta_fehlberg78<Row>>(1e-14, 1e-14), rate, y, 0.0, t,
      1e-6);
  AndrewsState state;
  const Eigen::Vector<double, 13> x = solve(p_of(y), v_of(y));
  std::copy_n(y.begin(), 7, state.p.begin());
  std::copy_n(y.begin() + 7, 7, state.v.begin());
  std::copy_n(x.data(), 7, state.a.begin());
  std::copy_n(x.data() + 7, 6, state.lambda.begin());
  return state;
}

}  // namespace yoke::cases
