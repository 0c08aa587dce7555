// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What a central impact must give: closed forms and quadratures that share no code with the laws.
// With y = d'/v, X = chi v and U the stored energy, the laws F_e (1 + chi d') obey
//   dU/dy = -m v^2 y/(1 + X y),   dt/dy = -m v/(F_e (1 + X y))
// whatever F_e: so restitution, largest penetration and force, duration and dissipated energy are a
// root, a logarithm, a maximum, a quadrature. Laws with a damper from the stored energy are the
// linear damped oscillator in q = sqrt(2 U), by a clock that runs with F_e/q.
#pragma once

#include <algorithm>
#include <boost/math/quadrature/tanh_sinh.hpp>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <string>
#include <vector>

namespace yoke::reference {

inline constexpr double pi = std::numbers::pi;
inline constexpr double v = 0.37, m = 1.3;  // [m/s], [kg]
inline constexpr double energy = 0.5 * m * v * v;
inline constexpr double asked[] = {0.1, 0.3, 0.5, 0.7, 0.9, 0.99};

inline double root(const std::function<double(double)>& f, double low, double high) {
  const bool rises = f(high) > 0.0;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    ((f(middle) > 0.0) == rises ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

inline double largest(const std::function<double(double)>& f, double low, double high) {
  // Brackets first: a maximum may lie at an end.
  constexpr int cells = 400;
  int best = 0;
  for (int i = 0; i <= cells; ++i)
    if (f(low + (high - low) * i / cells) > f(low + (high - low) * best / cells)) best = i;
  const double from = low + (high - low) * std::max(best - 1, 0) / cells;
  const double to = low + (high - low) * std::min(best + 1, cells) / cells;
  const double inside =
      -boost::math::tools::brent_find_minima([&](double x) { return -f(x); }, from, to, 50).second;
  return std::max({inside, f(from), f(to)});
}

/// Integral of f(distance from a, distance from b); either end may have an integrable pole.
inline double integral(const std::function<double(double, double)>& f, double a, double b) {
  boost::math::quadrature::tanh_sinh<double> quadrature(15);
  return quadrature.integrate(
      [&](double x, double to_end) {  // to_end: a - x near a, b - x near b, exact there
        const double left = to_end < 0.0 ? -to_end : x - a;
        const double right = to_end < 0.0 ? b - x : to_end;
        return f(left, right);
      },
      a, b, 1e-13);
}

// ---- elastic laws, written again

/// K d^n, or d = a F ln(B/F). Steel, pin of 7.9 mm in a bore of 8 mm, 10 mm long.
struct Spring {
  std::string specification;
  double n, K;  // n = 0: logarithmic
  double a = 0, B = 0;

  struct Point {
    double penetration, force;
  };
  Point at_energy(double U) const {
    if (n > 0.0) {
      const double d = std::pow((n + 1.0) * U / K, 1.0 / (n + 1.0));
      return {d, K * std::pow(d, n)};
    }
    // U = a F^2 (s/2 - 1/4) with s = ln(B/F) > 1, solved for s by Newton in the logarithm.
    const double wanted = std::log(a * B * B / U);
    double s = std::max(1.0001, 0.5 * wanted);
    for (int i = 0; i < 60; ++i) {
      const double f = 2.0 * s - std::log(0.5 * s - 0.25) - wanted;
      s = std::max(0.5 * (1.0 + s), s - f / (2.0 - 1.0 / (s - 0.5)));
    }
    const double F = B * std::exp(-s);
    return {a * F * s, F};
  }
  /// U = E sin^2 p: dt = m v sin p/F dp.
  double elastic_duration() const {
    if (n > 0.0) {
      const double depth = at_energy(energy).penetration;
      return 2.0 * depth / v * std::sqrt(pi) * std::tgamma(1.0 + 1.0 / (n + 1.0)) /
             std::tgamma(0.5 + 1.0 / (n + 1.0));
    }
    return 2.0 * integral(
                     [this](double p, double) {
                       const double sine = std::sin(p);
                       if (!(sine > 1e-140)) return 0.0;
                       return m * v * sine / at_energy(energy * sine * sine).force;
                     },
                     0.0, 0.5 * pi);
  }
};

inline std::vector<Spring> springs() {
  const double E = 207e9 / (2.0 * (1.0 - 0.09)), L = 10e-3, DR = 0.1e-3, R = 7.9e-3 * 8e-3 / DR;
  const double hertz = 4.0 / 3.0 * E * std::sqrt(R), a = 1.0 / (pi * E * L), e = std::numbers::e;
  // Pereira's are of newton and millimetre: DR = 0.1, L = 10.
  const auto pereira = [E](const char* name, double first, double second, double Y) {
    const double n = Y * std::pow(0.1, -0.005);
    const double K = (first * 0.1 + second) * 10.0 * (E * 1e-6) / 0.1;
    return Spring{name, n, K * std::pow(1e3, n)};
  };
  return {{"power:K=1e8,n=1", 1.0, 1e8},
          {"power:K=1e8,n=1.5", 1.5, 1e8},
          {"hertz", 1.5, hertz},
          {"lankarani-nikravesh", 1.5, hertz},
          {"radzimovsky", 0.0, 0.0, a, std::exp(2.0 / 3.0) * 8.0 * DR * E * L / 2.56},
          {"goldsmith", 0.0, 0.0, a, e * pi * E * L * L * L / R},
          {"dubowsky-freudenstein", 0.0, 0.0, a, e * pi * E * L * L * L / R},
          {"esdu-78035", 0.0, 0.0, a, 4.0 * e * pi * E * L * DR},
          {"johnson", 0.0, 0.0, a, 4.0 * pi * E * DR * L / e},
          pereira("pereira-2011", 0.49, 0.10, 1.56 * std::pow(std::log(100.0), -0.192)),
          pereira("pereira-2015", 0.965, 0.0965, 1.51 * std::pow(std::log(100.0), -0.151))};
}

// ---- impacts

struct Expected {
  double restitution, penetration, force, duration, set = 0.0;
};

inline double exact_damping(double e) {  // X for the restitution e
  return root([e](double X) { return X * (1.0 + e) - std::log((1.0 + X) / (1.0 - e * X)); }, 1e-4,
              (1.0 - 1e-15) / e);
}

/// X of each law at the restitution it is given.
inline const std::map<std::string, double (*)(double)> proportional = {
    {"hunt-crossley", [](double e) { return 1.5 * (1.0 - e); }},
    {"herbert-mcwhannell",
     [](double e) { return 6.0 * (1.0 - e) / ((2.0 * e - 1.0) * (2.0 * e - 1.0) + 3.0); }},
    {"lee-wang-1", [](double e) { return 0.75 * (1.0 - e); }},
    {"khulief-shabana", [](double e) { return 0.75 * (1.0 - e * e); }},
    {"lankarani-nikravesh", [](double e) { return 0.75 * (1.0 - e * e); }},
    {"marhefka-orin", [](double e) { return 1.5 * (1.0 - e * e) / (1.0 + e * e * e); }},
    {"marhefka-orin-simplified", [](double e) { return 1.5 * (1.0 - e * e) / (3.0 * e - 1.0); }},
    {"gonthier", exact_damping},
    {"zhang-sharf", exact_damping},
    {"flores", [](double e) { return 8.0 * (1.0 - e) / (5.0 * e); }},
    {"gharib-hurmuzlu", [](double e) { return 1.0 / e; }},
    {"hu-guo", [](double e) { return 1.5 * (1.0 - e) / e; }},
    {"carvalho-martins", [](double e) { return 1.5 * (1.0 - e) * (11.0 - e) / (1.0 + 9.0 * e); }},
};

inline Expected proportional_impact(const Spring& spring, double X) {
  // In e, the balance has the root -1 too; the other lies between 0 and 1/X.
  const double e =
      root([X](double y) { return X * (1.0 + y) - std::log1p(X) + std::log1p(-X * y); }, 0.0,
           std::min(1.0, (1.0 - 1e-15) / X));
  const double unit = m * v * v / (X * X);
  const auto in = [&](double s) {  // stored energy at y = 1 - s
    return unit * (X * s + std::log1p(-X * s / (1.0 + X)));
  };
  const auto out = [&](double s) {  // at y = s - e
    return unit * (-X * s + std::log1p(X * s / (1.0 - e * X)));
  };
  const auto slowness = [&](double U, double y) {
    return U > 0.0 ? m * v / (spring.at_energy(U).force * (1.0 + X * y)) : 0.0;
  };
  // A strong damper lets go slowly: the last stretch has a length of its own, 1/X - e.
  const double turn = std::min(0.5 * e, 100.0 * (1.0 / X - e));
  const auto way_out = [&](double from, double to) {
    return integral([&](double s, double) { return slowness(out(from + s), from + s - e); }, 0.0,
                    to - from);
  };
  return {
      .restitution = e,
      .penetration = spring.at_energy(in(1.0)).penetration,
      .force = largest(
          [&](double y) {
            return y < 1.0 ? spring.at_energy(in(1.0 - y)).force * (1.0 + X * y) : 0.0;
          },
          0.0, 1.0),
      .duration = integral([&](double s, double) { return slowness(in(s), 1.0 - s); }, 0.0, 1.0) +
                  way_out(0.0, turn) + way_out(turn, e)};
}

/// Damper beside the spring, c from the stored energy: q'' + 2 xi w q' + w^2 q = 0, w = 1/sqrt(m),
/// in the clock dt = q/F_e dtau. `clamp`: let go where the force vanishes.
inline Expected oscillator(const Spring& spring, double e, bool clamp = false) {
  const double l = std::log(e), xi = -l / std::sqrt(l * l + pi * pi), s = std::sqrt(1.0 - xi * xi);
  const double w = 1.0 / std::sqrt(m);
  const double end = clamp ? pi - std::atan2(2.0 * xi * s, 1.0 - 2.0 * xi * xi) : pi;  // s w tau
  const auto q_at = [&](double angle, double sine) {
    return v / (s * w) * std::exp(-xi / s * angle) * sine;
  };
  const double deepest = energy * std::exp(-2.0 * xi / s * std::atan2(s, xi));
  Expected expected{.restitution = std::exp(-xi / s * end),
                    .penetration = spring.at_energy(deepest).penetration,
                    .force = 0.0,
                    .duration = 0.0};
  expected.force = largest(
      [&](double angle) {
        const double q = q_at(angle, std::sin(angle));
        if (!(q > 0.0)) return spring.n == 1.0 ? 2.0 * xi * std::sqrt(spring.K * m) * v : 0.0;
        const double rate = v * std::exp(-xi / s * angle) * std::cos(angle) - xi * w * q;
        return spring.at_energy(0.5 * q * q).force * (1.0 + 2.0 * xi * rate / (w * q));
      },
      0.0, end);
  expected.duration = integral(
                          [&](double left, double right) {
                            const double to_pi = clamp ? pi - left : right;
                            const double sine = std::sin(std::min(left, to_pi));
                            const double q = q_at(left, sine);
                            if (!(q > 1e-140)) return 0.0;
                            return q / spring.at_energy(0.5 * q * q).force;
                          },
                          0.0, end) /
                      (s * w);
  return expected;
}

/// Loading by F_e, unloading by F_e((d - d_p)/e^2), d_p = d_m (1 - e^2): the elastic motion of a
/// mass e^2 m.
inline Expected indentation(const Spring& spring, double e) {
  const Spring::Point deepest = spring.at_energy(energy);
  return {e, deepest.penetration, deepest.force, 0.5 * (1.0 + e) * spring.elastic_duration(),
          deepest.penetration * (1.0 - e * e)};
}

/// Lee and Wang II by Runge-Kutta: m d'' = -K d - 2 m w xi T(d) d', T = exp(2 q (d - eps)/eps)
/// below eps, 1 above. Steps end at eps, at the turn and at d = 0, where the right side has
/// corners. `clamp`: no force while it would pull, free flight; it may press again.
inline Expected lee_wang_2(double K, double e, double q, double share, bool clamp = false) {
  const double l = std::log(e), xi = -l / std::sqrt(l * l + pi * pi), w = std::sqrt(K / m);
  const double eps = share * v / w;
  struct Point {
    double d, rate;
  };
  const auto force = [&](Point p, bool faded) {
    const double T = faded ? std::exp(2.0 * q * (p.d - eps) / eps) : 1.0;
    return K * p.d + 2.0 * m * w * xi * T * p.rate;
  };
  const auto step = [&](Point p, double h, bool faded) {
    const auto slope = [&](Point x) { return Point{x.rate, -force(x, faded) / m}; };
    const auto moved = [&](Point k, double by) {
      return Point{p.d + by * k.d, p.rate + by * k.rate};
    };
    const Point a = slope(p), b = slope(moved(a, 0.5 * h)), c = slope(moved(b, 0.5 * h)),
                f = slope(moved(c, h));
    return Point{p.d + h / 6.0 * (a.d + 2.0 * b.d + 2.0 * c.d + f.d),
                 p.rate + h / 6.0 * (a.rate + 2.0 * b.rate + 2.0 * c.rate + f.rate)};
  };
  const double h = 1e-4 / w;
  Point p{0.0, v};
  double t = 0.0;
  Expected result{.restitution = 0.0, .penetration = 0.0, .force = force(p, true), .duration = 0.0};
  const auto go = [&](bool faded, const std::function<double(Point)>& until) {
    while (until(p) < 0.0) {
      Point next = step(p, h, faded);
      double by = h;
      if (until(next) >= 0.0) {
        by = root([&](double x) { return until(step(p, x, faded)); }, 0.0, h);
        next = step(p, by, faded);
        t += by;
        p = next;
        result.force = std::max(result.force, force(p, faded));
        return;
      }
      t += by;
      p = next;
      result.force = std::max(result.force, force(p, faded));
    }
  };
  go(true, [&](Point x) { return x.d - eps; });
  go(false, [](Point x) { return -x.rate; });
  result.penetration = p.d;
  if (!clamp) {
    go(false, [&](Point x) { return eps - x.d; });
    go(true, [](Point x) { return -x.d; });
    result.duration = t;
  }
  // Unloading with what presses only: alternately pressing and free, in small pieces of d.
  while (clamp && p.d > 0.0) {
    const bool faded = p.d <= eps;
    const auto pulls = [&](Point x) { return -force(x, faded); };
    const double floor = faded ? 0.0 : eps;
    if (pulls(p) < 0.0) {
      go(faded, [&](Point x) { return std::max(pulls(x), floor - x.d); });
      result.duration = t;  // as long as it has pressed
      if (p.d <= floor + 1e-9 * eps) {
        if (!faded) p.d = eps;  // on with the other formula
        if (faded) break;
        continue;
      }
    }
    // Free flight until it presses, or to the end of the piece.
    constexpr int cells = 200000;
    const double from = p.d, piece = (from - floor) / cells;
    double found = -1.0;
    for (int i = 1; i < cells && found < 0.0; ++i) {
      const double d = from - piece * i;
      if (pulls({d, p.rate}) < 0.0)
        found = root([&](double x) { return -pulls({x, p.rate}); }, d, d + piece);
    }
    const double to = found > 0.0 ? found - 1e-12 * eps : floor;
    t += (from - to) / -p.rate;
    p.d = to;
    if (found < 0.0 && faded) break;
  }
  result.restitution = -p.rate / v;
  return result;
}

}  // namespace yoke::reference
