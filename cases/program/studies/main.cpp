// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The program yoke-studies: validation and what reproduces the paper. `yoke VERB` calls it.
#include <yoke/cases/program/program.hpp>

int main(int argc, char** argv) {
  using namespace yoke::cases;
  return run_program(argc, argv, [](CLI::App& app, Action& action) {
    add_study_verb(app, action);
    add_validate_verb(app, action);
    add_reproduce_verb(app, action);
  });
}
