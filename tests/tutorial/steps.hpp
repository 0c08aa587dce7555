// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The case of the tutorial (docs/tutorial/) as it is at the end of each page.
#pragma once

#include <string>
#include <vector>

#include <yoke/cases/case.hpp>

namespace yoke::cases {

// slotted_lever_case() of each page, by another name as all of them are in one program.
Case slotted_lever_ideal();
Case slotted_lever_clearance();
Case slotted_lever_friction();
Case slotted_lever_own_law();

struct TutorialStep {
  std::string page;  // docs/tutorial/PAGE.md, tests/tutorial/PAGE.hpp
  Case (*make)();
  std::vector<std::string> laws{};  // that its pictures show; empty: all
};

inline std::vector<TutorialStep> tutorial_steps() {
  return {{"ideal", slotted_lever_ideal},
          {"clearance", slotted_lever_clearance},
          {"friction", slotted_lever_friction},
          {"own_law", slotted_lever_own_law, {"steel", "lined"}}};
}

}  // namespace yoke::cases
