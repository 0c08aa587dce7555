// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/core/equations/grips/grips.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <yoke/core/equations/assemblies.hpp>
#include <yoke/core/equations/linear/index.hpp>

namespace yoke {

namespace {

constexpr double at_limit = 1e-12;     // of the holding force: no more is kept for rounding
constexpr double same_instant = 1e-9;  // of the holding force
constexpr double immobile = 1e-10;     // of the mobility of the bodies without constraints
// With other friction at rest, of the mobility without. Two feet of one body are not quite at one height
// where they penetrate differently: their rows tell that difference from zero, their friction does not.
constexpr double hardly_mobile = 1e-6;
constexpr double mobile_by_rounding = 1e-13;  // of the mobility of the bodies without constraints
constexpr double no_acceleration = 1e-9;      // of its terms
constexpr double next_to_no_friction = 1e-6;  // of the holding force
constexpr double cancelled = 1e-12;           // of the reactions that hold a structure at rest

/// The row of one hold at the motion set, whether it holds or not.
struct Row {
  std::vector<double> s;
  double drift = 0.0, gamma = 0.0;
};

Row row_of(const System& system, const ForceSlot& f) {
  Row row;
  row.s.assign(at(f.columns), 0.0);
  f.element->calc_hold(system.force_input(f),
                       {.G = row.s.data(), .phi_t = &row.drift, .gamma = &row.gamma});
  return row;
}

/// A sum and the size of its terms.
struct Sum {
  double value = 0.0, size = 0.0;
  void add(double term) {
    value += term;
    size += std::abs(term);
  }
};

Sum product(const System& system, const ForceSlot& f, const Row& row, const Eigen::VectorXd& x) {
  Sum sum;
  for (int j = 0; j < f.columns; ++j)
    if (const int dof = system.dof()[at(f.dofs + j)]; dof >= 0) sum.add(row.s[at(j)] * x[dof]);
  return sum;
}

/// [m/s] s v + s_t
Sum sliding_speed(const System& system, const ForceSlot& f, const Row& row,
                  const Eigen::VectorXd& v) {
  Sum speed = product(system, f, row, v);
  speed.add(row.drift);
  return speed;
}

class Settlement {
 public:
  Settlement(Dynamics& dynamics, State& state, std::span<const ContactMemory> before)
      : dynamics_(dynamics), system_(dynamics.system()), state_(state) {
    set_motion();
    for (const ConstraintSlot& hold : system_.holds()) consider(hold, before);
    if (!candidates_.empty()) assembly_ = assemblies_of(system_);
    if (std::ranges::any_of(candidates_, &Candidate::broke)) break_with_it(before);
  }

  Outcome settle() {
    if (candidates_.empty()) return {};
    const int worst_first = 2 * static_cast<int>(candidates_.size());
    const int most = 10 + 8 * static_cast<int>(candidates_.size());
    for (int round = 0; round < most; ++round) {
      if (!try_grips()) return {false, "accelerations are not finite" + names()};
      if (!pivot(round >= worst_first)) return finish();
    }
    return {false, "no friction forces are consistent" + names()};
  }

 private:
  struct Candidate {
    const ForceSlot* f;
    ContactMemory* memory;
    Row row;
    bool rests = true;
    bool broke = false;  // must not hold again at this instant
    bool guided = false;
    double alone = 0.0;      // [1/kg] mobility of the bodies without constraints
    double free = 0.0;       // [1/kg] mobility where nothing holds
    double direction = 0.0;  // +1, -1 of one that slides
  };

  void set_motion() {
    system_.bind(state_);
    system_.set_motion(state_.t, state_.q.data(), state_.v.data());
    system_.set_states(state_.z.data());
  }

  void consider(const ConstraintSlot& hold, std::span<const ContactMemory> before) {
    const ForceSlot& f = system_.forces()[at(hold.hold)];
    ContactMemory& memory = state_.contacts[at(f.contacts)];
    const Grip grip = memory.grip;
    if (grip == Grip::none) return;
    Candidate c{.f = &f, .memory = &memory, .row = row_of(system_, f)};
    if (grip == Grip::forward || grip == Grip::backward) {
      const Grip earlier = before[at(f.contacts)].grip;
      c.broke = earlier == Grip::held || earlier == Grip::carried;
      c.direction = grip == Grip::forward ? 1.0 : -1.0;
      const Sum speed = sliding_speed(system_, f, c.row, state_.v);
      const double slowest = 2.0 * slowest_sliding(system_.scales(), speed.size);
      if (c.direction * speed.value > slowest) return;  // it slides
      c.rests = !c.broke;
    }
    candidates_.push_back(std::move(c));
  }

