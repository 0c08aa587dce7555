// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <fmt/ranges.h>

#include <algorithm>

#include <yoke/cases/case.hpp>
#include <yoke/core/error.hpp>

namespace yoke::cases {

// One function per case, defined in the file of its name or, for the last four, in
// benchmark_cases.cpp.
Case scotch_yoke_case();
Case n_four_bar_case();
Case parallelogram_case();
Case slider_crank_case();
Case hanging_chain_case();
Case point_pendulum_case();
Case double_pendulum_case();
Case andrews_case();
Case car_axis_case();

const std::vector<Case>& case_registry() {
  static const std::vector<Case> cases = {
      scotch_yoke_case(),     n_four_bar_case(),    parallelogram_case(),
      slider_crank_case(),    hanging_chain_case(), point_pendulum_case(),
      double_pendulum_case(), andrews_case(),       car_axis_case(),
  };
  return cases;
}

const Case& find_case(std::string_view name) {
  std::vector<std::string> known;
  for (const Case& c : case_registry()) {
    if (c.name == name) return c;
    known.push_back(c.name);
  }
  if (name.empty())
    throw ModelError(fmt::format("which case? There are '{}'", fmt::join(known, "', '")));
  throw ModelError(fmt::format("unknown case '{}'{}", name, suggestion(name, known)));
}

std::vector<std::string> choose_laws(const Case& c, const std::vector<std::string>& laws) {
  std::vector<std::string> known, chosen;
  for (const LawNote& note : c.laws) known.push_back(note.name);
  if (known.empty() && !laws.empty())
    throw ModelError(fmt::format("--law {}: case '{}' has no contact laws to choose from",
                                 laws.front(), c.name));
  for (const std::string& law : laws)
    if (std::ranges::find(known, law) == known.end())
      throw ModelError(fmt::format("unknown law '{}'{}", law, suggestion(law, known)));
  std::ranges::copy_if(known, std::back_inserter(chosen), [&](const std::string& law) {
    return laws.empty() || std::ranges::find(laws, law) != laws.end();
  });
  return chosen;
}

}  // namespace yoke::cases
