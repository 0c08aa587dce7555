// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// yoke report DIR: the report of a run again, from what the run has stored.
#include <fmt/format.h>

#include <memory>
#include <string>

#include <yoke/cases/program/verb.hpp>
#include <yoke/cases/report/page.hpp>
#include <yoke/cases/report/stored.hpp>

namespace yoke::cases {

void add_report_verb(CLI::App& app, Action& action) {
  CLI::App* verb = app.add_subcommand("report", "Make report.html again from stored results");
  auto folder = std::make_shared<std::string>();
  verb->add_option("DIR", *folder, "A folder that 'yoke run' wrote to")->required();
  verb->callback([folder, &action] {
    action = [folder] {
      const std::filesystem::path path = *folder;
      std::vector<std::string> replays;
      std::string title;
      for (StoredReplay& replay : stored_replays(path)) {
        title = replay.case_name;
        replays.push_back(std::move(replay.json));
      }
      write_page(path / report_name, title, PageKind::report, replays);
      fmt::print("report: {}\n", (path / report_name).string());
      return exit_ok;
    };
  });
}

}  // namespace yoke::cases
