// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/core/check.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <span>

namespace yoke {
namespace {

using Values = std::vector<double>;

std::size_t index(int i) { return static_cast<std::size_t>(i); }

double largest(std::span<const double> values) {
  double size = 0.0;
  for (const double x : values) size = std::max(size, std::abs(x));
  return size;
}

// Uniform in +-(0.2 to 1): the same on every machine, and never near zero.
class Random {
 public:
  explicit Random(unsigned seed) : bits_(seed) {}
  double operator()() {
    const double u = static_cast<double>(bits_()) / 4294967296.0;
    const double size = 0.2 + 0.8 * static_cast<double>(bits_()) / 4294967296.0;
    return u < 0.5 ? -size : size;
  }

 private:
  std::mt19937 bits_;
};

// d f / d h at h = 0 by central differences, extrapolated to step zero (Ridders 1982): of all
// extrapolations the one whose neighbours agree best with it, entry by entry. The steps span four
// decades, so that truncation and rounding are both small somewhere.
Values differentiate(const std::function<Values(double h)>& f, double scale) {
  constexpr int levels = 14;
  const double first = 0.02 * scale;
  std::array<Values, levels> differences;
  double h = first;
  for (Values& difference : differences) {
    const Values right = f(h), left = f(-h);
    for (std::size_t i = 0; i < right.size(); ++i)
      difference.push_back((right[i] - left[i]) / (2.0 * h));
    h /= 2.0;
  }
  Values best(differences[0].size());
  for (std::size_t i = 0; i < best.size(); ++i) {
    std::array<double, levels> previous{}, current{};
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t level = 0; level < levels; ++level) {
      current[0] = differences[level][i];
      double factor = 4.0;
      for (std::size_t order = 1; order <= level; ++order, factor *= 4.0) {
        current[order] = (factor * current[order - 1] - previous[order - 1]) / (factor - 1.0);
        const double error = std::max(std::abs(current[order] - current[order - 1]),
                                      std::abs(current[order] - previous[order - 1]));
        if (error < least) {
          least = error;
          best[i] = current[order];
        }
      }
      previous = current;
    }
  }
  return best;
}

// The state an element is evaluated at, with the cosines and sines of the bodies.
class Probe {
 public:
  Probe(const Model& model, const State& state)
      : model_(&model), bodies_(model.bodies().size()), t_(state.t) {
    for (std::size_t i = 1; i < bodies_.size(); ++i) {
      const auto offset = static_cast<Eigen::Index>(3 * (i - 1));
      BodyMotion& b = bodies_[i];
      b.x = state.q[offset], b.y = state.q[offset + 1], b.angle = state.q[offset + 2];
      b.vx = state.v[offset], b.vy = state.v[offset + 1], b.omega = state.v[offset + 2];
      turn(b);
    }
  }

  Motion motion() const { return {.t = t_, .bodies = bodies_, .inertia = model_->bodies()}; }

  void advance_time(double h) { t_ += h; }
  void move_coordinate(BodyId id, int axis, double h) {
    BodyMotion& b = bodies_[index(id.index)];
    (axis == 0 ? b.x : axis == 1 ? b.y : b.angle) += h;
    turn(b);
  }
  void move_velocity(BodyId id, int axis, double h) {
    BodyMotion& b = bodies_[index(id.index)];
    (axis == 0 ? b.vx : axis == 1 ? b.vy : b.omega) += h;
  }
  /// Everything moves on with its velocity for the time h.
  void drift(double h) {
    t_ += h;
    for (BodyMotion& b : bodies_) {
      b.x += h * b.vx, b.y += h * b.vy, b.angle += h * b.omega;
      turn(b);
    }
  }
  /// Velocities of the given bodies, in the order of an element's columns.
  Values velocities(const std::vector<BodyId>& ids) const {
    Values v;
    for (const BodyId id : ids) {
      const BodyMotion& b = bodies_[index(id.index)];
      v.insert(v.end(), {b.vx, b.vy, b.omega});
    }
    return v;
  }

 private:
  static void turn(BodyMotion& b) { b.c = std::cos(b.angle), b.s = std::sin(b.angle); }

