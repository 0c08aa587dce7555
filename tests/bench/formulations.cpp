// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Does the cost of a step grow with the size of the model no faster than KLU does? A chain of 10 to
// 100 000 links is stepped by every formulation, in turn with the bare KLU refactor + solve of that
// formulation's own matrix, block by block. The trajectory is the same bits each time it is run, so
// it is run several times and of each block the fastest counts: other programs on the machine then
// leave no trace. Printed: time per step and per KLU, the ratio of the two, and the exponents of
// their growth. Aim: exponent of a step <= exponent of KLU + 0.03.
//
// Below it the cost of everything around the steps, per link: it must not grow either.
//
// Options: --most=N leaves out longer chains.
#include <fmt/format.h>

#include <yoke/integrators/formulations/equations/acceleration_matrix.hpp>
#include <yoke/integrators/formulations/equations/ggl_equations.hpp>
#include <yoke/integrators/formulations/generalised_alpha.hpp>
#include <yoke/integrators/run/singular/closed_loops.hpp>
#include <yoke/integrators/run/start/error_weights.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/tests/bench/chain.hpp>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <memory>
#include <string_view>

namespace {

using namespace yoke;
using namespace yoke::bench;

constexpr int warm_up = 24;  // steps while the order of a multistep method rises
constexpr int blocks = 8, steps_in_block = 8;
constexpr double klu_share = 0.25;       // of the time of a block of steps
constexpr double shortest_block = 1e-4;  // [s] of KLU: reading the clock is not free
constexpr double allowance = 0.03;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Acts on nothing; counts how often forces are asked for: residuals and accelerations.
struct EvaluationCounter {
  std::string name = "counter";
  std::unique_ptr<ForceElement> build(const Model&) const;
};
long evaluations = 0;

class CountingForce final : public ForceElement {
 public:
  CountingForce() : ForceElement("counter", {}, {.position = false, .velocity = false}) {}
  void evaluate(const ForceInput&, const ForceRequest&) const override { ++evaluations; }
};

std::unique_ptr<ForceElement> EvaluationCounter::build(const Model&) const {
  return std::make_unique<CountingForce>();
}

SimulationOptions options_of(std::string formulation) {
  return {.until = 10.0,
          .relative_tolerance = 1e-6,
          .formulation = std::move(formulation),
          .samples = 0};
}

/// A chain ready to be stepped, with what it took to get there.
struct Chain {
  explicit Chain(int links);

