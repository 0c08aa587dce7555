// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/sweep/sweep.hpp>

#include <fmt/format.h>

#include <utility>

#include <yoke/cases/jobs/law_run.hpp>
#include <yoke/cases/jobs/progress.hpp>
#include <yoke/cases/jobs/report.hpp>
#include <yoke/cases/report/page.hpp>
#include <yoke/cases/report/stored.hpp>
#include <yoke/cases/sweep/sweep_results.hpp>
#include <yoke/core/error.hpp>

namespace yoke::cases {

namespace {

namespace fs = std::filesystem;

std::string law_of(const RunRequest& request) {
  return request.laws.empty() ? "" : request.laws.front();
}

/// One point from its setting to its row.
class PointRun {
 public:
  PointRun(const Case& c, const SweepRequest& request, const SweepPoints& points)
      : c_(c), request_(request), points_(points), quantities_(first_quantities()) {}

  const SweepQuantities& quantities() const { return quantities_; }

  StudyOutcome operator()(const StudyPoint& point) const {
    RunRequest own = request_.request_of(points_.setting(point.index()));
    own.plots = false;
    own.report = request_.keep_runs;
    own.output = request_.output / run_folder(point.index());
    RunOutput output(own.choice, own.output);
    const LawRun run = run_law(
        c_, own, law_of(own), [](const Progress&) { return !interrupted(); },
        request_.keep_runs ? &output : nullptr);
    if (run.summary.stop == Stop::interrupted) return {.unfinished = true};
    if (request_.keep_runs) keep(own, run, output);
    return {.values = quantities_.of(run), .failure = run.summary.ok() ? "" : run.summary.reason};
  }

 private:
  /// Measures are those of the first point: what it does not have is a mistake of whoever asks.
  SweepQuantities first_quantities() const {
    const RunRequest own = request_.request_of(points_.setting(0));
    const Model model = make_model(c_, own.parameters, law_of(own));
    return {request_.measures, request_.turn, request_.from, model,
            c_.columns ? c_.columns(own.parameters, model) : std::vector<MotionColumn>{}};
  }
  void keep(const RunRequest& own, const LawRun& run, RunOutput& output) const {
    make_output_folder(own.output);
    write_run(c_, own, run, own.output, output);
    if (!run.replay.empty())
      write_page(own.output / report_name, c_.name, PageKind::report,
                 {stored_replays(own.output).front().json});
  }

  const Case& c_;
  const SweepRequest& request_;
  const SweepPoints& points_;
  SweepQuantities quantities_;
};

}  // namespace

std::string run_folder(std::size_t point) { return fmt::format("runs/{:06}", point); }

RunStatus run_sweep(const Case& c, const SweepRequest& request) {
  const SweepPoints points(c, request.choice);
  const PointRun run(c, request, points);
  if (request.leads) settle_sweep(c, request);
  StudyProgressLine line(request.leads && !request.quiet);
  StudyOptions options{.jobs = request.jobs, .folder = request.output};
  options.identity = request.typed.dump();
  options.observer = [&](const StudyProgress& progress) { line.report(progress); };
  options.stop = [] { return interrupted(); };
  options.executor = request.executor;
  options.leads = request.leads;
  const StudyResult study =
      run_study(points.points(), run.quantities().all(), std::cref(run), options);
  line.clear();
  if (!request.leads) return interrupted() ? RunStatus::interrupted : RunStatus::completed;
  write_sweep(c, request, points, study);
  if (request.report) write_sweep_page(c, request, points, study);
  print_sweep(c, request, points, study);
  if (!study.complete) return RunStatus::interrupted;
  return study.progress.failed == study.progress.total ? RunStatus::failed : RunStatus::completed;
}

}  // namespace yoke::cases
