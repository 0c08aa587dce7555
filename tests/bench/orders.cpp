// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What accuracy costs. Without arguments: evaluations of the equations of motion per digit on P1 to P4
// of the benchmark beside a peer, over the tolerances, by explicit steps of either order, by those of
// the order that the run chooses, and by Adams and BDF. With --cases: processor time of the formulation that is
// chosen for each case of the program, and of the fastest one, at equal error. Both as tables in Markdown.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <yoke/cases/case.hpp>
#include <yoke/cases/n_four_bar.hpp>
#include <yoke/tests/bench/clock.hpp>
#include <yoke/tests/bench/work_precision.hpp>
#include <yoke/tests/integrators/problems.hpp>

namespace {

using namespace yoke;
using namespace yoke::bench;

struct Method {
  std::string name, formulation;
  int order = 0;
};

const std::vector<Method> methods = {{"order 5", "arkode-projection", 5},
                                     {"order 7", "arkode-projection", 7},
                                     {"chosen", "arkode-projection", 0},
                                     {"Adams", "adams-baumgarte", 0},
                                     {"BDF", "cvode-projection", 0}};
constexpr double reference_tolerance = 1e-13;

struct Problem {
  std::string name;
  Model model;
  double end = 0.0;  // [s]
};

/// [m] Largest difference of a coordinate of a body at the samples; not a number if a run is not whole.
double largest_difference(const Result& run, const Result& reference) {
  if (!run.summary.ok() || run.samples.rows() != reference.samples.rows())
    return std::numeric_limits<double>::quiet_NaN();
  double worst = 0.0;
  for (std::size_t column = 1; column < run.samples.names().size(); ++column) {
    const std::string& name = run.samples.names()[column];
    if (run.samples.part(column) != "motion") break;
    if (!name.ends_with(".x_m") && !name.ends_with(".y_m")) continue;
    for (std::size_t i = 0; i < run.samples.rows(); ++i)
      worst = std::max(worst,
                       std::abs(run.samples.value(i, column) - reference.samples.value(i, column)));
  }
  return worst;
}

Result run(const Problem& problem, const Method& method, double tolerance, int samples) {
  return simulate(problem.model, {.until = problem.end,
                                  .relative_tolerance = tolerance,
                                  .formulation = method.formulation,
                                  .samples = samples,
                                  .order = method.order});
}

void print_evaluations(const Problem& problem) {
  const Result reference = run(problem, methods[2], reference_tolerance, 2);
  const double size = reference.summary.length_scale;
  fmt::print("\n{}: evaluations / digits = evaluations per digit\n\n| tolerance |", problem.name);
  for (const Method& method : methods) fmt::print(" {} |", method.name);
  fmt::print("\n|--|");
  for (std::size_t i = 0; i < methods.size(); ++i) fmt::print("--|");
  fmt::print("\n");
  for (int k = 4; k <= 12; ++k) {
    fmt::print("| 1e-{} |", k);
    for (const Method& method : methods) {
      const Result result = run(problem, method, std::pow(10.0, -k), 2);
      const double digits = -std::log10(largest_difference(result, reference) / size);
      const auto evaluations = static_cast<double>(result.summary.evaluations);
      if (digits > 0.0)
        fmt::print(" {} / {:.1f} = {:.0f} |", evaluations, digits, evaluations / digits);
      else
        fmt::print(" - |");
    }
    fmt::print("\n");
  }
}

void print_problems() {
  for (const Problem& problem :
       {Problem{"P1 chain of 10 links", tests::horizontal_chain(10), 1.0},
        Problem{"P1 chain of 100 links", tests::horizontal_chain(100), 1.0},
        Problem{"P2 1-four-bar", cases::n_four_bar({.loops = 1}), 10.0},
        Problem{"P2 10-four-bar", cases::n_four_bar({.loops = 10}), 10.0},
        Problem{"P3 scotch-yoke", tests::scotch_yoke(), 2.0 * tests::yoke_period},
        Problem{"P4 bouncing disc", tests::bouncing_disc(), 2.0}})
    print_evaluations(problem);
}

constexpr std::size_t tolerances = 4;  // 1e-4, 1e-6, ...
constexpr double hopeless = 10.0;      // times as long as another: not followed
constexpr int rounds = 7;  // of all formulations in turn, the fastest run of each counts
constexpr double enough_seconds = 10.0;  // after which there is no other round

struct Candidate {
  std::string formulation;
  std::vector<WorkPoint> curve = std::vector<WorkPoint>(
      tolerances, {.error = 0.0, .work = std::numeric_limits<double>::infinity()});
};

/// Each tolerance once; `fastest` [s] of each is kept up to date.
void run_once(const Problem& problem, const Result& reference, Candidate& candidate,
              std::vector<double>& fastest) {
  for (std::size_t i = 0; i < tolerances; ++i) {
    WorkPoint& point = candidate.curve[i];
    if (std::isnan(point.error)) continue;
    const auto begin = Clock::now();
    const Result result =
        simulate(problem.model, {.until = problem.end,
                                 .relative_tolerance = std::pow(10.0, -4.0 - 2.0 * double(i)),
                                 .formulation = candidate.formulation,
                                 .samples = 51,
                                 .observer = [&](const Progress&) {
                                   return seconds_since(begin) < hopeless * fastest[i];
                                 }});
    const double taken = seconds_since(begin);
    const double error = largest_difference(result, reference);
    if (std::isnan(error) && std::isfinite(point.work))
      continue;  // cut by what else the machine did
    point.error = error;
    if (std::isnan(error)) continue;
    point.work = std::min(point.work, taken);
    fastest[i] = std::min(fastest[i], taken);
  }
}

double work_of(const Candidate& candidate, double wanted) {
  std::vector<WorkPoint> whole;
  for (const WorkPoint& point : candidate.curve)
    if (!std::isnan(point.error)) whole.push_back(point);
  return work_at(whole, wanted);
}

void print_case(const cases::Case& c) {
  const cases::Parameters parameters(c.parameters, {});
  const Problem problem{c.name, cases::make_model(c, parameters), c.duration(parameters)};
  SimulationOptions exact{.until = problem.end, .relative_tolerance = 1e-12, .samples = 51};
  const Result reference = simulate(problem.model, exact);
  exact.relative_tolerance = 1e-11;
  const double wanted = 1e-6 * reference.summary.length_scale;
  fmt::print("| {} |", c.name);
  if (!(largest_difference(simulate(problem.model, exact), reference) < 0.1 * wanted)) {
    fmt::print(" - | - | - | too sensitive, or not run to its end |\n");
    return;
  }
  std::vector<Candidate> candidates{{.formulation = "automatic"}};
  for (const FormulationNote& f : formulations())
    if (f.name != reference.summary.formulation)
      candidates.push_back({.formulation = std::string(f.name)});
  // In turn: what else the machine does meets all of them.
  std::vector<double> fastest(tolerances, std::numeric_limits<double>::infinity());
  const auto begin = Clock::now();
  for (int round = 0; round < rounds && seconds_since(begin) < enough_seconds; ++round)
    for (Candidate& candidate : candidates) run_once(problem, reference, candidate, fastest);
  const double chosen = work_of(candidates.front(), wanted);
  double best = chosen;
  std::string name = reference.summary.formulation;
  for (const Candidate& candidate : candidates) {
    const double work = work_of(candidate, wanted);
    if (!(work < best)) continue;
    best = work;
    name = candidate.formulation;
  }
  fmt::print(" {} | {} | {:.2f} | {:.3g} |\n", reference.summary.formulation, name, chosen / best,
             1e3 * chosen);
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string_view> arguments(argv + 1, argv + argc);
  if (std::ranges::any_of(arguments, [](std::string_view a) {
        return a.starts_with("--benchmark_");  // `./dev bench` asks for others
      }))
    return 0;
  if (arguments.empty()) {
    print_problems();
    return 0;
  }
  if (arguments.front() != "--cases") {
    fmt::print(stderr, "usage: yoke_bench_orders [--cases [NAME...]]\n");
    return 2;
  }
  fmt::print("| case | chosen | fastest | chosen / fastest | chosen [ms] |\n|--|--|--|--|--|\n");
  for (const cases::Case& c : cases::case_registry())
    if (arguments.size() == 1 || std::ranges::find(arguments, c.name) != arguments.end())
      print_case(c);
  return 0;
}
