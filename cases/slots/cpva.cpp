// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A rotor with centrifugal pendulum absorbers: masses that roll on paths in the rotor and, driven by
// the torque of an engine, swing against it.
//
//            path, radius of curvature rho0 at its vertex
//        .--(o)--.                R0  from the axis to the vertex
//      .'         '.              n   order: swings in a turn of the rotor, n^2 = (R0 - rho0)/rho0
//     |      +      | Omega       s   of a mass along its path, from the vertex
//      '.         .'
//        '--(o)--'
//
// At constant speed:  s'^2 = Omega^2 (|r(s)|^2 - |r(s_max)|^2), and so the order of a swing of s_max
//   circle        sqrt(R/rho0) pi / (2 K(sin(a/2)))   R = R0 - rho0, a = s_max/rho0, K elliptic
//   tautochrone   n: |r|^2 = R0^2 - n^2 s^2
//   cycloid       by quadrature
// With a torque T sin(n theta) on the free rotor, small swings:
//   without absorbers        theta'' = T/(I + N m R0^2) sin(n theta), the masses held
//   with absorbers, order n  theta'' = 0, s = -s_max sin(n theta), s_max = T/(N m R0 n^2 Omega^2)
//
// What should happen. With masses on tautochrones what remains of the ripple has twice the order and
// grows with the square of the swing. On circles large swings have a lower order, and part
// of the ripple stays. Rollers with clearance stay on the outer walls of their slots.
#include <algorithm>
#include <boost/math/special_functions/ellint_1.hpp>
#include <cmath>
#include <complex>
#include <optional>

#include <yoke/cases/case.hpp>
#include <yoke/cases/slots/machine_laws.hpp>
#include <yoke/contact/clearance.hpp>
#include <yoke/core/curves/absorber_paths.hpp>
#include <yoke/core/curves/smooth_curves.hpp>
#include <yoke/core/units.hpp>
#include <yoke/joints/drivers/angle_driver.hpp>
#include <yoke/joints/forces/applied_torque.hpp>
#include <yoke/joints/point_on_curve.hpp>
#include <yoke/joints/revolute.hpp>

namespace yoke::cases {

namespace {

using namespace yoke::literals;

constexpr double roller_radius = 4.0_mm;

struct Cpva {
  std::string path;
  bool driven;
  int number;
  double order, distance, swing;    // swing [rad]: s_max over rho0
  double mass, inertia;             // [kg] of one absorber, [kg m^2] of the rotor
  double omega, torque, clearance;  // [rad/s], [N m], [m]

  explicit Cpva(const Parameters& p)
      : path(p.word("path")),
        driven(p.word("rotor") == "driven"),
        number(p.whole("number")),
        order(p.number("order")),
        distance(p.number("distance")),
        swing(p.number("swing")),
        mass(p.number("mass")),
        inertia(p.number("inertia")),
        omega(p.number("speed") * pi / 30.0),
        torque(p.number("torque")),
        clearance(p.number("clearance")) {
    if (driven && number == 0)
      throw ModelError("cpva: number = 0 with rotor = driven: nothing swings; accepted is 1 to 4");
    if (real() && !(radius() > 2.0 * half_width()))
      throw ModelError(fmt::format(
          "cpva: distance = {:g} mm and order = {:g} give a path of radius {:g} mm; with "
          "clearance it must be greater than {:g} mm, twice the half-width of the slot",
          1e3 * distance, order, 1e3 * radius(), 2e3 * half_width()));
    // The ripple of rollers beside the path may be greater than meant for the path itself.
    const double room = real() ? 1.2 : 1.02;
    if (number > 0 && !(room * largest() < reach()))
      throw ModelError(fmt::format(
          "cpva: {} makes the masses swing by {:g} mm along the path; it ends at {:g} "
          "mm, so that {} must be less than {:g}{}",
          driven ? "swing" : "torque", 1e3 * largest(), 1e3 * reach(), driven ? "swing" : "torque",
          (driven ? swing * 180.0 / pi : torque) * reach() / (room * largest()),
          driven ? " deg" : " N m"));
    if (!driven && number > 0 && !(inertia >= least_inertia()))
      throw ModelError(fmt::format(
          "cpva: inertia = {:g} kg m^2 must be at least {:.3g} kg m^2 with masses of {:g} kg, of "
          "which a torque of {:g} N m makes a swing of {:g} mm: a lighter rotor throws them off "
          "their paths",
          inertia, least_inertia(), mass, torque, 1e3 * largest()));
  }

