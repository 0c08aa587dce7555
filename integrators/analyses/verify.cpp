// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/analyses/verify.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include <yoke/core/error.hpp>

namespace yoke {

namespace {

constexpr double tighter = 1e-2, tightest = 1e-13;
constexpr int high_order = 4;

/// The formulation with least in common with `first`: another index and family if a method of high
/// order has them, else another family.
std::string_view counterpart(const std::string& first) {
  const std::vector<FormulationNote> all = formulations();
  const auto own = std::ranges::find(all, first, &FormulationNote::name);
  for (const bool other_index : {true, false})
    for (const FormulationNote& f : all)
      if (f.family != own->family && f.order >= high_order &&
          (!other_index || f.index != own->index))
        return f.name;
  return all.front().name;
}

double digits(double difference, double peak) {
  constexpr double most = 16.0;
  return difference > 0.0 ? std::clamp(-std::log10(difference / peak), 0.0, most) : most;
}

Agreement compare(const std::string& column, const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  Agreement agreement;
  agreement.column = column;
  agreement.peak = std::max(a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff());
  agreement.difference = (a - b).cwiseAbs().maxCoeff();
  agreement.digits = digits(agreement.difference, agreement.peak);
  return agreement;
}

// "x_m" and "y_m" of bodies are of one kind: what stands after the first underscore.
std::string kind_of(const std::string& column) {
  const std::size_t dot = column.rfind('.');
  const std::size_t underscore = column.find('_', dot == std::string::npos ? 0 : dot);
  return underscore == std::string::npos ? column : column.substr(underscore);
}

// What is zero but for rounding has no digits to agree in: the largest of its kind is its measure.
void measure_by_kind(std::vector<Agreement>& quantities) {
  std::map<std::string, double> largest;
  for (const Agreement& a : quantities) {
    double& peak = largest[kind_of(a.column)];
    peak = std::max(peak, a.peak);
  }
  // Where no speed changes, accelerations are to be small beside those of points that go around.
  const double omega = largest["_rad_per_s"];
  double& alpha = largest["_rad_per_s2"];
  alpha = std::max(alpha, omega * omega);
  constexpr double noise = 1e-9;
  for (Agreement& a : quantities) {
    const double peak = largest[kind_of(a.column)];
    if (a.peak < noise * peak && a.difference > 0.0) a.digits = digits(a.difference, peak);
  }
}

void compare_events(const Result& a, const Result& b, Verification& out) {
  out.events = static_cast<long>(a.events.size());
  out.other_events = static_cast<long>(b.events.size());
  out.same_events = out.events == out.other_events;
  for (std::size_t i = 0; i < a.events.size() && out.same_events; ++i) {
    const EventRecord &x = a.events[i], &y = b.events[i];
    out.same_events = x.kind == y.kind && x.element == y.element;
    out.event_time_difference = std::max(out.event_time_difference, std::abs(x.t - y.t));
  }
}

}  // namespace

const Agreement* Verification::worst() const {
  const auto least = std::ranges::min_element(quantities, {}, &Agreement::digits);
  return least == quantities.end() ? nullptr : &*least;
}

Verification verify(const Model& model, const State& start, const SimulationOptions& options,
                    const Result& result) {
  if (!result.summary.ok() || result.samples.rows() == 0)
    throw ModelError("verification: the run must have completed and have samples");
  if (options.until != result.summary.t_asked ||
      options.relative_tolerance != result.summary.relative_tolerance)
    throw ModelError(
        fmt::format("verification: the run was until {:g} s at a tolerance of {:g}, the options "
                    "say {:g} s and {:g}",
                    result.summary.t_asked, result.summary.relative_tolerance, options.until,
                    options.relative_tolerance));
  SimulationOptions second = options;
  second.checkpoints = {};
  second.formulation = counterpart(result.summary.formulation);
  second.relative_tolerance = std::max(
      tightest, tighter * std::min(options.relative_tolerance, result.summary.relative_tolerance));
  const Result other = simulate(model, start, second);
  Verification out;
  out.formulation = second.formulation;
  out.relative_tolerance = second.relative_tolerance;
  out.summary = other.summary;
  compare_events(result, other, out);
  const auto rows =
      static_cast<Eigen::Index>(std::min(result.samples.rows(), other.samples.rows()));
  if (rows == 0) return out;
  for (const std::string& column : result.samples.names())
    if (column != "t_s" && column != "balance_J")
      out.quantities.push_back(
          compare(column, result[column].head(rows), other[column].head(rows)));
  measure_by_kind(out.quantities);
  return out;
}

Verification verify(const Model& model, const SimulationOptions& options, const Result& result) {
  return verify(model, model.start_state(), options, result);
}

std::string to_json(const Verification& v) {
  nlohmann::ordered_json json = {{"formulation", v.formulation},
                                 {"relative_tolerance", v.relative_tolerance},
                                 {"completed", v.summary.ok()},
                                 {"reason", v.summary.reason},
                                 {"steps", v.summary.steps},
                                 {"same_events", v.same_events},
                                 {"events", {v.events, v.other_events}},
                                 {"event_time_difference_s", v.event_time_difference}};
  if (const Agreement* worst = v.worst())
    json["worst"] = {{"column", worst->column}, {"digits", worst->digits}};
  nlohmann::ordered_json& digits = json["digits"] = nlohmann::ordered_json::object();
  for (const Agreement& a : v.quantities) digits[a.column] = a.digits;
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace yoke
