// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/report/replay.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>

#include <yoke/cases/report/base64.hpp>
#include <yoke/cases/report/thinning.hpp>
#include <yoke/cases/results/contact_spans.hpp>
#include <yoke/core/drawing/drawing.hpp>
#include <yoke/core/version.hpp>

namespace yoke::cases {

namespace {

using Json = nlohmann::ordered_json;

constexpr double bytes_of_report = 6e6;  // that the numbers of all its runs may take
constexpr std::size_t fewest_rows = 1500, most_rows = 20000;
constexpr std::size_t most_impacts = 20000;  // in the table

Json number_or_null(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json flat(const std::vector<Vec2>& points) {
  constexpr double per_metre = 1e10;  // more digits than that are no picture
  Json numbers = Json::array();
  for (const Vec2& p : points)
    for (const double x : {p.x(), p.y()}) numbers.push_back(std::round(x * per_metre) / per_metre);
  return numbers;
}

/// What the page calls them: names of functions and colours in page/mechanism.js.
constexpr std::array<std::pair<ShapeKind, const char*>, 14> kind_names = {
    {{ShapeKind::pin, "pin"},
     {ShapeKind::weld, "weld"},
     {ShapeKind::line, "line"},
     {ShapeKind::block, "block"},
     {ShapeKind::point, "point"},
     {ShapeKind::curve, "curve"},
     {ShapeKind::rod, "rod"},
     {ShapeKind::spring, "spring"},
     {ShapeKind::disc, "disc"},
     {ShapeKind::wall, "wall"},
     {ShapeKind::turn, "turn"},
     {ShapeKind::arrow, "arrow"},
     {ShapeKind::gear, "gear"},
     {ShapeKind::belt, "belt"}}};
constexpr std::array<std::pair<ShapeRole, const char*>, 5> role_names = {
    {{ShapeRole::joint, "joint"},
     {ShapeRole::spring, "spring"},
     {ShapeRole::driver, "driver"},
     {ShapeRole::load, "load"},
     {ShapeRole::contact, "contact"}}};

/// Throws std::out_of_range for a value without a name.
template <class Names, class Value>
const char* name_in(const Names& names, Value value) {
  const auto found = std::ranges::find(names, value, &Names::value_type::first);
  if (found == names.end()) throw std::out_of_range("a shape without a name in the report");
  return found->second;
}

Json drawing_json(const Drawing& drawing) {
  Json bodies = Json::array(), shapes = Json::array();
  for (const DrawnBody& body : drawing.bodies())
    bodies.push_back({{"name", body.name},
                      {"outline", flat(body.outline)},
                      {"given", body.given},
                      {"gyration", body.gyration}});
  for (const Shape& s : drawing.shapes()) {
    Json shape = {{"kind", name_in(kind_names, s.kind)},
                  {"role", name_in(role_names, s.role)},
                  {"element", s.element},
                  {"body", s.body.index},
                  {"other", s.other.index},
                  {"points", flat(s.points)}};
    if (s.radius > 0.0) shape["radius"] = s.radius;
    if (s.closed) shape["closed"] = true;
    shapes.push_back(std::move(shape));
  }
  return {{"bodies", std::move(bodies)}, {"shapes", std::move(shapes)}};
}

/// "crank.vx_m_per_s" is "crank.vx" in "m/s".
std::pair<std::string, std::string> name_and_unit(const std::string& column) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 12> units = {
      {{"_rad_per_s2", "rad/s\u00b2"},
       {"_m_per_s2", "m/s\u00b2"},
       {"_rad_per_s", "rad/s"},
       {"_m_per_s", "m/s"},
       {"_1/m", "1/m"},
       {"_N_m", "N m"},
       {"_rad", "rad"},
       {"_N", "N"},
       {"_J", "J"},
       {"_W", "W"},
       {"_m", "m"},
       {"_s", "s"}}};
  for (const auto& [ending, unit] : units)
    if (column.ends_with(ending))
      return {column.substr(0, column.size() - ending.size()), std::string(unit)};
  return {column, ""};
}

/// Interpolation and the lens need all digits of these.
bool needs_all_digits(const std::string& column) {
  return column == "t_s" || column.ends_with(".x_m") || column.ends_with(".y_m") ||
         column.ends_with(".angle_rad");
}

Json column_json(const std::string& column, const std::vector<std::string>& labels,
                 const std::vector<double>& values) {
  const auto [name, unit] = name_and_unit(column);
  Json json = {{"name", name}, {"unit", unit}};
  if (!labels.empty()) json["labels"] = labels;
  const auto differs = [&](double x) { return !(x == values.front()); };
  if (!values.empty() && std::ranges::none_of(values, differs)) {
    json["constant"] = number_or_null(values.front());
  } else if (needs_all_digits(column)) {
    json["f8"] = base64(values.data(), values.size() * sizeof(double));
  } else {
    const std::vector<float> narrow(values.begin(), values.end());
    json["f4"] = base64(narrow.data(), narrow.size() * sizeof(float));
  }
  return json;
}

/// Loads have no columns among the samples; those that depend on the motion alone are computed again.
class Loads {
 public:
  explicit Loads(const Model& model) : model_(model), bodies_(model.bodies().size()) {
    for (const auto& force : model.forces())
      if (force->supplies() && force->contacts() == 0 && force->states().empty() &&
          force->parameters().empty() && force->events() == 0 && force->bodies(model).size() == 1)
        loads_.push_back(force.get());
  }