  /// What was at its limit at the same instant breaks too: what a break leaves to others is a matter of
  /// how they share, of which nothing is known for certain.
  void break_with_it(std::span<const ContactMemory> before) {
    const auto earlier = [&](const Candidate& c) { return before[at(c.f->contacts)].grip; };
    for (Candidate& c : candidates_)
      if (rests(earlier(c))) c.memory->grip = earlier(c);
    if (!dynamics_.calc_accelerations(state_)) return;
    dynamics_.share_hold_forces(state_.lambda.data());
    for (Candidate& c : candidates_) {
      const Grip grip = earlier(c);
      if (grip != Grip::held && grip != Grip::carried) continue;
      const ForceInput in = system_.force_input(*c.f);
      if (std::abs(*in.hold) < c.f->element->holding_force(in) * (1.0 - same_instant)) continue;
      c.rests = false;
      c.broke = true;
      c.direction = *in.hold < 0.0 ? -1.0 : 1.0;
    }
  }

  /// Accelerations and friction forces if the candidates do what they are thought to do.
  bool try_grips() {
    for (Candidate& c : candidates_)
      c.memory->grip = c.rests ? Grip::carried : c.direction > 0.0 ? Grip::forward : Grip::backward;
    if (!dynamics_.calc_accelerations(state_)) return false;
    for (Candidate& c : candidates_) {  // nothing is held yet
      c.free = dynamics_.mobility(*c.f, c.row.s.data(), c.alone);
      c.guided = !(c.free > immobile * c.alone);
      if (c.rests && c.guided) c.memory->grip = Grip::guided;
    }
    for (Candidate& c : candidates_) {
      if (!c.rests || c.guided || hangs_on_others(c)) continue;
      c.memory->grip = Grip::held;
      if (!dynamics_.calc_accelerations(state_) && !let_slide(c)) return false;
    }
    dynamics_.share_hold_forces(state_.lambda.data());
    measure_reactions();
    return true;
  }

  bool hangs_on_others(Candidate& c) {
    const double mobility = dynamics_.mobility(*c.f, c.row.s.data(), c.alone);
    return !(mobility > std::max(hardly_mobile * c.free, mobile_by_rounding * c.alone));
  }

  /// Where nothing can move, accelerations are what rounding leaves of reactions that cancel the loads: the
  /// terms of s a are as small then as their sum and say nothing of it.
  void measure_reactions() {
    jolt_.assign(assembly_.size(), 0.0);
    for (const ConstraintSlot& c : system_.constraints())
      for (int i = 0; i < c.rows; ++i)
        for (int j = 0; j < c.columns; ++j)
          if (const int dof = system_.dof()[at(c.dofs + j)]; dof >= 0)
            note_reaction(dof, system_.G()[c.block + i * c.columns + j] * state_.lambda[c.row + i]);
  }
  void note_reaction(int dof, double pull) {
    const double mass = system_.mass()[at(dof)];
    if (mass == 0.0) return;  // it moves as others do
    double& jolt = jolt_[at(assembly_[at(dof / 3)])];
    jolt = std::max(jolt, std::abs(pull) / mass * unit_of(dof));
  }
  /// [m] An angle times this is a length.
  double unit_of(int dof) const { return dof % 3 == 2 ? system_.scales().length : 1.0; }

  /// [m/s^2] What an acceleration along the surface may be by rounding; no less than what makes the slowest
  /// sliding within the time scale.
  double noise(const Candidate& c, const Sum& along) const {
    const Scales scales = system_.scales();
    double noise = slowest_sliding(scales, 0.0) / scales.time + no_acceleration * along.size;
    for (int j = 0; j < c.f->columns; ++j)
      if (const int dof = system_.dof()[at(c.f->dofs + j)]; dof >= 0)
        noise +=
            cancelled * std::abs(c.row.s[at(j)]) * jolt_[at(assembly_[at(dof / 3)])] / unit_of(dof);
    return noise;
  }

