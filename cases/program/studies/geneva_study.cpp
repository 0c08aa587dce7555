// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/program/studies/geneva_study.hpp>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include <yoke/cases/jobs/markdown.hpp>
#include <yoke/cases/jobs/progress.hpp>
#include <yoke/integrators/studies/work_pool.hpp>

namespace yoke::cases {

namespace {

struct Setting {
  std::string clearance, speed;
};

/// Speed and formula of an impact: the check named `what`, and the first onset of slot 1 in `region`.
std::vector<std::string> impact(const LawRun& run, std::string_view what, std::string_view region) {
  const auto check = std::ranges::find(run.checks, what, &Check::what);
  const auto onset = std::ranges::find_if(run.events, [&](const EventRecord& e) {
    return e.kind == "onset" && e.element == "slot 1" && e.region == region;
  });
  return {onset == run.events.end() ? "-" : fmt::format("{:.5f}", onset->speed),
          check == run.checks.end() ? "-" : fmt::format("{:.5f}", check->expected)};
}

}  // namespace

RunStatus study_geneva(const RunRequest& request) {
  std::vector<Setting> settings;
  for (const char* clearance : {"0.01mm", "0.02mm", "0.05mm", "0.1mm", "0.2mm"})
    for (const char* speed : {"60", "120", "240"}) settings.push_back({clearance, speed});
  std::vector<std::string> names;
  for (const Setting& s : settings) names.push_back(fmt::format("{} {}", s.clearance, s.speed));
  std::vector<LawRun> runs(settings.size());
  ProgressLine progress(names);
  run_parallel(settings.size(), request.jobs, [&](std::size_t i) {
    if (interrupted()) return;
    RunRequest one = request;
    one.parameters.set("clearance", settings[i].clearance);
    one.parameters.set("speed", settings[i].speed);
    one.parameters.set("turns", "1");
    runs[i] = run_law(find_case("geneva"), one, request.laws.front(), progress.observer(i));
  });
  if (interrupted()) return RunStatus::interrupted;
  Document doc;
  doc.head({"clearance", "speed [rpm]", "entry [m/s]", "formula", "other wall [m/s]", "formula"});
  bool ok = true;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    ok = ok && runs[i].summary.ok();
    std::vector<std::string> row{settings[i].clearance, settings[i].speed};
    for (const auto& [what, region] :
         {std::pair{"speed of the first impact", "right"},
          std::pair{"speed of the first impact on the other wall", "left"}})
      for (const std::string& cell : impact(runs[i], what, region)) row.push_back(cell);
    doc.row(row);
  }
  fmt::print("{}", doc.plain());
  return ok ? RunStatus::completed : RunStatus::failed;
}

}  // namespace yoke::cases
