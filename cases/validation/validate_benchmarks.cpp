// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include <yoke/cases/andrews.hpp>
#include <yoke/cases/jobs/markdown.hpp>
#include <yoke/cases/jobs/plot.hpp>
#include <yoke/cases/validation/andrews_reference.hpp>
#include <yoke/cases/validation/benchmark_problems.hpp>
#include <yoke/cases/validation/validation.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/integrators/studies/work_pool.hpp>

namespace yoke::cases {

namespace {

constexpr double short_run = 0.2;  // [s] runs below this are timed three times

/// What is compared, as a column of the tables.
struct Quantity {
  const char* name;
  double BenchmarkBars::*bar;
  double (*value)(const BenchmarkRun&);
};

const Quantity quantities[] = {
    {"positions", &BenchmarkBars::position,
     [](const BenchmarkRun& r) { return r.errors.position; }},
    {"velocities", &BenchmarkBars::velocity,
     [](const BenchmarkRun& r) { return r.errors.velocity; }},
    {"accelerations", &BenchmarkBars::acceleration,
     [](const BenchmarkRun& r) { return r.errors.acceleration; }},
    {"reactions", &BenchmarkBars::reaction,
     [](const BenchmarkRun& r) { return r.errors.reaction; }},
    {"period", &BenchmarkBars::period, [](const BenchmarkRun& r) { return r.period_error; }},
    {"energy drift", &BenchmarkBars::energy, [](const BenchmarkRun& r) { return r.energy; }},
};

/// One benchmark by one formulation, from loose to tight.
struct Ladder {
  std::string formulation;
  std::vector<BenchmarkRun> runs;

  /// The tightest that got to the end, or of those that did not the one that got farthest.
  const BenchmarkRun& best() const {
    const BenchmarkRun* best = &runs.front();
    for (const BenchmarkRun& r : runs)
      if (r.trouble.empty() || (!best->trouble.empty() && r.reached >= best->reached)) best = &r;
    return *best;
  }