  const Model* model_;
  std::vector<BodyMotion> bodies_;
  double t_;
};

// Collects comparisons into an ElementCheck.
class Comparison {
 public:
  explicit Comparison(ElementCheck& check) : check_(check) {}

  void complain(const std::string& problem) {
    if (check_.problem.empty()) check_.problem = problem;
  }

  void require_finite_block(const char* name, const Values& block) {
    if (!std::ranges::all_of(block, [](double x) { return std::isfinite(x); }))
      complain(fmt::format("{} holds a number that is not finite", name));
  }

  /// Relative to the row, but a row of zeros is judged by its block, and a block of zeros by
  /// `natural`, the size rounding errors come from.
  void compare(const char* name, int rows, int columns, const Values& analytic,
               const Values& numeric, const std::vector<bool>& skip, double natural) {
    const double block = std::max({largest(analytic), largest(numeric), natural});
    for (int r = 0; r < rows; ++r) {
      const std::size_t start = index(r * columns), width = index(columns);
      const double row = std::max({largest(std::span(analytic).subspan(start, width)),
                                   largest(std::span(numeric).subspan(start, width)),
                                   1e-3 * block, std::numeric_limits<double>::min()});
      for (int c = 0; c < columns; ++c)
        if (!skip[index(c)])
          entry(name, r, c, analytic[start + index(c)], numeric[start + index(c)], row);
    }
  }

  /// The same block obtained in another way, equal up to rounding.
  void require_same(const char* name, const Values& alone, const Values& together) {
    const double size = std::max(largest(alone), largest(together));
    for (std::size_t i = 0; i < alone.size(); ++i)
      if (std::abs(alone[i] - together[i]) > 1e-11 * size)
        complain(fmt::format("{} asked for alone differs from {} asked for with the other blocks",
                             name, name));
  }

 private:
  void entry(const char* name, int r, int c, double analytic, double numeric, double scale) {
    ++check_.entries;
    double error = std::abs(analytic - numeric) / scale;
    if (!std::isfinite(error)) error = std::numeric_limits<double>::infinity();
    if (error <= check_.worst_error) return;
    check_.worst_error = error;
    check_.block = name;
    check_.row = r, check_.column = c;
    check_.analytic = analytic, check_.numeric = numeric;
  }

  ElementCheck& check_;
};

// Columns of the ground: it does not move, so what an element writes there is nobody's business.
std::vector<bool> ground_columns(const std::vector<BodyId>& bodies) {
  std::vector<bool> skip;
  for (const BodyId id : bodies) skip.insert(skip.end(), 3, id == ground);
  return skip;
}

double step_scale(int column, const CheckOptions& options) {
  return column % 3 == 2 ? options.angle : options.length;
}

// [s] within which the motion stays where the element is smooth.
double drift_scale(const Values& v, const CheckOptions& options) {
  double scale = options.time;
  for (std::size_t i = 0; i < v.size(); ++i)
    if (v[i] != 0.0)
      scale = std::min(scale, step_scale(static_cast<int>(i), options) / std::abs(v[i]));
  return scale;
}

bool any_nonzero(const Values& block, const std::vector<bool>& skip) {
  for (std::size_t i = 0; i < block.size(); ++i)
    if (block[i] != 0.0 && !skip[i % skip.size()]) return true;
  return false;
}

// ------------------------------------------------------------------------------------------ joints

struct ConstraintBlocks {
  Values phi, G, phi_t, gamma, H, K;
};

class ConstraintChecker {
 public:
  ConstraintChecker(const Constraint& element, const Model& model, const State& state,
                    const CheckOptions& options, ElementCheck& check)
      : element_(element),
        probe_(model, state),
        options_(options),
        rows_(element.rows()),
        columns_(element.columns()),
        skip_(ground_columns(element.bodies())),
        v_(probe_.velocities(element.bodies())),
        comparison_(check) {
    Random random(options.seed);
    for (int r = 0; r < rows_; ++r) lambda_.push_back(3.0 * random());
  }

