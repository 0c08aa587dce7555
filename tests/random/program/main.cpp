// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Checks random mechanisms and prints the faults by kind; docs/validation/random.md explains them.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include <yoke/tests/random/checks.hpp>
#include <yoke/tests/random/generator.hpp>
#include <yoke/tests/random/print.hpp>
#include <yoke/tests/random/shrink.hpp>

namespace {

using namespace yoke::tests::random;

struct Request {
  std::uint64_t from = 0, count = 2000;
  unsigned jobs = 2;
  std::string kind, family;
  bool shrink = false, print = false, measures = false, quiet = false;
  int examples = 3;
};

/// Verdicts in the order of the seeds, whatever order the threads finish in.
std::vector<Verdict> check_all(const Request& request) {
  std::vector<std::uint64_t> seeds;
  for (std::uint64_t seed = request.from; seed < request.from + request.count; ++seed)
    if (request.family.empty() || generate(seed).family == request.family) seeds.push_back(seed);
  std::vector<Verdict> verdicts(seeds.size());
  std::atomic<std::size_t> next = 0;
  std::vector<std::thread> threads;
  for (unsigned k = 0; k < request.jobs; ++k)
    threads.emplace_back([&] {
      for (std::size_t i = next++; i < seeds.size(); i = next++)
        verdicts[i] = check(generate(seeds[i]), request.kind);
    });
  for (std::thread& thread : threads) thread.join();
  return verdicts;
}

void print_outcomes(const std::vector<Verdict>& verdicts) {
  std::map<std::string, long> outcomes;
  long with_faults = 0;
  for (const Verdict& v : verdicts) {
    ++outcomes[v.outcome];
    if (!v.faults.empty()) ++with_faults;
  }
  fmt::print("{} mechanisms, {} with faults\n\n| outcome of the first run | count |\n|--|--|\n",
             verdicts.size(), with_faults);
  for (const auto& [outcome, count] : outcomes) fmt::print("| {} | {} |\n", outcome, count);
}

void print_faults(const std::vector<Verdict>& verdicts, const Request& request) {
  std::map<std::string, std::vector<std::pair<std::uint64_t, std::string>>> kinds;
  for (const Verdict& v : verdicts)
    for (const Fault& fault : v.faults) kinds[fault.kind].emplace_back(v.seed, fault.detail);
  fmt::print("\n| kind of fault | count | seeds |\n|--|--|--|\n");
  for (const auto& [kind, cases] : kinds) {
    fmt::print("| {} | {} |", kind, cases.size());
    for (std::size_t i = 0; i < std::min<std::size_t>(cases.size(), 12); ++i)
      fmt::print(" {}", cases[i].first);
    fmt::print("{} |\n", cases.size() > 12 ? " ..." : "");
  }
  if (request.quiet) return;
  for (const auto& [kind, cases] : kinds) {
    if (!kind.starts_with(request.kind.substr(0, request.kind.find(' ')))) continue;
    fmt::print("\n## {}\n\n", kind);
    for (std::size_t i = 0;
         i < std::min<std::size_t>(cases.size(), static_cast<std::size_t>(request.examples)); ++i) {
      const auto& [seed, detail] = cases[i];
      fmt::print("* {} ({}): {}\n", seed, generate(seed).family, detail);
      if (!request.shrink && !request.print) continue;
      const Description d = request.shrink ? shrink(generate(seed), kind) : generate(seed);
      const Verdict v = check(d, kind);
      for (const Fault& fault : v.faults)
        if (fault.kind == kind) fmt::print("  shrunk to {} parts: {}\n", d.parts(), fault.detail);
      fmt::print("\n```cpp\n{}```\n", as_code(d, kind));
    }
  }
}

void print_slowest(std::vector<Verdict> verdicts) {
  std::ranges::sort(verdicts, std::greater(), &Verdict::seconds);
  double total = 0.0;
  for (const Verdict& v : verdicts) total += v.seconds;
  fmt::print("\n{:.1f} s together; slowest:", total);
  for (std::size_t i = 0; i < std::min<std::size_t>(verdicts.size(), 8); ++i)
    fmt::print(" {} ({}, {}, {:.2f} s)", verdicts[i].seed, generate(verdicts[i].seed).family,
               verdicts[i].outcome, verdicts[i].seconds);
  fmt::print("\n");
}

/// Quantiles of what was found over what is allowed.
void print_measures(const std::vector<Verdict>& verdicts) {
  std::map<std::string, std::vector<double>> all;
  for (const Verdict& v : verdicts)
    for (const auto& [check, value] : v.measures) all[check].push_back(value);
  fmt::print(
      "\n| found over allowed | median | 90 % | 99 % | 99.9 % | largest |\n|--|--|--|--|--|--|\n");
  for (auto& [check, values] : all) {
    std::ranges::sort(values);
    const auto at = [&, &list = values](double share) {
      return list[static_cast<std::size_t>(share * static_cast<double>(list.size() - 1))];
    };
    fmt::print("| {} | {:.1e} | {:.1e} | {:.1e} | {:.1e} | {:.1e} |\n", check, at(0.5), at(0.9),
               at(0.99), at(0.999), at(1.0));
  }
}

}  // namespace

int main(int argc, char** argv) {
  Request request;
  CLI::App app(
      "Checks random mechanisms: energy, constraints, agreement of formulations, invariance.");
  app.add_option("--from", request.from, "first seed");
  app.add_option("--count", request.count, "how many seeds");
  app.add_option("--jobs", request.jobs, "threads")->check(CLI::Range(1, 1024));
  app.add_option("--kind", request.kind,
                 "only checks that find faults of this kind, as 'turn differs' or 'turn '");
  app.add_option("--family", request.family, "only mechanisms of this family")
      ->check(CLI::IsMember(families()));
  app.add_option("--examples", request.examples, "printed of each kind");
  app.add_flag("--shrink", request.shrink, "reduce the examples and print them as C++");
  app.add_flag("--print", request.print, "print the examples as C++ as they are");
  app.add_flag("--measures", request.measures, "print how far within the bounds the checks were");
  app.add_flag("--quiet", request.quiet, "only tables");
  CLI11_PARSE(app, argc, argv);
  const std::vector<Verdict> verdicts = check_all(request);
  print_outcomes(verdicts);
  print_faults(verdicts, request);
  if (request.measures) {
    print_measures(verdicts);
    print_slowest(verdicts);
  }
  return std::ranges::all_of(verdicts, [](const Verdict& v) { return v.faults.empty(); }) ? 0 : 1;
}
