// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// yoke validate TOPIC: measures the engine against what it promises and prints a Markdown document,
// for docs/validation/TOPIC.md. A topic is a file of its own and a line here.
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <yoke/cases/validation.hpp>
#include <yoke/cases/verb.hpp>
#include <yoke/core/result.hpp>

namespace yoke::cases {

namespace {

struct Topic {
  const char* name;
  const char* description;
  std::string (*document)();
};

const std::vector<Topic> topics = {
    {"convergence",
     "both integrators towards each other, energy ledger and drift on the scotch-yoke",
     convergence_document},
};

}  // namespace

void add_validate_verb(CLI::App& app, Action& action) {
  CLI::App* verb = app.add_subcommand(
      "validate", "Measure the engine against what it promises; prints Markdown");
  verb->require_subcommand(1);
  for (const Topic& topic : topics) {
    CLI::App* sub = verb->add_subcommand(topic.name, topic.description);
    auto output = std::make_shared<std::string>();
    sub->add_option("-o,--output", *output, "File to write instead of the standard output");
    sub->callback([&topic, output, &action] {
      action = [&topic, output] {
        const std::string text = topic.document();
        if (output->empty()) {
          std::fputs(text.c_str(), stdout);
        } else {
          write_text(*output, text);
        }
        return exit_ok;
      };
    });
  }
}

}  // namespace yoke::cases
