// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Runs the steps of the tutorial as its pages do, for their pictures: yoke_tutorial FOLDER.
#include <cstdio>
#include <exception>
#include <filesystem>

#include <yoke/cases/jobs/job.hpp>
#include <yoke/cases/program/request.hpp>
#include <yoke/tests/tutorial/steps.hpp>

int main(int count, char** arguments) {
  using namespace yoke::cases;
  if (count != 2) {
    std::fputs("usage: yoke_tutorial FOLDER\n", stderr);
    return 2;
  }
  try {
    for (const TutorialStep& step : tutorial_steps()) {
      RequestOptions options;
      options.output = (std::filesystem::path(arguments[1]) / step.page).string();
      options.laws = step.laws;
      const Case c = step.make();
      if (run_case(c, make_request(c, options)) != RunStatus::completed) return 1;
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
