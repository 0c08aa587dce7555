// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/sweep/sweep_axes.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <utility>

#include <yoke/core/error.hpp>

namespace yoke::cases {

namespace {

using Texts = std::vector<std::string>;

constexpr const char* run_options[] = {"rtol", "formulation", "spectral-radius"};

Texts split_at(std::string_view text, char separator) {
  Texts parts(1);
  for (const char c : text)
    if (c == separator)
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

/// A list of laws: what begins with NAME= belongs to the law before it, as an argument or another wall.
Texts split_laws(std::string_view text) {
  Texts laws;
  for (const std::string& piece : split_at(text, ',')) {
    const std::size_t mark = piece.find_first_of("=:+");
    const bool more = mark != std::string::npos && piece[mark] == '=' && !laws.empty();
    if (more)
      laws.back() += "," + piece;
    else
      laws.push_back(piece);
  }
  return laws;
}

bool has_parameter(const Case& c, std::string_view name) {
  return std::ranges::find(c.parameters, name, &CaseParameter::name) != c.parameters.end();
}

std::string in_braces(const std::string& name) { return "{" + name + "}"; }

void replace_all(std::string& text, const std::string& what, const std::string& with) {
  for (std::size_t at = text.find(what); at != std::string::npos;
       at = text.find(what, at + with.size()))
    text.replace(at, what.size(), with);
}

/// A number and its unit, or nothing if the text is a word.
std::optional<std::pair<double, std::string>> typed_number(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || !std::isfinite(value)) return std::nullopt;
  std::string unit(end, text.data() + text.size());
  unit.erase(0, unit.find_first_not_of(' '));
  return std::pair{value, unit};
}

std::size_t count_of(const std::string& owner, const std::string& text) {
  std::size_t count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc{} || end != text.data() + text.size() || count < 1)
    throw ModelError(
        fmt::format("{}: '{}' is not a number of points; accepted is a whole number "
                    "of 1 or more",
                    owner, text));
  return count;
}

/// The cells of a line of CSV.
Texts csv_cells(const std::string& line) {
  Texts all(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char ch = line[i];
    if (ch == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
      all.back() += line[++i];
    } else if (ch == '"') {
      quoted = !quoted;
    } else if (ch == ',' && !quoted) {
      all.emplace_back();
    } else if (ch != '\r') {
      all.back() += ch;
    }
  }
  for (std::string& cell : all) {
    cell.erase(0, cell.find_first_not_of(' '));
    cell.erase(cell.find_last_not_of(' ') + 1);
  }
  return all;
}

/// In the order in which they come first.
Texts distinct(const Texts& words) {
  Texts once;
  for (const std::string& word : words)
    if (std::ranges::find(once, word) == once.end()) once.push_back(word);
  return once;
}

double place_of(const std::string& word, const Texts& words) {
  return static_cast<double>(std::ranges::find(words, word) - words.begin());
}

std::string ending(std::string_view unit) {
  Table alone;  // it makes the name
  alone.add_column("", unit);
  return alone.names().front();
}

}  // namespace

SweepPoints::Axis SweepPoints::target_of(const Case& c, const SweepChoice& choice,
                                         const std::string& name) const {
  const auto parameter = std::ranges::find(c.parameters, name, &CaseParameter::name);
  if (parameter != c.parameters.end())
    return {.name = name,
            .quantity = parameter->quantity,
            .numeric = parameter->numeric(),
            .whole = parameter->whole};
  const auto words = [&](SweepTarget target) {
    return Axis{.name = name, .target = target, .numeric = false};
  };
  const bool laws = !c.contact.laws.empty();
  if (laws && (name == "law" || name == "contact-law")) return words(SweepTarget::law);
  if (laws && name == "friction") return words(SweepTarget::friction);
  if (name == "formulation") return words(SweepTarget::formulation);
  if (name == "rtol") return {.name = name, .target = SweepTarget::rtol};
  if (name == "spectral-radius") return {.name = name, .target = SweepTarget::spectral_radius};
  for (const std::string& text : {choice.law, choice.friction})
    if (!name.empty() && text.find(in_braces(name)) != std::string::npos)
      return {.name = name, .target = SweepTarget::word};
  Texts known;
  for (const CaseParameter& p : c.parameters) known.push_back(p.name);
  if (laws) known.emplace_back(has_parameter(c, "law") ? "contact-law" : "law");
  if (laws) known.emplace_back("friction");
  known.insert(known.end(), std::begin(run_options), std::end(run_options));
  throw ModelError(fmt::format("nothing of '{}' is called '{}'{}; or {} in the text of --law",
                               c.name, name, suggestion(name, known), in_braces(name)));
}

std::string SweepPoints::typed_text(const Axis& axis, double typed) {
  return fmt::format("{}{}", typed, axis.unit);
}

double SweepPoints::si(std::size_t a, double typed) const {
  const Axis& axis = axes_[a];
  if (axis.unit.empty()) return typed;
  return parse_quantity(axis.name, axis.quantity, typed_text(axis, typed));
}

