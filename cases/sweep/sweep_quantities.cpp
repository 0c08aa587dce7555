// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/sweep/sweep_quantities.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include <yoke/cases/results/output_table.hpp>
#include <yoke/core/error.hpp>

namespace yoke::cases {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

const std::vector<StudyQuantity>& quantities_of_every_sweep() {
  static const std::vector<StudyQuantity> all = {{"peak_force", "N"},
                                                 {"largest_penetration", "m"},
                                                 {"impacts", ""},
                                                 {"turns", ""},
                                                 {"impacts_per_turn", ""},
                                                 {"energy_lost", "J"},
                                                 {"t_end", "s"},
                                                 {"steps", ""},
                                                 {"rejected", ""},
                                                 {"evaluations", ""},
                                                 {"events", ""},
                                                 {"degrees_of_freedom", ""},
                                                 {"singular_positions", ""},
                                                 {"energy_balance", "J"},
                                                 {"energy_exchanged", "J"},
                                                 {"position_violation", "m"},
                                                 {"angle_violation", "rad"},
                                                 {"velocity_violation", "m/s"},
                                                 {"angular_velocity_violation", "rad/s"},
                                                 {"checks_missed", ""}};
  return all;
}

constexpr const char* ways[] = {"max", "min", "range", "mean", "rms", "final"};

std::size_t first_row(const Table& rows, double from) {
  std::size_t i = 0;
  while (i < rows.rows() && rows.value(i, 0) < from) ++i;
  return i;
}

/// [N] the largest of the contacts; without contacts of the joints.
double peak_force(const LawRun& run, double from) {
  const Table& rows = run.all();
  const std::size_t begin = first_row(rows, from);
  if (begin == rows.rows()) return none;
  double peak = run.contacts.empty() ? none : 0.0;
  for (const ContactRecord& c : run.contacts)
    peak = std::max(peak, measure(rows, c.element + ".normal_force_N", "max", 0.0, from));
  if (!run.contacts.empty()) return peak;
  for (std::size_t j = 0; j + 1 < rows.names().size(); ++j) {
    if (rows.part(j) != "reactions" || !rows.names()[j].ends_with(".fx_N")) continue;
    for (std::size_t i = begin; i < rows.rows(); ++i)
      peak = std::fmax(peak, std::hypot(rows.value(i, j), rows.value(i, j + 1)));
  }
  return peak;
}

double largest_penetration(const LawRun& run, double from) {
  double most = run.contacts.empty() ? none : 0.0;
  for (const ContactRecord& c : run.contacts)
    most = std::max(most, measure(run.all(), c.element + ".penetration_m", "max", 0.0, from));
  return most;
}

double impacts(const LawRun& run, double from) {
  if (run.contacts.empty()) return 0.0;
  return static_cast<double>(std::ranges::count_if(run.events, [&](const EventRecord& e) {
    return e.kind == "onset" && e.t >= from &&
           std::ranges::find(run.contacts, e.element, &ContactRecord::element) !=
               run.contacts.end();
  }));
}

double difference_over(const Table& rows, const std::string& column, double from) {
  const std::size_t begin = first_row(rows, from);
  if (!rows.has(column) || begin == rows.rows()) return none;
  const std::size_t j = rows.index(column);
  return rows.value(rows.rows() - 1, j) - rows.value(begin, j);
}

double integral(const Table& rows, std::size_t column, std::size_t begin, bool squared) {
  double sum = 0.0;
  for (std::size_t i = begin + 1; i < rows.rows(); ++i) {
    double a = rows.value(i - 1, column), b = rows.value(i, column);
    if (squared) {
      a *= a;
      b *= b;
    }
    sum += 0.5 * (a + b) * (rows.value(i, 0) - rows.value(i - 1, 0));
  }
  return sum;
}

double between_rows(const Table& rows, std::size_t column, double t) {
  const std::size_t after = first_row(rows, t);
  if (after == rows.rows()) return none;
  const double later = rows.value(after, 0), value = rows.value(after, column);
  if (later == t) return value;
  if (after == 0) return none;
  const double earlier = rows.value(after - 1, 0), before = rows.value(after - 1, column);
  return before + (value - before) * (t - earlier) / (later - earlier);
}

/// Bodies that drivers move, by the columns of their angles.
std::vector<std::string> driven_angles(const Model& model) {
  std::vector<std::string> columns;
  for (const auto& constraint : model.constraints()) {
    if (!constraint->rheonomic()) continue;
    const BodyId body = constraint->bodies()[constraint->reaction_body()];
    if (body != ground) columns.push_back(model.body(body).name + ".angle_rad");
  }
  return columns;
}

/// A name without the unit at its end.
std::string bare_name(const std::string& column, const std::string& unit) {
  Table alone;  // it makes the name
  alone.add_column("", unit);
  const std::string& end = alone.names().front();
  return column.ends_with(end) ? column.substr(0, column.size() - end.size()) : column;
}

}  // namespace