  /// Minus the slope of log(error of positions) over log(steps), by least squares over the errors
  /// that are neither rounding nor larger than the mechanism. NaN: too few.
  double order() const {
    std::vector<std::pair<double, double>> points;
    for (const BenchmarkRun& r : runs)
      if (r.trouble.empty() && r.finer_error > 1e-11 && r.finer_error < 1e-2)
        points.push_back({std::log(static_cast<double>(r.steps)), std::log(r.finer_error)});
    if (points.size() < 3) return BenchmarkErrors::none;
    double mx = 0.0, my = 0.0, xx = 0.0, xy = 0.0;
    for (const auto& [x, y] : points) {
      mx += x / static_cast<double>(points.size());
      my += y / static_cast<double>(points.size());
    }
    for (const auto& [x, y] : points) {
      xx += (x - mx) * (x - mx);
      xy += (x - mx) * (y - my);
    }
    return -xy / xx;
  }
};

struct Row {
  Benchmark benchmark;
  std::vector<Ladder> ladders;
};

BenchmarkRun timed_run(const Benchmark& benchmark, const std::string& formulation,
                       double tolerance) {
  BenchmarkRun run = run_benchmark(benchmark, formulation, tolerance);
  if (run.time < short_run)
    for (int again = 0; again < 2; ++again)
      run.time = std::min(run.time, run_benchmark(benchmark, formulation, tolerance).time);
  return run;
}

std::vector<Row> measure_all() {
  std::vector<Row> rows;
  struct Job {
    std::size_t row, ladder, run;
  };
  std::vector<Job> jobs;
  for (const Benchmark& b : benchmarks()) {
    Row row{b, {}};
    for (const FormulationNote& f : formulations()) {
      Ladder ladder{std::string(f.name), {}};
      for (const double tolerance : tolerances_of(b, f.name)) {
        jobs.push_back({rows.size(), row.ladders.size(), ladder.runs.size()});
        ladder.runs.push_back({.formulation = ladder.formulation, .tolerance = tolerance});
      }
      row.ladders.push_back(std::move(ladder));
    }
    rows.push_back(std::move(row));
  }
  // The tightest first, which take longest.
  std::stable_sort(jobs.begin(), jobs.end(),
                   [](const Job& a, const Job& b) { return a.run > b.run; });
  run_parallel(jobs.size(), static_cast<int>(std::thread::hardware_concurrency()),
               [&](std::size_t i) {
                 Row& row = rows[jobs[i].row];
                 BenchmarkRun& run = row.ladders[jobs[i].ladder].runs[jobs[i].run];
                 run = timed_run(row.benchmark, run.formulation, run.tolerance);
               });
  return rows;
}

std::string number(double x) { return std::isnan(x) ? "" : fmt::format("{:.1e}", x); }

/// A bar as it is spoken of: 2e-9.
std::string bar_text(double x) {
  const int exponent = static_cast<int>(std::floor(std::log10(x) + 1e-9));
  return fmt::format("{:.0f}e{}", x / std::pow(10.0, exponent), exponent);
}

std::string bars_text(const BenchmarkBars& bars) {
  Texts texts;
  for (const Quantity& q : quantities)
    if (!std::isnan(bars.*q.bar))
      texts.push_back(fmt::format("{} {}", q.name, bar_text(bars.*q.bar)));
  return fmt::format("{}", fmt::join(texts, ", "));
}

/// By how much a run misses its bars (< 1: it does not).
double worst_share(const BenchmarkRun& r, const BenchmarkBars& bars) {
  double worst = r.trouble.empty() ? 0.0 : 1e99;
  for (const Quantity& q : quantities)
    if (!std::isnan(bars.*q.bar)) worst = std::max(worst, q.value(r) / (bars.*q.bar));
  return worst;
}

void print_table(Document& doc, const Row& row) {
  const auto any = [&](const Quantity& q) {
    return std::ranges::any_of(row.ladders,
                               [&](const Ladder& l) { return !std::isnan(q.value(l.best())); });
  };
  double fastest = INFINITY;
  for (const Ladder& l : row.ladders)
    if (l.best().trouble.empty()) fastest = std::min(fastest, l.best().time);
  Texts head{"formulation", "rtol"};
  for (const Quantity& q : quantities)
    if (any(q)) head.push_back(q.name);
  for (const char* text :
       {"order", "drift", "drift of rates", "steps", "evaluations", "time", "bar"})
    head.push_back(text);
  doc.head(head);
  for (const Ladder& ladder : row.ladders) {
    const BenchmarkRun& r = ladder.best();
    Texts cells{r.formulation, fmt::format("{:.0e}", r.tolerance)};
    for (const Quantity& q : quantities)
      if (any(q)) cells.push_back(number(q.value(r)));
    const double order = ladder.order();
    cells.push_back(std::isnan(order) ? "" : fmt::format("{:.1f}", order));
    cells.push_back(number(r.position_drift));
    cells.push_back(number(r.velocity_drift));
    cells.push_back(std::to_string(r.steps));
    cells.push_back(std::to_string(r.evaluations));
    cells.push_back(r.trouble.empty() ? fmt::format("{:.1f}", r.time / fastest) : "");
    cells.push_back(!r.trouble.empty()            ? fmt::format("stopped at {:.4g} s", r.reached)
                    : r.meets(row.benchmark.bars) ? "met"
                                                  : "");
    doc.row(cells);
  }
}

void print_troubles(Document& doc, const Row& row) {
  Texts lines;
  for (const Ladder& ladder : row.ladders)
    for (const BenchmarkRun& r : ladder.runs)
      if (!r.trouble.empty())
        lines.push_back(fmt::format("* {} at {:.0e}: at {:.6g} of {:g} s: {}\n", r.formulation,
                                    r.tolerance, r.reached, row.benchmark.until, r.trouble));
  if (!lines.empty()) doc.print("\nDid not get to the end:\n\n{}", fmt::join(lines, ""));
}

void print_verdict(Document& doc, const Row& row) {
  std::vector<const BenchmarkRun*> runs;
  for (const Ladder& l : row.ladders) runs.push_back(&l.best());
  std::ranges::sort(runs, {},
                    [&](const BenchmarkRun* r) { return worst_share(*r, row.benchmark.bars); });
  const auto met = std::ranges::count_if(
      runs, [&](const BenchmarkRun* r) { return r->meets(row.benchmark.bars); });
  Texts best;
  for (const BenchmarkRun* r : {runs[0], runs[1]}) {
    Texts values;
    for (const Quantity& q : quantities)
      if (!std::isnan(row.benchmark.bars.*q.bar))
        values.push_back(fmt::format("{} {}", q.name, number(q.value(*r))));
    best.push_back(fmt::format("{} ({})", r->formulation, fmt::join(values, ", ")));
  }
  doc.verdict(fmt::format("{}: {}", row.benchmark.title, bars_text(row.benchmark.bars)),
              fmt::format("{} by {} of {}", met >= 2 ? "met" : "missed", met, runs.size()),
              fmt::format("Best two: {}.", fmt::join(best, "; ")));
}

void print_andrews_reference(Document& doc) {
  const AndrewsState own = andrews_by_published_equations(0.03);
  const AndrewsState run = andrews_end(simulate(andrews(), {.until = 0.03,
                                                            .relative_tolerance = 1e-13,
                                                            .formulation = "arkode-projection",
                                                            .samples = 2}));
  doc.print(
      "\nThe published values end where their authors' tolerance did. The published equations "
      "(seven relative coordinates, mass matrix, six constraints), integrated by Boost.Odeint's "
      "Runge-Kutta-Fehlberg 7(8) at 1e-14 without the engine, differ from them and from the seven "
      "bodies (arkode-projection at 1e-13) as below. Order and diagram use them as the "
      "reference.\n\n");
  doc.head({"", "positions", "velocities", "accelerations", "multipliers"});
  const auto line = [&](const char* name, const AndrewsState& state) {
    const BenchmarkErrors d = andrews_difference(state, own);
    doc.row(
        {name, number(d.position), number(d.velocity), number(d.acceleration), number(d.reaction)});
  };
  line("published values", andrews_published());
  line("seven bodies", run);
}

constexpr const char* front = R"(# Benchmarks

Printed by `yoke validate benchmarks`, which takes one to two minutes on 2 cores; `-o DIR` writes it
with every single run as CSV and JSON, and the work-precision diagrams. Mechanisms of the literature
whose motion is known, by all formulations.

What is promised holds for the two best formulations of each mechanism; the others print what they
reach. `generalised-alpha` is of second order and made for other purposes: the bars are not asked of
it, and its tolerance is 1e-7.
)";

constexpr const char* legend = R"(
How to read the tables:

* `rtol`: the tightest tried with which the formulation got to the end (all are in the CSV). Runge-Kutta
  is tried down to 1e-12, BDF and Adams to 1e-13. Whatever did not get to the end is listed.
* `positions`: largest error, in m or rad. `velocities`, `accelerations`, `reactions`: largest error over
  the largest value, linear and angular ones each for themselves. For Andrews' mechanism all are relative
  to each number itself.
* `energy drift`: largest error of the energy ledger over the largest energy exchanged.
* `order`: minus the slope of the error of positions over the number of steps, in logarithms, by least
  squares over the tolerances tried and errors above 1e-11. BDF (order 1 to 5) and Adams (1 to 12) choose theirs as they go: smaller tolerances also
  raise the order, so the slope is no order of convergence of one method. Empty where fewer than three
  errors are above rounding (a mechanism that is wholly driven) or runs were made.
* `drift`, `drift of rates`: largest violation of the constraints by positions and by velocities at
  samples, before they are projected (m and rad, m/s and rad/s).
* `evaluations`: how often forces were evaluated to make the steps, counted in the model, so by the same
  rule for all. IDA evaluates them twice where loads, drivers or dampers keep energy accounts. Jacobians
  and projections are not counted.
* `time`: processor time over that of the fastest of the table, at its own tolerance. The least
  of three for runs below {} s; on a busy machine it differs by some ten percent from one printing to
  the next.
)";

