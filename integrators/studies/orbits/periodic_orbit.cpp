// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/studies/orbits/periodic_orbit.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <yoke/core/error.hpp>
#include <yoke/integrators/simulation.hpp>
#include <yoke/integrators/studies/linearised/memory_numbers.hpp>
#include <yoke/integrators/studies/orbits/variation.hpp>

namespace yoke {

namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

constexpr double free_direction = 1e-7;  // of the largest singular value: equations leave it free
constexpr double near_circle = 1e-2;     // distance at which a bifurcation is named
constexpr double on_circle = 1e-5;       // to which a multiplier is known, at least
constexpr double same_volume = 1e-6;     // of a determinant
constexpr double family = 1e-2;   // two multipliers at 1 are known to the root of their error
constexpr double readily = 30.0;  // of a family the member near by is taken: rather another period
constexpr double earliest = 0.6, latest = 1.6;  // of a guessed period
constexpr int looks = 500;                      // at it
constexpr double at_rest = 1e-6;                // a speed in scales of the model
constexpr int most_halvings = 8;                // of a step of Newton's
constexpr double longest_change = 0.25;         // of the period in one step

/// How one period misses its start.
struct Miss {
  Vector q, v, z, memory;
  double size = std::numeric_limits<double>::infinity();
  std::string worst;
};

/// Of a number that has no scale but itself.
double size_of(double x, double y) {
  const double size = std::max(std::abs(x), std::abs(y));
  return size > 0.0 ? size : 1.0;
}

class Shooting {
 public:
  Shooting(const Model& model, const PeriodicOrbitOptions& options)
      : model_(model), options_(options), system_(model), numbers_(system_) {}
  PeriodicOrbit search(const State& start);

 private:
  bool look(const State& start, double period);
  bool improve();
  Miss miss(const FlowDerivative& d) const;
  void write(PeriodicOrbit& orbit) const;
  void classify(PeriodicOrbit& orbit) const;
  Vector allowed(const Vector& dq, const Vector& dv, const Vector& dz) const;
  Matrix monodromy() const;
  bool keeps_volumes() const { return std::abs(flow_.matrix.determinant() - 1.0) < same_volume; }
  double speed() const;
  double guess_period(const State& start) const;
  std::vector<bool> trivial_ones(const std::vector<std::complex<double>>& values) const;
  State moved(const Vector& y) const;

