// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The result of a run: time histories with names and units, events, and a summary of progress,
// reason for the end, cost and accuracy.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <yoke/core/force.hpp>
#include <yoke/core/state.hpp>

namespace yoke {

/// Rows of numbers in columns whose names include the unit. The first column of samples is the time.
/// Columns belong to parts, each of which makes a file of its own: what the samples of a run hold is
/// listed in docs/results.md.
class Table {
 public:
  /// Columns added from here on belong to this part; before, to "motion".
  void begin_part(std::string part) { part_ = std::move(part); }
  /// Adds a column called "name_unit" ("crank.x_m"); with labels the number is an index into them.
  void add_column(std::string name, std::string_view unit, std::vector<std::string> labels = {});
  /// Room for this many rows (up to 256 MiB at once), so that appending them allocates nothing.
  void reserve(std::size_t rows);
  /// Appends a row of zeros and returns it; valid until the next call.
  double* append();

  /// Keeps the first rows; n <= rows().
  void keep(std::size_t n);

  /// How many rows there are.
  std::size_t rows() const { return rows_; }
  /// All numbers, row after row.
  const std::vector<double>& data() const { return data_; }
  /// Of the columns.
  const std::vector<std::string>& names() const { return names_; }
  /// Whether there is a column of this name.
  bool has(std::string_view name) const;
  /// Values of a column. Throws ModelError that lists the nearest names if there is none.
  Eigen::VectorXd operator[](std::string_view name) const;
  /// One number, without a check.
  double value(std::size_t row, std::size_t column) const {
    return data_[row * names_.size() + column];
  }
  /// Number of a column. Throws ModelError that lists the nearest names.
  std::size_t index(std::string_view name) const;
  /// For messages: the names that begin like this one up to its dot.
  std::string nearest(std::string_view name) const;
  /// Labels of a column, empty if it holds numbers.
  const std::vector<std::string>& labels(std::size_t column) const {
    return kind_of(column).labels;
  }
  /// As "m/s^2"; empty if the column has none or it was not told apart from the name.
  const std::string& unit(std::size_t column) const { return kind_of(column).unit; }
  /// The part a column belongs to: "motion", "reactions", ...
  const std::string& part(std::size_t column) const { return kind_of(column).part; }
  /// Parts that have columns besides the first, in their order; "motion" of a table of one column.
  std::vector<std::string> parts() const;
  /// The first column and those of a part.
  std::vector<std::size_t> columns_of(std::string_view part) const;
  /// A table without rows, of these columns.
  Table only(const std::vector<std::size_t>& columns) const;
  /// A table of the same columns with rows first, first + n, first + 2 n, ...; n >= 1.
  Table every(std::size_t n, std::size_t first = 0) const;
  /// A table with the rows of both, which have the same columns, rising in the first, the time; of
  /// rows at one time the one here alone.
  Table merged(const Table& other) const;
  /// Text of a labelled cell; otherwise the number, with as many digits as bring back every bit.
  std::string text(std::size_t row, std::size_t column) const;

  /// Comma-separated values with one header line, of all columns or of those named. Throws
  /// OutputError naming the path; then what was there before stays.
  void write_csv(const std::filesystem::path& path) const;
  void write_csv(const std::filesystem::path& path, const std::vector<std::size_t>& columns) const;

 private:
  /// What many columns share: a large model has millions of them.
  struct Kind {
    std::string unit, part;
    std::vector<std::string> labels;
    bool operator==(const Kind&) const = default;
  };
  const Kind& kind_of(std::size_t column) const { return kinds_[kind_[column]]; }
  Table headed_alike() const;

