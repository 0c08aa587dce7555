// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/friction/friction_laws.hpp>

#include <algorithm>
#include <array>
#include <boost/numeric/odeint/integrate/integrate_adaptive.hpp>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/generation/generation_runge_kutta_dopri5.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <yoke/contact/laws/catalog/friction_catalog.hpp>
#include <yoke/contact/laws/dissipative/hunt_crossley.hpp>
#include <yoke/contact/laws/elastic/power_law.hpp>

namespace yoke::cases {

namespace {

constexpr double contact_exponent = 1.5, contact_damping = 10.0;  // [s/m]
using PressedMass = std::function<Pressed(const Parameters&)>;

/// The value of a parameter of a friction law, if the case decides it. Bristles bend by the parameter
/// presliding before they slip, and are damped critically, whatever the mass.
std::optional<double> own_value(const std::string& name, const Parameters& p,
                                const PressedMass& pressed) {
  for (const char* own : {"mu", "mu_static", "threshold"})
    if (name == own) return p.number(own);
  const Pressed at = pressed(p);
  const double stiffness = p.number("mu") * at.normal_force / p.number("presliding");
  if (name == "stiffness") return stiffness;
  if (name == "damping") return 2.0 * std::sqrt(stiffness * at.mass);
  return std::nullopt;
}

NamedLaw law_named_after(const char* friction, const char* description,
                         const PressedMass& pressed) {
  return {friction, description, [friction, pressed](const Parameters& p, const Wall&) {
            std::vector<std::pair<std::string, double>> values;
            for (const FrictionParameter& each : find_friction(friction).parameters)
              if (const auto value = own_value(each.name, p, pressed))
                values.emplace_back(each.name, *value);
            return ContactLaw{PowerLaw{p.number("stiffness"), contact_exponent},
                              HuntCrossley{contact_damping}, make_friction(friction, values)};
          }};
}

}  // namespace

std::vector<CaseParameter> friction_parameters(const char* mu, const char* mu_static) {
  return {{.name = "stiffness",
           .quantity = Quantity::number,
           .default_text = "1e8",
           .low = 1e5,
           .high = 1e12,
           .description = "K of the contact's F = K d^1.5, in N/m^1.5"},
          {.name = "mu",
           .quantity = Quantity::number,
           .default_text = mu,
           .low = 0.001,
           .high = 2.0,
           .description = "coefficient of friction while it slides"},
          {.name = "mu_static",
           .quantity = Quantity::number,
           .default_text = mu_static,
           .low = 0.001,
           .high = 3.0,
           .description = "the greatest, for laws that have it"},
          {.name = "threshold",
           .quantity = Quantity::number,
           .default_text = "0.001",
           .low = 1e-4,
           .high = 1.0,
           .description = "sliding velocity below which the laws without bristles creep, in m/s"},
          {.name = "presliding",
           .quantity = Quantity::length,
           .default_text = "20um",
           .low = 1e-7,
           .high = 1e-2,
           .description = "by which bristles bend before they slip, for laws that have them"}};
}

ContactChoice friction_laws(std::function<std::vector<Wall>(const Parameters&)> walls,
                            const std::function<Pressed(const Parameters&)>& pressed) {
  const auto law = [&](const char* friction, const char* description) {
    return law_named_after(friction, description, pressed);
  };
  return {.walls = std::move(walls),
          .laws = {law("coulomb", "itself: holds without creeping, mu N while it slides"),
                   law("brown-mcphee", "smooth, greatest friction at the threshold"),
                   law("regularised-coulomb", "mu N tanh(v/threshold)"),
                   law("stribeck", "falls from mu_static to mu about 0.1 m/s"),
                   law("bengisu-akay", "falls from mu_static to mu within 0.1 m/s"),
                   law("dahl", "bristles: holds, a spring that yields"),
                   law("lugre", "bristles, damped; falls from mu_static to mu about 10 mm/s")},
          .base = "coulomb"};
}

namespace {

/// Under Coulomb's law forces are linear in the position between transitions: closed forms.
class CoulombLine {
 public:
  CoulombLine(const FrictionLaw& friction, const LineMotion& line)
      : line_(line),
        sliding_(friction.evaluate({.normal_force = line.normal_force, .direction = 1.0}).force),
        limit_(friction.holding_force(line.normal_force)),
        x_(line.x),
        v_(line.v) {
    if (v_ == line.belt)
      come_to_rest();
    else
      direction_ = v_ > line.belt ? 1.0 : -1.0;
  }

  /// After `span` [s] more.
  LinePoint advance(double span) {
    for (double end = end_of_piece(); end < span; end = end_of_piece()) {
      span -= end;
      move(end);
      if (direction_ == 0.0)
        direction_ = pull() > 0.0 ? 1.0 : -1.0;
      else
        come_to_rest();
    }
    move(span);
    return {x_, v_};
  }

 private:
  double pull() const { return line_.load - line_.stiffness * x_; }  // [N]

  void come_to_rest() {
    v_ = line_.belt;
    direction_ = std::abs(pull()) <= limit_ ? 0.0 : pull() > 0.0 ? 1.0 : -1.0;
  }

