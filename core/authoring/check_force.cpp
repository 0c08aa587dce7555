// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <algorithm>
#include <cmath>

#include <yoke/core/authoring/check_tools.hpp>

namespace yoke::checking {
namespace {

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
  std::ptrdiff_t z = 0, contact = 0;
  for (std::size_t i = 0; i < model.forces().size(); ++i) {
    const auto& force = model.forces()[i];
    if (force.get() == &element) {
      std::copy_n(state.z.data() + z, owned.z.size(), owned.z.begin());
      std::copy_n(state.parameters.data() + model.first_parameter_of_force(i),
                  owned.parameters.size(), owned.parameters.begin());
      std::copy_n(state.contacts.begin() + contact, owned.contacts.size(), owned.contacts.begin());
      break;
    }
    z += static_cast<std::ptrdiff_t>(force->states().size());
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
  void fill_column(int c, int width, double scale, const Move& move, Values& of_Q, Values& of_z) {
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
      fill_column(
          c, columns_, step_scale(c, options_),
          [&](double h) { probe_.move_coordinate(id, c % 3, h); }, Qq, zq);
      fill_column(
          c, columns_, options_.rate, [&](double h) { probe_.move_velocity(id, c % 3, h); }, Qv,
          zv);
    }
    for (int c = 0; c < states_; ++c)
      fill_column(
          c, states_, options_.state, [&](double h) { owned_.z[index(c)] += h; }, Qz, zz);

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
    const double expected = all_.energy.supplied_power - all_.energy.dissipated_power - growth[0];
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

}  // namespace

bool check_at(const ForceElement& element, const Model& model, const State& state,
              const CheckOptions& options, ElementCheck& check) {
  return ForceChecker(element, model, state, options, check).run();
}

}  // namespace yoke::checking