  double model_seconds = 0.0, assembly_seconds = 0.0;
  Model model;
  std::unique_ptr<Dynamics> dynamics;
  State state;
};

Chain::Chain(int links) {
  auto begin = Clock::now();
  model = chain(links);
  model_seconds = seconds_since(begin);
  model.add(EvaluationCounter{});
  state = model.start_state();
  begin = Clock::now();
  dynamics = std::make_unique<Dynamics>(model);
  if (!dynamics->assemble(state)) std::abort();
  assembly_seconds = seconds_since(begin);
  if (has_closed_loops(dynamics->system())) std::abort();  // then steps would cost a watch more
  dynamics->system().set_scales(choose_scales(dynamics->system(), state, options_of("")));
}

const FormulationEntry& entry_of(std::string_view name) {
  return *std::ranges::find(formulation_registry(), name, &FormulationEntry::name);
}

/// The matrix a formulation hands to KLU, at a state, for steps of a length.
SparseMatrix matrix_of(std::string_view name, Dynamics& dynamics, const Tolerances& tolerances,
                       const State& state, double step) {
  System& system = dynamics.system();
  const auto n = static_cast<std::size_t>(system.dofs());
  const double c = 1.5 / step;
  if (name == "ida-ggl") {
    GglEquations matrix(system);
    std::vector<double> y(static_cast<std::size_t>(matrix.size()), 0.0), y_dot(y);
    std::copy_n(state.q.data(), n, y.begin());
    std::copy_n(state.v.data(), n, y.begin() + static_cast<std::ptrdiff_t>(n));
    std::copy_n(state.lambda.data(), state.lambda.size(), y.begin() + matrix.lambda());
    matrix.calc_jacobian(state.t, c, y.data(), y_dot.data());
    matrix.factorise();
    return matrix.scaled();
  }
  if (name == "generalised-alpha") {
    GeneralisedAlpha alpha(dynamics, tolerances, {.steps = {step}});
    alpha.start(state);
    alpha.step(state.t + 2.0 * step);
    return alpha.matrix().scaled();
  }
  if (name.starts_with("arkode") || name.starts_with("adams")) return dynamics.matrix();
  AccelerationMatrix matrix(system);
  matrix.evaluate(state.t, c, state.q.data(), state.v.data(), state.z.data(), state.lambda.data(),
                  state.a.data());
  matrix.factorise();
  return matrix.scaled();
}

struct Cost {
  double step = 0.0, klu = 0.0;                             // [s]
  double evaluations = 0.0, factors = 0.0, rejected = 0.0;  // in a step
  double set_up = 0.0;                                      // [s]
  double klu_set_up = 0.0;                                  // [s] analysis and first factor
};

long factors_of(const Dynamics& dynamics, const Formulation& formulation) {
  const FactorCounters own = formulation.counters().factors, saddle = dynamics.counters();
  return own.refactorisations + own.fresh + saddle.refactorisations + saddle.fresh;
}

Cost measure(std::string_view name, Chain& chain, int repeats) {
  const SimulationOptions options = options_of(std::string(name));
  Dynamics& dynamics = *chain.dynamics;
  const Tolerances tolerances = choose_tolerances(dynamics.system(), options);
  std::unique_ptr<BareKlu> klu;
  double klu_seconds = 0.0;
  Cost cost{.set_up = infinity};
  std::array<double, blocks> steps{}, klus{};
  steps.fill(infinity);
  klus.fill(infinity);
  for (int repeat = 0; repeat < repeats; ++repeat) {
    dynamics.reset();
    dynamics.system().bind(chain.state);
    auto begin = Clock::now();
    const auto formulation = entry_of(name).make(dynamics, tolerances);
    formulation->start(chain.state);
    cost.set_up = std::min(cost.set_up, seconds_since(begin));
    const auto step = [&] {
      if (formulation->step(options.until) != Step::advanced) std::abort();
    };
    for (int i = 0; i < warm_up; ++i) step();
    if (!klu) {
      State state = chain.state;
      formulation->interpolate(formulation->time(), state);
      if (!dynamics.project(state)) std::abort();
      const SparseMatrix matrix =
          matrix_of(name, dynamics, tolerances, state, formulation->last_step());
      begin = Clock::now();
      klu = std::make_unique<BareKlu>(matrix);
      cost.klu_set_up = seconds_since(begin);
      dynamics.system().bind(chain.state);
      begin = Clock::now();
      klu->refactor_and_solve();
      klu_seconds = seconds_since(begin);
    }
    evaluations = 0;
    const long factors = factors_of(dynamics, *formulation);
    const long rejected = formulation->counters().rejected;
    for (std::size_t block = 0; block < blocks; ++block) {
      begin = Clock::now();
      for (int i = 0; i < steps_in_block; ++i) step();
      const double seconds = seconds_since(begin);
      steps[block] = std::min(steps[block], seconds / steps_in_block);
      const double span = std::max(klu_share * seconds, shortest_block);
      const int count = std::max(2, static_cast<int>(span / klu_seconds));
      begin = Clock::now();
      for (int i = 0; i < count; ++i) klu->refactor_and_solve();
      klu_seconds = seconds_since(begin) / count;
      klus[block] = std::min(klus[block], klu_seconds);
    }
    constexpr double all = blocks * steps_in_block;
    cost.evaluations = static_cast<double>(evaluations) / all;
    cost.factors = static_cast<double>(factors_of(dynamics, *formulation) - factors) / all;
    cost.rejected = static_cast<double>(formulation->counters().rejected - rejected) / all;
  }
  for (std::size_t block = 0; block < blocks; ++block) {
    cost.step += steps[block] / blocks;
    cost.klu += klus[block] / blocks;
  }
  return cost;
}

/// Slope of log time over log N by least squares.
double exponent(const std::vector<int>& links, const std::vector<Cost>& costs,
                double (*time)(const Cost&)) {
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (std::size_t i = 0; i < links.size(); ++i) {
    const double x = std::log(links[i]), y = std::log(time(costs[i]));
    sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  const double n = static_cast<double>(links.size());
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

/// The same from the two ends alone.
double end_exponent(const std::vector<int>& links, const std::vector<Cost>& costs,
                    double (*time)(const Cost&)) {
  return std::log(time(costs.back()) / time(costs.front())) /
         std::log(static_cast<double>(links.back()) / links.front());
}

double time_of_step(const Cost& c) { return c.step; }
double time_of_klu(const Cost& c) { return c.klu; }
double time_of_evaluation(const Cost& c) { return c.step / c.evaluations; }

int repeats_for(int links) { return std::clamp(20000 / links, 1, 30); }

void print_growth(const std::vector<int>& links, const std::vector<std::vector<Cost>>& costs) {
  fmt::print(
      "\nGrowth with the number of links (exponent; least squares, and from end to end)\n\n");
  fmt::print("{:18} {:>15} {:>15} {:>15} {:>17} {}\n", "formulation", "step", "KLU", "difference",
             "per evaluation", fmt::format(" at most KLU + {}", allowance));
  for (std::size_t f = 0; f < costs.size(); ++f) {
    const auto pair = [&](double (*time)(const Cost&)) {
      return std::array{exponent(links, costs[f], time), end_exponent(links, costs[f], time)};
    };
    const auto step = pair(time_of_step), klu = pair(time_of_klu);
    const auto evaluation = pair(time_of_evaluation);
    const auto show = [](double a, double b) { return fmt::format("{:.3f} {:.3f}", a, b); };
    fmt::print("{:18} {:>15} {:>15} {:>15} {:>17}  {}\n", formulation_registry()[f].name,
               show(step[0], step[1]), show(klu[0], klu[1]),
               show(step[0] - klu[0], step[1] - klu[1]), show(evaluation[0], evaluation[1]),
               std::max(step[0] - klu[0], step[1] - klu[1]) <= allowance ? "PASS" : "MISS");
  }
}

void print_formulations(const std::vector<int>& links) {
  std::vector<std::vector<Cost>> costs(formulation_registry().size());
  std::vector<double> model(links.size()), assembly(links.size());
  for (std::size_t i = 0; i < links.size(); ++i) {
    Chain chain(links[i]);
    model[i] = chain.model_seconds;
    assembly[i] = chain.assembly_seconds;
    for (std::size_t f = 0; f < costs.size(); ++f)
      costs[f].push_back(measure(formulation_registry()[f].name, chain, repeats_for(links[i])));
  }
  fmt::print("Cost of a step of a chain, rtol 1e-6, {} steps after {}\n\n", blocks * steps_in_block,
             warm_up);
  fmt::print("{:18} {:>7} {:>13} {:>12} {:>9} {:>9} {:>12} {:>8} {:>15} {:>12}\n", "formulation",
             "links", "step ns/link", "KLU ns/link", "step/KLU", "rejected", "evaluations",
             "factors", "set-up ns/link", "of KLU alone");
  for (std::size_t f = 0; f < costs.size(); ++f) {
    for (std::size_t i = 0; i < links.size(); ++i) {
      const Cost& c = costs[f][i];
      const double ns = 1e9 / links[i];
      fmt::print(
          "{:18} {:>7} {:>13.0f} {:>12.0f} {:>9.2f} {:>9.2f} {:>12.2f} {:>8.2f} {:>15.0f} "
          "{:>12.0f}\n",
          formulation_registry()[f].name, links[i], ns * c.step, ns * c.klu, c.step / c.klu,
          c.rejected, c.evaluations, c.factors, ns * c.set_up, ns * c.klu_set_up);
    }
  }
  if (links.size() > 1) print_growth(links, costs);
  fmt::print("\nBefore the first step, ns per link\n\n{:>7} {:>12} {:>12}\n", "links", "model",
             "assembly");
  for (std::size_t i = 0; i < links.size(); ++i)
    fmt::print("{:>7} {:>12.0f} {:>12.0f}\n", links[i], 1e9 * model[i] / links[i],
               1e9 * assembly[i] / links[i]);
}

// A whole run with three samples and few steps, and its output.
void print_runs(const std::vector<int>& links) {
  const auto folder = std::filesystem::temp_directory_path() / "yoke_bench_formulations";
  fmt::print("\nA run with few steps and 3 samples, us per link\n\n{:>7} {:>7} {:>9} {:>9}\n",
             "links", "steps", "simulate", "write");
  for (const int n : links) {
    const Model model = chain(n);
    SimulationOptions options = options_of("automatic");
    options.until = 2e-3;
    options.samples = 3;
    auto begin = Clock::now();
    const Result result = simulate(model, options);
    const double run = seconds_since(begin);
    if (!result.summary.ok()) std::abort();
    begin = Clock::now();
    result.write(folder);
    fmt::print("{:>7} {:>7} {:>9.2f} {:>9.2f}\n", n, result.summary.steps, 1e6 * run / n,
               1e6 * seconds_since(begin) / n);
  }
  std::filesystem::remove_all(folder);
}

}  // namespace

int main(int argc, char** argv) {
  int most = 100000;
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument(argv[i]);
    if (argument.starts_with("--most=")) most = std::atoi(argv[i] + 7);
    // `./dev bench --benchmark_filter=...` asks for others
    if (argument.starts_with("--benchmark_filter=")) return 0;
  }
  std::vector<int> links{10, 100, 1000, 10000, 100000};
  std::erase_if(links, [most](int n) { return n > most; });
  print_formulations(links);
  print_runs(links);
}