  bool real() const { return clearance > 0.0; }
  double half_width() const { return roller_radius + clearance; }
  double radius() const { return distance / (1.0 + order * order); }  // rho0
  double lambda() const {
    return path == "circle" ? 0.0 : path == "cycloid" ? 1.0 : tautochronic_lambda(order);
  }
  /// [m] of the path, along it: short of its cusp, and of where a slot would have none inside.
  double reach() const {
    if (path == "circle") return (real() ? 2.2 : 2.8) * radius();
    const double least = real() ? 1.3 * half_width() / radius() : 0.0;  // radius of curvature there
    return std::min(0.97, std::sqrt(1.0 - least * least)) * radius() / lambda();
  }
  /// [m] s_max.
  double largest() const {
    if (driven) return swing * radius();
    return torque / (number * mass * distance * order * order * omega * omega);
  }
  double swing_ratio() const { return largest() / radius(); }
  /// Of the ideal path of the mass i.
  Curve curve(int i) const {
    return absorber_path({.direction = 2.0 * pi * i / number,
                          .distance = distance,
                          .order = order,
                          .lambda = lambda(),
                          .reach = reach()});
  }
  /// [kg m^2] of the rotor: below, its speed changes so much in a swing that the masses swing much
  /// farther than meant.
  double least_inertia() const {
    return 0.75 * largest() / reach() * number * mass * distance * distance;
  }
  /// Rotor and masses held at their vertices.
  double held_inertia() const { return inertia + number * mass * distance * distance; }

