// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The scalar with which users' own elements are differentiated: a value with its derivatives by N
// variables, f = (f0; df/dx_1 ... df/dx_N). The rules are those of Eigen's AutoDiffScalar; Dual
// only evaluates each operation at once. AutoDiffScalar itself returns expressions that refer to
// their operands, so that `auto d = a * b;` or a lambda that returns `a * b` dangles, and the two
// arms of a ternary have different types. With Dual all of that is plain arithmetic:
//
//   template <class T>
//   T phi(const AutoPose<T>& a, const AutoPose<T>& b, const T& t) const {
//     const auto d = b.point(at_b) - a.point(at_a);      // an Eigen vector of T
//     return d.norm() - length;
//   }
//
// Rules for users: write sin, sqrt, pow ... without std:: (the right one is found by its
// argument), do not cast T to double (it would lose the derivatives), and for Eigen expressions of
// vectors the usual rule of Eigen holds: name the type (Eigen::Vector2<T>) where one is kept.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <type_traits>
#include <unsupported/Eigen/AutoDiff>
#include <utility>

#include <yoke/core/motion.hpp>

namespace yoke {

/// A value and its derivatives by N variables; Scalar is double, or again a Dual for second ones.
template <class Scalar, int N>
class Dual {
 public:
  using Gradient = Eigen::Matrix<Scalar, N, 1>;   // derivatives by the variables
  using Rules = Eigen::AutoDiffScalar<Gradient>;  // whose arithmetic is used

  /// Zero, a constant, or a value with its derivatives.
  Dual() : Dual(0.0) {}
  template <class Number>
  requires std::is_arithmetic_v<Number> Dual(
      Number constant)  // implicit: numbers may be mixed with variables
      : ad_(Scalar(static_cast<double>(constant)), Gradient::Zero()) {}
  Dual(const Scalar& value, const Gradient& gradient) : ad_(value, gradient) {}
  template <class Expression>
  explicit Dual(const Eigen::AutoDiffScalar<Expression>& expression) : ad_(expression) {}

  /// The number itself.
  const Scalar& value() const { return ad_.value(); }
  /// Its derivatives.
  const Gradient& gradient() const { return ad_.derivatives(); }
  /// A function with value f0 and slope df/dx here, for what the rules of Eigen do not cover.
  Dual chain(const Scalar& f, const Scalar& slope) const {
    return Dual(f, Gradient(gradient() * slope));
  }

  /// Arithmetic as of numbers; so are +, -, *, / and comparisons.
  Dual& operator+=(const Dual& b) { return *this = *this + b; }
  /// As of numbers.
  Dual& operator-=(const Dual& b) { return *this = *this - b; }
  /// As of numbers.
  Dual& operator*=(const Dual& b) { return *this = *this * b; }
  /// As of numbers.
  Dual& operator/=(const Dual& b) { return *this = *this / b; }

  friend Dual operator+(const Dual& a) { return a; }
  friend Dual operator-(const Dual& a) { return Dual(-a.ad_); }
  friend Dual operator+(const Dual& a, const Dual& b) { return Dual(a.ad_ + b.ad_); }
  friend Dual operator-(const Dual& a, const Dual& b) { return Dual(a.ad_ - b.ad_); }
  friend Dual operator*(const Dual& a, const Dual& b) { return Dual(a.ad_ * b.ad_); }
  friend Dual operator/(const Dual& a, const Dual& b) { return Dual(a.ad_ / b.ad_); }

  // With plain numbers: the same rules, without dragging zeros along.
  friend Dual operator+(const Dual& a, double b) { return Dual(a.value() + b, a.gradient()); }
  friend Dual operator+(double a, const Dual& b) { return b + a; }
  friend Dual operator-(const Dual& a, double b) { return Dual(a.value() - b, a.gradient()); }
  friend Dual operator-(double a, const Dual& b) { return Dual(a - b.value(), -b.gradient()); }
  friend Dual operator*(const Dual& a, double b) {
    return Dual(a.value() * b, Gradient(a.gradient() * Scalar(b)));
  }
  friend Dual operator*(double a, const Dual& b) { return b * a; }
  friend Dual operator/(const Dual& a, double b) { return a * (1.0 / b); }
  friend Dual operator/(double a, const Dual& b) { return Dual(a) / b; }

  friend bool operator==(const Dual& a, const Dual& b) { return a.value() == b.value(); }
  friend bool operator!=(const Dual& a, const Dual& b) { return !(a == b); }
  friend bool operator<(const Dual& a, const Dual& b) { return a.value() < b.value(); }
  friend bool operator>(const Dual& a, const Dual& b) { return b < a; }
  friend bool operator<=(const Dual& a, const Dual& b) { return !(b < a); }
  friend bool operator>=(const Dual& a, const Dual& b) { return !(a < b); }

  friend Dual sin(const Dual& a) { return Dual(sin(a.ad_)); }
  friend Dual cos(const Dual& a) { return Dual(cos(a.ad_)); }
  friend Dual tan(const Dual& a) { return Dual(tan(a.ad_)); }
  friend Dual exp(const Dual& a) { return Dual(exp(a.ad_)); }
  friend Dual log(const Dual& a) { return Dual(log(a.ad_)); }
  friend Dual sqrt(const Dual& a) { return Dual(sqrt(a.ad_)); }
  friend Dual sinh(const Dual& a) { return Dual(sinh(a.ad_)); }
  friend Dual cosh(const Dual& a) { return Dual(cosh(a.ad_)); }
  friend Dual tanh(const Dual& a) { return Dual(tanh(a.ad_)); }

