// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/validation/benchmark_problems.hpp>

#include <fmt/ranges.h>
#include <time.h>

#include <span>

#include <yoke/cases/andrews.hpp>
#include <yoke/cases/car_axis.hpp>
#include <yoke/cases/case.hpp>
#include <yoke/cases/n_four_bar.hpp>
#include <yoke/cases/pendulums.hpp>
#include <yoke/cases/slider_crank.hpp>
#include <yoke/core/error.hpp>
#include <yoke/integrators/simulate.hpp>

namespace yoke::cases {

namespace {

constexpr double g = 9.81;  // [m/s^2]

// ---- closed forms

/// `compare(t, check)` calls check(column, expected) for what is known at time t.
template <class Compare>
BenchmarkErrors compare_samples(const Result& run, const Compare& compare) {
  Comparison comparison;
  for (std::size_t i = 0; i < run.samples.rows(); ++i) {
    const auto check = [&](std::string_view column, double expected) {
      comparison.add(column, run.samples.value(i, run.samples.index(column)), expected);
    };
    compare(run.samples.value(i, run.samples.index("t_s")), check);
  }
  return comparison.errors();
}

PendulumMotion point_pendulum_motion() { return {std::sqrt(g), 0.5 * pi, 0.0}; }

/// On the right of the pivot at the start; the force on the mass is that of the rod's tension.
BenchmarkErrors point_pendulum_errors(const Result& run) {
  const PendulumMotion motion = point_pendulum_motion();
  return compare_samples(run, [&](double t, const auto& check) {
    const auto [angle, rate, acceleration] = motion.at(t);
    const double s = std::sin(angle), c = std::cos(angle);
    check("mass.x_m", s);
    check("mass.y_m", -c);
    check("mass.vx_m_per_s", c * rate);
    check("mass.vy_m_per_s", s * rate);
    const double tension = rate * rate + g * c;
    check("rod.fx_N", -tension * s);
    check("rod.fy_N", tension * c);
  });
}

/// From where the mass is when it is fastest, near the end.
double point_pendulum_period_error(const Result& run) {
  const PendulumMotion motion = point_pendulum_motion();
  const Eigen::VectorXd t = run["t_s"], x = run["mass.x_m"], y = run["mass.y_m"];
  const Eigen::Index last = t.size() - 1;
  double fastest = 0.0, error = BenchmarkErrors::none;
  for (Eigen::Index i = std::max<Eigen::Index>(1, last - 10); i <= last; ++i) {
    const auto p = motion.at(t[i]);
    if (std::abs(p.rate) < fastest) continue;
    fastest = std::abs(p.rate);
    error = std::abs((std::atan2(x[i], -y[i]) - p.angle) / p.rate) / t[i];
  }
  return error;
}

/// w^2 = m g (L/2) / (m L^2/3).
BenchmarkErrors rod_pendulum_errors(const Result& run) {
  const PendulumMotion motion(std::sqrt(1.5 * g), 0.5 * pi, 0.0);
  return compare_samples(run, [&](double t, const auto& check) {
    const auto [angle, rate, acceleration] = motion.at(t);
    const double s = std::sin(angle), c = std::cos(angle);
    check("rod.x_m", 0.5 * s);
    check("rod.y_m", -0.5 * c);
    check("rod.angle_rad", angle - 0.5 * pi);
    check("rod.omega_rad_per_s", rate);
    check("rod.alpha_rad_per_s2", acceleration);
    check("pivot.fx_N", 0.5 * (acceleration * c - rate * rate * s));
    check("pivot.fy_N", 0.5 * (acceleration * s + rate * rate * c) + g);
  });
}

BenchmarkErrors n_four_bar_errors(const Result& run, int loops) {
  // From the top at 1 m/s: theta = psi - pi/2.
  const PendulumMotion motion(std::sqrt(1.5 * g * (3.0 * loops + 1.0) / (4.0 * loops + 1.0)), pi,
                              -1.0);
  return compare_samples(run, [&](double t, const auto& check) {
    const auto p = motion.at(t);
    const Vec2 tip = rotate(p.angle - 0.5 * pi, {1.0, 0.0}), velocity = p.rate * perp(tip);
    for (int i = 0; i <= loops; ++i) {
      const auto compare_body = [&](const std::string& body, const Vec2& at, const Vec2& v,
                                    double angle, double rate) {
        check(body + ".x_m", at.x());
        check(body + ".y_m", at.y());
        check(body + ".angle_rad", angle);
        check(body + ".vx_m_per_s", v.x());
        check(body + ".vy_m_per_s", v.y());
        check(body + ".omega_rad_per_s", rate);
      };
      compare_body(fmt::format("link {}", i), Vec2(i, 0.0) + 0.5 * tip, 0.5 * velocity,
                   p.angle - 0.5 * pi, p.rate);
      if (i > 0)
        compare_body(fmt::format("bar {}", i), Vec2(i - 0.5, 0.0) + tip, velocity, 0.0, 0.0);
    }
  });
}

/// Case "parallelogram" with three cranks of 0.3 m and 0.5 kg and a coupler of 2 kg, from 1.1 rad
/// and 4 rad/s: w^2 = (2 r + 3 (0.5 r/2)) g / (2 r^2 + 3 (0.5 r^2/3)) = 1.1 g / r.
BenchmarkErrors parallelogram_errors(const Result& run) {
  const double r = 0.3;
  const PendulumMotion motion(std::sqrt(1.1 * g / r), 1.1 + 0.5 * pi, 4.0);
  return compare_samples(run, [&](double t, const auto& check) {
    const auto p = motion.at(t);
    const double angle = p.angle - 0.5 * pi;
    const Vec2 up = rotate(angle, {r, 0.0}), velocity = p.rate * perp(up);
    check("coupler.x_m", 0.5 + up.x());
    check("coupler.y_m", up.y());
    check("coupler.angle_rad", 0.0);
    check("coupler.vx_m_per_s", velocity.x());
    check("coupler.vy_m_per_s", velocity.y());
    for (const char* crank : {"crank 1", "crank 2", "crank 3"}) {
      check(fmt::format("{}.angle_rad", crank), angle);
      check(fmt::format("{}.omega_rad_per_s", crank), p.rate);
    }
  });
}

// ---- tables

BenchmarkErrors car_axis_errors(const Result& run) {
  const BenchmarkErrors early = compare(run, car_axis_early_reference());
  BenchmarkErrors errors = compare(run, car_axis_reference());
  errors.position = std::max(errors.position, early.position);
  errors.velocity = early.velocity;
  return errors;
}

BenchmarkErrors andrews_errors(const Result& run) {
  return run.summary.ok() ? andrews_difference(andrews_end(run), andrews_published())
                          : BenchmarkErrors{};
}

double andrews_finer_error(const Result& run) {
  static const AndrewsState reference = andrews_by_published_equations(0.03);
  return run.summary.ok() ? andrews_difference(andrews_end(run), reference).position
                          : BenchmarkErrors::none;
}

/// The numbers asked for, at 10 s.
BenchmarkErrors sprung_slider_crank_errors(const Result& run) {
  return compare(run, {{"crank.angle_rad", "rod.x_m", "rod.angle_rad"},
                       {{10.0, {1.27567584865, 1.02357855898, -0.49881304918}}}});
}

// ---- the list

Benchmark a02(int loops) {
  Benchmark b{.name = fmt::format("a02_n{}", loops),
              .title = fmt::format("A02, N-four-bar with N = {}, 10 s", loops),
              .description = fmt::format(
                  "IFToMM library: {} links, all in line twice a turn, where the rank falls by {}. "
                  "Jacobi's amplitude; positions and velocities of all bodies at 101 times.",
                  2 * loops + 1, loops),
              .model = [loops] { return n_four_bar({.loops = loops}); },
              .until = 10.0,
              .bars = {.position = 1e-7, .energy = 1e-8},
              .errors = [loops](const Result& run) { return n_four_bar_errors(run, loops); },
              .work_precision = loops == 10};
  if (loops > 10) {
    b.budget = 8.0;
    b.tolerances = [](std::string_view formulation) {
      const std::vector<double> all = usual_tolerances(formulation);
      return std::vector<double>(all.end() - 3, all.end());
    };
  }
  return b;
}

Benchmark andrews_benchmark(bool own) {
  return {.name = own ? "andrews_own_elements" : "andrews",
          .title = own ? "Andrews' mechanism again, with elements of its own"
                       : "Andrews' seven-body mechanism, 0.03 s",
          .description =
              own ? "One joint of six equations for four bodies and a spring, both from their "
                    "equation alone, differentiated automatically. The multipliers are the "
                    "problem's own."
                  : "Test set for IVP solvers: seven bodies, ten revolute joints, a spring, a "
                    "torque. Published values; all errors relative to each of the 27 numbers. The "
                    "forces at the three joints in E are the published multipliers.",
          .model = own ? andrews_own_elements : andrews,
          .until = 0.03,
          .samples = 31,
          .bars = {.position = 2e-9, .velocity = 1e-7, .acceleration = 3e-6, .reaction = 3e-6},
          .errors = andrews_errors,
          .finer_error = andrews_finer_error,
          .work_precision = !own};
}

/// Counts how often forces are asked for, and pushes nothing.
class ForceCounter final : public ForceElement {
 public:
  ForceCounter(BodyId body, long& count)
      : ForceElement("evaluations counted", {body}, {.position = false, .velocity = false}),
        count_(&count) {}
  void evaluate(const ForceInput&, const ForceRequest& out) const override {
    if (out.Q != nullptr) ++*count_;
  }