  /// True if G was seen to be other than zero.
  bool run() {
    all_ = evaluate(true, true, true, true, true, true);
    check_finite();
    check_alone();
    check_pattern();
    check_by_position();
    check_by_time();
    return any_nonzero(all_.G, skip_);
  }

 private:
  ConstraintBlocks evaluate(bool phi, bool G, bool phi_t, bool gamma, bool H, bool K) const {
    const std::size_t rows = index(rows_), columns = index(columns_);
    ConstraintBlocks b{.phi = Values(rows),
                       .G = Values(rows * columns),
                       .phi_t = Values(rows),
                       .gamma = Values(rows),
                       .H = Values(rows * columns),
                       .K = Values(columns * columns)};
    element_.evaluate(probe_.motion(), {.phi = phi ? b.phi.data() : nullptr,
                                        .G = G ? b.G.data() : nullptr,
                                        .phi_t = phi_t ? b.phi_t.data() : nullptr,
                                        .gamma = gamma ? b.gamma.data() : nullptr,
                                        .H = H ? b.H.data() : nullptr,
                                        .K = K ? b.K.data() : nullptr,
                                        .lambda = K ? lambda_.data() : nullptr});
    return b;
  }

  void check_finite() {
    comparison_.require_finite_block("phi", all_.phi);
    comparison_.require_finite_block("G", all_.G);
    comparison_.require_finite_block("phi_t", all_.phi_t);
    comparison_.require_finite_block("gamma", all_.gamma);
    comparison_.require_finite_block("H", all_.H);
    comparison_.require_finite_block("K", all_.K);
  }

  void check_alone() {
    comparison_.require_same("phi", evaluate(true, false, false, false, false, false).phi,
                             all_.phi);
    comparison_.require_same("G", evaluate(false, true, false, false, false, false).G, all_.G);
    comparison_.require_same("phi_t", evaluate(false, false, true, false, false, false).phi_t,
                             all_.phi_t);
    comparison_.require_same("gamma", evaluate(false, false, false, true, false, false).gamma,
                             all_.gamma);
    comparison_.require_same("H", evaluate(false, false, false, false, true, false).H, all_.H);
    comparison_.require_same("K", evaluate(false, false, false, false, false, true).K, all_.K);
  }

  void check_pattern() {
    for (int r = 0; r < rows_; ++r)
      for (int c = 0; c < columns_; ++c) {
        const std::size_t i = index(r * columns_ + c);
        if (element_.in_pattern(r, c) || skip_[index(c)]) continue;
        if (all_.G[i] != 0.0 || all_.H[i] != 0.0)
          comparison_.complain(fmt::format(
              "row {} column {} is outside the declared pattern but G = {:g}, H = {:g} there", r, c,
              all_.G[i], all_.H[i]));
      }
    if (!element_.rheonomic() && largest(all_.phi_t) != 0.0)
      comparison_.complain("phi_t is not zero but rheonomic() says that phi does not depend on time");
  }

  // phi, G v + phi_t and G^T lambda one after the other, at the probe's place with v held.
  Values quantities() const {
    const ConstraintBlocks b = evaluate(true, true, true, false, false, false);
    Values f = b.phi;
    for (int r = 0; r < rows_; ++r) {
      double rate = b.phi_t[index(r)];
      for (int c = 0; c < columns_; ++c) rate += b.G[index(r * columns_ + c)] * v_[index(c)];
      f.push_back(rate);
    }
    for (int c = 0; c < columns_; ++c) {
      double force = 0.0;
      for (int r = 0; r < rows_; ++r) force += b.G[index(r * columns_ + c)] * lambda_[index(r)];
      f.push_back(force);
    }
    return f;
  }

  template <class Move>
  Values derivative(double scale, const Move& move) {
    const Probe here = probe_;
    const Values result = differentiate(
        [&](double h) {
          move(h);
          Values f = quantities();
          probe_ = here;
          return f;
        },
        scale);
    return result;
  }