  const Model& model_;
  const PeriodicOrbitOptions& options_;
  System system_;
  MemoryNumbers numbers_;
  double period_ = 0.0;
  FlowDerivative flow_;
  Miss miss_;
  std::string failure_;
};

/// y of a difference, in the basis of the start.
Vector Shooting::allowed(const Vector& dq, const Vector& dv, const Vector& dz) const {
  const Matrix& N = flow_.start_basis;
  Vector mass(dq.size());
  for (int i = 0; i < model_.body_count(); ++i) {
    const Body& body = model_.bodies()[static_cast<std::size_t>(i + 1)];
    mass.segment<3>(3 * i) = Eigen::Vector3d(body.mass, body.mass, body.inertia);
  }
  Vector y(2 * N.cols() + dz.size());
  y << N.transpose() * mass.cwiseProduct(dq), N.transpose() * mass.cwiseProduct(dv), dz;
  return y;
}

Miss Shooting::miss(const FlowDerivative& d) const {
  const State &a = d.start, &b = d.run.final;
  const Summary& s = d.run.summary;
  Miss m{.q = b.q - a.q,
         .v = b.v - a.v,
         .z = b.z - a.z,
         .memory = d.memory_at_end - d.memory_at_start,
         .size = 0.0,
         .worst = {}};
  const auto note = [&](double size, const auto& name) {
    if (!(size > m.size)) return;
    m.size = size;
    m.worst = name();
  };
  constexpr const char* coordinates[] = {"x", "y", "angle"};
  constexpr const char* rates[] = {"vx", "vy", "omega"};
  for (Eigen::Index i = 0; i < m.q.size(); ++i) {
    const bool angle = i % 3 == 2;
    if (angle && options_.whole_turns) m.q[i] -= 2.0 * pi * std::round(m.q[i] / (2.0 * pi));
    const double unit = angle ? 1.0 : s.length_scale;
    const std::string& body = model_.bodies()[static_cast<std::size_t>(i / 3 + 1)].name;
    note(std::abs(m.q[i]) / unit, [&] { return body + "." + coordinates[i % 3]; });
    note(std::abs(m.v[i]) * s.time_scale / unit, [&] { return body + "." + rates[i % 3]; });
  }
  for (Eigen::Index i = 0; i < m.z.size(); ++i)
    note(std::abs(m.z[i]) / size_of(a.z[i], b.z[i]),
         [&] { return fmt::format("state {} of an element", i + 1); });
  for (Eigen::Index i = 0; i < m.memory.size(); ++i)
    note(std::abs(m.memory[i]) / size_of(d.memory_at_start[i], d.memory_at_end[i]),
         [&] { return d.memory[static_cast<std::size_t>(i)]; });
  return m;
}

/// A period from `start`; false if it cannot be run to its end.
bool Shooting::look(const State& start, double period) {
  SimulationOptions run = options_.run;
  run.until = start.t + period;
  run.checkpoints = {};
  const bool first = flow_.start_basis.size() == 0;
  FlowDerivative next;
  try {
    next = flow_derivative(model_, start, run);
  } catch (const ModelError& error) {
    if (first) throw;  // the model has no orbits, whatever the start
    failure_ = error.what();
    return false;
  }
  if (next.run.summary.stop != Stop::completed) {
    failure_ = next.run.summary.reason;
    if (first) flow_ = std::move(next);
    return false;
  }
  const Miss there = miss(next);
  if (!first && !(there.size < miss_.size)) return false;
  flow_ = std::move(next);
  miss_ = there;
  period_ = period;
  return true;
}

State Shooting::moved(const Vector& y) const {
  const Eigen::Index f = flow_.start_basis.cols();
  State state = flow_.start;
  state.q += flow_.start_basis * y.head(f);
  state.v += flow_.start_basis * y.segment(f, f) + flow_.start_basis_rate * y.head(f);
  const Eigen::Index s = 2 * f + state.z.size();
  state.z += y.segment(2 * f, state.z.size());
  for (int i = 0; i < numbers_.contact_numbers(); ++i)
    for (std::size_t k = 0; k < flow_.memory.size(); ++k)
      if (flow_.memory[k] == numbers_.name(i))
        numbers_.add(state, i, y[s + static_cast<Eigen::Index>(k)]);
  return state;
}

/// A step of Newton's, halved until it comes nearer. False if none does.
bool Shooting::improve() {
  const State &a = flow_.start, &b = flow_.run.final;
  const Eigen::Index f = flow_.start_basis.cols(), nz = a.z.size();
  const Eigen::Index s = flow_.matrix.cols(), numbers = miss_.memory.size();
  const double time = flow_.run.summary.time_scale;
  // Rows and columns in lengths: velocities times the time scale, states by their size.
  Vector unit = Vector::Ones(s);
  unit.segment(f, f).setConstant(1.0 / time);
  for (Eigen::Index i = 0; i < nz; ++i) unit[2 * f + i] = size_of(a.z[i], b.z[i]);
  for (Eigen::Index i = 0; i < numbers; ++i)
    unit[2 * f + nz + i] = size_of(flow_.memory_at_start[i], flow_.memory_at_end[i]);
  const auto extended = [&](const Vector& q, const Vector& v, const Vector& z,
                            const Vector& memory) -> Vector {
    Vector y(s);
    y << allowed(q, v, z), memory;
    return y.cwiseQuotient(unit);
  };
  const Vector miss = extended(miss_.q, miss_.v, miss_.z, miss_.memory);
  Matrix J = monodromy() - Matrix::Identity(s, s);
  J = unit.cwiseInverse().asDiagonal() * J * unit.asDiagonal();
  Vector right = -miss;
  if (options_.autonomous) {
    const auto rate = [&](const State& x) -> Vector {
      return extended(x.v, x.a, Vector::Zero(nz), Vector::Zero(numbers)) * time;
    };
    const Vector at_start = rate(a), at_end = rate(b);
    const double size = at_start.norm();
    J.conservativeResize(s + 1, s + 1);
    J.col(s) << readily * at_end, 0.0;
    J.row(s).head(s) = at_start.transpose() / std::max(size, 1e-300);
    right.conservativeResize(s + 1);
    right[s] = 0.0;  // no change along the motion: another place of the same orbit
  }
  Eigen::JacobiSVD<Matrix> svd(J, Eigen::ComputeThinU | Eigen::ComputeThinV);
  svd.setThreshold(free_direction);
  const Vector step = svd.solve(right);
  const double longer = options_.autonomous ? readily * step[s] * time : 0.0;
  double share = 1.0;
  if (std::abs(longer) > longest_change * period_)
    share = longest_change * period_ / std::abs(longer);
  for (int i = 0; i < most_halvings; ++i, share *= 0.5)
    if (look(moved(share * step.head(s).cwiseProduct(unit)), period_ + share * longer)) return true;
  return false;
}

/// Of an autonomous motion: when the start comes back nearest.
double Shooting::guess_period(const State& start) const {
  SimulationOptions run = options_.run;
  run.until = start.t + latest * options_.period;
  run.samples = 0;
  run.checkpoints = {};
  Simulation trial(model_, start, run);
  FlowDerivative beside;
  beside.start = trial.state();
  double best = options_.period, least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= looks; ++i) {
    const double after = (earliest + (latest - earliest) * i / looks) * options_.period;
    if (!trial.advance_to(std::min(start.t + after, run.until))) break;
    beside.run.final = trial.state();
    beside.run.summary = trial.summary();
    if (const double size = miss(beside).size; size < least) least = size, best = after;
  }
  return best;
}