  Json columns(const Table& samples, const std::vector<std::size_t>& rows) {
    Json json = Json::array();
    for (const ForceElement* load : loads_) {
      std::array<std::vector<double>, 3> values;
      for (const std::size_t row : rows) {
        const std::array<double, 3> Q = force_at(*load, samples, row);
        for (std::size_t k = 0; k < 3; ++k) values[k].push_back(Q[k]);
      }
      constexpr std::array<const char*, 3> names = {".fx_N", ".fy_N", ".moment_N_m"};
      for (std::size_t k = 0; k < 3; ++k)
        json.push_back(column_json(load->name() + names[k], {}, values[k]));
    }
    return json;
  }

 private:
  std::array<double, 3> force_at(const ForceElement& load, const Table& samples, std::size_t row) {
    for (std::size_t i = 1; i < bodies_.size(); ++i) {
      const std::size_t x = samples.index(model_.bodies()[i].name + ".x_m");
      const auto value = [&](std::size_t k) { return samples.value(row, x + k); };
      bodies_[i] = {value(0),           value(1), value(2), std::cos(value(2)),
                    std::sin(value(2)), value(3), value(4), value(5)};
    }
    std::array<double, 3> Q{};
    const Motion motion{.t = samples.value(row, 0), .bodies = bodies_, .inertia = model_.bodies()};
    load.evaluate({.motion = motion}, {.Q = Q.data()});
    return Q;
  }

