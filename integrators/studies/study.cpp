// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/studies/study.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <exception>
#include <limits>
#include <mutex>
#include <optional>
#include <string_view>
#include <thread>
#include <utility>

#include <yoke/core/error.hpp>
#include <yoke/core/output/csv_file.hpp>
#include <yoke/integrators/studies/details/journal.hpp>
#include <yoke/integrators/studies/work_pool.hpp>

namespace yoke {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// FNV-1a of 64 bits.
class Fingerprint {
 public:
  void add(std::string_view text) {
    for (const char c : text) take(static_cast<unsigned char>(c));
    take(0);
  }
  void add(double number) {
    unsigned char bytes[sizeof number];
    std::copy_n(reinterpret_cast<const unsigned char*>(&number), sizeof number, bytes);
    for (const unsigned char b : bytes) take(b);
  }
  std::string text() const { return fmt::format("{:016x}", sum_); }

 private:
  void take(unsigned char byte) { sum_ = (sum_ ^ byte) * 1099511628211u; }
  std::uint64_t sum_ = 14695981039346656037u;
};

std::string fingerprint(const StudyPoints& points, const std::vector<StudyQuantity>& quantities,
                        const std::string& identity) {
  Fingerprint sum;
  sum.add(identity);
  for (const StudyAxis& axis : points.axes()) {
    sum.add(axis.name);
    sum.add(axis.unit);
    for (const std::string& word : axis.words) sum.add(word);
  }
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t a = 0; a < points.axes().size(); ++a) sum.add(points.coordinate(i, a));
  for (const StudyQuantity& q : quantities) {
    sum.add(q.name);
    sum.add(q.unit);
  }
  return sum.text();
}

/// In one line of a table.
std::string one_line(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
  return text;
}

/// The columns of the table without rows.
Table header_of(const StudyResult& study) {
  Table table;
  table.add_column("point", "");
  for (const StudyAxis& axis : study.points.axes())
    table.add_column(axis.name, axis.unit, axis.words);
  for (const StudyQuantity& q : study.quantities) table.add_column(q.name, q.unit);
  table.add_column("state", "", {"missing", "completed", "failed"});
  return table;
}

void require_distinct_columns(const StudyResult& study) {
  std::vector<std::string> names = header_of(study).names();
  names.emplace_back("reason");
  std::ranges::sort(names);
  const auto twice = std::ranges::adjacent_find(names);
  if (twice != names.end())
    throw ModelError(fmt::format("the table of the study would have two columns '{}'", *twice));
}

/// What the rows of one study go through; `deliver` is called from any thread.
class Ledger {
 public:
  Ledger(StudyResult& study, const StudyOptions& options, Journal* journal)
      : study_(study), options_(options), journal_(journal), start_(Clock::now()) {
    study_.progress = {.total = study.points.size()};
    study_.rows.resize(study.points.size());
    for (std::size_t i = 0; i < study.rows.size(); ++i) study_.rows[i].point = i;
    if (journal_ != nullptr)
      for (StudyRow& row : journal_->take_rows()) take(std::move(row));
    study_.progress.reused = study_.progress.done;
    report();
  }
  void deliver(const std::vector<StudyRow>& rows) {
    const std::lock_guard lock(mutex_);
    if (journal_ != nullptr) journal_->append(rows);
    for (const StudyRow& row : rows) take(row);
    report();
  }
  void finish() {
    if (journal_ != nullptr) journal_->sync();
    study_.complete = study_.progress.done == study_.points.size();
    report();
  }

 private:
  void take(StudyRow row) {
    StudyRow& place = study_.rows[row.point];
    if (place.state != PointState::missing) return;
    ++study_.progress.done;
    if (row.state == PointState::failed) ++study_.progress.failed;
    place = std::move(row);
  }
  void report() {
    StudyProgress& p = study_.progress;
    p.elapsed = seconds_since(start_);
    const std::size_t here = p.done - p.reused;
    p.remaining = p.done == p.total ? 0.0
                  : here > 0        ? p.elapsed * double(p.total - p.done) / double(here)
                                    : not_a_number;
    if (options_.observer) options_.observer(p);
  }

