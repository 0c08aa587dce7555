// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/run/event_dispatch.hpp>

#include <algorithm>
#include <utility>

#include <yoke/core/equations/grips.hpp>

namespace yoke {

ElementEvents::ElementEvents(Dynamics& dynamics, State& state, Result& result, StopRun stop)
    : dynamics_(dynamics),
      state_(state),
      result_(result),
      stop_(std::move(stop)),
      contacts_before_(state.contacts) {}

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
          }};
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

void ElementEvents::handle(const std::vector<int>& fired) {
  contacts_before_ = state_.contacts;
  parameters_changed_ = false;
  state_.handled.clear();
  state_.handled_at = state_.t;
  if (dynamics_.system().any_grip()) dynamics_.share_hold_forces(state_.lambda.data());
  for (const int event : fired) {
    for (const ForceSlot& slot : dynamics_.system().forces()) {
      if (event < slot.events || event >= slot.events + slot.element->events()) continue;
      handle_one(slot, event - slot.events);
    }
  }
  if (changed()) settle_grips();
}

void ElementEvents::handle_one(const ForceSlot& slot, int event) {
  if (slot.element->events_settle()) state_.handled.push_back(slot.events + event);
  EventContext context = context_of(slot);
  const EnergyTerms before = dynamics_.system().calc_energy();
  slot.element->handle_event(event, context);
  if (parameters_changed_) dynamics_.system().model().check_parameters(state_.parameters);
  if (!parameters_changed_ || slot.supplied < 0) return;
  const EnergyTerms after = dynamics_.system().calc_energy();
  state_.energy[slot.supplied] += after.potential + after.stored - before.potential - before.stored;
}

bool ElementEvents::changed() const {
  return parameters_changed_ || !(state_.contacts == contacts_before_);
}

}  // namespace yoke