/// Of the start, in length scales or rad and time scales, with the acceleration.
double Shooting::speed() const {
  const Summary& s = flow_.run.summary;
  double fastest = 0.0;
  for (Eigen::Index i = 0; i < flow_.start.v.size(); ++i) {
    const double unit = i % 3 == 2 ? 1.0 : s.length_scale;
    fastest = std::max({fastest, std::abs(flow_.start.v[i]) * s.time_scale / unit,
                        std::abs(flow_.start.a[i]) * s.time_scale * s.time_scale / unit});
  }
  return fastest;
}

PeriodicOrbit Shooting::search(const State& start) {
  PeriodicOrbit orbit;
  const double period = options_.autonomous ? guess_period(start) : options_.period;
  if (!look(start, period)) {
    orbit.period = period;
    orbit.start = flow_.start;
    orbit.run = std::move(flow_.run);
    orbit.reason = "the first period could not be run: " + failure_;
    return orbit;
  }
  orbit.residuals.push_back(miss_.size);
  while (miss_.size > options_.tolerance &&
         std::ssize(orbit.residuals) <= options_.largest_iterations && improve())
    orbit.residuals.push_back(miss_.size);
  orbit.found = miss_.size <= options_.tolerance;
  const auto steps = orbit.residuals.size() - 1;
  orbit.reason =
      orbit.found
          ? fmt::format("returns within {:.2g} after {} steps of Newton's method", miss_.size,
                        steps)
          : fmt::format(
                "no orbit: after {} steps of Newton's method '{}' misses its start by {:.3g} (in "
                "length scales, rad, time scales){}{}",
                steps, miss_.worst, miss_.size,
                static_cast<int>(steps) >= options_.largest_iterations
                    ? ""
                    : ", and no smaller step comes nearer",
                failure_.empty() ? "" : "; a run on the way failed: " + failure_);
  write(orbit);
  if (orbit.found && options_.autonomous && speed() < at_rest) {
    orbit.found = false;
    orbit.reason = "no orbit: the search came to an equilibrium, where every period is one";
  }
  return orbit;
}

/// The derivative over the period, the end in the basis of the start, to which the motion returns.
Matrix Shooting::monodromy() const {
  const Eigen::Index s = 2 * flow_.start_basis.cols() + flow_.start.z.size();
  Matrix matrix = flow_.matrix;
  for (Eigen::Index i = 0; i < matrix.cols(); ++i)
    matrix.col(i).head(s) = allowed(flow_.dq.col(i), flow_.dv.col(i), flow_.dz.col(i));
  return matrix;
}

void Shooting::write(PeriodicOrbit& orbit) const {
  orbit.period = period_;
  orbit.start = flow_.start;
  orbit.run = flow_.run;
  orbit.worst = miss_.worst;
  orbit.residual = miss_.size;
  orbit.monodromy = monodromy();
  orbit.basis = flow_.start_basis;
  orbit.basis_rate = flow_.start_basis_rate;
  orbit.degrees_of_freedom = flow_.degrees_of_freedom;
  orbit.memory = flow_.memory;
  orbit.notes = flow_.notes;
  orbit.determinant = orbit.monodromy.determinant();
  classify(orbit);
}