  void check_by_position() {
    Values G(all_.G.size()), H(all_.H.size()), K(all_.K.size());
    for (int c = 0; c < columns_; ++c) {
      if (skip_[index(c)]) continue;
      const BodyId id = element_.bodies()[index(c / 3)];
      const Values d = derivative(step_scale(c, options_),
                                  [&](double h) { probe_.move_coordinate(id, c % 3, h); });
      for (int r = 0; r < rows_; ++r) {
        G[index(r * columns_ + c)] = d[index(r)];
        H[index(r * columns_ + c)] = d[index(rows_ + r)];
      }
      for (int i = 0; i < columns_; ++i)
        K[index(i * columns_ + c)] = d[index(2 * rows_ + i)];
    }
    forget_ground(all_.G, rows_);
    forget_ground(all_.H, rows_);
    forget_ground(all_.K, columns_);
    for (int i = 0; i < columns_; ++i)  // rows of the ground in K
      if (skip_[index(i)])
        for (int c = 0; c < columns_; ++c)
          all_.K[index(i * columns_ + c)] = K[index(i * columns_ + c)] = 0.0;
    const double size = largest(all_.G);
    comparison_.compare("G", rows_, columns_, all_.G, G, skip_, 0.0);
    comparison_.compare("H", rows_, columns_, all_.H, H, skip_, size * largest(v_));
    comparison_.compare("K", columns_, columns_, all_.K, K, skip_, size * largest(lambda_));
  }

  void forget_ground(Values& block, int rows) const {
    for (int r = 0; r < rows; ++r)
      for (int c = 0; c < columns_; ++c)
        if (skip_[index(c)]) block[index(r * columns_ + c)] = 0.0;
  }

  void check_by_time() {
    const std::vector<bool> keep{false};
    const double size = largest(all_.G), speed = largest(v_);
    const Values by_time =
        derivative(options_.time, [&](double h) { probe_.advance_time(h); });
    comparison_.compare("phi_t", rows_, 1, all_.phi_t,
                        Values(by_time.begin(), by_time.begin() + rows_), keep, size);
    const Values along = derivative(drift_scale(v_, options_), [&](double h) { probe_.drift(h); });
    Values gamma;
    for (int r = 0; r < rows_; ++r) gamma.push_back(-along[index(rows_ + r)]);
    comparison_.compare("gamma", rows_, 1, all_.gamma, gamma, keep, size * speed * speed);
  }

  const Constraint& element_;
  Probe probe_;
  const CheckOptions& options_;
  int rows_, columns_;
  std::vector<bool> skip_;
  Values v_, lambda_;
  ConstraintBlocks all_;
  Comparison comparison_;
};

// ------------------------------------------------------------------------------------------ forces

struct ForceBlocks {
  Values Q, dQ_dq, dQ_dv, dQ_dz, z_dot, dz_dq, dz_dv, dz_dz;
  Energy energy;
};

// What a force element owns in the state, found by its place in the model.
struct Owned {
  Values z, parameters;
  std::vector<ContactMemory> contacts;
};

Owned defaults_of(const ForceElement& element) {
  Owned owned;
  owned.z.resize(element.states().size());
  if (!owned.z.empty()) element.initial_states(owned.z.data());
  for (const Parameter& p : element.parameters()) owned.parameters.push_back(p.value);
  owned.contacts.resize(index(element.contacts()));
  return owned;
}

Owned owned_by(const ForceElement& element, const Model& model, const State& state) {
  Owned owned = defaults_of(element);
  std::ptrdiff_t z = 0, parameter = 0, contact = 0;
  for (const auto& force : model.forces()) {
    if (force.get() == &element) {
      std::copy_n(state.z.data() + z, owned.z.size(), owned.z.begin());
      std::copy_n(state.parameters.begin() + parameter, owned.parameters.size(),
                  owned.parameters.begin());
      std::copy_n(state.contacts.begin() + contact, owned.contacts.size(),
                  owned.contacts.begin());
      break;
    }
    z += static_cast<std::ptrdiff_t>(force->states().size());
    parameter += static_cast<std::ptrdiff_t>(force->parameters().size());
    contact += force->contacts();
  }
  return owned;
}

class ForceChecker {
 public:
  ForceChecker(const ForceElement& element, const Model& model, const State& state,
               const CheckOptions& options, ElementCheck& check)
      : element_(element),
        bodies_(element.bodies(model)),
        probe_(model, state),
        owned_(owned_by(element, model, state)),
        options_(options),
        columns_(3 * static_cast<int>(bodies_.size())),
        states_(static_cast<int>(owned_.z.size())),
        skip_(ground_columns(bodies_)),
        v_(probe_.velocities(bodies_)),
        comparison_(check) {}

