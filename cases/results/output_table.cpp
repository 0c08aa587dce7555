// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/results/output_table.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include <yoke/core/equations/dynamics.hpp>
#include <yoke/core/error.hpp>
#include <yoke/core/output/pattern.hpp>
#include <yoke/integrators/run/recorder.hpp>

namespace yoke::cases {

SampleColumns::SampleColumns(const Table& header, const std::vector<MotionColumn>& own,
                             const OutputChoice& choice)
    : choice_(choice) {
  for (const std::string& part : header.parts()) {
    if (part == "motion" && !own.empty()) {
      for (const MotionColumn& c : own) {
        Table alone;  // it makes the name
        alone.add_column(c.name, c.unit);
        const std::size_t source = header.index(c.source);
        columns_.push_back(
            {part, alone.names().front(), c.unit, header.labels(source), source, c.shift});
      }
    } else {
      for (const std::size_t source : header.columns_of(part)) add(part, header, source);
    }
  }
  if (!choice.columns.empty()) choose(choice.columns);
}

void SampleColumns::add(const std::string& table, const Table& header, std::size_t source) {
  columns_.push_back(
      {table, header.names()[source], header.unit(source), header.labels(source), source, 0.0});
}

/// The time of each table stays; a table of nothing else goes.
void SampleColumns::choose(const std::vector<std::string>& patterns) {
  std::vector<std::string> names;
  for (const Column& c : columns_)
    if (std::ranges::find(names, c.name) == names.end()) names.push_back(c.name);
  for (const std::string& pattern : patterns)
    if (std::ranges::none_of(names, [&](const std::string& n) { return matches(pattern, n); }))
      throw ModelError(
          fmt::format("--columns {}: no column matches{}", pattern, suggestion(pattern, names)));
  const auto wanted = [&](const Column& c) {
    return std::ranges::any_of(patterns, [&](const std::string& p) { return matches(p, c.name); });
  };
  std::set<std::string> tables;
  for (const Column& c : columns_)
    if (c.source != 0 && wanted(c)) tables.insert(c.table);
  std::erase_if(columns_, [&](const Column& c) {
    return !tables.contains(c.table) || (c.source != 0 && !wanted(c));
  });
}

std::vector<OutputTable> SampleColumns::tables(const Table& samples) const {
  std::vector<OutputTable> tables;
  if (choice_.events_only) return tables;
  const std::size_t width = samples.names().size(), rows = samples.rows();
  std::size_t begin = 0;  // the first row written
  while (begin < rows && samples.value(begin, 0) < choice_.from) ++begin;
  const std::size_t step = choice_.every;
  const std::size_t written = begin < rows ? (rows - begin - 1) / step + 1 : 0;
  for (const Column& c : columns_) {
    if (tables.empty() || tables.back().name != c.table)
      tables.push_back({.name = c.table, .rows = written});
    OutputColumn column{.name = c.name, .unit = c.unit, .step = step * width, .shift = c.shift};
    if (written > 0) column.first = samples.data().data() + begin * width + c.source;
    if (!c.labels.empty())
      column.text = [labels = c.labels, first = column.first, step = column.step](std::size_t row) {
        return std::string_view(labels.at(static_cast<std::size_t>(first[row * step])));
      };
    tables.back().columns.push_back(std::move(column));
  }
  return tables;
}

Table sample_header(const Model& model, const std::vector<std::string>& patterns) {
  Dynamics dynamics(model);
  Result result;
  const Recorder recorder(dynamics, result, 0, patterns);
  return std::move(result.samples);
}

OutputTable event_table(const std::vector<EventRecord>& events, double from) {
  static_assert(sizeof(EventRecord) % sizeof(double) == 0);
  constexpr std::size_t step = sizeof(EventRecord) / sizeof(double);
  const auto begin =
      std::ranges::find_if(events, [&](const EventRecord& e) { return e.t >= from; });
  const EventRecord* first = begin == events.end() ? nullptr : &*begin;
  const auto numbers = [&](const char* name, const char* unit, double EventRecord::*member) {
    OutputColumn column{.name = name, .unit = unit, .step = step};
    if (first != nullptr) column.first = &(first->*member);
    return column;
  };
  const auto words = [&](const char* name, std::string EventRecord::*member) {
    OutputColumn column{.name = name, .unit = ""};
    column.text = [first, member](std::size_t row) { return std::string_view(first[row].*member); };
    return column;
  };
  return {.name = "events",
          .columns = {numbers("t_s", "s", &EventRecord::t), words("kind", &EventRecord::kind),
                      words("region", &EventRecord::region),
                      numbers("speed_m_per_s", "m/s", &EventRecord::speed),
                      numbers("penetration_m", "m", &EventRecord::penetration),
                      words("element", &EventRecord::element)},
          .rows = static_cast<std::size_t>(events.end() - begin)};
}

}  // namespace yoke::cases