  /// No reactions let it rest: it slides the way it would be accelerated without friction.
  bool let_slide(Candidate& c) {
    c.memory->grip = Grip::carried;
    if (!dynamics_.calc_accelerations(state_)) return false;
    c.rests = false;
    c.broke = true;
    c.direction = acceleration(c).value < 0.0 ? -1.0 : 1.0;
    c.memory->grip = c.direction > 0.0 ? Grip::forward : Grip::backward;
    return dynamics_.calc_accelerations(state_);
  }

  /// Changes the worst, or the first, of what is not as it was thought to be. False: all is.
  bool pivot(bool first) {
    Candidate* worst = nullptr;
    double most = 0.0, direction = 0.0;
    for (Candidate& c : candidates_) {
      const auto [violation, way] = c.rests ? of_rest(c) : of_sliding(c);
      if (!(violation > most)) continue;
      worst = &c;
      most = violation;
      direction = way;
      if (first) break;
    }
    if (worst == nullptr) return false;
    worst->rests = !worst->rests && !worst->broke;
    worst->direction = direction;
    return true;
  }

  struct Verdict {
    double violation, direction;
  };

  Verdict of_rest(const Candidate& c) const {
    const ForceInput in = system_.force_input(*c.f);
    const double limit = c.f->element->holding_force(in) * (1.0 - at_limit), T = *in.hold;
    const double way = T < 0.0 ? -1.0 : 1.0;
    if (std::abs(T) > limit)
      return {std::abs(T) / std::max(limit, std::numeric_limits<double>::min()), way};
    if (c.memory->grip != Grip::guided) return {0.0, 0.0};
    const Sum along = acceleration(c);
    const bool rests = std::abs(along.value) <= noise(c, along);
    return {rests ? 0.0 : std::numeric_limits<double>::infinity(), along.value < 0.0 ? -1.0 : 1.0};
  }

  Verdict of_sliding(const Candidate& c) const {
    const Sum along = acceleration(c);
    const double limit = c.f->element->holding_force(system_.force_input(*c.f));
    const double nothing = noise(c, along) + next_to_no_friction * c.alone * limit;
    const double against = -c.direction * along.value;
    return {against > nothing ? against / along.size : 0.0, -c.direction};
  }

  Sum acceleration(const Candidate& c) const {
    Sum along = product(system_, *c.f, c.row, state_.a);
    along.add(-c.row.gamma);
    return along;
  }

  Outcome finish() {
    if (!dynamics_.project_velocities(state_.t, state_.q.data(), state_.v.data()) ||
        !dynamics_.calc_accelerations(state_))
      return {false, "accelerations are not finite" + names()};
    return {};
  }

  std::string names() const {
    std::string all;
    for (const Candidate& c : candidates_)
      all += (all.empty() ? " at '" : ", '") + c.f->element->name() + "'";
    return all;
  }

  Dynamics& dynamics_;
  System& system_;
  State& state_;
  std::vector<Candidate> candidates_;
  std::vector<int> assembly_;  // [bodies]
  std::vector<double> jolt_;   // [assemblies, m/s^2] the most that one reaction alone would make
};

}  // namespace

Outcome settle_grips(Dynamics& dynamics, State& state, std::span<const ContactMemory> before) {
  if (dynamics.system().holds().empty()) return {};
  return Settlement(dynamics, state, before).settle();
}

bool let_go_of_grips(Dynamics& dynamics, State& state) {
  System& system = dynamics.system();
  std::vector<const ForceSlot*> rested;
  for (const ConstraintSlot& hold : system.holds()) {
    const ForceSlot& f = system.forces()[at(hold.hold)];
    Grip& grip = state.contacts[at(f.contacts)].grip;
    if (!rests(grip)) continue;
    grip = Grip::undecided;
    rested.push_back(&f);
  }
  system.bind(state);
  if (!dynamics.project_velocities(state.t, state.q.data(), state.v.data())) return false;
  system.set_motion(state.t, state.q.data(), state.v.data());
  for (const ForceSlot* f : rested) {
    const Sum speed = sliding_speed(system, *f, row_of(system, *f), state.v);
    if (std::abs(speed.value) <= slowest_sliding(system.scales(), speed.size)) continue;
    state.contacts[at(f->contacts)].grip = speed.value > 0.0 ? Grip::forward : Grip::backward;
  }
  return true;
}

}  // namespace yoke