  /// True if something was seen to be other than zero that ought to be.
  bool run() {
    all_ = evaluate([](int) { return true; });
    check_finite();
    check_alone();
    check_dependence();
    check_derivatives();
    check_power();
    return seen();
  }

 private:
  enum Block { Q, dQ_dq, dQ_dv, dQ_dz, z_dot, dz_dq, dz_dv, dz_dz, energy };

  template <class Wanted>
  ForceBlocks evaluate(const Wanted& wanted) const {
    const std::size_t n = index(columns_), nz = index(states_);
    ForceBlocks b{.Q = Values(n),
                  .dQ_dq = Values(n * n),
                  .dQ_dv = Values(n * n),
                  .dQ_dz = Values(n * nz),
                  .z_dot = Values(nz),
                  .dz_dq = Values(nz * n),
                  .dz_dv = Values(nz * n),
                  .dz_dz = Values(nz * nz),
                  .energy = {}};
    const auto pointer = [&](Block block, Values& values) {
      return wanted(block) ? values.data() : nullptr;
    };
    const Motion motion = probe_.motion();
    element_.evaluate({.motion = motion,
                       .z = owned_.z.data(),
                       .parameters = owned_.parameters.data(),
                       .contact = owned_.contacts.data()},
                      {.Q = pointer(Q, b.Q),
                       .dQ_dq = pointer(dQ_dq, b.dQ_dq),
                       .dQ_dv = pointer(dQ_dv, b.dQ_dv),
                       .dQ_dz = pointer(dQ_dz, b.dQ_dz),
                       .z_dot = pointer(z_dot, b.z_dot),
                       .dz_dq = pointer(dz_dq, b.dz_dq),
                       .dz_dv = pointer(dz_dv, b.dz_dv),
                       .dz_dz = pointer(dz_dz, b.dz_dz),
                       .energy = wanted(energy) ? &b.energy : nullptr});
    return b;
  }

  static Values energies(const Energy& e) {
    return {e.potential, e.stored, e.dissipated_power, e.supplied_power};
  }

  void check_finite() {
    comparison_.require_finite_block("Q", all_.Q);
    comparison_.require_finite_block("z_dot", all_.z_dot);
    comparison_.require_finite_block("energy", energies(all_.energy));
    // Derivatives that are not finite show as infinite errors.
  }

  void check_alone() {
    const auto alone = [&](Block block) {
      return evaluate([block](int wanted) { return wanted == block; });
    };
    comparison_.require_same("Q", alone(Q).Q, all_.Q);
    comparison_.require_same("dQ_dq", alone(dQ_dq).dQ_dq, all_.dQ_dq);
    comparison_.require_same("dQ_dv", alone(dQ_dv).dQ_dv, all_.dQ_dv);
    comparison_.require_same("dQ_dz", alone(dQ_dz).dQ_dz, all_.dQ_dz);
    comparison_.require_same("z_dot", alone(z_dot).z_dot, all_.z_dot);
    comparison_.require_same("dz_dq", alone(dz_dq).dz_dq, all_.dz_dq);
    comparison_.require_same("dz_dv", alone(dz_dv).dz_dv, all_.dz_dv);
    comparison_.require_same("dz_dz", alone(dz_dz).dz_dz, all_.dz_dz);
    comparison_.require_same("energy", energies(alone(energy).energy), energies(all_.energy));
  }