std::string document(const std::vector<Row>& rows) {
  Document doc;
  doc.print(legend, short_run);
  for (const Row& row : rows) {
    doc.heading(row.benchmark.title);
    doc.print("{}\n\n", row.benchmark.description);
    print_table(doc, row);
    print_verdict(doc, row);
    print_troubles(doc, row);
    if (row.benchmark.name == "andrews") print_andrews_reference(doc);
    if (row.benchmark.work_precision)
      doc.print("\n![Work-precision diagram](../pictures/benchmarks/{}.png)\n", row.benchmark.name);
  }
  return doc.text(front);
}

std::string exactly(double x) { return std::isnan(x) ? "" : fmt::format("{:.6e}", x); }

std::string csv_of(const Row& row, bool only_complete) {
  double fastest = INFINITY;
  for (const Ladder& l : row.ladders)
    for (const BenchmarkRun& r : l.runs)
      if (r.trouble.empty()) fastest = std::min(fastest, r.time);
  std::string text;
  for (const Ladder& l : row.ladders)
    for (const BenchmarkRun& r : l.runs) {
      if (only_complete && !r.trouble.empty()) continue;
      text += fmt::format("{},{},{:g},{},{},{},{},{},{},{},{},{},{},{},{},{:.4g},{:.9g},\"{}\"\n",
                          row.benchmark.name, r.formulation, r.tolerance,
                          exactly(r.errors.position), exactly(r.finer_error),
                          exactly(r.errors.velocity), exactly(r.errors.acceleration),
                          exactly(r.errors.reaction), exactly(r.period_error), exactly(r.energy),
                          exactly(r.position_drift), exactly(r.velocity_drift), r.steps,
                          r.evaluations, r.jacobians, r.time / fastest, r.reached, r.trouble);
    }
  return text;
}

