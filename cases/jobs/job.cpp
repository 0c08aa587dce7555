// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/jobs/job.hpp>

#include <fmt/format.h>

#include <algorithm>

#include <yoke/cases/jobs/progress.hpp>
#include <yoke/cases/jobs/report.hpp>
#include <yoke/cases/jobs/standard_figures.hpp>
#include <yoke/cases/report/page.hpp>
#include <yoke/cases/report/replay.hpp>
#include <yoke/cases/report/stored.hpp>
#include <yoke/integrators/studies/work_pool.hpp>

namespace yoke::cases {

namespace {

namespace fs = std::filesystem;

RunStatus worst_status(const std::vector<LawRun>& runs) {
  if (interrupted()) return RunStatus::interrupted;
  const auto stopped = [](const LawRun& r) { return r.summary.stop == Stop::interrupted; };
  if (std::ranges::any_of(runs, stopped)) return RunStatus::interrupted;
  const bool ok = std::ranges::all_of(runs, [](const LawRun& r) { return r.summary.ok(); });
  return ok ? RunStatus::completed : RunStatus::failed;
}

/// The most important files of a run, as a shell would name them.
const char* files_of(const OutputChoice& choice) {
  if (choice.format == "hdf5") return "{results.h5,summary.json}";
  if (choice.format == "mat") return "{results.mat,summary.json}";
  return choice.events_only ? "{events.csv,summary.json}" : "{motion.csv,events.csv,summary.json}";
}

/// On stderr, where nothing else says so.
void print_failures(const std::vector<LawRun>& runs) {
  for (const LawRun& run : runs)
    if (run.done && !run.summary.ok())
      fmt::print(stderr, "yoke: {}{}{}\n", run.law, run.law.empty() ? "" : ": ",
                 run.summary.reason);
}

struct Job {
  const Case& c;
  const RunRequest& request;
  const FigureMaker& more;
  bool choice = false;  // of laws: a folder for each
  std::vector<std::string> laws{}, folders{};

  fs::path plots() const { return request.output / "plots"; }

  /// Runs and writes one law. The tables are kept only if other figures than the standard ones are
  /// to be made of them.
  LawRun run(std::size_t i, std::function<bool(const Progress&)> observer, DrawnRun& drawn) const {
    RunRequest own = request;
    own.output = request.output / folders[i];
    RunOutput output(request.choice, own.output);
    LawRun run = run_law(c, own, laws[i], std::move(observer), &output);
    run.folder = folders[i];
    write_run(c, request, run, own.output, output);
    if (request.plots && run.summary.ok()) drawn = write_standard_data(run, plots(), c.paths);
    run.replay.clear();
    if (!request.plots || !more) run.history = run.samples = run.dense = run.dense_history = {};
    return run;
  }

  /// As `yoke report` does, from what the runs have stored.
  void write_report(const std::vector<LawRun>& runs) const {
    std::vector<std::string> replays;
    for (const LawRun& run : runs)
      if (run.done && fs::exists(request.output / run.folder / replay_file))
        replays.push_back(stored_replays(request.output / run.folder).front().json);
    if (replays.empty()) return;
    write_page(request.output / report_name, c.name, PageKind::report, replays);
    if (!request.quiet) fmt::print("report: {}\n", (request.output / report_name).string());
  }

  void draw(const std::vector<LawRun>& runs, const std::vector<DrawnRun>& drawn) const {
    std::vector<Figure> figures;
    const auto take = [&](std::vector<Figure> made) {
      for (Figure& figure : made) figures.push_back(std::move(figure));
    };
    for (const Sheet& sheet : request.sheets) take(standard_figures(c.name, drawn, sheet));
    if (more) take(more(c, request, runs, plots()));
    const std::string drawn_text = draw_figures(figures, plots(), request.jobs, request.films);
    if (!request.quiet) fmt::print("{}\n", drawn_text);
  }
};

}  // namespace

RunStatus run_case(const Case& c, const RunRequest& request, const FigureMaker& more) {
  Job job{.c = c, .request = request, .more = more, .choice = !request.laws.empty()};
  job.laws = job.choice ? request.laws : std::vector<std::string>{""};
  job.folders = job.choice ? folder_names(request.laws) : job.laws;
  make_output_folder(request.output);
  std::vector<LawRun> runs(job.laws.size());
  std::vector<DrawnRun> drawn(runs.size());
  {
    ProgressLine progress(job.choice ? job.laws : std::vector<std::string>{c.name}, !request.quiet);
    run_parallel(runs.size(), request.jobs, [&](std::size_t i) {
      if (interrupted()) return;
      runs[i] = job.run(i, progress.observer(i), drawn[i]);
      progress.report(i, 1.0);
    });
  }
  if (job.choice) write_comparison(runs, request.output);
  if (!request.quiet) {
    print_report(c.name, request, runs);
    print_checks(runs);
    if (runs.size() > 1)
      fmt::print("\nresults: {}/LAW/{}\n", request.output.string(), files_of(request.choice));
  }
  if (request.report) job.write_report(runs);
  const RunStatus status = worst_status(runs);
  if (status == RunStatus::interrupted && !request.quiet)
    fmt::print("interrupted; what was computed is there\n");
  if (status == RunStatus::failed && request.quiet) print_failures(runs);
  if (request.plots && status == RunStatus::completed) job.draw(runs, drawn);
  return status;
}

}  // namespace yoke::cases
