// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/sweep/sweep_results.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <system_error>
#include <utility>

#include <yoke/cases/results/hdf5_file.hpp>
#include <yoke/core/error.hpp>
#include <yoke/core/version.hpp>

namespace yoke::cases {

namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

/// The least and the largest of a quantity over the rows.
struct Extremes {
  const StudyRow* least = nullptr;  // none: there is no number
  const StudyRow* most = nullptr;
};

Extremes extremes_of(const StudyResult& study, std::size_t quantity) {
  Extremes e;
  for (const StudyRow& row : study.rows) {
    if (row.state != PointState::completed || std::isnan(row.values[quantity])) continue;
    if (e.least == nullptr || row.values[quantity] < e.least->values[quantity]) e.least = &row;
    if (e.most == nullptr || row.values[quantity] > e.most->values[quantity]) e.most = &row;
  }
  return e;
}

/// How often each reason came, the first of them first.
std::vector<std::pair<std::string, std::size_t>> reasons_of(const StudyResult& study) {
  std::vector<std::pair<std::string, std::size_t>> reasons;
  std::map<std::string, std::size_t> place;
  for (const StudyRow& row : study.rows) {
    if (row.state != PointState::failed) continue;
    const auto [at, is_new] = place.try_emplace(row.reason, reasons.size());
    if (is_new) reasons.emplace_back(row.reason, 0);
    ++reasons[at->second].second;
  }
  return reasons;
}

Json axes_json(const SweepPoints& points) {
  Json axes = Json::array();
  for (std::size_t a = 0; a < points.points().axes().size(); ++a) {
    const StudyAxis& axis = points.points().axes()[a];
    Json json = {{"name", axis.name}, {"unit", axis.unit}};
    if (!axis.words.empty()) json["words"] = axis.words;
    if (axis.range) json["logarithmic"] = axis.logarithmic;
    axes.push_back(std::move(json));
  }
  return axes;
}

std::string sweep_summary(const Case& c, const SweepRequest& request, const SweepPoints& points,
                          const StudyResult& study) {
  Json json = {{"schema", sweep_schema},
               {"version", version},
               {"case", c.name},
               {"command", request.command},
               {"points", points.points().origin()},
               {"axes", axes_json(points)},
               {"total", study.progress.total},
               {"done", study.progress.done},
               {"failed", study.progress.failed},
               {"complete", study.complete}};
  for (const auto& [reason, count] : reasons_of(study))
    json["failures"].push_back({{"reason", reason}, {"count", count}});
  for (std::size_t k = 0; k < study.quantities.size(); ++k) {
    const Extremes e = extremes_of(study, k);
    Json& q = json["quantities"][study.quantities[k].name];
    q["unit"] = study.quantities[k].unit;
    if (e.least == nullptr) continue;
    q["least"] = {{"value", e.least->values[k]}, {"point", e.least->point}};
    q["largest"] = {{"value", e.most->values[k]}, {"point", e.most->point}};
  }
  double seconds = 0.0;
  for (const StudyRow& row : study.rows) seconds += row.seconds;
  json["seconds_of_points"] = seconds;  // of all processors, resumed ones too
  json["seconds"] = study.progress.elapsed;
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

/// The numbers of the table in memory, and its words and reasons as text.
OutputTable output_table(const Table& table, const std::vector<const StudyRow*>& rows) {
  OutputTable out{.name = "sweep", .rows = table.rows()};
  const std::size_t width = table.names().size();
  for (std::size_t j = 0; j < width; ++j) {
    OutputColumn column{.name = table.names()[j], .unit = table.unit(j), .step = width};
    if (table.rows() > 0) column.first = table.data().data() + j;
    if (!table.labels(j).empty())
      column.text = [&table, j](std::size_t row) {
        return std::string_view(table.labels(j)[static_cast<std::size_t>(table.value(row, j))]);
      };
    out.columns.push_back(std::move(column));
  }
  OutputColumn reason{.name = "reason", .unit = ""};
  reason.text = [&rows](std::size_t row) { return std::string_view(rows[row]->reason); };
  out.columns.push_back(std::move(reason));
  return out;
}

void write_sweep_hdf5(const fs::path& path, const StudyResult& study, const std::string& about) {
  const Table table = study.table();
  std::vector<const StudyRow*> rows;
  for (const StudyRow& row : study.rows)
    if (row.state != PointState::missing) rows.push_back(&row);
  const OutputTable out = output_table(table, rows);
  std::size_t width = 1;  // of text
  for (const OutputColumn& column : out.columns)
    for (std::size_t i = 0; column.text && i < out.rows; ++i)
      width = std::max(width, column.text(i).size());
  fs::path part = path;
  part += ".part";
  std::error_code error;
  try {
    Hdf5File file(part, path);
    file.append(out, out.rows, width, true);
    file.add_text("points", about);
    file.close();
  } catch (const OutputError&) {
    fs::remove(part, error);
    throw;
  }
  fs::rename(part, path, error);
  if (error)
    throw OutputError(fmt::format("cannot write '{}': {}", path.string(), error.message()));
}

/// A value of an option for a message.
std::string shown(const Json& json) {
  return json.is_null() ? "nothing" : json.is_string() ? json.get<std::string>() : json.dump();
}

}  // namespace

void settle_sweep(const Case& c, const SweepRequest& request) {
  make_output_folder(request.output);
  const fs::path path = request.output / "sweep.json";
  Json here = {{"schema", sweep_schema}, {"case", c.name}};
  here.update(request.typed);
  if (std::ifstream file(path); file) {
    const Json there = Json::parse(file, nullptr, false);
    for (const auto& [name, value] : here.items()) {
      const Json other = there.is_object() ? there.value(name, Json()) : Json();
      if (other != value)
        throw ModelError(fmt::format(
            "'{}' holds another sweep: {} is {} there and {} here; choose another folder with "
            "-o, or remove that one to begin anew",
            request.output.string(), name, shown(other), shown(value)));
    }
    return;
  }
  write_text(path, here.dump(2));
}

void write_sweep(const Case& c, const SweepRequest& request, const SweepPoints& points,
                 const StudyResult& study) {
  const std::string summary = sweep_summary(c, request, points, study);
  write_text(request.output / "summary.json", summary);
  study.write_csv(request.output / "sweep.csv");
  if (has_hdf5) write_sweep_hdf5(request.output / "sweep.h5", study, points.points().origin());
}

void print_sweep(const Case& c, const SweepRequest& request, const SweepPoints& points,
                 const StudyResult& study) {
  const StudyProgress& p = study.progress;
  if (p.failed > 0) {
    fmt::print(stderr, "yoke: {} of {} points failed:\n", p.failed, p.total);
    std::size_t lines = 0;
    for (const auto& [reason, count] : reasons_of(study)) {
      constexpr std::size_t most_lines = 5;
      if (++lines > most_lines) break;
      fmt::print(stderr, "  {} times: {}\n", count, reason);
    }
  }
  if (request.quiet) return;
  fmt::print("{}: {}, {} done ({} from before), {} failed, {:.1f} s\n", c.name,
             points.points().origin(), p.done, p.reused, p.failed, p.elapsed);
  for (std::size_t k = 0; k < study.quantities.size(); ++k) {
    const Extremes e = extremes_of(study, k);
    const bool of_solver =
        k >= mechanism_quantities && k < mechanism_quantities + solver_quantities;
    if (e.least == nullptr || of_solver) continue;
    const StudyQuantity& q = study.quantities[k];
    if (e.least->values[k] == e.most->values[k]) {
      fmt::print("  {:<28} {:.5g} {}\n", q.name, e.least->values[k], q.unit);
      continue;
    }
    fmt::print("  {:<28} {:.5g} {} (point {}) to {:.5g} {} (point {})\n", q.name,
               e.least->values[k], q.unit, e.least->point, e.most->values[k], q.unit,
               e.most->point);
  }
  fmt::print("results: {}: sweep.csv, {}summary.json{}\n", request.output.string(),
             has_hdf5 ? "sweep.h5, " : "", request.report ? ", report.html" : "");
  if (!study.complete) fmt::print("interrupted; the same command goes on with what is left\n");
}

}  // namespace yoke::cases
