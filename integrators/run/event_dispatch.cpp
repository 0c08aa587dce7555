// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/run/event_dispatch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <yoke/core/equations/grips/grips.hpp>
#include <yoke/core/error.hpp>

namespace yoke {

namespace {

constexpr std::size_t most_consequences = 100;  // of blows at one instant
constexpr double conflict = 1e-6;  // of a jump of speed: a joint that does not follow it

void require_not_own(const std::string& element, const Parameter& p) {
  if (p.own)
    throw ModelError(
        fmt::format("'{0}': {1} is kept by the element itself and cannot be set", element, p.name));
}

}  // namespace

ElementEvents::ElementEvents(Dynamics& dynamics, State& state, Result& result, StopRun stop)
    : dynamics_(dynamics),
      state_(state),
      result_(result),
      stop_(std::move(stop)),
      contacts_before_(state.contacts),
      g_(static_cast<std::size_t>(dynamics.system().events()), 0.0) {
  fired_.reserve(g_.size() + most_consequences + 1);
  constexpr double never = std::numeric_limits<double>::infinity();
  const System& system = dynamics.system();
  for (const OwnedParameter& p : system.model().parameters()) parameters_.push_back(p.parameter);
  for (const ForceSlot& slot : system.forces())
    own_parameters_.push_back(slot.element->parameters().size());
  for (const ConstraintSlot& c : system.joints())
    if (const std::size_t own = c.element->parameters().size(); own > 0)
      drivers_.push_back({&c, static_cast<std::size_t>(c.parameters), own});
  if (parameters_.size() != state.parameters.size()) return;
  parameters_before_ = state.parameters;
  const Motion start{.t = state.t, .bodies = {}, .inertia = {}};
  for (const ForceSlot& slot : system.forces())
    if (slot.element->next_sample(
            {.motion = start, .parameters = state.parameters.data() + slot.parameters}) < never)
      sampled_.push_back(&slot);
}

EventContext ElementEvents::context_of(const ForceSlot& slot) {
  System& system = dynamics_.system();
  local_acceleration_.assign(static_cast<std::size_t>(slot.columns), 0.0);
  for (int j = 0; j < slot.columns; ++j)
    if (const int dof = system.dof()[static_cast<std::size_t>(slot.dofs + j)]; dof >= 0)
      local_acceleration_[static_cast<std::size_t>(j)] = state_.a[dof];
  return {.input = system.force_input(slot),
          .contact = state_.contacts.data() + slot.contacts,
          .z = state_.z.data() + slot.z,
          .effective_mass = [this,
                             &slot](const double* d) { return dynamics_.effective_mass(slot, d); },
          .acceleration = local_acceleration_.data(),
          .dissipate =
              [this, &slot](double joules) {
                if (slot.dissipated >= 0) state_.energy[slot.dissipated] += joules;
              },
          .record =
              [this, &slot](EventRecord record) {
                record.t = state_.t;
                record.element = slot.element->name();
                result_.events.push_back(std::move(record));
              },
          .fail =
              [this, &slot](std::string reason) {
                stop_(Stop::failed, fmt::format("'{}': {}", slot.element->name(), reason));
              },
          .stop =
              [this, &slot] {
                stop_(Stop::by_event,
                      fmt::format("event '{}' at t = {:.9g} s", slot.element->name(), state_.t));
              },
          .note =
              [this, &slot](std::string text) {
                add_note(fmt::format("'{}': {}", slot.element->name(), text));
              },
          .parameter = [this](std::string_view name) -> double& {
            parameters_changed_ = true;
            return state_.parameters[dynamics_.system().model().find_parameter(name)];
          },
          .parameters = state_.parameters.data(),
          .impulse = [this](BodyId body, const Vec2& impulse,
                            double angular) { strike(body, impulse, angular); }};
}

/// What an element says again and again is noted a few times only.
void ElementEvents::add_note(const std::string& note) {
  constexpr std::ptrdiff_t most = 3;
  const std::string beginning = note.substr(0, note.find(" at t ="));
  std::vector<std::string>& notes = result_.summary.notes;
  const auto same = std::ranges::count_if(
      notes, [&](const std::string& earlier) { return earlier.starts_with(beginning); });
  if (same < most) notes.push_back(note + (same + 1 == most ? "; further ones are not noted" : ""));
}

void ElementEvents::initialise_contacts() {
  for (const ForceSlot& slot : dynamics_.system().forces()) {
    if (slot.element->contacts() == 0) continue;
    EventContext context = context_of(slot);
    slot.element->initialise_contacts(context);
  }
  settle_grips();
}

void ElementEvents::settle() {
  begin();
  settle_grips();
}

/// Which friction holds is a matter of all contacts together.
void ElementEvents::settle_grips() {
  System& system = dynamics_.system();
  if (system.holds().empty()) return;
  if (const Outcome outcome = yoke::settle_grips(dynamics_, state_, contacts_before_); !outcome)
    stop_(Stop::failed, fmt::format("friction at t = {:.9g} s: {}", state_.t, outcome.why));
  for (const ConstraintSlot& hold : system.holds()) {
    const ForceSlot& slot = system.forces()[static_cast<std::size_t>(hold.hold)];
    const Grip before = contacts_before_[static_cast<std::size_t>(slot.contacts)].grip;
    if (system.grip_memory(hold).grip == before) continue;
    EventContext context = context_of(slot);
    slot.element->grip_changed(before, context);
  }
}

void ElementEvents::begin() {
  contacts_before_ = state_.contacts;
  parameters_changed_ = stiffness_changed_ = velocities_changed_ = struck_ = loads_only_ = false;
}

void ElementEvents::handle(const std::vector<int>& fired) {
  begin();
  state_.handled.clear();
  state_.handled_at = state_.t;
  dynamics_.share_hold_forces(state_.lambda.data());
  // A blow may take more of them across zero, which are handled too, and may strike in turn.
  fired_ = fired;
  handle_fired(fired.size());
  stiffness_changed_ = parameters_changed_;
  if (changed()) settle_grips();
}

/// What has fired, `known` of them before any blow.
void ElementEvents::handle_fired(std::size_t known) {
  for (std::size_t i = 0; i < fired_.size(); ++i) {
    for (const ForceSlot& slot : dynamics_.system().forces()) {
      const int event = fired_[i] - slot.events;
      if (event < 0 || event >= slot.element->events()) continue;
      handle_one(slot, event);
    }
    if (fired_.size() <= known + most_consequences) continue;
    stop_(Stop::failed,
          fmt::format("events at t = {:.9g} s strike one another without end; the last "
                      "is of '{}'",
                      state_.t, result_.events.back().element));
    break;
  }
}

void ElementEvents::handle_one(const ForceSlot& slot, int event) {
  // Both directions of a crossing: rounding leaves the motion on either side of it.
  for (int i = 0; slot.element->events_settle() && i < slot.element->events(); ++i)
    state_.handled.push_back(slot.events + i);
  EventContext context = context_of(slot);
  const EnergyTerms before = dynamics_.system().calc_energy();
  note_drivers();
  slot.element->handle_event(event, context);
  if (parameters_changed_) dynamics_.system().model().check_parameters(state_.parameters);
  const bool struck = struck_, driven = withhold_drivers();
  if (struck) follow_blow();
  if ((parameters_changed_ || struck) && slot.supplied >= 0) {
    const EnergyTerms after = dynamics_.system().calc_energy();
    state_.energy[slot.supplied] +=
        after.potential + after.stored - before.potential - before.stored;
    if (struck) state_.energy[slot.supplied] += after.kinetic - before.kinetic;
  }
  if (driven) drive_on();
}

void ElementEvents::drive(const std::vector<double>& values) {
  begin();
  fired_.clear();
  note_drivers();
  std::ranges::copy(values, state_.parameters.begin());
  if (withhold_drivers()) drive_on();
}

void ElementEvents::handle_consequences() {
  handle_fired(0);
  if (changed()) settle_grips();
}

/// Before somebody may set drivers, who is to find their present motion.
void ElementEvents::note_drivers() {
  if (drivers_.empty()) return;
  drivers_raw_ = state_.parameters;
  dynamics_.system().model().update_parameters(state_.t, state_.parameters);
  drivers_then_ = state_.parameters;
}

/// Have drivers been set? They have their parameters of before until drive_on().
bool ElementEvents::withhold_drivers() {
  if (drivers_.empty()) return false;
  drivers_wanted_ = state_.parameters;
  const auto differs = [&](const Driver& d) {
    const auto first = static_cast<std::ptrdiff_t>(d.first);
    return !std::equal(drivers_wanted_.begin() + first,
                       drivers_wanted_.begin() + first + static_cast<std::ptrdiff_t>(d.count),
                       drivers_then_.begin() + first);
  };
  const bool set = std::ranges::any_of(drivers_, differs);
  const std::vector<double>& before = set ? drivers_then_ : drivers_raw_;
  for (const Driver& d : drivers_)
    for (std::size_t i = d.first; i < d.first + d.count; ++i) state_.parameters[i] = before[i];
  return set;
}

/// One after the other, which leads to the same velocities as all at once.
void ElementEvents::drive_on() {
  for (const Driver& driver : drivers_) drive_on(driver);
}

/// The driver has its new parameters. Its work is the kinetic energy of the blow.
void ElementEvents::drive_on(const Driver& of) {
  System& system = dynamics_.system();
  const ConstraintSlot& driver = *of.slot;
  const auto rate = [&] {
    double phi_t = 0.0;
    system.evaluate(driver, {.phi_t = &phi_t});
    return phi_t;
  };
  system.set_motion(state_.t, state_.q.data(), state_.v.data());
  const double before = rate();
  bool changes = false;
  for (std::size_t i = of.first; i < of.first + of.count; ++i) {
    if (state_.parameters[i] == drivers_wanted_[i]) continue;
    require_not_own(driver.element->name(), parameters_[i]);
    state_.parameters[i] = drivers_wanted_[i];
    changes = parameters_changed_ = true;
  }
  if (!changes) return;
  const double after = rate();
  if (before == after) return;
  const double kinetic = system.calc_energy().kinetic;
  system.calc_events(g_.data());
  velocities_changed_ = true;
  follow_blow();
  if (!system.left_out_rows().empty() &&
      dynamics_.velocity_violation(state_).largest() > conflict * std::abs(after - before))
    throw ModelError(
        fmt::format("driver '{}': speed: another joint or driver prescribes this motion too",
                    driver.element->name()));
  if (driver.quadrature >= 0)
    state_.energy[driver.quadrature] += system.calc_energy().kinetic - kinetic;
}

void ElementEvents::strike(BodyId body, const Vec2& impulse, double angular) {
  System& system = dynamics_.system();
  const Body& struck = system.model().body(body);
  const std::string owner = fmt::format("impulse on '{}'", struck.name);
  require_finite(owner, "x", impulse.x());
  require_finite(owner, "y", impulse.y());
  require_finite(owner, "angular", angular);
  if (body == ground) throw ModelError(owner + ": the ground does not move");
  if (!impulse.isZero(0.0)) require_positive(owner, "mass", struck.mass, "kg");
  if (angular != 0.0) require_positive(owner, "inertia", struck.inertia, "kg m^2");
  if (!struck_) system.calc_events(g_.data());
  struck_ = velocities_changed_ = true;
  double* v = state_.v.data() + 3 * (body.index - 1);
  if (!impulse.isZero(0.0)) v[0] += impulse.x() / struck.mass, v[1] += impulse.y() / struck.mass;
  if (angular != 0.0) v[2] += angular / struck.inertia;
}

/// The projection in the metric of the masses gives M dv + G^T Lambda = impulse, G dv = 0.
void ElementEvents::follow_blow() {
  struck_ = false;
  System& system = dynamics_.system();
  if (!let_go_of_grips(dynamics_, state_) || !dynamics_.calc_accelerations(state_)) {
    stop_(Stop::failed,
          fmt::format("the velocities after the blow at t = {:.9g} s are not finite", state_.t));
    return;
  }
  g_before_ = g_;
  system.calc_events(g_.data());
  for (std::size_t i = 0; i < g_.size(); ++i)
    if (g_before_[i] < 0.0 && g_[i] >= 0.0) fired_.push_back(static_cast<int>(i));
}

double ElementEvents::next_sample() const {
  double next = std::numeric_limits<double>::infinity();
  if (sampled_.empty()) return next;
  System& system = dynamics_.system();
  system.set_motion(state_.t, state_.q.data(), state_.v.data());
  for (const ForceSlot* slot : sampled_)
    next = std::min(next, slot->element->next_sample(system.force_input(*slot)));
  return next;
}

void ElementEvents::take_samples(double t) {
  begin();
  fired_.clear();
  for (const ForceSlot* slot : sampled_) {
    if (slot->element->next_sample(dynamics_.system().force_input(*slot)) > t) continue;
    note_drivers();
    parameters_before_ = state_.parameters;
    EventContext context = context_of(*slot);
    slot->element->sample(context);
    if (struck_) follow_blow();
    book_parameters(*slot);
    if (withhold_drivers()) drive_on();
  }
  handle_consequences();
  loads_only_ = parameters_changed_ && !stiffness_changed_ && !velocities_changed_ &&
                state_.contacts == contacts_before_;
}

/// What a sample has changed; its own parameters matter to nobody else.
void ElementEvents::book_parameters(const ForceSlot& by) {
  const auto own = static_cast<std::size_t>(by.parameters);
  const std::size_t behind =
      own + own_parameters_[static_cast<std::size_t>(&by - dynamics_.system().forces().data())];
  bool stores = false;
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    const double value = state_.parameters[i];
    if (value == parameters_before_[i] || (i >= own && i < behind)) continue;
    const Parameter& p = parameters_[i];
    if (!(value >= p.low && value <= p.high) || !std::isfinite(value))
      dynamics_.system().model().check_parameters(state_.parameters);
    parameters_changed_ = true;
    stores = stores || !p.load;
  }
  if (!stores) return;
  stiffness_changed_ = true;
  for (const ForceSlot& f : dynamics_.system().forces())
    f.element->check_parameters(state_.parameters.data() + f.parameters);
  const auto elastic = [&] {
    const EnergyTerms energy = dynamics_.system().calc_energy();
    return energy.potential + energy.stored;
  };
  const double after = elastic();
  std::ranges::swap_ranges(parameters_before_, state_.parameters);
  const double before = elastic();
  std::ranges::swap_ranges(parameters_before_, state_.parameters);
  if (by.supplied >= 0) state_.energy[by.supplied] += after - before;
}

bool ElementEvents::changed() const {
  return parameters_changed_ || velocities_changed_ || !(state_.contacts == contacts_before_);
}

}  // namespace yoke