  void check_dependence() {
    const Dependence d = element_.dependence();
    if (!d.position && largest(all_.dQ_dq) != 0.0)
      comparison_.complain("dQ_dq is not zero but dependence().position is false");
    if (!d.velocity && largest(all_.dQ_dv) != 0.0)
      comparison_.complain("dQ_dv is not zero but dependence().velocity is false");
    if (!element_.dissipates() && all_.energy.dissipated_power != 0.0)
      comparison_.complain("dissipated_power is not zero but dissipates() is false");
    if (!element_.supplies() && all_.energy.supplied_power != 0.0)
      comparison_.complain("supplied_power is not zero but supplies() is false");
  }

  template <class Move, class Quantity>
  Values derivative(double scale, const Move& move, const Quantity& quantity) {
    const Probe probe = probe_;
    const Owned owned = owned_;
    return differentiate(
        [&](double h) {
          move(h);
          Values f = quantity();
          probe_ = probe;
          owned_ = owned;
          return f;
        },
        scale);
  }

  // Derivatives of (Q, z_dot) by one variable, put into column `c` of the two blocks.
  template <class Move>
  void fill_column(int c, int width, double scale, const Move& move, Values& of_Q,
                   Values& of_z) {
    const Values d = derivative(scale, move, [this] {
      const ForceBlocks b = evaluate([](int block) { return block == Q || block == z_dot; });
      Values f = b.Q;
      f.insert(f.end(), b.z_dot.begin(), b.z_dot.end());
      return f;
    });
    for (int r = 0; r < columns_; ++r) of_Q[index(r * width + c)] = d[index(r)];
    for (int r = 0; r < states_; ++r) of_z[index(r * width + c)] = d[index(columns_ + r)];
  }

  void check_derivatives() {
    Values Qq(all_.dQ_dq.size()), Qv(all_.dQ_dv.size()), Qz(all_.dQ_dz.size());
    Values zq(all_.dz_dq.size()), zv(all_.dz_dv.size()), zz(all_.dz_dz.size());
    for (int c = 0; c < columns_; ++c) {
      if (skip_[index(c)]) continue;
      const BodyId id = bodies_[index(c / 3)];
      fill_column(c, columns_, step_scale(c, options_),
                  [&](double h) { probe_.move_coordinate(id, c % 3, h); }, Qq, zq);
      fill_column(c, columns_, options_.rate,
                  [&](double h) { probe_.move_velocity(id, c % 3, h); }, Qv, zv);
    }
    for (int c = 0; c < states_; ++c)
      fill_column(c, states_, options_.state, [&](double h) { owned_.z[index(c)] += h; }, Qz, zz);

    forget_ground(all_.dQ_dq), forget_ground(Qq);
    forget_ground(all_.dQ_dv), forget_ground(Qv);
    const double force = largest(all_.Q), rate = largest(all_.z_dot);
    const std::vector<bool> keep(index(states_), false);
    comparison_.compare("dQ_dq", columns_, columns_, all_.dQ_dq, Qq, skip_, force);
    comparison_.compare("dQ_dv", columns_, columns_, all_.dQ_dv, Qv, skip_, force);
    comparison_.compare("dQ_dz", columns_, states_, all_.dQ_dz, Qz, keep, force);
    comparison_.compare("dz_dq", states_, columns_, all_.dz_dq, zq, skip_, rate);
    comparison_.compare("dz_dv", states_, columns_, all_.dz_dv, zv, skip_, rate);
    comparison_.compare("dz_dz", states_, states_, all_.dz_dz, zz, keep, rate);
  }

  // Forces on the ground do no work and move nothing.
  void forget_ground(Values& block) const {
    for (int r = 0; r < columns_; ++r)
      for (int c = 0; c < columns_; ++c)
        if (skip_[index(r)] || skip_[index(c)]) block[index(r * columns_ + c)] = 0.0;
  }