constexpr const char* csv_head =
    "benchmark,formulation,rtol,position,finer_position,velocity,acceleration,reaction,period,"
    "energy,"
    "position_drift,velocity_drift,steps,evaluations,jacobians,relative_time,reached_s,trouble\n";

std::string json_of(const std::vector<Row>& rows) {
  using Json = nlohmann::ordered_json;
  Json all = Json::array();
  for (const Row& row : rows)
    for (const Ladder& l : row.ladders)
      for (const BenchmarkRun& r : l.runs) {
        Json errors = Json::object();  // NaN becomes null
        for (const Quantity& q : quantities) errors[q.name] = q.value(r);
        all.push_back({{"benchmark", row.benchmark.name},
                       {"formulation", r.formulation},
                       {"rtol", r.tolerance},
                       {"errors", errors},
                       {"finer_position_error", r.finer_error},
                       {"position_drift", r.position_drift},
                       {"velocity_drift", r.velocity_drift},
                       {"steps", r.steps},
                       {"evaluations", r.evaluations},
                       {"jacobians", r.jacobians},
                       {"time_s", r.time},
                       {"reached_s", r.reached},
                       {"trouble", r.trouble}});
      }
  return all.dump(2) + "\n";
}

constexpr const char* colours[] = {"#0072b2", "#d55e00", "#e69f00", "#cc79a7",
                                   "#56b4e9", "#009e73", "#404040"};

std::string panel(const Row& row, const char* x_label, int column) {
  std::string text = fmt::format("  set xlabel '{}'\n  plot ", x_label);
  std::size_t i = 0;
  for (const Ladder& l : row.ladders) {
    text += fmt::format(
        "{}'{}.csv' every ::1 using (strcol(2) eq '{}' ? ${} : NaN):5 title '{}' with linespoints "
        "lw 2 pt {} ps 0.8 lc rgb '{}'",
        i == 0 ? "" : ", \\\n    ", row.benchmark.name, l.formulation, column, l.formulation, 4 + i,
        colours[i % std::size(colours)]);
    ++i;
  }
  return text + "\n";
}

/// Error over evaluations and over time.
Figure work_precision(const Row& row) {
  Figure f{.name = row.benchmark.name,
           .title = fmt::format("{}: work and precision", row.benchmark.title),
           .width = 1200,
           .height = 520,
           .body = {}};
  f.body = fmt::format(
      "  set multiplot layout 1,2 title \"{}\"\n"
      "  set logscale xy; set format xy '10^{{%T}}'; set grid\n"
      "  set ylabel 'largest error of positions'; set key off\n",
      row.benchmark.title);
  f.body += panel(row, "evaluations of the forces", 14);
  f.body += "  set key inside right top reverse Left samplen 2; set ylabel ''\n";
  f.body += panel(row, "processor time, fastest run = 1", 16);
  f.body += "  unset multiplot";
  return f;
}

}  // namespace

std::string benchmarks_document() { return document(measure_all()); }

void write_benchmarks(const std::filesystem::path& folder) {
  const std::vector<Row> rows = measure_all();
  make_output_folder(folder / "plots");
  write_text(folder / "benchmarks.md", document(rows));
  std::string csv = csv_head;
  std::vector<Figure> figures;
  for (const Row& row : rows) {
    csv += csv_of(row, false);
    if (!row.benchmark.work_precision) continue;
    write_text(folder / "plots" / (row.benchmark.name + ".csv"), csv_head + csv_of(row, true));
    figures.push_back(work_precision(row));
  }
  write_text(folder / "benchmarks.csv", csv);
  write_text(folder / "benchmarks.json", json_of(rows));
  draw_figures(figures, folder / "plots", 2);
}

}  // namespace yoke::cases