/// The ends may have different units; then the axis is in SI.
StudyAxis SweepPoints::parse_range(const Texts& parts, const SweepChoice& choice,
                                   Axis& axis) const {
  const std::string owner = fmt::format("--vary {}={}", axis.name, fmt::join(parts, ":"));
  const bool sampled = choice.random > 0 || choice.sobol > 0;
  Texts rest(parts.begin() + 2, parts.end());
  bool logarithmic = choice.logarithmic;
  if (!rest.empty() && (rest.back() == "log" || rest.back() == "linear")) {
    logarithmic = rest.back() == "log";
    rest.pop_back();
  }
  if (rest.size() > 1 || (rest.empty() && !sampled))
    throw ModelError(fmt::format("{}: accepted are LOW:HIGH:N, LOW:HIGH:N:log and A,B,C{}", owner,
                                 sampled ? "; with --random or --sobol also LOW:HIGH" : ""));
  const std::size_t count = rest.empty() ? 2 : count_of(owner, rest.front());
  const double low_si = parse_quantity(owner, axis.quantity, parts[0]);
  const double high_si = parse_quantity(owner, axis.quantity, parts[1]);
  const auto low = typed_number(parts[0]), high = typed_number(parts[1]);
  const bool same = low && high && low->second == high->second;
  axis.unit = same ? low->second : std::string(si_unit_name(axis.quantity));
  const double from = same ? low->first : low_si, to = same ? high->first : high_si;
  try {
    StudyAxis made = logarithmic ? log_axis(axis.name, from, to, count, axis.unit)
                                 : linear_axis(axis.name, from, to, count, axis.unit);
    made.whole = axis.whole;
    return made;
  } catch (const ModelError& error) {
    throw ModelError(fmt::format("{}: {}", owner, error.what()));
  }
}

/// Numbers if all of them are, else words.
StudyAxis SweepPoints::parse_list(const Texts& texts, Axis& axis) const {
  std::vector<std::pair<double, std::string>> numbers;
  for (const std::string& text : texts) {
    const auto number = typed_number(text);
    if (axis.numeric && number) numbers.push_back(*number);
  }
  if (numbers.size() < texts.size()) {
    axis.unit.clear();
    axis.numeric = false;
    return word_axis(axis.name, texts);
  }
  const bool same = std::ranges::all_of(
      numbers, [&](const auto& n) { return n.second == numbers.front().second; });
  axis.unit = same ? numbers.front().second : std::string(si_unit_name(axis.quantity));
  std::vector<double> values;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const double in_si = parse_quantity(axis.name, axis.quantity, texts[i]);
    values.push_back(same ? numbers[i].first : in_si);
  }
  return value_axis(axis.name, std::move(values), axis.unit);
}

StudyAxis SweepPoints::parse(const Case& c, const SweepChoice& choice, const std::string& vary) {
  const std::size_t equals = vary.find('=');
  if (equals == std::string::npos || equals + 1 == vary.size())
    throw ModelError(fmt::format(
        "--vary {}: expected NAME=LOW:HIGH:N, NAME=LOW:HIGH:N:log or NAME=A,B,C", vary));
  const std::string name = vary.substr(0, equals), values = vary.substr(equals + 1);
  Axis axis;
  try {
    axis = target_of(c, choice, name);
  } catch (const ModelError& error) {
    throw ModelError(fmt::format("--vary {}: {}", vary, error.what()));
  }
  const bool laws = axis.target == SweepTarget::law || axis.target == SweepTarget::friction;
  const Texts parts = split_at(values, ':');
  StudyAxis made = !laws && axis.numeric && parts.size() > 1
                       ? parse_range(parts, choice, axis)
                       : parse_list(laws ? split_laws(values) : split_at(values, ','), axis);
  axes_.push_back(std::move(axis));
  return made;
}

/// A header of names, as they are or with the unit of SI behind them, as sweep.csv has them; then a line a
/// point.
void SweepPoints::read_list(const Case& c, const SweepChoice& choice) {
  const std::string owner = fmt::format("--list {}", choice.list);
  std::ifstream file(choice.list);
  if (!file) throw ModelError(fmt::format("{}: cannot read it", owner));
  std::string line;
  std::getline(file, line);
  const Texts header = csv_cells(line);
  std::vector<Texts> columns(header.size());
  for (std::size_t number = 2; std::getline(file, line); ++number) {
    if (line.empty() || line == "\r") continue;
    const Texts row = csv_cells(line);
    if (row.size() != header.size())
      throw ModelError(fmt::format("{}, line {}: {} cells; the first line has {}", owner, number,
                                   row.size(), header.size()));
    for (std::size_t j = 0; j < row.size(); ++j) columns[j].push_back(row[j]);
  }
  if (columns.front().empty()) throw ModelError(fmt::format("{}: there are no points", owner));
  std::vector<StudyAxis> axes;
  for (std::size_t j = 0; j < header.size(); ++j) {
    std::string name = header[j];
    for (const CaseParameter& p : c.parameters)
      if (const std::string_view unit = si_unit_name(p.quantity);
          !unit.empty() && name == p.name + ending(unit)) {
        name = p.name;
        for (std::string& cell : columns[j])
          if (const auto n = typed_number(cell); n && n->second.empty()) cell += unit;
        break;
      }
    try {
      Axis axis = target_of(c, choice, name);
      axes.push_back(parse_list(columns[j], axis));
      axes_.push_back(std::move(axis));
    } catch (const ModelError& error) {
      throw ModelError(fmt::format("{}: {}", owner, error.what()));
    }
  }
  std::vector<std::vector<double>> rows(columns.front().size());
  for (std::size_t j = 0; j < axes.size(); ++j) {
    const std::vector<double> values = axes[j].values;
    if (!axes[j].words.empty()) axes[j] = word_axis(axes[j].name, distinct(columns[j]));
    for (std::size_t i = 0; i < rows.size(); ++i)
      rows[i].push_back(axes[j].words.empty() ? values[i] : place_of(columns[j][i], axes[j].words));
  }
  typed_ = listed_points(std::move(axes), rows);
}

