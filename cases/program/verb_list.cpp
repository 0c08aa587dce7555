// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// yoke list: cases, their laws, formulations.
#include <fmt/core.h>

#include <yoke/cases/case.hpp>
#include <yoke/cases/program/verb.hpp>
#include <yoke/integrators/simulate.hpp>

namespace yoke::cases {

namespace {

int list_everything() {
  fmt::print("Cases\n");
  for (const CaseGroup& group : case_groups()) {
    fmt::print(" {}\n", group.name);
    for (const Case* c : group.cases) fmt::print("  {:<22} {}\n", c->name, c->description);
  }
  for (const Case& c : case_registry()) {
    if (c.contact.laws.empty()) continue;
    fmt::print("\nLaws of {} ('yoke law list' has more for --law)\n", c.name);
    for (const NamedLaw& law : c.contact.laws)
      fmt::print("  {:<28} {}\n", law.name, law.description);
  }
  fmt::print("\nFormulations (default: automatic, chosen from the model)\n");
  for (const FormulationNote& f : formulations())
    fmt::print("  {:<22} {}\n", f.name, f.description);
  return exit_ok;
}

}  // namespace

void add_list_verb(CLI::App& app, Action& action) {
  app.add_subcommand("list", "Cases, contact laws and formulations")->callback([&action] {
    action = list_everything;
  });
}

}  // namespace yoke::cases