double measure(const Table& rows, const std::string& column, const std::string& how, double at,
               double from) {
  const std::size_t begin = first_row(rows, from);
  if (!rows.has(column) || begin == rows.rows()) return none;
  const std::size_t j = rows.index(column), last = rows.rows() - 1;
  if (how == "final") return rows.value(last, j);
  if (how == "at") return between_rows(rows, j, at);
  if (how == "mean" || how == "rms") {
    const double time = rows.value(last, 0) - rows.value(begin, 0);
    const bool squared = how == "rms";
    if (!(time > 0.0)) return squared ? std::abs(rows.value(last, j)) : rows.value(last, j);
    const double mean = integral(rows, j, begin, squared) / time;
    return squared ? std::sqrt(mean) : mean;
  }
  double least = rows.value(begin, j), most = least;
  for (std::size_t i = begin; i < rows.rows(); ++i) {
    least = std::min(least, rows.value(i, j));
    most = std::max(most, rows.value(i, j));
  }
  return how == "min" ? least : how == "max" ? most : most - least;
}

SweepQuantities::SweepQuantities(const std::vector<std::string>& measures, const std::string& turn,
                                 double from, const Model& model,
                                 const std::vector<MotionColumn>& own)
    : all_(quantities_of_every_sweep()), from_(from) {
  const Table header = sample_header(model);
  turning_ = turn.empty() ? driven_angles(model) : std::vector{turn};
  if (!turn.empty() && (!header.has(turn) || header.unit(header.index(turn)) != "rad"))
    throw ModelError(fmt::format("--turn {}: it is not a column of an angle{}", turn,
                                 suggestion(turn, header.names())));
  for (const std::string& text : measures) {
    measures_.push_back(parse(text, header, own));
    all_.push_back(measures_.back().quantity);
  }
}

SweepMeasure SweepQuantities::parse(const std::string& text, const Table& header,
                                    const std::vector<MotionColumn>& own) const {
  const std::size_t colon = text.rfind(':');
  SweepMeasure m{.column = text.substr(0, colon),
                 .how = colon == std::string::npos ? "" : text.substr(colon + 1)};
  const std::string owner = fmt::format("--measure {}", text), typed = m.how;
  if (m.how.starts_with("at=")) {
    m.at = parse_quantity(owner, Quantity::time, m.how.substr(3));
    m.how = "at";
  } else if (std::ranges::find(ways, m.how) == std::end(ways)) {
    throw ModelError(fmt::format("{}: expected COLUMN:{} or COLUMN:at=TIME", owner,
                                 fmt::join(ways, ", COLUMN:")));
  }
  Table names = header;  // and the case's own
  for (const MotionColumn& c : own) names.add_column(c.name, c.unit);
  if (!names.has(m.column))
    throw ModelError(fmt::format("{}: the first point has no column '{}'{}", owner, m.column,
                                 suggestion(m.column, names.names())));
  const std::string unit = names.unit(names.index(m.column));
  std::string prefix = typed;
  std::ranges::replace(prefix, '=', '_');
  m.quantity = {prefix + "." + bare_name(m.column, unit), unit};
  return m;
}

double SweepQuantities::turns_of(const Table& rows) const {
  double most = none;
  for (const std::string& column : turning_)
    most = std::fmax(most, std::abs(difference_over(rows, column, from_)) / (2.0 * pi));
  return most > 0.0 ? most : none;
}

std::vector<double> SweepQuantities::of(const LawRun& run) const {
  const Summary& s = run.summary;
  const double hits = impacts(run, from_), turns = turns_of(run.samples);
  const auto missed = std::ranges::count_if(run.checks, [](const Check& c) { return !c.within(); });
  std::vector<double> values = {peak_force(run, from_),
                                largest_penetration(run, from_),
                                hits,
                                turns,
                                hits / turns,
                                difference_over(run.samples, "dissipated_J", from_),
                                s.t_end,
                                static_cast<double>(s.steps),
                                static_cast<double>(s.rejected),
                                static_cast<double>(s.evaluations),
                                static_cast<double>(s.events),
                                static_cast<double>(s.degrees_of_freedom),
                                static_cast<double>(s.singular_positions.size()),
                                s.energy_balance,
                                s.energy_exchanged,
                                s.position_violation,
                                s.angle_violation,
                                s.velocity_violation,
                                s.angular_velocity_violation,
                                static_cast<double>(missed)};
  for (const SweepMeasure& m : measures_) {
    const Table& rows = run.all().has(m.column) ? run.all() : run.all_motion();
    values.push_back(measure(rows, m.column, m.how, m.at, from_));
  }
  return values;
}

}  // namespace yoke::cases
