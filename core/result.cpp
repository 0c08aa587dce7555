// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/core/result.hpp>

#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include <yoke/core/error.hpp>

namespace yoke {

namespace {

/// A file that is there whole or not at all: it is written beside its place and takes it once it is
/// closed. What is no file, as a pipe or a device, is written to directly.
class OutputFile {
 public:
  explicit OutputFile(const std::filesystem::path& path) : path_(path), target_(path) {
    std::error_code unknown;
    if (std::filesystem::is_symlink(path, unknown))
      target_ = std::filesystem::weakly_canonical(path, unknown);
    const bool other = std::filesystem::exists(target_, unknown) &&
                       !std::filesystem::is_regular_file(target_, unknown);
    written_ = target_;
    if (!other) written_ += ".part";
    file_ = std::fopen(written_.c_str(), "w");
    if (file_ == nullptr) fail(errno);
    buffer_.reserve(1 << 16);
  }
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile() {
    if (file_ != nullptr) std::fclose(file_);
    discard();
  }

  void line(std::string_view text) {
    buffer_.append(text);
    buffer_.push_back('\n');
    if (buffer_.size() > (1 << 15)) flush();
  }
  /// The file takes its place.
  void finish() {
    flush();
    // Some file systems tell only here that there is no room.
    if (std::fclose(std::exchange(file_, nullptr)) != 0) fail(errno);
    std::error_code error;
    if (written_ != target_) std::filesystem::rename(written_, target_, error);
    if (error) fail(error.value());
    finished_ = true;
  }

 private:
  void flush() {
    const std::size_t done = std::fwrite(buffer_.data(), 1, buffer_.size(), file_);
    if (done != buffer_.size() || std::fflush(file_) != 0) fail(errno);
    buffer_.clear();
  }
  [[noreturn]] void fail(int error) {
    if (file_ != nullptr) std::fclose(std::exchange(file_, nullptr));
    discard();
    throw OutputError(fmt::format("cannot write '{}': {}", path_.string(), std::strerror(error)));
  }
  void discard() {
    std::error_code unknown;
    if (!finished_ && written_ != target_) std::filesystem::remove(written_, unknown);
    finished_ = true;
  }

  std::filesystem::path path_, target_, written_;
  std::FILE* file_ = nullptr;
  std::string buffer_;
  bool finished_ = false;
};

nlohmann::json number(double x) {
  return std::isfinite(x) ? nlohmann::json(x) : nlohmann::json(nullptr);
}

nlohmann::json larger(double a, double b) { return number(std::max(a, b)); }

}  // namespace

void Table::add_column(std::string name, std::string_view unit, std::vector<std::string> labels) {
  // "m/s^2" becomes "_m_per_s2": column names are identifiers in most tools that read them.
  if (unit == "1") unit = "";
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
  labels_.push_back(std::move(labels));
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

Table Table::merged(const Table& other) const {
  Table table;
  table.names_ = names_;
  table.labels_ = labels_;
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

Table Table::every(std::size_t n) const {
  Table thinned;
  thinned.names_ = names_;
  thinned.labels_ = labels_;
  thinned.reserve(rows_ / n + 1);
  for (std::size_t i = 0; i < rows_; i += n)
    std::copy_n(data_.begin() + static_cast<std::ptrdiff_t>(i * names_.size()), names_.size(),
                thinned.append());
  return thinned;
}

std::string Table::text(std::size_t row, std::size_t column) const {
  const double x = value(row, column);
  if (labels_[column].empty()) return fmt::format("{:.17g}", x);
  return labels_[column].at(static_cast<std::size_t>(x));
}

void Table::write_csv(const std::filesystem::path& path) const {
  OutputFile file(path);
  file.line(fmt::format("{}", fmt::join(names_, ",")));
  fmt::memory_buffer line;
  for (std::size_t i = 0; i < rows_; ++i) {
    line.clear();
    for (std::size_t j = 0; j < names_.size(); ++j) {
      if (j > 0) line.push_back(',');
      if (labels_[j].empty()) {
        fmt::format_to(std::back_inserter(line), "{:.17g}", value(i, j));
      } else {
        fmt::format_to(std::back_inserter(line), "{}", text(i, j));
      }
    }
    file.line({line.data(), line.size()});
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
  OutputFile file(path);
  file.line(text);
  file.finish();
}

void write_events(const std::vector<EventRecord>& events, const std::filesystem::path& path) {
  OutputFile file(path);
  file.line("t_s,kind,region,speed_m_per_s,penetration_m,element");
  for (const EventRecord& e : events)
    file.line(fmt::format("{:.17g},{},{},{:.17g},{:.17g},{}", e.t, e.kind, e.region, e.speed,
                          e.penetration, e.element));
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
      {"stop", stop[static_cast<int>(s.stop)]},
      {"reason", s.reason},
      {"formulation", s.formulation},
      {"formulation_reason", s.formulation_reason},
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
  samples.write_csv(folder / "motion.csv");
  write_events(events, folder / "events.csv");
  write_text(folder / "summary.json", to_json(summary));
}

}  // namespace yoke