  double order_of_swing() const;
};

/// At constant speed, for a swing of s_max.
double Cpva::order_of_swing() const {
  if (path == "tautochrone") return order;
  if (path == "circle") return order * 0.5 * pi / boost::math::ellint_1(std::sin(0.5 * swing));
  // A quarter of a period, in which the rotor turns by the integral of ds/sqrt(|r(s)|^2 -
  // |r(s_max)|^2): with s = s_max sin(x) the integrand is smooth and periodic, and the midpoint rule
  // exact to rounding. The difference of the squares is -2 times the integral of r.t.
  const Curve c = curve(0);
  const double top = largest(), end = c.at(reach() + top).point.squaredNorm();
  constexpr int parts = 400;
  double quarter = 0.0;
  for (int k = 0; k < parts; ++k) {
    const double x = 0.5 * pi * (k + 0.5) / parts, s = top * std::sin(x);
    quarter += top * std::cos(x) / std::sqrt(c.at(reach() + s).point.squaredNorm() - end) * 0.5 *
               pi / parts;
  }
  return 0.5 * pi / quarter;
}

std::string mass_name(int i) { return fmt::format("mass {}", i + 1); }

Model cpva_model(const Cpva& c, const WallLaws& laws) {
  Model m;
  const BodyId rotor = m.add(
      Body{.name = "rotor", .mass = 5.0, .inertia = c.inertia, .twist = {{0.0, 0.0}, c.omega}});
  m.add(Revolute{.name = "bearing", .a = ground, .b = rotor, .at = {0.0, 0.0}});
  if (c.driven) {
    m.add(AngleDriver{.name = "motor", .body = rotor, .angle = constant_speed(0.0, c.omega)});
  } else {
    const double T = c.torque, n = c.order;
    m.add(applied_torque("engine", rotor,
                         [T, n](auto, const auto& body) { return T * sin(n * body.angle); }));
  }
  for (int i = 0; i < c.number; ++i) {
    const Curve path = c.curve(i);
    // At rest in the rotor at the end of the swing, or at the vertex with the speed of the swing.
    const CurvePoint at = path.at(c.reach() + (c.driven ? c.largest() : 0.0));
    const double speed = c.driven ? 0.0 : -c.order * c.omega * c.largest();
    Vec2 start = at.point;
    if (c.real()) {  // on the outer wall, pressed by what curves its way
      const Vec2 out = -perp(at.tangent);
      const double force = c.mass * (c.omega * c.omega * at.point.dot(out) + 2.0 * c.omega * speed +
                                     at.curvature * speed * speed);
      start += (c.clearance + laws["wall"].elastic.penetration_at(force)) * out;
    }
    const BodyId mass = m.add(Body{.name = mass_name(i),
                                   .mass = c.mass,
                                   .inertia = 0.5 * c.mass * roller_radius * roller_radius,
                                   .pose = {start, 0.0},
                                   .twist = {c.omega * perp(start) + speed * at.tangent, 0.0}});
    PointOnCurve joint{
        .name = fmt::format("path {}", i + 1), .a = mass, .at = start, .b = rotor, .curve = path};
    if (c.real())
      joint.clearance =
          SlotClearance{.pin_radius = roller_radius, .radial = c.clearance, .law = laws["wall"]};
    m.add(joint);
  }
  return m;
}

/// A motion of the rotor at equal times: its angle, speed and acceleration.
struct RotorMotion {
  Eigen::VectorXd angle, omega, alpha;
};

RotorMotion rotor_of(const Result& run) {
  return {run["rotor.angle_rad"], run["rotor.omega_rad_per_s"], run["rotor.alpha_rad_per_s2"]};
}

/// The motion under the torque from the equations in theta and s alone, by the classical method of
/// Runge and Kutta; masses that stay `aside` [m] outside their path, on its parallel. All masses move alike, so with r, t, k of the path at s and
/// X = r x t
///   s'' = r.t theta'^2 - X theta''
///   (I + N m (r^2 - X^2)) theta'' = T sin(n theta)
///                                   - N m (2 r.t s' theta' + X r.t theta'^2 + k r.t s'^2)
RotorMotion reduced_motion(const Cpva& c, double aside, double duration, Eigen::Index rows) {
  struct Y {
    double theta, s, omega, speed;
  };
  std::optional<Curve> path = c.number > 0 ? std::optional(c.curve(0)) : std::nullopt;
  if (path && aside > 0.0) {  // as far as they swing: it need not be smooth at its ends
    const double middle = 0.5 * path->length(), half = std::min(0.95 * middle, 1.5 * c.largest());
    path = curve_of(
        [ideal = *path, aside](double s) -> Vec2 {
          const CurvePoint at = ideal.at(s);
          return at.point - aside * perp(at.tangent);
        },
        middle - half, middle + half);
  }
  const double vertex = path ? 0.5 * path->length() : 0.0;
  const double Nm = c.number * c.mass;
  const auto rates = [&](const Y& y) {
    const CurvePoint at = path ? path->at(vertex + y.s) : CurvePoint{};
    const double rt = at.point.dot(at.tangent), X = cross(at.point, at.tangent), w = y.omega,
                 v = y.speed;
    const double load = c.torque * std::sin(c.order * y.theta) -
                        Nm * (2.0 * rt * v * w + X * rt * w * w + at.curvature * rt * v * v);
    const double alpha = load / (c.inertia + Nm * (at.point.squaredNorm() - X * X));
    return Y{w, v, alpha, rt * w * w - X * alpha};
  };
  const auto moved = [](const Y& y, const Y& rate, double h) {
    return Y{y.theta + h * rate.theta, y.s + h * rate.s, y.omega + h * rate.omega,
             y.speed + h * rate.speed};
  };
  // So many steps from row to row that a swing has a thousand.
  const double row = duration / static_cast<double>(rows - 1);
  const int steps = static_cast<int>(std::ceil(row * c.omega * c.order * 1000.0 / (2.0 * pi)));
  const double h = row / steps;
  Y y{0.0, 0.0, c.omega, c.number > 0 ? -c.order * c.omega * c.largest() : 0.0};
  RotorMotion motion{Eigen::VectorXd(rows), Eigen::VectorXd(rows), Eigen::VectorXd(rows)};
  for (Eigen::Index i = 0; i < rows; ++i) {
    motion.angle[i] = y.theta, motion.omega[i] = y.omega, motion.alpha[i] = rates(y).omega;
    for (int k = 0; k < steps && i + 1 < rows; ++k) {
      const Y a = rates(y), b = rates(moved(y, a, 0.5 * h)), d = rates(moved(y, b, 0.5 * h)),
              e = rates(moved(y, d, h));
      y = moved(moved(moved(moved(y, a, h / 6.0), b, h / 3.0), d, h / 3.0), e, h / 6.0);
    }
  }
  return motion;
}

/// Amplitude of theta'' in its part of order `n`, as a function of theta, over the whole run; a
/// window of Hann keeps other orders out.
double ripple(const RotorMotion& motion, double n) {
  const auto& [angle, omega, alpha] = motion;
  const double from = angle[0], turned = angle[angle.size() - 1] - from;
  std::complex<double> sum = 0.0;
  double weights = 0.0;
  for (Eigen::Index i = 0; i < angle.size(); ++i) {
    const double w = omega[i] * std::pow(std::sin(pi * (angle[i] - from) / turned), 2);
    weights += w;
    sum += w * alpha[i] * std::polar(1.0, -n * angle[i]);
  }
  return 2.0 * std::abs(sum) / weights;
}

/// Sideways in the rotor, with its rate: where it rises through 0 the mass passes its vertex.
std::vector<double> vertex_times(const Result& run) {
  const Eigen::VectorXd t = run["t_s"], angle = run["rotor.angle_rad"],
                        omega = run["rotor.omega_rad_per_s"], x = run["mass 1.x_m"],
                        y = run["mass 1.y_m"], vx = run["mass 1.vx_m_per_s"],
                        vy = run["mass 1.vy_m_per_s"];
  Eigen::VectorXd side(t.size()), rate(t.size());
  for (Eigen::Index i = 0; i < t.size(); ++i) {
    const Vec2 across = rotate(angle[i], {0.0, 1.0}), r(x[i], y[i]);
    side[i] = across.dot(r);
    rate[i] = across.dot(Vec2(vx[i], vy[i]) - omega[i] * perp(r));
  }
  return rising_times(t, side, rate);
}

std::vector<Check> cpva_checks(const Cpva& c, const Result& run) {
  std::vector<Check> checks;
  if (c.driven) {
    const std::vector<double> times = vertex_times(run);
    if (times.size() >= 2) {
      const double swings = static_cast<double>(times.size() - 1);
      const double expected = c.order_of_swing(), period = 2.0 * pi / (expected * c.omega);
      // A roller with clearance runs beside the path.
      const double aside = c.real() ? 4.0 * c.clearance / c.radius() : 0.0;
      checks.push_back({.what = fmt::format("order of a swing of {:g} deg", c.swing * 180.0 / pi),
                        .value = 2.0 * pi * swings / (c.omega * (times.back() - times.front())),
                        .expected = expected,
                        .tolerance = expected * (tolerance_of(run, 1.0) + aside +
                                                 interpolation_error(run, period)),
                        .remark = c.path == "cycloid" ? "quadrature" : "closed form"});
    }
  } else {
    const double held = c.torque / c.held_inertia();
    const Eigen::VectorXd t = run["t_s"];
    const auto reduced = [&](double aside) {
      return ripple(reduced_motion(c, aside, t[t.size() - 1] - t[0], t.size()), c.order);
    };
    // Rollers lie on the outer walls, pressed in by as much as is seen.
    double deepest = 0.0;
    for (int i = 1; c.real() && i <= c.number; ++i)
      deepest = std::max(deepest, run[fmt::format("path {}.penetration_m", i)].maxCoeff());
    if (held > 0.0) {
      const double expected = reduced(c.clearance) / held;
      const double give =
          deepest > 0.0 ? 2.0 * std::abs(reduced(c.clearance + deepest) / held - expected) : 0.0;
      checks.push_back(
          {.what = fmt::format("ripple of order {:g} over that with the masses held", c.order),
           .value = ripple(rotor_of(run), c.order) / held,
           .expected = expected,
           // Places are known to the tolerance times the length scale, that of a large rotor too.
           .tolerance =
               tolerance_of(run, std::max(1.0, run.summary.length_scale / c.distance)) + give,
           .remark = "equations in theta and s"});
    }
  }
  checks.push_back(energy_check(run));
  return checks;
}

/// What is left of the ripple, over what the engine's torque alone would make.
std::vector<Portrait> cpva_portraits(const Cpva& c, const Result& run) {
  if (c.driven) return {};
  const RotorMotion rotor = rotor_of(run);
  PortraitLine with{.name = c.number > 0 ? "with absorbers" : "rotor alone", .points = {}},
      held{.name = "masses held, speed constant", .points = {}};
  for (Eigen::Index i = 0; i < rotor.angle.size(); ++i) {
    const double turns = rotor.angle[i] / (2.0 * pi);
    with.points.emplace_back(turns, rotor.alpha[i]);
    held.points.emplace_back(turns,
                             c.torque / c.held_inertia() * std::sin(c.order * rotor.angle[i]));
  }
  return {{.name = "ripple",
           .title = "torsional ripple of the rotor",
           .x_label = "turns",
           .y_label = "angular acceleration [rad/s^2]",
           .lines = {held, with}}};
}

}  // namespace

Case cpva_case() {
  return {
      .name = "cpva",
      .group = "slots and cams",
      .description = "rotor with centrifugal pendulum absorbers on circles, cycloids, tautochrones",
      .parameters = {{.name = "path",
                      .default_text = "tautochrone",
                      .words = {"circle", "cycloid", "tautochrone"},
                      .description = "of the masses; the tautochrone is an epicycloid"},
                     {.name = "rotor",
                      .default_text = "free",
                      .words = {"free", "driven"},
                      .description = "under the engine's torque, or turning at constant speed"},
                     {.name = "number",
                      .quantity = Quantity::number,
                      .default_text = "2",
                      .low = 0,
                      .high = 4,
                      .whole = true,
                      .description = "of absorbers; 0: the rotor alone"},
                     {.name = "order",
                      .quantity = Quantity::number,
                      .default_text = "2",
                      .low = 0.5,
                      .high = 8.0,
                      .description = "n of the paths, for small swings, and of the torque"},
                     {.name = "distance",
                      .quantity = Quantity::length,
                      .default_text = "125mm",
                      .low = 10.0_mm,
                      .high = 1000.0_mm,
                      .description = "R0, from the axis to the vertex of a path"},
                     {.name = "swing",
                      .quantity = Quantity::angle,
                      .default_text = "30deg",
                      .low = 0.01_deg,
                      .high = 160.0_deg,
                      .description = "s_max over rho0, rotor = driven"},
                     {.name = "torque",
                      .quantity = Quantity::number,
                      .default_text = "100",
                      .low = 0.0,
                      .high = 1e6,
                      .description = "T of the engine, in N m, rotor = free"},
                     {.name = "mass",
                      .quantity = Quantity::number,
                      .default_text = "0.5",
                      .low = 1e-3,
                      .high = 100.0,
                      .description = "of one absorber, in kg"},
                     {.name = "inertia",
                      .quantity = Quantity::number,
                      .default_text = "0.1",
                      .low = 1e-5,
                      .high = 1000.0,
                      .description = "of the rotor without absorbers, in kg m^2"},
                     {.name = "speed",
                      .quantity = Quantity::number,
                      .default_text = "1200",
                      .low = 1.0,
                      .high = 2e4,
                      .description = "of the rotor at the start, in revolutions per minute"},
                     {.name = "clearance",
                      .quantity = Quantity::length,
                      .default_text = "0mm",
                      .low = 0.0,
                      .high = 0.5_mm,
                      .description =
                          "of rollers of 4 mm in slots, to each side; 0: held on their paths"},
                     {.name = "turns",
                      .quantity = Quantity::number,
                      .default_text = "10",
                      .low = 0.1,
                      .high = 10000.0,
                      .description = "of the rotor"}},
      .contact = machine_laws([](const Parameters& p) {
        const Cpva c(p);
        if (!c.real() || c.number == 0) return std::vector<Wall>{};
        return std::vector<Wall>{{.name = "wall",
                                  .pair = {.pin_radius = roller_radius,
                                           .wall_radius = c.radius() + c.half_width(),
                                           .conformity = Conformity::internal},
                                  .length = 10.0_mm}};
      }),
      .default_output = "results/cpva",
      .model = [](const Parameters& p, const WallLaws& laws) { return cpva_model(Cpva(p), laws); },
      .duration = [](const Parameters& p) { return p.number("turns") * 60.0 / p.number("speed"); },
      .checks = [](const Parameters& p, const Model&,
                   const Result& run) { return cpva_checks(Cpva(p), run); },
      .portraits = [](const Parameters& p, const Model&,
                      const Result& run) { return cpva_portraits(Cpva(p), run); }};
}

}  // namespace yoke::cases