void Shooting::classify(PeriodicOrbit& orbit) const {
  const Eigen::VectorXcd values = orbit.monodromy.eigenvalues();
  std::vector<std::complex<double>> sorted(values.begin(), values.end());
  std::ranges::sort(sorted, [](auto x, auto y) {
    return std::abs(x) != std::abs(y) ? std::abs(x) > std::abs(y) : x.imag() > y.imag();
  });
  const std::vector<bool> trivial = trivial_ones(sorted);
  orbit.multipliers.clear();
  double nearest = near_circle;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const std::complex<double> value = sorted[i];
    orbit.multipliers.push_back({value, trivial[i]});
    if (trivial[i]) continue;
    orbit.largest_multiplier = std::max(orbit.largest_multiplier, std::abs(value));
    const double distance = std::abs(std::abs(value) - 1.0);
    if (distance >= nearest) continue;
    const bool real = std::abs(value.imag()) < near_circle;
    if (!real && keeps_volumes()) continue;
    nearest = distance;
    orbit.bifurcation = !real              ? BifurcationKind::neimark_sacker
                        : value.real() > 0 ? BifurcationKind::fold
                                           : BifurcationKind::flip;
  }
  // Where all are trivial those of a model that keeps volumes say nothing, else there are none but 1.
  const bool silent = keeps_volumes() && orbit.largest_multiplier == 0.0;
  const double excess = silent ? 0.0 : orbit.largest_multiplier - 1.0;
  orbit.stability = excess > on_circle    ? OrbitStability::unstable
                    : excess < -on_circle ? OrbitStability::stable
                                          : OrbitStability::neutral;
}

/// Of an autonomous model the one nearest to 1, along the orbit, and if volumes last (a conservative one) the
/// next, across the family; and one for each memory that lasts.
std::vector<bool> Shooting::trivial_ones(const std::vector<std::complex<double>>& values) const {
  std::vector<bool> trivial(values.size(), false);
  std::size_t count = options_.autonomous ? 1 : 0;
  const Eigen::Index s = 2 * flow_.start_basis.cols() + flow_.start.z.size();
  for (Eigen::Index i = s; i < flow_.matrix.rows(); ++i)
    if (flow_.matrix(i, i) == 1.0 && flow_.matrix.row(i).head(s).isZero(0.0)) ++count;
  if (options_.autonomous && keeps_volumes())
    count += static_cast<std::size_t>(std::ranges::count_if(
                 values, [](auto x) { return std::abs(x - 1.0) < family; })) > 1;
  for (; count > 0; --count) {
    std::optional<std::size_t> nearest;
    for (std::size_t i = 0; i < values.size(); ++i)
      if (!trivial[i] && (!nearest || std::abs(values[i] - 1.0) < std::abs(values[*nearest] - 1.0)))
        nearest = i;
    if (nearest) trivial[*nearest] = true;
  }
  return trivial;
}

void check(const PeriodicOrbitOptions& o) {
  const std::string owner = "periodic orbit";
  require_positive(owner, "period", o.period, "s");
  require_range(owner, "settle", o.settle, 0.0, std::numeric_limits<double>::max(), "s");
  require_range(owner, "tolerance", o.tolerance, 1e-12, 1e-2, "");
  if (o.largest_iterations < 1)
    throw ModelError(
        fmt::format("{}: largest_iterations = {} must be at least 1", owner, o.largest_iterations));
}

}  // namespace

std::string_view name_of(OrbitStability stability) {
  switch (stability) {
    case OrbitStability::stable:
      return "stable";
    case OrbitStability::unstable:
      return "unstable";
    default:
      return "neutral";
  }
}

std::string_view name_of(BifurcationKind bifurcation) {
  switch (bifurcation) {
    case BifurcationKind::fold:
      return "fold";
    case BifurcationKind::flip:
      return "flip";
    case BifurcationKind::neimark_sacker:
      return "neimark_sacker";
    default:
      return "none";
  }
}

PeriodicOrbit periodic_orbit(const Model& model, const State& start,
                             const PeriodicOrbitOptions& options) {
  check(options);
  State from = start;
  if (options.settle > 0.0) {
    SimulationOptions run = options.run;
    run.until = start.t + options.settle;
    run.samples = 0;
    run.checkpoints = {};
    Result settled = simulate(model, start, run);
    if (settled.summary.stop != Stop::completed) {
      PeriodicOrbit none;
      none.reason = "settling did not come to its end: " + settled.summary.reason;
      none.period = options.period;
      none.start = settled.final;
      none.run = std::move(settled);
      return none;
    }
    from = settled.final;
  }
  return Shooting(model, options).search(from);
}

PeriodicOrbit periodic_orbit(const Model& model, const PeriodicOrbitOptions& options) {
  return periodic_orbit(model, model.start_state(), options);
}

}  // namespace yoke
