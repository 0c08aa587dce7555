// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/core/result.hpp>

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <numeric>
#include <system_error>
#include <utility>

#include <yoke/core/error.hpp>
#include <yoke/core/output/csv_file.hpp>
#include <yoke/core/version.hpp>

namespace yoke {

namespace {

nlohmann::json number(double x) {
  return std::isfinite(x) ? nlohmann::json(x) : nlohmann::json(nullptr);
}

nlohmann::json larger(double a, double b) { return number(std::max(a, b)); }

}  // namespace

void Table::add_column(std::string name, std::string_view unit, std::vector<std::string> labels) {
  // "m/s^2" becomes "_m_per_s2": column names are identifiers in most tools that read them.
  if (unit == "1") unit = "";
  Kind kind{std::string(unit), part_, std::move(labels)};
  if (!unit.empty()) name += "_";
  for (const char c : unit) {
    if (c == '/') {
      name += "_per_";
    } else if (c == ' ') {
      name += '_';
    } else if (c != '^') {
      name += c;
    }
  }
  names_.push_back(std::move(name));
  const auto known = std::find(kinds_.rbegin(), kinds_.rend(), kind);
  kind_.push_back(static_cast<std::uint32_t>(known == kinds_.rend() ? kinds_.size()
                                                                    : kinds_.rend() - known - 1));
  if (known == kinds_.rend()) kinds_.push_back(std::move(kind));
}

void Table::reserve(std::size_t rows) {
  // Large models ask for more than a machine has before the run is worth it; they grow in blocks.
  constexpr std::size_t largest_block = 1 << 25;  // numbers, 256 MiB
  data_.reserve(std::min(rows * names_.size(), largest_block));
}

double* Table::append() {
  data_.resize(data_.size() + names_.size(), 0.0);
  ++rows_;
  return data_.data() + (rows_ - 1) * names_.size();
}

void Table::keep(std::size_t n) {
  data_.resize(n * names_.size());
  rows_ = n;
}

bool Table::has(std::string_view name) const {
  return std::ranges::find(names_, name) != names_.end();
}

std::size_t Table::index(std::string_view name) const {
  const auto found = std::ranges::find(names_, name);
  if (found != names_.end()) return static_cast<std::size_t>(found - names_.begin());
  throw ModelError(fmt::format("unknown column '{}'; {}", name, nearest(name)));
}

std::string Table::nearest(std::string_view name) const {
  const std::string_view owner = name.substr(0, name.find('.'));
  std::string near;
  for (const std::string& n : names_)
    if (n.starts_with(owner)) near += (near.empty() ? "there are '" : ", '") + n + "'";
  return near.empty() ? "no column starts like it" : near;
}

Eigen::VectorXd Table::operator[](std::string_view name) const {
  const std::size_t column = index(name);
  Eigen::VectorXd values(static_cast<Eigen::Index>(rows_));
  for (std::size_t i = 0; i < rows_; ++i) values(static_cast<Eigen::Index>(i)) = value(i, column);
  return values;
}

std::vector<std::string> Table::parts() const {
  std::vector<std::string> found;
  for (std::size_t i = 1; i < names_.size(); ++i)
    if (std::ranges::find(found, part(i)) == found.end()) found.push_back(part(i));
  if (found.empty()) found.emplace_back("motion");
  return found;
}

std::vector<std::size_t> Table::columns_of(std::string_view part) const {
  std::vector<std::size_t> columns;
  for (std::size_t i = 0; i < names_.size(); ++i)
    if (i == 0 || kind_of(i).part == part) columns.push_back(i);
  return columns;
}

Table Table::headed_alike() const {
  Table table;
  table.part_ = part_;
  table.names_ = names_;
  table.kind_ = kind_;
  table.kinds_ = kinds_;
  return table;
}

Table Table::only(const std::vector<std::size_t>& columns) const {
  Table table;
  table.part_ = part_;
  table.kinds_ = kinds_;
  for (const std::size_t i : columns) {
    table.names_.push_back(names_[i]);
    table.kind_.push_back(kind_[i]);
  }
  return table;
}

Table Table::merged(const Table& other) const {
  Table table = headed_alike();
  const std::size_t width = names_.size();
  table.data_.reserve(data_.size() + other.data_.size());
  const auto take = [&](const Table& from, std::size_t row) {
    const auto first = from.data_.begin() + static_cast<std::ptrdiff_t>(row * width);
    table.data_.insert(table.data_.end(), first, first + static_cast<std::ptrdiff_t>(width));
    ++table.rows_;
  };
  for (std::size_t i = 0, j = 0; i < rows_ || j < other.rows_;) {
    const bool mine = j == other.rows_ || (i < rows_ && data_[i * width] <= other.data_[j * width]);
    while (mine && j < other.rows_ && other.data_[j * width] == data_[i * width]) ++j;
    mine ? take(*this, i++) : take(other, j++);
  }
  return table;
}

Table Table::every(std::size_t n, std::size_t first) const {
  Table thinned = headed_alike();
  if (first < rows_) thinned.reserve((rows_ - first) / n + 1);
  for (std::size_t i = first; i < rows_; i += n)
    std::copy_n(data_.begin() + static_cast<std::ptrdiff_t>(i * names_.size()), names_.size(),
                thinned.append());
  return thinned;
}

std::string Table::text(std::size_t row, std::size_t column) const {
  const double x = value(row, column);
  if (labels(column).empty()) return fmt::format("{}", x);
  return labels(column).at(static_cast<std::size_t>(x));
}

void Table::write_csv(const std::filesystem::path& path) const {
  std::vector<std::size_t> all(names_.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  write_csv(path, all);
}

void Table::write_csv(const std::filesystem::path& path,
                      const std::vector<std::size_t>& columns) const {
  CsvFile file(path);
  for (const std::size_t j : columns) file.cell(names_[j]);
  file.end_line();
  for (std::size_t i = 0; i < rows_; ++i) {
    for (const std::size_t j : columns) {
      const double x = value(i, j);
      if (labels(j).empty())
        file.cell(x);
      else
        file.cell(labels(j).at(static_cast<std::size_t>(x)));
    }
    file.end_line();
  }
  file.finish();
}

void make_output_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw OutputError(
        fmt::format("cannot make the output folder '{}': {}", folder.string(), error.message()));
  if (::access(folder.c_str(), W_OK) != 0)
    throw OutputError(fmt::format("cannot write into the output folder '{}': {}", folder.string(),
                                  std::strerror(errno)));
}

void write_text(const std::filesystem::path& path, std::string_view text) {
  CsvFile file(path);
  file.line(text);
  file.finish();
}

void write_events(const std::vector<EventRecord>& events, const std::filesystem::path& path) {
  CsvFile file(path);
  file.line("t_s,kind,region,speed_m_per_s,penetration_m,element");
  for (const EventRecord& e : events) {
    file.cell(e.t);
    file.cell(e.kind);
    file.cell(e.region);
    file.cell(e.speed);
    file.cell(e.penetration);
    file.cell(e.element);
    file.end_line();
  }
  file.finish();
}

std::string to_json(const Summary& s) {
  const char* stop[] = {"completed", "by_event", "interrupted", "failed"};
  nlohmann::ordered_json singular = nlohmann::ordered_json::array();
  for (const SingularPosition& p : s.singular_positions)
    singular.push_back({{"t_s", p.t},
                        {"equation", p.equation},
                        {"independence", number(p.independence)},
                        {"energy_before_J", number(p.energy_before)},
                        {"energy_after_J", number(p.energy_after)}});
  const nlohmann::ordered_json json = {
      {"schema", summary_schema},
      {"version", version},
      {"stop", stop[static_cast<int>(s.stop)]},
      {"reason", s.reason},
      {"formulation", s.formulation},
      {"formulation_reason", s.formulation_reason},
      {"linear_solver", s.linear_solver},
      {"relative_tolerance", s.relative_tolerance},
      {"tolerance_kept", std::max(s.relative_tolerance, s.tolerance_kept)},
      {"length_scale_m", s.length_scale},
      {"time_scale_s", s.time_scale},
      {"t_start_s", s.t_start},
      {"t_end_s", s.t_end},
      {"t_asked_s", s.t_asked},
      {"steps", s.steps},
      {"rejected", s.rejected},
      {"evaluations", s.evaluations},
      {"recording_evaluations", s.recording_evaluations},
      {"jacobians", s.jacobians},
      {"refactorisations", s.refactorisations},
      {"fresh_factorisations", s.fresh_factorisations},
      {"factorisations", s.refactorisations + s.fresh_factorisations},
      {"events", s.events},
      {"last_step_s", s.last_step},
      {"position_violation_m", number(s.position_violation)},
      {"angle_violation_rad", number(s.angle_violation)},
      {"velocity_violation_m_per_s", number(s.velocity_violation)},
      {"angular_velocity_violation_rad_per_s", number(s.angular_velocity_violation)},
      {"position_drift_m", number(s.position_drift)},
      {"angle_drift_rad", number(s.angle_drift)},
      {"velocity_drift_m_per_s", number(s.velocity_drift)},
      {"angular_velocity_drift_rad_per_s", number(s.angular_velocity_drift)},
      // Before 0.2 one figure each, of metres and radians mixed: the larger of the two.
      {"position_violation_m_or_rad", larger(s.position_violation, s.angle_violation)},
      {"velocity_violation_m_per_s_or_rad_per_s",
       larger(s.velocity_violation, s.angular_velocity_violation)},
      {"position_drift_m_or_rad", larger(s.position_drift, s.angle_drift)},
      {"velocity_drift_m_per_s_or_rad_per_s", larger(s.velocity_drift, s.angular_velocity_drift)},
      {"energy_balance_J", number(s.energy_balance)},
      {"energy_exchanged_J", number(s.energy_exchanged)},
      {"degrees_of_freedom", s.degrees_of_freedom},
      {"redundant_equations", s.redundant_equations},
      {"not_unique_reactions", s.not_unique_reactions},
      {"singular_positions", singular},
      {"notes", s.notes},
      {"wall_time_s", s.wall_time},
  };
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

void Result::write(const std::filesystem::path& folder) const {
  make_output_folder(folder);
  for (const std::string& part : samples.parts())
    samples.write_csv(folder / (part + ".csv"), samples.columns_of(part));
  write_events(events, folder / "events.csv");
  write_text(folder / "summary.json", to_json(summary));
}

}  // namespace yoke
