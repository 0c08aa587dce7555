// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/studies/linearised/memory_numbers.hpp>

namespace yoke {

namespace {

constexpr std::array<const char*, MemoryNumbers::per_contact> names = {
    "approach_velocity", "effective_mass", "largest_penetration", "permanent_set",
    "release_penetration"};
constexpr int release_penetration = 4;
constexpr double behind_a_wall = 1e100;  // [m] a contact that waits behind its wall is given more
constexpr double dent = 1e-3;  // of the contact's penetration scale: far above margins of rounding

std::size_t index(int i) { return static_cast<std::size_t>(i); }

}  // namespace

MemoryNumbers::MemoryNumbers(const System& system)
    : model_(&system.model()), parameters_(static_cast<int>(model_->parameters().size())) {
  for (std::size_t i = 0; i < system.forces().size(); ++i)
    for (int k = 0; k < system.forces()[i].element->contacts(); ++k) owner_.push_back(i);
  contact_numbers_ = per_contact * static_cast<int>(owner_.size());
}

double& MemoryNumbers::number(ContactMemory& memory, int i) {
  switch (i) {
    case 0:
      return memory.approach_velocity;
    case 1:
      return memory.effective_mass;
    case 2:
      return memory.largest_penetration;
    case 3:
      return memory.permanent_set;
    default:
      return memory.release_penetration;
  }
}

double MemoryNumbers::get(const State& state, int i) const {
  if (i >= contact_numbers_) return state.parameters[index(i - contact_numbers_)];
  ContactMemory memory = state.contacts[index(i / per_contact)];
  return number(memory, i % per_contact);
}

void MemoryNumbers::add(State& state, int i, double change) const {
  if (i >= contact_numbers_)
    state.parameters[index(i - contact_numbers_)] += change;
  else
    number(state.contacts[index(i / per_contact)], i % per_contact) += change;
}

bool MemoryNumbers::counts(const System& system, const State& state, int i) const {
  if (i >= contact_numbers_) return true;
  const ContactMemory& memory = state.contacts[index(i / per_contact)];
  const ForceElement& element = *system.forces()[owner_[index(i / per_contact)]].element;
  const double end = dent * element.penetration_scale();
  const bool remembers = memory.phase == ContactPhase::apart && memory.release_penetration > end &&
                         memory.release_penetration < behind_a_wall;
  if (i % per_contact == release_penetration) return remembers;
  return remembers || memory.phase != ContactPhase::apart;
}

bool MemoryNumbers::acts(const State& state, int i) const {
  if (i >= contact_numbers_) return true;
  return i % per_contact != release_penetration &&
         state.contacts[index(i / per_contact)].phase != ContactPhase::apart;
}

std::string MemoryNumbers::name(int i) const {
  if (i >= contact_numbers_) return model_->parameters()[index(i - contact_numbers_)].name();
  return model_->forces()[owner_[index(i / per_contact)]]->name() + "." +
         names[index(i % per_contact)];
}

}  // namespace yoke