/// What can be checked of a value without the others.
void SweepPoints::check_values(const Case& c, const std::vector<StudyAxis>& typed) const {
  Parameters parameters(c.parameters);
  for (std::size_t a = 0; a < axes_.size(); ++a) {
    if (axes_[a].target != SweepTarget::parameter) continue;
    std::vector<double> values = typed[a].values;
    if (typed[a].range) values.insert(values.end(), {typed[a].low, typed[a].high});
    for (const double x : values)
      parameters.set(axes_[a].name, typed[a].words.empty()
                                        ? typed_text(axes_[a], x)
                                        : typed[a].words[static_cast<std::size_t>(x)]);
  }
}

SweepPoints::SweepPoints(const Case& c, const SweepChoice& choice)
    : law_(choice.law), friction_(choice.friction) {
  const int ways = (choice.random > 0) + (choice.sobol > 0) + !choice.list.empty();
  if (ways > 1) throw ModelError("--random, --sobol, --list: one of them at a time");
  if (!choice.list.empty() && !choice.vary.empty())
    throw ModelError(fmt::format("--list {} says the points; it does not go with --vary {}",
                                 choice.list, choice.vary.front()));
  if (choice.list.empty() && choice.vary.empty())
    throw ModelError("what shall vary? --vary NAME=LOW:HIGH:N, or --list FILE");
  std::vector<StudyAxis> axes;
  for (const std::string& vary : choice.vary) axes.push_back(parse(c, choice, vary));
  if (!choice.list.empty())
    read_list(c, choice);
  else if (choice.random > 0)
    typed_ = random_points(std::move(axes), choice.random, choice.seed);
  else if (choice.sobol > 0)
    typed_ = sobol_points(std::move(axes), choice.sobol);
  else
    typed_ = grid_points(std::move(axes));
  check_values(c, typed_.axes());

  std::vector<StudyAxis> in_si = typed_.axes();
  for (std::size_t a = 0; a < in_si.size(); ++a) {
    in_si[a].unit = in_si[a].words.empty() ? si_unit_name(axes_[a].quantity) : "";
    for (double& x : in_si[a].values) x = si(a, x);
  }
  std::vector<double> coordinates;
  coordinates.reserve(typed_.size() * in_si.size());
  for (std::size_t i = 0; i < typed_.size(); ++i)
    for (std::size_t a = 0; a < in_si.size(); ++a)
      coordinates.push_back(si(a, typed_.coordinate(i, a)));
  points_ = StudyPoints(std::move(in_si), std::move(coordinates), typed_.origin());
}

std::string SweepPoints::text(std::size_t point, std::size_t axis) const {
  return typed_.axes()[axis].words.empty() ? typed_text(axes_[axis], typed_.coordinate(point, axis))
                                           : typed_.text(point, axis);
}

SweepSetting SweepPoints::setting(std::size_t point) const {
  SweepSetting s{.law = law_, .friction = friction_};
  for (std::size_t a = 0; a < axes_.size(); ++a) {
    if (axes_[a].target == SweepTarget::law) s.law = text(point, a);
    if (axes_[a].target == SweepTarget::friction) s.friction = text(point, a);
  }
  for (std::size_t a = 0; a < axes_.size(); ++a) {
    const std::string value = text(point, a);
    switch (axes_[a].target) {
      case SweepTarget::parameter:
        s.parameters.push_back(axes_[a].name + "=" + value);
        break;
      case SweepTarget::rtol:
        s.rtol = value;
        break;
      case SweepTarget::formulation:
        s.formulation = value;
        break;
      case SweepTarget::spectral_radius:
        s.spectral_radius = value;
        break;
      case SweepTarget::word:
        replace_all(s.law, in_braces(axes_[a].name), value);
        replace_all(s.friction, in_braces(axes_[a].name), value);
        break;
      case SweepTarget::law:
      case SweepTarget::friction:
        break;
    }
  }
  return s;
}

}  // namespace yoke::cases
