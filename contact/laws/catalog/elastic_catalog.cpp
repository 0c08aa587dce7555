// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/contact/laws/catalog/elastic_catalog.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include <yoke/contact/laws/elastic/dubowsky_freudenstein.hpp>
#include <yoke/contact/laws/elastic/esdu_78035.hpp>
#include <yoke/contact/laws/elastic/goldsmith.hpp>
#include <yoke/contact/laws/elastic/hertz.hpp>
#include <yoke/contact/laws/elastic/johnson.hpp>
#include <yoke/contact/laws/elastic/pereira.hpp>
#include <yoke/contact/laws/elastic/power_law.hpp>
#include <yoke/contact/laws/elastic/radzimovsky.hpp>
#include <yoke/core/error.hpp>

namespace yoke {

namespace {

/// A law of the catalog: what is known of it, how it is made, what is odd about its readings.
struct ElasticEntry {
  ElasticNote note;
  ElasticLaw (*make)(const RoundPair& pair, double length, Reading reading);
  const char* printed_warning;
  const char* tabulated_warning;
};

std::vector<LawParameter> cylinder_parameters(bool with_length) {
  std::vector<LawParameter> list{
      {"E", "Pa", "> 0, of pin and wall"},
      {"nu", "", "greater than -1, at most 0.5, of pin and wall"},
      {"pin_radius", "m", "> 0"},
      {"wall_radius", "m", "> 0; internal contact: greater than pin_radius"},
      {"conformity", "", "internal or external"},
  };
  if (with_length) list.push_back({"length", "m", "> 0"});
  return list;
}

const char* const machines = "Machines 2022, 10, 966, Table 1";
const char* const ends_earlier =
    "The limit is where the stiffness becomes infinite; the theory needs the half-width of "
    "contact, sqrt(4 F R/(pi E* L)), far below the radii and ends much earlier.";
const char* const per_length =
    "The tables' K are of the force per millimetre of pin; the law is scaled by the length.";

std::string log_law(const char* a, const char* B) {
  return fmt::format("d = a F ln(B/F), a = {}, B = {}", a, B);
}

std::vector<ElasticEntry> make_elastic_entries() {
  const std::vector<Reading> one{Reading::consistent};
  const std::vector<Reading> two{Reading::consistent, Reading::printed};
  const std::vector<Reading> three{Reading::consistent, Reading::printed, Reading::tabulated};
  std::vector<ElasticEntry> list;
  list.push_back({{.name = "hertz",
                   .title = "Hertz, point contact",
                   .formula = "F = 4/3 E* sqrt(R) d^1.5, R = R_pin R_wall/DR",
                   .source = "H. Hertz, 1882; " + std::string(machines),
                   .validity = "d far below the radii; no limit of its own",
                   .caveats = {"A law of spheres: the length of the pin does not enter."},
                   .parameters = cylinder_parameters(false),
                   .readings = one},
                  [](const RoundPair& pair, double, Reading) { return ElasticLaw(hertz(pair)); },
                  "",
                  ""});
  list.push_back(
      {{.name = "lankarani-nikravesh",
        .title = "Lankarani and Nikravesh, elastic part",
        .formula = "F = 4/3 E* sqrt(R) d^1.5, R = R_pin R_wall/DR",
        .source =
            "H. M. Lankarani, P. E. Nikravesh, J. Mech. Des. 112, 1990; " + std::string(machines),
        .validity = "d far below the radii; no limit of its own",
        .caveats = {"A law of spheres: the length of the pin enters the tabulated reading only."},
        .parameters = cylinder_parameters(true),
        .readings = three},
       [](const RoundPair& pair, double length, Reading reading) {
         return ElasticLaw(lankarani_nikravesh(pair, length, reading));
       },
       "",
       "K is pi too large for a pin of 10 mm and in proportion to the length; Table 11 has it for "
       "1 mm, pi/10 of 4/3 E* sqrt(R)"});
  list.push_back(
      {{.name = "radzimovsky",
        .title = "Radzimovsky, parallel cylinders",
        .formula = log_law("1/(pi E* L)", "e^(2/3) 8 DR E* L/1.6^2"),
        .source = "E. I. Radzimovsky, Univ. of Illinois, 1953; " + std::string(machines) +
                  " and Section 4",
        .validity = "0 <= d <= 8 e^(-1/3)/(1.6^2 pi) DR = 0.713 DR (tabulated: twice that)",
        .caveats = {ends_earlier, "1.6 is the rounded 1.596 of Hertz' width of contact.",
                    per_length},
        .parameters = cylinder_parameters(true),
        .readings = three},
       [](const RoundPair& pair, double length, Reading reading) {
         return ElasticLaw(radzimovsky(pair, length, reading));
       },
       "",
       "the width of contact is a factor sqrt(2) too small (16 in the logarithm for 8)"});
  list.push_back(
      {{.name = "goldsmith",
        .title = "Goldsmith, parallel cylinders of finite length",
        .formula = log_law("1/(pi E* L)", "e pi E* L^3/R") + ", R = R_pin R_wall/DR",
        .source = "W. Goldsmith, Impact, 1960; " + std::string(machines),
        .validity = "0 <= d <= L^2/R (printed: 1 mm^2/R; tabulated: 1e8 mm^2/R)",
        .caveats = {ends_earlier, per_length},
        .parameters = cylinder_parameters(true),
        .readings = three},
       [](const RoundPair& pair, double length, Reading reading) {
         return ElasticLaw(goldsmith(pair, length, reading));
       },
       "the logarithm is of mm^-2 (m = 1, newton and millimetre), the limit of 1 mm^2/R is met at "
       "a few newton, and h lacks 1/pi",
       "a factor 1e8 in the logarithm that no consistent set of units gives"});
  list.push_back(
      {{.name = "dubowsky-freudenstein",
        .title = "Dubowsky and Freudenstein, pin in a sleeve",
        .formula = log_law("1/(pi E* L)", "e pi E* L^3/R") + ", R = R_pin R_wall/DR",
        .source = "S. Dubowsky, F. Freudenstein, J. Eng. Ind. 93, 1971; " + std::string(machines) +
                  ", Eq. (8)",
        .validity = "0 <= d <= L^2/R",
        .caveats = {ends_earlier, "With the coefficient of elasticity it is Goldsmith's law."},
        .parameters = cylinder_parameters(true),
        .readings = two},
       [](const RoundPair& pair, double length, Reading reading) {
         return ElasticLaw(dubowsky_freudenstein(pair, length, reading));
       },
       "h lacks 1/pi^2, so the law is about pi^2 too soft; the difference of the radii is taken in "
       "an external contact too",
       ""});
  list.push_back(
      {{.name = "esdu-78035",
        .title = "ESDU 78035, parallel cylinders",
        .formula = log_law("1/(pi E* L)", "4 e pi E* L DR"),
        .source = "ESDU 78035, 1978; " + std::string(machines),
        .validity = "0 <= d <= 4 DR",
        .caveats = {ends_earlier, "It is Johnson's law plus 2 F/(pi E* L).", per_length},
        .parameters = cylinder_parameters(true),
        .readings = three},
       [](const RoundPair& pair, double length, Reading reading) {
         return ElasticLaw(esdu_78035(pair, length, reading));
       },
       "h lacks 1/pi, so the law is about pi times too soft; the difference of the radii is taken "
       "in an external contact too",
       "h lacks 1/pi, so the law is about pi times too soft; the difference of the radii is taken "
       "in an external contact too"});
  list.push_back({{.name = "johnson",
                   .title = "Johnson, parallel cylinders",
                   .formula = log_law("1/(pi E* L)", "4 pi E* DR L/e"),
                   .source = "K. L. Johnson, Contact Mechanics, 1985; " + std::string(machines),
                   .validity = "0 <= d <= 4/e^2 DR = 0.541 DR",
                   .caveats = {ends_earlier, per_length},
                   .parameters = cylinder_parameters(true),
                   .readings = three},
                  [](const RoundPair& pair, double length, Reading) {
                    return ElasticLaw(johnson(pair, length));
                  },
                  "",
                  ""});
  list.push_back({{.name = "pereira-2011",
                   .title = "Pereira, Ramalho and Ambrosio 2011, internal contact",
                   .formula = "F = (0.49 DR + 0.10) L E*/DR d^n (N, mm), n = Y DR^-0.005, Y = 1.56 "
                              "ln(1000 DR)^-0.192 below DR = 0.75 mm, 0.0028 DR + 1.083 above",
                   .source = "C. Pereira, A. Ramalho, J. Ambrosio, 2011; " + std::string(machines),
                   .validity = "internal contact, 0.005 mm <= DR <= 10 mm",
                   .caveats = {"Empirical, in newton and millimetre: a fit to Johnson's law."},
                   .parameters = cylinder_parameters(true),
                   .readings = two},
                  [](const RoundPair& pair, double length, Reading reading) {
                    return ElasticLaw(pereira_2011(pair, length, reading));
                  },
                  "1.1083 in Y is a misprint of 1.083: with it the exponent jumps at DR = 0.75 mm",
                  ""});
  list.push_back(
      {{.name = "pereira-2015",
        .title = "Pereira, Ramalho and Ambrosio 2015, internal and external contact",
        .formula = "F = (a DR + b) L E*/DR d^n (N, mm); internal: a = 0.965, b = 0.0965, n = Y "
                   "DR^-0.005, Y = 1.51 ln(1000 DR)^-0.151 below DR = 0.34954 mm, 0.0151 DR + "
                   "1.151 above; external: a = 0.39, b = 0.85, n = 1.094",
        .source = "C. Pereira, A. Ramalho, J. Ambrosio, Multibody Syst. Dyn. 35, 2015; " +
                  std::string(machines),
        .validity = "internal contact: 0.005 mm <= DR <= 10 mm; external: not stated",
        .caveats = {"Empirical, in newton and millimetre: a fit to Johnson's law.",
                    "For DR of 5 mm and more and small loads it is less than half of Johnson's."},
        .parameters = cylinder_parameters(true),
        .readings = two},
       [](const RoundPair& pair, double length, Reading reading) {
         return ElasticLaw(pereira_2015(pair, length, reading));
       },
       "",
       ""});
  list.push_back({{.name = "power",
                   .title = "Power law",
                   .formula = "F = K d^n",
                   .source = "given by the user: power:K=1e8,n=1.5 (N/m^n) or "
                             "power:K=4.907e4,n=1.10,unit=mm (N/mm^n)",
                   .validity = "d >= 0",
                   .caveats = {"The unit of K depends on n."},
                   .parameters = {{"K", "N/m^n", "> 0 (unit=mm: N/mm^n)"},
                                  {"n", "", "1 to 10"},
                                  {"unit", "", "m (default) or mm"}},
                   .readings = one},
                  nullptr,
                  "",
                  ""});
  return list;
}

const std::vector<ElasticEntry>& elastic_entries() {
  static const std::vector<ElasticEntry> list = make_elastic_entries();
  return list;
}

const ElasticEntry& find_elastic_entry(std::string_view name) {
  for (const ElasticEntry& entry : elastic_entries())
    if (entry.note.name == name) return entry;
  std::vector<std::string> names;
  for (const ElasticEntry& entry : elastic_entries()) names.push_back(entry.note.name);
  throw ModelError(
      fmt::format("unknown elastic law '{}'; there are {}", name, fmt::join(names, ", ")));
}

constexpr std::string_view power_usage =
    "law 'power': give its constants, power:K=1e8,n=1.5 (N/m^n) or "
    "power:K=4.907e4,n=1.10,unit=mm (N/mm^n)";

/// What follows "power:".
ElasticLaw parse_power(std::string_view text) {
  std::optional<double> K, n;
  bool per_millimetre = false;
  while (!text.empty()) {
    const std::string_view item = text.substr(0, text.find(','));
    text.remove_prefix(std::min(text.size(), item.size() + 1));
    const std::size_t equals = item.find('=');
    const std::string_view key = item.substr(0, equals);
    const std::string_view value =
        equals == std::string_view::npos ? std::string_view{} : item.substr(equals + 1);
    if (key == "unit") {
      if (value != "m" && value != "mm")
        throw ModelError(fmt::format("law 'power': unit = '{}' must be m or mm", value));
      per_millimetre = value == "mm";
      continue;
    }
    if (key != "K" && key != "n")
      throw ModelError(fmt::format("{}; '{}' is not one of K, n, unit", power_usage, key));
    double number = 0.0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
    if (error != std::errc{} || end != value.data() + value.size())
      throw ModelError(fmt::format("law 'power': {} = '{}' must be a number", key, value));
    std::optional<double>& target = key == "K" ? K : n;
    if (target) throw ModelError(fmt::format("law 'power': {} is given twice", key));
    target = number;
  }
  if (!K || !n) throw ModelError(std::string(power_usage));
  // Checked in the unit given, so that the message shows the number of the user.
  require_positive("law 'power'", "K", *K, per_millimetre ? "N/mm^n" : "N/m^n");
  require_range("law 'power'", "n", *n, 1.0, 10.0);
  return per_millimetre ? per_mm(*K, *n, "power") : PowerLaw{*K, *n, "power"};
}

}  // namespace

const std::vector<ElasticNote>& elastic_catalog() {
  static const std::vector<ElasticNote> notes = [] {
    std::vector<ElasticNote> list;
    for (const ElasticEntry& entry : elastic_entries()) list.push_back(entry.note);
    return list;
  }();
  return notes;
}

const ElasticNote& find_elastic(std::string_view name) { return find_elastic_entry(name).note; }

ElasticLaw make_elastic(std::string_view specification, const ElasticArguments& arguments) {
  constexpr std::string_view prefix = "power:";
  if (specification.substr(0, prefix.size()) == prefix) {
    if (arguments.reading != Reading::consistent)
      throw_no_reading("power", arguments.reading, "consistent");
    return parse_power(specification.substr(prefix.size()));
  }
  const ElasticEntry& entry = find_elastic_entry(specification);
  if (!entry.make) throw ModelError(std::string(power_usage));
  const std::vector<Reading>& readings = entry.note.readings;
  if (std::find(readings.begin(), readings.end(), arguments.reading) == readings.end()) {
    std::vector<std::string_view> names;
    for (const Reading reading : readings) names.push_back(name_of(reading));
    throw_no_reading(specification, arguments.reading, fmt::format("{}", fmt::join(names, ", ")));
  }
  const RoundPair pair{.pin_radius = arguments.pin_radius,
                       .wall_radius = arguments.wall_radius,
                       .conformity = arguments.conformity,
                       .pin = arguments.pin,
                       .wall = arguments.wall};
  return entry.make(pair, arguments.length, arguments.reading);
}

std::string elastic_warning(std::string_view name, Reading reading) {
  const ElasticEntry& entry = find_elastic_entry(name.substr(0, name.find(':')));
  switch (reading) {
    case Reading::consistent:
      break;
    case Reading::printed:
      return entry.printed_warning;
    case Reading::tabulated:
      return entry.tabulated_warning;
  }
  return "";
}

}  // namespace yoke
