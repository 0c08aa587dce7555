// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What writing results costs: all rows of a run with impacts (slider-crank with clearance) as CSV files and
// as results.h5, beside fprintf of the same digits into files of the same names. The three are run in turn;
// the counters are medians over the rounds, of processor time:
//   csv_ns, hdf5_ns, fprintf_ns   per number
//   csv_to_hdf5                   aim: at least 3
//   fprintf_to_csv                aim: at least 1
//   csv_bytes, hdf5_bytes         per number
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <vector>

#include <yoke/cases/jobs/law_run.hpp>
#include <yoke/cases/results/hdf5_file.hpp>
#include <yoke/cases/results/run_output.hpp>

namespace {

using namespace yoke;
using namespace yoke::cases;
namespace fs = std::filesystem;

/// A run recorded densely, and what a writer needs to know of it.
struct Written {
  const Case& mechanism = find_case("slider_crank_clearance");
  Parameters parameters{mechanism.parameters, std::vector<std::string>{}};
  Model model = make_model(mechanism, parameters, "hertz-flores");
  LawRun run;
  std::vector<OutputTable> tables;
  std::vector<std::vector<int>> digits;  // of each column
  double numbers = 0.0;

  Written() {
    const RunRequest request{.parameters = parameters,
                             .laws = {"hertz-flores"},
                             .output = {},
                             .samples = 100001,
                             .plots = false};
    run = run_law(mechanism, request, "hertz-flores", {});
    tables = SampleColumns(sample_header(model), {}, {}).tables(run.samples);
    for (const OutputTable& table : tables)
      for (const OutputColumn& column : table.columns) {
        digits.emplace_back();
        for (std::size_t i = 0; i < table.rows && !column.text; ++i)
          digits.back().push_back(digits_of(column.number(i)));
        numbers += static_cast<double>(table.rows);
      }
  }

  void write(const std::string& format, const fs::path& folder) const {
    make_output_folder(folder);
    RunOutput output({.format = format}, folder);
    output.begin(model, {}, run.samples.rows());
    output.finish(run.samples, run.events, {}, "{}");
  }

  void print(const fs::path& folder) const {
    make_output_folder(folder);
    std::size_t first = 0;
    for (const OutputTable& table : tables) {
      std::FILE* file = std::fopen((folder / (table.name + ".csv")).c_str(), "w");
      for (const OutputColumn& c : table.columns) std::fprintf(file, "%s,", c.name.c_str());
      for (std::size_t i = 0; i < table.rows; ++i) {
        for (std::size_t j = 0; j < table.columns.size(); ++j) {
          const OutputColumn& c = table.columns[j];
          if (c.text)
            std::fprintf(file, ",%s", std::string(c.text(i)).c_str());
          else
            std::fprintf(file, ",%.*g", digits[first + j][i], c.number(i));
        }
        std::fputc('\n', file);
      }
      std::fclose(file);
      first += table.columns.size();
    }
  }

 private:
  static int digits_of(double x) {
    const std::string shortest = fmt::format("{}", x);
    const std::size_t end = std::min(shortest.find('e'), shortest.size());
    int count = 0;
    bool begun = false;
    for (const char k : shortest.substr(0, end)) {
      begun = begun || (k >= '1' && k <= '9');
      if (begun && k >= '0' && k <= '9') ++count;
    }
    return std::max(count, 1);
  }
};

/// [s] Processor time, of the system's part too.
template <class Work>
double seconds_of(const Work& work) {
  const std::clock_t begin = std::clock();
  work();
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

double middle(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

double bytes_in(const fs::path& folder, const char* ending) {
  double bytes = 0.0;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.path().string().ends_with(ending)) bytes += static_cast<double>(entry.file_size());
  return bytes;
}

void writing_results(benchmark::State& bench) {
  const Written written;
  const fs::path folder =
      fs::temp_directory_path() / fmt::format("yoke-bench-{}", static_cast<const void*>(&written));
  std::vector<double> csv, hdf5, plain, csv_to_hdf5, plain_to_csv;
  for (auto _ : bench) {
    csv.push_back(seconds_of([&] { written.write("csv", folder / "csv"); }));
    if (has_hdf5) hdf5.push_back(seconds_of([&] { written.write("hdf5", folder / "hdf5"); }));
    plain.push_back(seconds_of([&] { written.print(folder / "plain"); }));
    bench.SetIterationTime(csv.back());
    if (has_hdf5) csv_to_hdf5.push_back(csv.back() / hdf5.back());
    plain_to_csv.push_back(plain.back() / csv.back());
  }
  bench.counters["csv_ns"] = 1e9 * middle(csv) / written.numbers;
  bench.counters["fprintf_ns"] = 1e9 * middle(plain) / written.numbers;
  bench.counters["fprintf_to_csv"] = middle(plain_to_csv);
  bench.counters["csv_bytes"] = bytes_in(folder / "csv", ".csv") / written.numbers;
  if (has_hdf5) {
    bench.counters["hdf5_ns"] = 1e9 * middle(hdf5) / written.numbers;
    bench.counters["csv_to_hdf5"] = middle(csv_to_hdf5);
    bench.counters["hdf5_bytes"] = bytes_in(folder / "hdf5", ".h5") / written.numbers;
  }
  fs::remove_all(folder);
}
BENCHMARK(writing_results)->Unit(benchmark::kMillisecond)->Iterations(11)->UseManualTime();

}  // namespace