  StudyResult& study_;
  const StudyOptions& options_;
  Journal* journal_;
  Clock::time_point start_;
  std::mutex mutex_;
};

StudyRow computed(const StudyPoints& points, std::size_t index, std::size_t quantities,
                  const StudyFunction& function) {
  const Clock::time_point start = Clock::now();
  StudyOutcome outcome;
  try {
    outcome = function(StudyPoint(points, index));
    if (outcome.values.size() > quantities)
      outcome = {.failure = fmt::format("the function gave {} values; there are {} quantities",
                                        outcome.values.size(), quantities)};
  } catch (const std::exception& error) {
    outcome = {.failure = *error.what() != '\0' ? error.what() : "an exception without a text"};
  }
  StudyRow row{.point = index, .values = std::move(outcome.values)};
  row.values.resize(quantities, not_a_number);
  for (double& x : row.values)
    if (std::isnan(x)) x = not_a_number;  // one kind alone, for equal bits
  row.reason = one_line(std::move(outcome.failure));
  row.seconds = seconds_since(start);
  if (!outcome.unfinished)
    row.state = row.reason.empty() ? PointState::completed : PointState::failed;
  return row;
}

const char* state_text(PointState state) {
  return state == PointState::completed ? "completed" : "failed";
}

}  // namespace

StudyExecutor on_threads(int jobs) {
  if (jobs < 1) jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  return [jobs](const StudyWork& work) {
    run_parallel(work.points.size(), jobs, [&](std::size_t i) {
      if (work.stopped()) return;
      StudyRow row = work.compute(work.points[i]);
      if (row.state != PointState::missing) work.deliver({std::move(row)});
    });
  };
}

Table StudyResult::table() const {
  Table table = header_of(*this);
  for (const StudyRow& r : rows) {
    if (r.state == PointState::missing) continue;
    double* cell = table.append();
    *cell++ = static_cast<double>(r.point);
    for (std::size_t a = 0; a < points.axes().size(); ++a) *cell++ = points.coordinate(r.point, a);
    for (const double x : r.values) *cell++ = x;
    *cell = static_cast<double>(r.state);
  }
  return table;
}

void StudyResult::write_csv(const std::filesystem::path& path) const {
  CsvFile file(path);
  const Table header = header_of(*this);
  for (const std::string& name : header.names()) file.cell(std::string_view(name));
  file.cell("reason");
  file.end_line();
  for (const StudyRow& r : rows) {
    if (r.state == PointState::missing) continue;
    file.cell(static_cast<double>(r.point));
    for (std::size_t a = 0; a < points.axes().size(); ++a)
      file.cell(std::string_view(points.text(r.point, a)));
    for (const double x : r.values) file.cell(x);
    file.cell(state_text(r.state));
    file.cell(std::string_view(r.reason));
    file.end_line();
  }
  file.finish();
}

StudyResult run_study(StudyPoints points, std::vector<StudyQuantity> quantities,
                      const StudyFunction& function, const StudyOptions& options) {
  if (points.axes().empty()) throw ModelError("a study needs at least one axis");
  StudyResult study{.points = std::move(points), .quantities = std::move(quantities)};
  require_distinct_columns(study);
  const std::size_t width = study.quantities.size();
  StudyWork work;
  work.compute = [&](std::size_t i) { return computed(study.points, i, width, function); };
  work.stopped = [&] { return options.stop && options.stop(); };
  const StudyExecutor execute = options.executor ? options.executor : on_threads(options.jobs);
  if (!options.leads) {
    execute(work);
    return study;
  }
  std::optional<Journal> journal;
  if (!options.folder.empty())
    journal.emplace(options.folder, fingerprint(study.points, study.quantities, options.identity),
                    study.points.size(), width);
  Ledger ledger(study, options, journal ? &*journal : nullptr);
  work.deliver = [&](const std::vector<StudyRow>& rows) { ledger.deliver(rows); };
  for (const StudyRow& row : study.rows)
    if (row.state == PointState::missing) work.points.push_back(row.point);
  execute(work);
  ledger.finish();
  return study;
}

}  // namespace yoke
