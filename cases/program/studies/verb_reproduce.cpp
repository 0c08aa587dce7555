// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// yoke reproduce tables|figures: what Machines 2022, 10, 966 says of the laws themselves, made
// again.
#include <cstdio>
#include <memory>
#include <string>

#include <yoke/cases/paper/reproduce.hpp>
#include <yoke/cases/program/verb.hpp>

namespace yoke::cases {

void add_reproduce_verb(CLI::App& app, Action& action) {
  CLI::App* verb = app.add_subcommand(study_verbs[2].name, study_verbs[2].description);
  verb->require_subcommand(1);

  CLI::App* tables = verb->add_subcommand(
      "tables", "Tables 2 to 9 and 11: published, reproduced, corrected; prints Markdown");
  auto folder = std::make_shared<std::string>();
  tables->add_option("-o,--output", *folder, "Folder for the document and CSV instead");
  tables->callback([folder, &action] {
    action = [folder] {
      if (folder->empty())
        std::fputs(tables_document().c_str(), stdout);
      else
        write_tables(*folder);
      return exit_ok;
    };
  });

  CLI::App* figures = verb->add_subcommand(
      "figures",
      "Figures 2, 3, 5, 6, 7, 10 and 15 and the loops of all laws: data, scripts, pictures");
  auto pictures = std::make_shared<std::string>();
  figures->add_option("-o,--output", *pictures, "Folder for data and pictures")->required();
  figures->callback([pictures, &action] {
    action = [pictures] {
      std::puts(write_figures(*pictures).c_str());
      return exit_ok;
    };
  });
}

}  // namespace yoke::cases