  // Those below are missing in Eigen 3.4, allocate there, or do not nest.
  friend Dual abs(const Dual& a) { return a.value() < 0.0 ? -a : a; }
  friend Dual abs2(const Dual& a) { return a * a; }
  friend Dual asin(const Dual& a) {
    using std::asin, std::sqrt;
    return a.chain(asin(a.value()), 1.0 / sqrt(1.0 - a.value() * a.value()));
  }
  friend Dual acos(const Dual& a) {
    using std::acos, std::sqrt;
    return a.chain(acos(a.value()), -1.0 / sqrt(1.0 - a.value() * a.value()));
  }
  friend Dual atan(const Dual& a) {
    using std::atan;
    return a.chain(atan(a.value()), 1.0 / (1.0 + a.value() * a.value()));
  }
  friend Dual atan2(const Dual& y, const Dual& x) {
    using std::atan2;
    const Scalar scale = 1.0 / (x.value() * x.value() + y.value() * y.value());
    return Dual(atan2(y.value(), x.value()), Gradient(y.gradient() * Scalar(x.value() * scale) -
                                                      x.gradient() * Scalar(y.value() * scale)));
  }
  friend Dual hypot(const Dual& x, const Dual& y) { return sqrt(x * x + y * y); }
  friend Dual pow(const Dual& a, double n) {
    using std::pow;
    if (n == 0.0) return Dual(1.0);  // 0 * pow(0, -1) would be NaN
    return a.chain(pow(a.value(), n), n * pow(a.value(), n - 1.0));
  }
  /// For a > 0 only: a variable exponent has no derivative elsewhere.
  friend Dual pow(const Dual& a, const Dual& n) { return exp(n * log(a)); }

 private:
  Rules ad_;
};

/// N variables of their own: the value `x` as variable number `index`.
template <class T>
T auto_variable(double x, int index) {
  return T(x, T::Gradient::Unit(index));
}

/// Twice differentiated along one direction: the outer derivative is that of the direction, a
/// number for each variable; the inner ones are those by N variables.
template <int N>
using Dual2 = Dual<Dual<double, N>, 1>;

/// The plain number in a T.
inline double auto_value(double x) { return x; }
template <class Scalar, int N>
double auto_value(const Dual<Scalar, N>& x) {
  return auto_value(x.value());
}

/// Cosine and sine of an angle whose cosine c and sine s are known already as numbers.
template <class T>
std::pair<T, T> auto_cos_sin(const T& angle, double c, double s) {
  if constexpr (std::is_same_v<T, double>) {
    return {c, s};
  } else {
    const auto [cosine, sine] = auto_cos_sin(angle.value(), c, s);
    return {angle.chain(cosine, -sine), angle.chain(sine, cosine)};
  }
}

/// A vector from two numbers, any of which may carry derivatives.
template <class X, class Y>
auto vec(const X& x, const Y& y) {
  using T = std::decay_t<decltype(x + y)>;
  return Eigen::Vector2<T>(T(x), T(y));
}

/// Where one body is, as users' templates see it.
template <class T>
struct AutoPose {
  T x, y, angle;  // [m, m, rad] centre of mass, global frame
  T c, s;         // cos(angle), sin(angle)

  /// [m] Centre of mass, global.
  Eigen::Vector2<T> position() const { return {x, y}; }
  /// A body-fixed vector, of numbers or of T, in global axes.
  template <class V>
  Eigen::Vector2<T> to_global(const V& local) const {
    return {c * local[0] - s * local[1], s * local[0] + c * local[1]};
  }
  /// A global vector in body axes.
  template <class V>
  Eigen::Vector2<T> to_local(const V& global) const {
    return {c * global[0] + s * global[1], c * global[1] - s * global[0]};
  }
  /// Global position of a body-fixed point [m].
  template <class V>
  Eigen::Vector2<T> point(const V& local) const {
    return position() + to_global(local);
  }
};

}  // namespace yoke

namespace Eigen {

template <class Scalar, int N>
struct NumTraits<yoke::Dual<Scalar, N>> : NumTraits<double> {
  using Real = yoke::Dual<Scalar, N>;
  using NonInteger = yoke::Dual<Scalar, N>;
  using Nested = yoke::Dual<Scalar, N>;
  using Literal = double;
  enum { RequireInitialization = 1, ReadCost = N + 1, AddCost = N + 1, MulCost = 3 * N + 1 };
};

template <class Scalar, int N, class Operation>
struct ScalarBinaryOpTraits<yoke::Dual<Scalar, N>, double, Operation> {
  using ReturnType = yoke::Dual<Scalar, N>;
};
template <class Scalar, int N, class Operation>
struct ScalarBinaryOpTraits<double, yoke::Dual<Scalar, N>, Operation> {
  using ReturnType = yoke::Dual<Scalar, N>;
};

}  // namespace Eigen
