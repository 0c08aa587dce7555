// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// yoke validate TOPIC: measures the engine against what it promises and prints a Markdown document,
// for docs/validation/TOPIC.md. A topic is a file of its own and a line here.
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <yoke/cases/program/verb.hpp>
#include <yoke/cases/validation/validation.hpp>
#include <yoke/core/result.hpp>

namespace yoke::cases {

namespace {

struct Topic {
  const char* name;
  const char* description;
  std::string (*document)();
  void (*write)(const std::filesystem::path& folder) = nullptr;  // document and data
};

const std::vector<Topic> topics = {
    {"convergence",
     "both integrators towards each other, energy ledger and drift on the scotch-yoke",
     convergence_document},
    {"impacts", "every dissipative law against its closed form, by both integrators",
     impacts_document, write_impacts},
    {"benchmarks", "mechanisms of the literature with known answers, by every formulation",
     benchmarks_document, write_benchmarks},
};

}  // namespace

void add_validate_verb(CLI::App& app, Action& action) {
  CLI::App* verb = app.add_subcommand(study_verbs[1].name, study_verbs[1].description);
  verb->require_subcommand(1);
  for (const Topic& topic : topics) {
    CLI::App* sub = verb->add_subcommand(topic.name, topic.description);
    auto output = std::make_shared<std::string>();
    sub->add_option("-o,--output", *output,
                    topic.write ? "Folder for the document, CSV and JSON instead"
                                : "File to write instead of the standard output");
    sub->callback([&topic, output, &action] {
      action = [&topic, output] {
        if (output->empty())
          std::fputs(topic.document().c_str(), stdout);
        else if (topic.write)
          topic.write(*output);
        else
          write_text(*output, topic.document());
        return exit_ok;
      };
    });
  }
}

}  // namespace yoke::cases
