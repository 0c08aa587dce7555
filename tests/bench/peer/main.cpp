// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// yoke_bench_peer [--large] [--rounds N] [--data DIR]: error against processor time of Yoke, Simbody and
// equations by hand, on four problems and several accuracies, as a document in Markdown. All programs
// are measured in turn, round by round; times are medians, ratios those of times interpolated at equal
// error. With --data also as files for a picture (peer.gp draws peer.png).
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <yoke/tests/bench/chain.hpp>
#include <yoke/tests/bench/peer/problems.hpp>
#include <yoke/tests/bench/work_precision.hpp>

namespace {

using namespace yoke::bench;
using namespace yoke::bench::peer;

constexpr double longest = 5.0;  // [s] a run of a round; what takes longer is measured once
constexpr double least = 0.02;   // [s] of measured time a round: short runs are repeated

struct Program {
  std::string name;
  std::function<Trajectory(double)> run;
};

struct Problem {
  std::string key, title;
  double wanted;                  // [m] error at which times are compared
  std::vector<double> reference;  // of a Trajectory
  std::vector<double> accuracies;
  std::vector<Program> programs;
};

/// One program at one accuracy.
struct Point {
  double accuracy = 0.0, error = 0.0;
  std::vector<double> times{};
  double time() const { return median(times); }
};

using Curve = std::vector<Point>;

double error_of(const Trajectory& trajectory, const std::vector<double>& reference) {
  double worst = 0.0;
  for (std::size_t i = 0; i < reference.size(); ++i)
    worst = std::max(worst, std::abs(trajectory.values[i] - reference[i]));
  return worst;
}

/// [s] Processor time of one run, mean of as many as take long enough to be measured.
double time_of(const Program& program, double accuracy) {
  double sum = 0.0;
  int runs = 0;
  while (sum < least) sum += program.run(accuracy).seconds, ++runs;
  return sum / runs;
}

std::vector<Curve> measure(const Problem& problem, int rounds) {
  std::vector<Curve> curves(problem.programs.size());
  for (std::size_t p = 0; p < curves.size(); ++p)
    for (const double accuracy : problem.accuracies) {
      const Trajectory once = problem.programs[p].run(accuracy);
      if (once.values.size() != problem.reference.size()) continue;  // it gave up
      curves[p].push_back({.accuracy = accuracy,
                           .error = error_of(once, problem.reference),
                           .times = {once.seconds}});
      if (once.seconds > longest) break;
    }
  for (int round = 0; round < rounds; ++round)
    for (std::size_t k = 0; k < problem.accuracies.size(); ++k)
      for (std::size_t p = 0; p < curves.size(); ++p)
        if (k < curves[p].size() && curves[p][k].times.front() < longest) {
          Point& point = curves[p][k];
          if (round == 0) point.times.clear();  // the first run warms up
          point.times.push_back(time_of(problem.programs[p], point.accuracy));
        }
  return curves;
}

/// [s] In which a program gets down to an error; nan if it does not.
double time_at(const Curve& curve, double error) {
  std::vector<WorkPoint> points;
  for (const Point& p : curve) points.push_back({.error = p.error, .work = p.time()});
  return work_at(points, error);
}

std::string milliseconds(double seconds) { return fmt::format("{:.3g}", 1e3 * seconds); }

void print_points(const Problem& problem, const std::vector<Curve>& curves) {
  fmt::print("\n{}: error [m] and processor time [ms].\n\n| accuracy asked |", problem.title);
  for (const Program& p : problem.programs) fmt::print(" {} | |", p.name);
  fmt::print("\n|--|");
  for (std::size_t p = 0; p < curves.size(); ++p) fmt::print("--|--|");
  for (const double accuracy : problem.accuracies) {
    fmt::print("\n| {:.0e} |", accuracy);
    for (const Curve& curve : curves) {
      const auto point = std::ranges::find(curve, accuracy, &Point::accuracy);
      if (point == curve.end())
        fmt::print(" - | - |");
      else
        fmt::print(" {:.1e} | {} |", point->error, milliseconds(point->time()));
    }
  }
  fmt::print("\n");
}

void print_ratios(const std::vector<Problem>& problems,
                  const std::vector<std::vector<Curve>>& curves) {
  fmt::print(
      "| problem | error | Yoke [ms] | Simbody / Yoke | Yoke / by hand |\n|--|--|--|--|--|\n");
  for (std::size_t i = 0; i < problems.size(); ++i) {
    const Problem& problem = problems[i];
    const double yoke = time_at(curves[i][0], problem.wanted);
    fmt::print("| {} | {:.0e} m | {} |", problem.title, problem.wanted, milliseconds(yoke));
    const double peer = time_at(curves[i][1], problem.wanted);
    fmt::print(" {} |", std::isnan(peer) ? "not reached" : fmt::format("{:.1f}", peer / yoke));
    if (curves[i].size() > 2)
      fmt::print(" {:.1f} |\n", yoke / time_at(curves[i][2], problem.wanted));
    else
      fmt::print(" |\n");
  }
}

void write_picture(const std::vector<Problem>& problems,
                   const std::vector<std::vector<Curve>>& curves, const std::string& folder) {
  std::string plot =
      "set terminal pngcairo size 1200,900 font 'DejaVu Sans,10'\nset output 'peer.png'\n"
      "set multiplot layout 3,3\nset logscale xy\nset format xy '10^{%T}'\nset grid lc rgb '#dddddd'\n"
      "set xlabel 'error [m]'\nset ylabel 'processor time [s]'\nset key top right\n";
  constexpr const char* colours[] = {"#0072b2", "#d55e00", "#777777"};
  for (std::size_t i = 0; i < problems.size(); ++i) {
    plot += fmt::format("set title '{}'\nplot ", problems[i].title);
    for (std::size_t p = 0; p < curves[i].size(); ++p) {
      const std::string name = fmt::format("{}-{}.txt", problems[i].key, p);
      std::ofstream file(folder + "/" + name);
      for (const Point& point : curves[i][p])
        if (point.error > 0.0) file << fmt::format("{} {}\n", point.error, point.time());
      plot += fmt::format("{}'{}' with linespoints pt 7 lw 2 lc rgb '{}' title '{}'",
                          p == 0 ? "" : ", ", name, colours[p], problems[i].programs[p].name);
    }
    plot += "\n";
  }
  std::ofstream(folder + "/peer.gp") << plot << "unset multiplot\n";
}

std::vector<double> powers(int from, int to) {
  std::vector<double> all;
  for (int k = from; k <= to; ++k) all.push_back(std::pow(10.0, -k));
  return all;
}

constexpr double tightest = 1e-13;

Problem chain_problem(int links) {
  const auto yoke = [links](double a) { return yoke_chain(links, a); };
  Problem problem{.key = fmt::format("chain-{}", links),
                  .title = fmt::format("P1 chain of {} links", links),
                  .wanted = 1e-5,
                  .reference = yoke(links > 1000 ? 1e-11 : tightest).values,
                  .accuracies = links > 100 ? powers(3, 8) : powers(2, 10),
                  .programs = {{"Yoke", yoke},
                               {"Simbody", [links](double a) { return simbody_chain(links, a); }}}};
  if (links == 10) problem.programs.push_back({"by hand", chain_by_hand});
  return problem;
}

Problem four_bar_problem(int loops) {
  return {.key = fmt::format("four-bar-{}", loops),
          .title = fmt::format("P2 {}-four-bar", loops),
          .wanted = 1e-4,
          .reference = exact_four_bar(loops),
          .accuracies = loops > 10 ? powers(3, 8) : powers(2, 10),
          .programs = {{"Yoke", [loops](double a) { return yoke_four_bar(loops, a); }},
                       {"Simbody", [loops](double a) { return simbody_four_bar(loops, a); }}}};
}

Problem scotch_yoke_problem() {
  return {.key = "scotch-yoke",
          .title = "P3 scotch-yoke",
          .wanted = 1e-7,
          .reference = yoke_scotch_yoke(tightest).values,
          .accuracies = powers(3, 11),
          .programs = {{"Yoke", yoke_scotch_yoke},
                       {"Simbody", simbody_scotch_yoke},
                       {"by hand", scotch_yoke_by_hand}}};
}

Problem disc_problem() {
  return {.key = "disc",
          .title = "P4 bouncing disc",
          .wanted = 1e-6,
          .reference = yoke_disc(tightest).values,
          .accuracies = powers(2, 11),
          .programs = {{"Yoke", yoke_disc}, {"Simbody", simbody_disc}, {"by hand", disc_by_hand}}};
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  bool large = false;
  int rounds = 5;
  std::string data;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const bool more = i + 1 < arguments.size();
    if (arguments[i] == "--large") {
      large = true;
    } else if (arguments[i] == "--rounds" && more) {
      rounds = std::max(1, std::stoi(arguments[++i]));
    } else if (arguments[i] == "--data" && more) {
      data = arguments[++i];
    } else {
      fmt::print(stderr, "usage: yoke_bench_peer [--large] [--rounds N] [--data DIR]\n");
      return 2;
    }
  }
  std::vector<Problem> problems = {chain_problem(10), chain_problem(100), chain_problem(1000)};
  if (large) problems.push_back(chain_problem(10000));
  for (const int loops : {1, 10, 40}) problems.push_back(four_bar_problem(loops));
  problems.push_back(scotch_yoke_problem());
  problems.push_back(disc_problem());
  std::vector<std::vector<Curve>> curves;
  for (const Problem& problem : problems) {
    fmt::print(stderr, "{}\n", problem.title);
    curves.push_back(measure(problem, rounds));
  }
  print_ratios(problems, curves);
  for (std::size_t i = 0; i < problems.size(); ++i) print_points(problems[i], curves[i]);
  if (!data.empty()) write_picture(problems, curves, data);
  return 0;
}