 private:
  long* count_;  // of one run, by one thread
};

double thread_time() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double worst_ratio(std::span<const double> values, std::span<const double> expected) {
  double error = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i)
    error = std::max(error, std::abs(values[i] / expected[i] - 1.0));
  return error;
}

bool meets_bar(double error, double bar) { return std::isnan(bar) || error <= bar; }

}  // namespace

BenchmarkErrors andrews_difference(const AndrewsState& s, const AndrewsState& expected) {
  return {.position = worst_ratio(s.p, expected.p),
          .velocity = worst_ratio(s.v, expected.v),
          .acceleration = worst_ratio(s.a, expected.a),
          .reaction = worst_ratio(s.lambda, expected.lambda)};
}

std::vector<Benchmark> benchmarks() {
  std::vector<Benchmark> all;
  all.push_back({.name = "pendulum",
                 .title = "A01, pendulum of a point mass, 10 s",
                 .description = "IFToMM library: 1 kg on a massless rod of 1 m, released "
                                "horizontal. Elliptic functions; position, velocity and the force "
                                "of the rod at 101 times.",
                 .model = point_pendulum,
                 .until = 10.0,
                 .bars = {.position = 1e-9, .reaction = 1e-9},
                 .errors = point_pendulum_errors});
  all.push_back({.name = "pendulum_2000s",
                 .title = "A01, pendulum of a point mass, 2000 s",
                 .description = "The same over 845 swings. Relative error of the period, from the "
                                "time by which the mass is early or late at the end.",
                 .model = point_pendulum,
                 .until = 2000.0,
                 .samples = 2001,
                 .bars = {.period = 1e-9},
                 .errors = point_pendulum_errors,
                 .period_error = point_pendulum_period_error,
                 .tolerances = [](std::string_view formulation) {
                   return std::vector<double>{usual_tolerances(formulation).back()};
                 }});
  all.push_back({.name = "rod_pendulum",
                 .title = "Pendulum of a rod, 10 s",
                 .description = "Uniform rod of 1 m and 1 kg, released horizontal. Elliptic "
                                "functions; motion and force of the pivot at 101 times.",
                 .model = rod_pendulum,
                 .until = 10.0,
                 .bars = {.position = 1e-9, .reaction = 1e-9},
                 .errors = rod_pendulum_errors});
  all.push_back({.name = "double_pendulum",
                 .title = "Double pendulum, 1 s",
                 .description = "Two such rods in a row, horizontal at rest. Quadruple precision; "
                                "all coordinates and reactions at 0.5 and 1 s.",
                 .model = double_pendulum,
                 .until = 1.0,
                 .bars = {.position = 1e-9, .reaction = 1e-9},
                 .errors = [](const Result& r) { return compare(r, double_pendulum_reference()); },
                 .work_precision = true});
  for (const int loops : {1, 2, 10, 40}) all.push_back(a02(loops));
  all.push_back(andrews_benchmark(false));
  all.push_back(andrews_benchmark(true));
  all.push_back({.name = "car_axis",
                 .title = "Car axis, 3 s",
                 .description = "Test set for IVP solvers, index 3, eps = 0.01: two masses of 5e-4 "
                                "kg on springs of 1 N/m over a moving axle. Quadruple precision; "
                                "positions at 0.1, 0.2 and 3 s, velocities at 0.1 and 0.2 s.",
                 .model = car_axis,
                 .until = 3.0,
                 .samples = 31,
                 .bars = {.position = 1e-9},
                 .errors = car_axis_errors,
                 .work_precision = true});
  all.push_back(
      {.name = "slider_crank_free",
       .title = "Ideal slider-crank, free, 0.2 s",
       .description = "Crank of 153 mm left alone at 150 rad/s, with gravity. Quadruple precision; "
                      "all coordinates and all reactions at four times.",
       .model = [] { return free_slider_crank(); },
       .until = 0.2,
       .bars = {.position = 1e-9, .reaction = 1e-9},
       .errors = [](const Result& r) { return compare(r, free_slider_crank_reference()); }});
  all.push_back(
      {.name = "slider_crank_driven",
       .title = "Ideal slider-crank, driven at 5000 rpm, one turn",
       .description = "Crank of 50 mm. Quadruple precision; all coordinates, all reactions and the "
                      "torque of the drive at four times.",
       .model = [] { return driven_slider_crank(); },
       .until = 0.012,
       .bars = {.position = 1e-9, .reaction = 1e-9},
       .errors = [](const Result& r) { return compare(r, driven_slider_crank_reference()); }});
  all.push_back({.name = "slider_crank_sprung",
                 .title = "Slider-crank with spring and damper (SUNDIALS), 10 s",
                 .description = "Example idasSlCrank_dns of SUNDIALS. Its numbers at 10 s: q = "
                                "1.27567584865, x = 1.02357855898, p = -0.49881304918.",
                 .model = sprung_slider_crank,
                 .until = 10.0,
                 .bars = {.position = 1e-9},
                 .errors = sprung_slider_crank_errors});
  all.push_back({.name = "parallelogram",
                 .title = "Over-closed parallelogram, 2 s",
                 .description = "A coupler on three cranks, one more than it needs, turning over "
                                "through the positions with all links in line. Elliptic functions; "
                                "101 times.",
                 .model =
                     [] {
                       const Case& c = find_case("parallelogram");
                       return make_model(c, Parameters(c.parameters));
                     },
                 .until = 2.0,
                 .bars = {.position = 1e-9},
                 .errors = parallelogram_errors});
  return all;
}

