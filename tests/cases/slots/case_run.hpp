// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A run of a case within a test: all its own checks must hold.
#pragma once

#include <doctest/doctest.h>

#include <string>
#include <utility>
#include <vector>

#include <yoke/cases/case.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/tests/messages.hpp>

namespace yoke::tests {

struct SlotCaseRun {
  cases::Parameters parameters;
  Model model;
  Result result;
  std::vector<cases::Check> checks;
};

inline SlotCaseRun run_case(const char* name, const std::vector<std::string>& settings,
                            const SimulationOptions& options, const std::string& law = "") {
  const cases::Case& c = cases::find_case(name);
  cases::Parameters p(c.parameters, settings);
  Model m = cases::make_model(c, p, law);
  SimulationOptions whole = options;
  if (whole.until == 0.0) whole.until = c.duration(p);
  Result r = simulate(m, whole);
  REQUIRE_MESSAGE(r.summary.ok(), r.summary.reason);
  std::vector<cases::Check> checks;
  if (options.until == 0.0) checks = c.checks(p, m, r);
  for (const cases::Check& check : checks) CHECK_MESSAGE(check.within(), cases::text_of(check));
  return {std::move(p), std::move(m), std::move(r), std::move(checks)};
}

/// What a case says about parameters that do not fit.
inline std::string refusal_of(const char* name, const std::vector<std::string>& settings) {
  const cases::Case& c = cases::find_case(name);
  return message_of([&] { cases::make_model(c, cases::Parameters(c.parameters, settings)); });
}

}  // namespace yoke::tests
