// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// yoke compare RESULT...: runs of laws, formulations or parameters over one another in one report.
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <yoke/cases/program/verb.hpp>
#include <yoke/cases/report/page.hpp>
#include <yoke/cases/report/stored.hpp>
#include <yoke/core/error.hpp>
#include <yoke/core/result.hpp>

namespace yoke::cases {

namespace {

constexpr std::size_t most_runs = 24;

/// What tells the runs apart: their laws; with laws that appear twice also their folders.
std::vector<std::string> labels_of(const std::vector<StoredReplay>& replays,
                                   const std::vector<std::string>& results) {
  std::vector<std::string> labels;
  for (std::size_t i = 0; i < replays.size(); ++i) {
    const auto same = [&](const StoredReplay& r) { return r.law == replays[i].law; };
    const bool alone = !replays[i].law.empty() && std::ranges::count_if(replays, same) == 1;
    const std::string result = std::filesystem::path(results[i]).lexically_normal().string();
    if (alone)
      labels.push_back(replays[i].law);
    else
      labels.push_back(replays[i].law.empty() ? result : result + ": " + replays[i].law);
  }
  return labels;
}

int compare(const std::vector<std::string>& results, const std::string& output) {
  std::vector<StoredReplay> replays;
  std::vector<std::string> from;
  for (const std::string& result : results)
    for (StoredReplay& replay : stored_replays(result)) {
      replays.push_back(std::move(replay));
      from.push_back(result);
    }
  if (replays.size() < 2)
    throw ModelError("compare: one run alone; give two results, or one of a case with laws");
  if (replays.size() > most_runs)
    throw ModelError(fmt::format("compare: {} runs; at most {} can be told apart in one report",
                                 replays.size(), most_runs));
  const std::vector<std::string> labels = labels_of(replays, from);
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < replays.size(); ++i)
    texts.push_back(with_label(replays[i], labels[i]));
  std::vector<std::string> cases;
  for (const StoredReplay& replay : replays)
    if (std::ranges::find(cases, replay.case_name) == cases.end())
      cases.push_back(replay.case_name);
  const std::filesystem::path folder = output;
  make_output_folder(folder);
  write_page(folder / "comparison.html",
             fmt::format("{}: {} runs", fmt::join(cases, ", "), texts.size()), PageKind::comparison,
             texts);
  for (const std::string& label : labels) fmt::print("  {}\n", label);
  fmt::print("comparison: {}\n", (folder / "comparison.html").string());
  return exit_ok;
}

}  // namespace

void add_compare_verb(CLI::App& app, Action& action) {
  CLI::App* verb = app.add_subcommand("compare", "Runs over one another in one report");
  auto results = std::make_shared<std::vector<std::string>>();
  auto output = std::make_shared<std::string>("results/comparison");
  verb->add_option("RESULT", *results,
                   "Folders that 'yoke run' wrote to, or of one law within: results/a results/b")
      ->required();
  verb->add_option("-o,--output", *output, "Folder for comparison.html")
      ->type_name("DIR")
      ->capture_default_str();
  verb->callback([results, output, &action] {
    action = [results, output] { return compare(*results, *output); };
  });
}

}  // namespace yoke::cases
