// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A run of a case of impacts under one law, all of whose checks hold.
#pragma once

#include <doctest/doctest.h>

#include <string>
#include <utility>
#include <vector>

#include <yoke/cases/impacts/impact_laws.hpp>
#include <yoke/integrators/simulate.hpp>

namespace yoke::tests {

struct ImpactRun {
  cases::Parameters parameters;
  Model model;
  Result result;
  std::vector<cases::Check> checks;
};

inline ImpactRun impact_run(const char* name, const std::vector<std::string>& settings = {},
                            const std::string& law = "", SimulationOptions options = {}) {
  const cases::Case& c = cases::find_case(name);
  cases::Parameters p(c.parameters, settings);
  Model m = cases::make_model(c, p, law);
  if (options.until == 0.0) options.until = c.duration(p);
  Result r = simulate(m, options);
  REQUIRE_MESSAGE(r.summary.ok(), r.summary.reason);
  std::vector<cases::Check> checks = cases::run_checks(c, p, law, m, r);
  CHECK(!checks.empty());
  for (const cases::Check& check : checks)
    CHECK_MESSAGE(check.within(), law << ": " << cases::text_of(check));
  return {std::move(p), std::move(m), std::move(r), std::move(checks)};
}

}  // namespace yoke::tests