const Benchmark& find_benchmark(const std::vector<Benchmark>& all, std::string_view name) {
  std::vector<std::string> known;
  for (const Benchmark& b : all) {
    if (b.name == name) return b;
    known.push_back(b.name);
  }
  throw ModelError(fmt::format("unknown benchmark '{}'{}", name, suggestion(name, known)));
}

std::vector<double> usual_tolerances(std::string_view formulation) {
  for (const FormulationNote& f : formulations()) {
    if (f.name != formulation) continue;
    // A second-order method takes ten times the steps for a hundredth of the error.
    if (f.order <= 2) return {1e-3, 1e-4, 1e-5, 1e-6, 1e-7};
    if (f.family == "BDF" || f.family == "Adams")
      return {1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13};
  }
  return {1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12};
}

std::vector<double> tolerances_of(const Benchmark& benchmark, std::string_view formulation) {
  return benchmark.tolerances ? benchmark.tolerances(formulation) : usual_tolerances(formulation);
}

bool BenchmarkRun::meets(const BenchmarkBars& bars) const {
  return trouble.empty() && meets_bar(errors.position, bars.position) &&
         meets_bar(errors.velocity, bars.velocity) &&
         meets_bar(errors.acceleration, bars.acceleration) &&
         meets_bar(errors.reaction, bars.reaction) && meets_bar(energy, bars.energy) &&
         meets_bar(period_error, bars.period);
}