  std::string part_ = "motion";
  std::vector<std::string> names_;
  std::vector<std::uint32_t> kind_;  // of each column
  std::vector<Kind> kinds_;
  std::vector<double> data_;
  std::size_t rows_ = 0;
};

/// Why a run ended.
enum class Stop { completed, by_event, interrupted, failed };

/// A position where constraint equations were dependent for an instant, and was crossed.
struct SingularPosition {
  double t = 0.0;              // [s]
  std::string equation;        // with the largest part in the dependency: "pivot: x"
  double independence = 0.0;   // smallest Dynamics::independence() met; 0: singular
  double energy_before = 0.0;  // [J] left side of the ledger minus work, on entering
  double energy_after = 0.0;   // [J] on leaving
};

/// How a run went.
struct Summary {
  Stop stop = Stop::failed;         // why it ended
  std::string reason = "not run";   // one sentence; for failures what to try
  std::string formulation;          // which one ran
  std::string formulation_reason;   // why
  std::string linear_solver;        // of accelerations: blocks, range-klu or klu
  double relative_tolerance = 0.0;  // asked for
  double tolerance_kept = 0.0;      // what was kept where that was out of reach; 0: it never was
  double length_scale = 0.0;        // [m] used in the error weights
  double time_scale = 0.0;          // [s]
  double t_start = 0.0;             // [s]
  double t_end = 0.0;               // [s] how far it got
  double t_asked = 0.0;             // [s] requested end
  long steps = 0;                   // accepted
  long rejected = 0;                // error test or Newton failures
  long evaluations = 0;             // of the equations of motion, for steps and events
  long recording_evaluations = 0;   // the same for samples
  long jacobians = 0;               // of an implicit method
  long refactorisations = 0;        // numeric only
  long fresh_factorisations = 0;    // with new pivots
  long events = 0;                  // that were handled
  double last_step = 0.0;           // [s]
  // Worst violations of the constraints at samples and events after projection: of equations that
  // are measured in lengths, and of those measured in angles.
  double position_violation = 0.0;          // [m]
  double angle_violation = 0.0;             // [rad]
  double velocity_violation = 0.0;          // [m/s]
  double angular_velocity_violation = 0.0;  // [rad/s]
  // The same before projection.
  double position_drift = 0.0;          // [m]
  double angle_drift = 0.0;             // [rad]
  double velocity_drift = 0.0;          // [m/s]
  double angular_velocity_drift = 0.0;  // [rad/s]
  double energy_balance = 0.0;          // [J] worst |T + V + stored + dissipated - work - initial|
  double energy_exchanged = 0.0;        // [J] largest of energy moved between forms, for scale
  double wall_time = 0.0;               // [s]
  int degrees_of_freedom = 0;           // 3 bodies minus the rank of the constraints
  std::vector<std::string> redundant_equations{};      // left out: they follow from others
  std::vector<std::string> not_unique_reactions{};     // columns that are one possibility of many
  std::vector<SingularPosition> singular_positions{};  // that were crossed
  std::vector<std::string> notes{};                    // what was assumed, a sentence each

  /// Completed, or ended by an event.
  bool ok() const { return stop == Stop::completed || stop == Stop::by_event; }
};

struct Result {
  Table samples;  // a row for each sample, uniform in time
  /// Rows of the same columns within contacts, not uniform in time; without columns unless
  /// SimulationOptions::contact_rows asks for them.
  Table contact_samples{};
  std::vector<EventRecord> events;  // in the order of time
  Summary summary;                  // how the run went
  State final;                      // at Summary::t_end, consistent: a run can start from it

  /// Column of the samples: result["crank.angle_rad"].
  Eigen::VectorXd operator[](std::string_view column) const { return samples[column]; }
  /// Writes a CSV file for each part of the samples (motion.csv, reactions.csv, contacts.csv,
  /// forces.csv, energies.csv), events.csv and summary.json into `folder` (made if missing). Throws
  /// OutputError naming the path.
  void write(const std::filesystem::path& folder) const;
};

/// The events as events.csv: t_s,kind,region,speed_m_per_s,penetration_m,element.
void write_events(const std::vector<EventRecord>& events, const std::filesystem::path& path);
/// What summary.json calls its form; it changes if a field is renamed, taken away or means another.
inline constexpr const char* summary_schema = "yoke-summary-1";
/// The summary as JSON text.
std::string to_json(const Summary& summary);
/// Makes a folder for results, or throws OutputError naming it and the reason.
void make_output_folder(const std::filesystem::path& folder);
/// Writes a text file whole or not at all: what was there before stays until the new one is on the
/// disk. Throws OutputError naming the path.
void write_text(const std::filesystem::path& path, std::string_view text);

}  // namespace yoke
