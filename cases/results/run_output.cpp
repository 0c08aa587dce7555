// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/results/run_output.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <system_error>
#include <utility>

#include <yoke/cases/results/mat_file.hpp>
#include <yoke/core/error.hpp>
#include <yoke/core/output/csv_file.hpp>

namespace yoke::cases {

namespace {

constexpr double seconds_between_looks = 1.0;
constexpr std::size_t text_while_running = 64;  // bytes: what will happen is not known yet
constexpr const char* hdf5_name = "results.h5";

double seconds_now() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(now).count();
}

std::size_t longest_text(const OutputTable& table) {
  std::size_t longest = 1;
  for (const OutputColumn& c : table.columns)
    if (c.text)
      for (std::size_t row = 0; row < table.rows; ++row)
        longest = std::max(longest, c.text(row).size());
  return longest;
}

void write_csv_table(const OutputTable& table, const std::filesystem::path& folder) {
  CsvFile file(folder / (table.name + ".csv"));
  for (const OutputColumn& c : table.columns) file.cell(c.name);
  file.end_line();
  for (std::size_t row = 0; row < table.rows; ++row) {
    for (const OutputColumn& c : table.columns)
      c.text ? file.cell(c.text(row)) : file.cell(c.number(row));
    file.end_line();
  }
  file.finish();
}

/// Nothing of an earlier run that this one does not write is taken for its own.
void remove_others(const std::filesystem::path& folder, const std::vector<std::string>& written) {
  for (const char* name : {"motion.csv", "reactions.csv", "contacts.csv", "forces.csv",
                           "energies.csv", "events.csv", "impacts.csv", hdf5_name, "results.mat"}) {
    std::error_code ignored;
    if (std::ranges::find(written, name) == written.end())
      std::filesystem::remove(folder / name, ignored);
  }
}

}  // namespace

void check_output_format(const std::string& format) {
  if (std::ranges::find(output_formats, format) == std::end(output_formats))
    throw ModelError(
        fmt::format("--format {}: accepted are {}", format, fmt::join(output_formats, ", ")));
  const auto need = [&](bool is_there, const char* package) {
    if (!is_there)
      throw ModelError(fmt::format(
          "--format {}: this program was built without it; install {} (Debian) and build again",
          format, package));
  };
  if (format == "hdf5") need(has_hdf5, "libhdf5-dev");
  if (format == "mat") need(has_matio, "libmatio-dev");
}

RunOutput::RunOutput(OutputChoice choice, std::filesystem::path folder)
    : choice_(std::move(choice)), folder_(std::move(folder)) {}

void RunOutput::begin(const Model& model, const std::vector<MotionColumn>& own,
                      std::size_t expected_rows, const std::vector<std::string>& kept) {
  columns_.emplace(sample_header(model, kept), own, choice_);
  expected_rows_ = expected_rows / choice_.every + 1;
  last_ = seconds_now();
}

void RunOutput::watch(const Result& so_far) {
  if (choice_.format != "hdf5" || seconds_now() - last_ < seconds_between_looks) return;
  if (!growing_) {
    make_output_folder(folder_);
    growing_ = std::make_unique<Hdf5File>(folder_ / hdf5_name, folder_ / hdf5_name);
  }
  std::vector<OutputTable> tables = columns_->tables(so_far.samples);
  tables.push_back(event_table(so_far.events, choice_.from));
  try {
    for (const OutputTable& table : tables)
      growing_->append(table, expected_rows_, text_while_running);
    growing_->flush();
  } catch (const OutputError&) {  // a file that broke off within a chunk may not be readable
    growing_.reset();
    std::error_code ignored;
    std::filesystem::remove(folder_ / hdf5_name, ignored);
    throw;
  }
  last_ = seconds_now();
}

void RunOutput::finish(const Table& samples, const std::vector<EventRecord>& events,
                       const std::vector<ContactSpan>& impacts, const std::string& summary) {
  // The small ones first: on a full disk they say what the large ones would have held.
  std::vector<OutputTable> tables = {event_table(events, choice_.from)};
  if (!impacts.empty()) tables.push_back(impact_table(impacts, choice_.from));
  for (OutputTable& table : columns_->tables(samples)) tables.push_back(std::move(table));
  std::vector<std::string> written;
  if (choice_.format == "hdf5") {
    written.emplace_back(hdf5_name);
    write_hdf5(tables, summary);
    growing_.reset();
  } else if (choice_.format == "mat") {
    written.emplace_back("results.mat");
    write_mat(folder_ / "results.mat", tables, summary);
  } else {
    for (const OutputTable& table : tables) {
      written.push_back(table.name + ".csv");
      write_csv_table(table, folder_);
    }
  }
  remove_others(folder_, written);
}

/// Beside the one that grew, all of it compressed; takes its place when it is whole.
void RunOutput::write_hdf5(const std::vector<OutputTable>& tables,
                           const std::string& summary) const {
  std::filesystem::path part = folder_ / hdf5_name;
  part += ".part";
  std::error_code error;
  try {
    Hdf5File file(part, folder_ / hdf5_name);
    for (const OutputTable& table : tables)
      file.append(table, table.rows, longest_text(table), true);
    file.add_text("summary", summary);
    file.close();
  } catch (const OutputError&) {
    std::filesystem::remove(part, error);
    throw;
  }
  std::filesystem::rename(part, folder_ / hdf5_name, error);
  if (error)
    throw OutputError(
        fmt::format("cannot write '{}': {}", (folder_ / hdf5_name).string(), error.message()));
}

OutputTable impact_table(const std::vector<ContactSpan>& impacts, double from) {
  static_assert(sizeof(ContactSpan) % sizeof(double) == 0);
  constexpr std::size_t step = sizeof(ContactSpan) / sizeof(double);
  const auto begin =
      std::ranges::find_if(impacts, [&](const ContactSpan& i) { return i.onset >= from; });
  const ContactSpan* first = begin == impacts.end() ? nullptr : &*begin;
  const auto numbers = [&](const char* name, const char* unit, double ContactSpan::*member) {
    OutputColumn column{.name = name, .unit = unit, .step = step};
    if (first != nullptr) column.first = &(first->*member);
    return column;
  };
  const auto words = [&](const char* name, std::string ContactSpan::*member) {
    OutputColumn column{.name = name, .unit = ""};
    column.text = [first, member](std::size_t row) { return std::string_view(first[row].*member); };
    return column;
  };
  return {
      .name = "impacts",
      .columns = {numbers("t_s", "s", &ContactSpan::onset), words("element", &ContactSpan::element),
                  words("region", &ContactSpan::region),
                  numbers("release_s", "s", &ContactSpan::release),
                  numbers("speed_m_per_s", "m/s", &ContactSpan::speed),
                  numbers("peak_force_N", "N", &ContactSpan::peak_force),
                  numbers("penetration_m", "m", &ContactSpan::deepest),
                  numbers("restitution", "", &ContactSpan::restitution)},
      .rows = static_cast<std::size_t>(impacts.end() - begin)};
}

}  // namespace yoke::cases
