// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What a run remembers besides positions, velocities and element states, as numbers that vary with
// them: the memories of contacts, on which laws depend, and parameters, which events may change.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <yoke/core/equations/system.hpp>

namespace yoke {

class MemoryNumbers {
 public:
  explicit MemoryNumbers(const System& system);

  static constexpr int per_contact = 5;
  int size() const { return contact_numbers_ + parameters_; }
  int contact_numbers() const { return contact_numbers_; }
  double get(const State& state, int i) const;
  void add(State& state, int i, double change) const;
  /// Whether the number counts at `state`: a contact that is apart remembers nothing but a dent or
  /// that it has lifted, and where the next onset is for these alone.
  bool counts(const System& system, const State& state, int i) const;
  /// The same that forces depend on it now.
  bool acts(const State& state, int i) const;
  /// "slot.approach_velocity".
  std::string name(int i) const;

 private:
  static double& number(ContactMemory& memory, int i);

  const Model* model_;
  int contact_numbers_, parameters_;
  std::vector<std::size_t> owner_;  // [contacts] index into System::forces()
};

}  // namespace yoke