  double end_of_piece() const {
    constexpr double never = std::numeric_limits<double>::infinity();
    const double k = line_.stiffness, belt = line_.belt;
    if (direction_ == 0.0) {
      const double fall = k * belt;  // [N/s] of the pull
      if (fall == 0.0) return never;
      return std::max((pull() + (fall > 0.0 ? limit_ : -limit_)) / fall, 0.0);
    }
    const double force = pull() - direction_ * sliding_;
    if (k == 0.0) return direction_ * force < 0.0 ? (belt - v_) * line_.mass / force : never;
    const double w = std::sqrt(k / line_.mass), sine = -force / k * w;  // v = R cos(w t + phase)
    const double R = std::hypot(v_, sine), phase = std::atan2(sine, v_);
    if (std::abs(belt) >= R) return never;
    double angle = direction_ * std::acos(belt / R) - phase;
    constexpr double just_now = 1e-9;
    while (angle < just_now) angle += 2.0 * pi;
    return angle / w;
  }

  void move(double t) {
    const double k = line_.stiffness, force = pull() - direction_ * sliding_;
    if (direction_ == 0.0) {
      x_ += line_.belt * t;
    } else if (k == 0.0) {
      x_ += t * (v_ + 0.5 * force / line_.mass * t);
      v_ += force / line_.mass * t;
    } else {
      const double w = std::sqrt(k / line_.mass), x = -force / k, v = v_;
      x_ += x * (std::cos(w * t) - 1.0) + v / w * std::sin(w * t);
      v_ = v * std::cos(w * t) - x * w * std::sin(w * t);
    }
  }

  const LineMotion& line_;
  double sliding_, limit_;  // [N]
  double x_, v_;
  double direction_ = 0.0;  // 0: at rest on the belt
};

}  // namespace

std::vector<LinePoint> move_on_line(const FrictionLaw& friction, const LineMotion& start,
                                    const std::vector<double>& times) {
  if (friction.holds()) {
    CoulombLine line(friction, start);
    std::vector<LinePoint> points;
    for (std::size_t i = 0; i < times.size(); ++i)
      points.push_back(line.advance(i > 0 ? times[i] - times[i - 1] : 0.0));
    return points;
  }
  namespace odeint = boost::numeric::odeint;
  using Row = std::array<double, 3>;  // x, v, z
  constexpr double tolerance = 1e-13, least_steps = 10000.0;
  const double bent = friction.has_state() ? friction.state_scale(start.reference_force) : 1.0;
  const auto rate = [&](const Row& y, Row& slope, double) {
    const FrictionOutput f = friction.evaluate({.normal_force = start.normal_force,
                                                .sliding = y[1] - start.belt,
                                                .state = bent * y[2],
                                                .reference_force = start.reference_force});
    slope = {y[1], (start.load - start.stiffness * y[0] - f.force) / start.mass, f.rate / bent};
  };
  Row y{start.x, start.v, 0.0};
  double t = times.empty() ? 0.0 : times.front();
  std::vector<LinePoint> points;
  // Where the force is constant any step is exact, and a long one would not see the end of that.
  const double longest = times.empty() ? 0.0 : (times.back() - times.front()) / least_steps;
  const auto stepper =
      odeint::make_controlled(tolerance, tolerance, longest, odeint::runge_kutta_dopri5<Row>());
  for (const double next : times) {
    if (next > t) odeint::integrate_adaptive(stepper, rate, y, t, next, 1e-3 * longest);
    t = next;
    points.push_back({y[0], y[1]});
  }
  return points;
}

std::vector<Check> line_checks(const Result& run, const FrictionLaw& friction,
                               const LineMotion& start, const std::string& x_column,
                               const std::string& v_column) {
  const Eigen::VectorXd t = run["t_s"], x = run[x_column], v = run[v_column];
  const Eigen::Index rows = t.size(), every = std::max<Eigen::Index>(1, rows / 50);
  std::vector<double> times;
  for (Eigen::Index i = 0; i < rows; i += every) times.push_back(t[i]);
  const std::vector<LinePoint> points = move_on_line(friction, start, times);
  double off_x = 0.0, off_v = 0.0, size_x = 0.0, size_v = 0.0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k) * every;
    off_x = std::max(off_x, std::abs(x[i] - x[0] + start.x - points[k].x));
    off_v = std::max(off_v, std::abs(v[i] - points[k].v));
    size_x = std::max(size_x, std::abs(points[k].x));
    size_v = std::max(size_v, std::abs(points[k].v));
  }
  // What the run takes for a length and a velocity of usual size: creep may be much less.
  const double usual = run.summary.length_scale / run.summary.time_scale;
  const char* remark =
      friction.holds() ? "closed form" : "equation of one coordinate, another integrator";
  return {{.what = "position differs by up to",
           .value = off_x,
           .unit = "m",
           .tolerance = tolerance_of(run, std::max(size_x, run.summary.length_scale)),
           .remark = remark},
          {.what = "velocity differs by up to",
           .value = off_v,
           .unit = "m/s",
           .tolerance = tolerance_of(run, std::max(size_v + std::abs(start.belt), usual)),
           .remark = remark}};
}

}  // namespace yoke::cases
