// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The page of a sweep: its points and what they gave, as columns of base64 of little-endian float64.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include <yoke/cases/report/base64.hpp>
#include <yoke/cases/report/page.hpp>
#include <yoke/cases/sweep/sweep_page_text.hpp>
#include <yoke/cases/sweep/sweep_results.hpp>
#include <yoke/core/version.hpp>

namespace yoke::cases {

namespace {

/// A page of more would be slow to draw and to load.
constexpr std::size_t most_points_of_page = 20000;

std::string numbers_as_base64(const std::vector<double>& numbers) {
  return base64(reinterpret_cast<const std::uint8_t*>(numbers.data()),
                numbers.size() * sizeof(double));
}

/// The rows there are; of very many every second, third, ...
std::vector<const StudyRow*> rows_of_page(const StudyResult& study) {
  std::vector<const StudyRow*> rows;
  for (const StudyRow& row : study.rows)
    if (row.state != PointState::missing) rows.push_back(&row);
  const std::size_t step = (rows.size() + most_points_of_page - 1) / most_points_of_page;
  for (std::size_t i = 1; i * step < rows.size(); ++i) rows[i] = rows[i * step];
  if (step > 1) rows.resize((rows.size() + step - 1) / step);
  return rows;
}

/// As it was typed where it was a number with a unit: people think in it.
double typed_number_of(const SweepPoints& points, std::size_t point, std::size_t axis) {
  const StudyAxis& about = points.points().axes()[axis];
  return about.words.empty() ? std::stod(points.text(point, axis))
                             : points.points().coordinate(point, axis);
}

}  // namespace

void write_sweep_page(const Case& c, const SweepRequest& request, const SweepPoints& points,
                      const StudyResult& study) {
  using Json = nlohmann::ordered_json;
  const std::vector<const StudyRow*> rows = rows_of_page(study);
  std::vector<double> numbers(rows.size());
  const auto column = [&](const auto& number_of) {
    std::ranges::transform(rows, numbers.begin(), number_of);
    return numbers_as_base64(numbers);
  };
  Json data = {{"yoke", version},
               {"case", c.name},
               {"description", c.description},
               {"command", request.command},
               {"origin", points.points().origin()},
               {"total", study.progress.total},
               {"done", study.progress.done},
               {"failures", study.progress.failed},
               {"rows", rows.size()},
               {"solver_first", mechanism_quantities},
               {"solver_count", solver_quantities}};
  data["points"] = column([](const StudyRow* r) { return static_cast<double>(r->point); });
  data["axes"] = Json::array();
  for (std::size_t a = 0; a < points.points().axes().size(); ++a) {
    const StudyAxis& axis = points.points().axes()[a];
    data["axes"].push_back(
        {{"name", axis.name},
         {"unit", axis.words.empty() ? points.unit(a) : ""},
         {"words", axis.words},
         {"log", axis.logarithmic},
         {"f8", column([&](const StudyRow* r) { return typed_number_of(points, r->point, a); })}});
  }
  data["quantities"] = Json::array();
  for (std::size_t k = 0; k < study.quantities.size(); ++k)
    data["quantities"].push_back({{"name", study.quantities[k].name},
                                  {"unit", study.quantities[k].unit},
                                  {"f8", column([&](const StudyRow* r) { return r->values[k]; })}});
  Json commands = Json::array(), reasons = Json::array(), runs = Json::array();
  for (const StudyRow* row : rows) {
    std::string command;
    try {
      command = request.request_of(points.setting(row->point)).command;
    } catch (const std::exception&) {  // of a point that cannot even be asked for
    }
    commands.push_back(std::move(command));
    reasons.push_back(row->reason);
    const std::string report = run_folder(row->point) + "/" + report_name;
    const bool kept = request.keep_runs && std::filesystem::exists(request.output / report);
    runs.push_back(kept ? report : "");
  }
  data["commands"] = std::move(commands);
  data["reasons"] = std::move(reasons);
  data["runs"] = std::move(runs);
  write_filled_page(
      request.output / report_name,
      {sweep_page_text::html(), sweep_page_text::style(), sweep_page_text::script(),
       sweep_page_text::style_sha256, sweep_page_text::script_sha256},
      c.name + ": sweep",
      json_block("id=\"data\"",
                 data.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)));
}

}  // namespace yoke::cases