BenchmarkRun run_benchmark(const Benchmark& benchmark, const std::string& formulation,
                           double tolerance) {
  Model model = benchmark.model();
  long count = 0;
  model.insert(std::make_unique<ForceCounter>(BodyId{1}, count));
  const double began = thread_time();
  const Result run =
      simulate(model, {.until = benchmark.until,
                       .relative_tolerance = tolerance,
                       .formulation = formulation,
                       .samples = benchmark.samples,
                       .observer = [&](const Progress& p) {
                         return p.steps % 64 != 0 || thread_time() - began < benchmark.budget;
                       }});
  BenchmarkRun r{.formulation = formulation, .tolerance = tolerance};
  r.time = thread_time() - began;
  const Summary& s = run.summary;
  r.errors = benchmark.errors(run);
  r.finer_error = benchmark.finer_error ? benchmark.finer_error(run) : r.errors.position;
  if (benchmark.period_error) r.period_error = benchmark.period_error(run);
  r.energy = s.energy_exchanged > 0.0 ? s.energy_balance / s.energy_exchanged : 0.0;
  r.position_drift = std::max(s.position_drift, s.angle_drift);
  r.velocity_drift = std::max(s.velocity_drift, s.angular_velocity_drift);
  r.steps = s.steps;
  r.evaluations = count - s.recording_evaluations;
  r.jacobians = s.jacobians;
  r.reached = s.t_end;
  if (s.stop == Stop::interrupted)
    r.trouble = fmt::format("cut after {:g} s of processor time", benchmark.budget);
  else if (!s.ok())
    r.trouble = s.reason;
  else if (s.tolerance_kept > tolerance)  // it counts where it is asked for
    r.trouble =
        fmt::format("the tolerance was out of reach on the way; {:g} was kept", s.tolerance_kept);
  return r;
}

}  // namespace yoke::cases