  const Model& model_;
  std::vector<BodyMotion> bodies_;
  std::vector<const ForceElement*> loads_;
};

Json columns_json(const Replay& replay, const std::vector<std::size_t>& rows) {
  const Table& samples = replay.samples;
  Json columns = Json::array();
  std::vector<double> values(rows.size());
  for (std::size_t j = 0; j < samples.names().size(); ++j) {
    for (std::size_t i = 0; i < rows.size(); ++i) values[i] = samples.value(rows[i], j);
    columns.push_back(column_json(samples.names()[j], samples.labels(j), values));
  }
  if (samples.rows() > 1)
    for (Json& column : Loads(replay.model).columns(samples, rows))
      columns.push_back(std::move(column));
  return columns;
}

Json impacts_json(const std::vector<ContactSpan>& impacts) {
  Json json = Json::array();
  for (const ContactSpan& i : impacts) {
    if (json.size() == most_impacts) break;
    json.push_back({{"element", i.element},
                    {"region", i.region},
                    {"onset", i.onset},
                    {"release", i.release},
                    {"speed", number_or_null(i.speed)},
                    {"peak", i.peak_force},
                    {"deepest", i.deepest},
                    {"restitution", number_or_null(i.restitution)}});
  }
  return json;
}

/// Those that are not part of a contact's table.
Json events_json(const std::vector<EventRecord>& events) {
  Json json = Json::array();
  for (const EventRecord& e : events) {
    if (e.kind == "onset" || e.kind == "release") continue;
    if (json.size() == most_impacts) break;
    json.push_back({{"t", e.t}, {"element", e.element}, {"kind", e.kind}, {"region", e.region}});
  }
  return json;
}

Json portraits_json(const std::vector<Portrait>& portraits) {
  Json json = Json::array();
  for (const Portrait& p : portraits) {
    Json lines = Json::array();
    for (const PortraitLine& line : p.lines)
      lines.push_back({{"name", line.name}, {"dots", line.dots}, {"points", flat(line.points)}});
    json.push_back({{"title", p.title},
                    {"x", p.x_label},
                    {"y", p.y_label},
                    {"equal", p.equal_scales},
                    {"lines", std::move(lines)}});
  }
  return json;
}

Json views_json(const Replay& replay) {
  Json json = Json::array();
  if (!replay.c.views || replay.samples.rows() < 2) return json;
  for (const ReportView& view : replay.c.views(replay.parameters))
    json.push_back({{"title", view.title},
                    {"from", view.from},
                    {"to", view.to},
                    {"columns", view.columns},
                    {"over", view.over_penetration}});
  return json;
}

Json names_json(const Model& model) {
  Json drivers = Json::array(), joints = Json::array(), contacts = Json::array();
  for (const auto& c : model.constraints())
    (c->rheonomic() ? drivers : joints).push_back(c->name());
  for (const auto& f : model.forces())
    if (f->penetration_scale() > 0.0) contacts.push_back(f->name());
  return {{"drivers", std::move(drivers)},
          {"joints", std::move(joints)},
          {"contacts", std::move(contacts)}};
}

}  // namespace

std::string to_json(const Replay& replay) {
  const Table& samples = replay.samples;
  const std::vector<ContactSpan> impacts = contact_spans(samples, replay.events);
  const double bytes_of_row = static_cast<double>(samples.names().size()) * sizeof(float) * 4 / 3;
  const auto fitting =
      static_cast<std::size_t>(bytes_of_report / bytes_of_row / static_cast<double>(replay.share));
  const std::vector<std::size_t> rows =
      thinned_rows(samples, impacts, std::clamp(fitting, fewest_rows, most_rows));
  Json checks = Json::array();
  for (const Check& check : replay.checks)
    checks.push_back({{"text", text_of(check)}, {"within", check.within()}});
  const Json json = {{"yoke", version},
                     {"case", replay.c.name},
                     {"description", replay.c.description},
                     {"law", replay.law},
                     {"command", replay.command},
                     {"parameters", replay.parameters.to_json()},
                     {"elements", names_json(replay.model)},
                     {"drawing", drawing_json(draw(replay.model))},
                     {"paths", replay.c.paths},
                     {"rows", rows.size()},
                     {"recorded", samples.rows()},
                     {"columns", columns_json(replay, rows)},
                     {"impacts", impacts_json(impacts)},
                     {"events", events_json(replay.events)},
                     {"summary", Json::parse(to_json(replay.summary))},
                     {"checks", std::move(checks)},
                     {"views", views_json(replay)},
                     {"portraits", portraits_json(replay.portraits)}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Table one_pose(const Model& model, const State& state) {
  Table table;
  table.add_column("t", "s");
  for (std::size_t i = 1; i < model.bodies().size(); ++i) {
    const std::string& name = model.bodies()[i].name;
    table.add_column(name + ".x", "m");
    table.add_column(name + ".y", "m");
    table.add_column(name + ".angle", "rad");
  }
  double* row = table.append();
  *row++ = state.t;
  for (const double q : state.q) *row++ = q;
  return table;
}

}  // namespace yoke::cases