  void check_power() {
    double work = 0.0, size = 0.0;
    for (int c = 0; c < columns_; ++c) {
      work += all_.Q[index(c)] * v_[index(c)];
      size += std::abs(all_.Q[index(c)] * v_[index(c)]);
    }
    const Values growth = derivative(
        drift_scale(v_, options_),
        [&](double h) {
          probe_.drift(h);
          for (int i = 0; i < states_; ++i) owned_.z[index(i)] += h * all_.z_dot[index(i)];
        },
        [this] {
          const Energy e = evaluate([](int block) { return block == energy; }).energy;
          return Values{e.potential + e.stored};
        });
    const double expected =
        all_.energy.supplied_power - all_.energy.dissipated_power - growth[0];
    comparison_.compare("power", 1, 1, {work}, {expected}, {false}, size);
  }

  bool seen() const {
    const Dependence d = element_.dependence();
    if (!d.position && !d.velocity && states_ == 0) return any_nonzero(all_.Q, skip_);
    return any_nonzero(all_.dQ_dq, skip_) || any_nonzero(all_.dQ_dv, skip_) ||
           largest(all_.dQ_dz) != 0.0;
  }

  const ForceElement& element_;
  std::vector<BodyId> bodies_;
  Probe probe_;
  Owned owned_;
  const CheckOptions& options_;
  int columns_, states_;
  std::vector<bool> skip_;
  Values v_;
  ForceBlocks all_;
  Comparison comparison_;
};

template <class Checker, class Element>
ElementCheck check_at(const Element& element, const Model& model, const std::vector<State>& states,
                      const CheckOptions& options) {
  ElementCheck check;
  check.element = element.name();
  bool seen = false;
  for (const State& state : states)
    if (Checker(element, model, state, options, check).run()) seen = true;
  if (!seen && check.problem.empty())
    check.problem = "only zeros were seen: nothing has been checked at these states";
  return check;
}

std::vector<State> ugly_states(const Model& model, const CheckOptions& options) {
  std::vector<State> states;
  for (int i = 0; i < options.states; ++i)
    states.push_back(ugly_state(model, options.seed + static_cast<unsigned>(i)));
  return states;
}

double spread(const Model& model) {
  double size = 0.3;  // [m] for models whose bodies start in one place
  for (std::size_t i = 2; i < model.bodies().size(); ++i)
    size = std::max(size,
                    (model.bodies()[i].pose.position - model.bodies()[1].pose.position).norm());
  return size;
}

}  // namespace

std::string ElementCheck::message() const {
  std::string text = fmt::format(
      "'{}': {} entries compared, worst error {:.2g} in {}({}, {}): {:.15g}, by differences {:.15g}",
      element, entries, worst_error, block, row, column, analytic, numeric);
  return problem.empty() ? text : text + "; " + problem;
}

ElementCheck check_element(const Constraint& element, const Model& model, const State& state,
                           const CheckOptions& options) {
  return check_at<ConstraintChecker>(element, model, {state}, options);
}

ElementCheck check_element(const ForceElement& element, const Model& model, const State& state,
                           const CheckOptions& options) {
  return check_at<ForceChecker>(element, model, {state}, options);
}

ElementCheck check_element(const Constraint& element, const Model& model,
                           const CheckOptions& options) {
  return check_at<ConstraintChecker>(element, model, ugly_states(model, options), options);
}

ElementCheck check_element(const ForceElement& element, const Model& model,
                           const CheckOptions& options) {
  return check_at<ForceChecker>(element, model, ugly_states(model, options), options);
}

std::vector<ElementCheck> check_elements(const Model& model, const CheckOptions& options) {
  std::vector<ElementCheck> checks;
  for (const auto& constraint : model.constraints())
    checks.push_back(check_element(*constraint, model, options));
  for (const auto& force : model.forces())
    checks.push_back(check_element(*force, model, options));
  return checks;
}

State ugly_state(const Model& model, unsigned seed) {
  Random random(seed);
  State state = model.start_state();
  const double size = spread(model);
  state.t = 0.5 + 0.4 * random();
  for (Eigen::Index i = 0; i < state.q.size(); ++i) {
    const bool angle = i % 3 == 2;
    state.q[i] += (angle ? 2.0 : size) * random();
    state.v[i] += (angle ? 7.0 : 3.0) * random();
  }
  for (Eigen::Index i = 0; i < state.z.size(); ++i) state.z[i] += random();
  return state;
}

}  // namespace yoke
