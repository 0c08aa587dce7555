// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// yoke reproduce tables: the fits of Tables 2 to 9 and 11 from the laws.
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>

#include <yoke/cases/jobs/markdown.hpp>
#include <yoke/cases/paper/published_tables.hpp>
#include <yoke/cases/paper/reproduce.hpp>
#include <yoke/contact/laws/catalog/elastic_catalog.hpp>
#include <yoke/core/error.hpp>
#include <yoke/core/result.hpp>

namespace yoke::cases {

namespace {

constexpr double max_line_load = 1000.0;   // [N/mm]
constexpr double goldsmith_length = 10.0;  // [mm] its right law is not proportional to the length
constexpr double outer_radius = 100.0;  // [mm] wall of Tables 2 to 9; only Goldsmith's law sees it

// ---- fits

/// The law per millimetre of a pin of `length` [mm], fitted from 0 to 1000 N/mm. A law of spheres
/// has no length: its constants are of the whole force.
TableFit fit(std::string_view law_name, ElasticArguments arguments, double length) {
  arguments.length = 1e-3 * length;
  const ElasticLaw law = make_elastic(law_name, arguments);
  const bool spheres =
      law_name == "lankarani-nikravesh" && arguments.reading == Reading::consistent;
  const double per = spheres ? 1.0 : length;
  const PowerFit found = fit_power_law(law, max_line_load * length);
  // The first of the fitted loads that presses 1 um deep or more.
  const double micron = 1e-6, step = max_line_load * length / (found.samples - 1);
  const double load = step * std::max(1.0, std::ceil(law.response(micron).force / step - 1e-9));
  const double d = law.penetration_at(load);
  return {.K = found.K / std::pow(1000.0, found.n) / per,
          .n = found.n,
          .error = 100.0 * std::abs(found.K * std::pow(d, found.n) / load - 1.0)};
}

TableFit tabulated(std::string_view law, ElasticArguments arguments) {
  arguments.reading = Reading::tabulated;
  return fit(law, arguments, 1.0);
}

/// Nothing if the right law does not reach 1000 N/mm.
std::optional<TableFit> corrected(std::string_view law, ElasticArguments arguments) {
  arguments.reading = Reading::consistent;
  try {
    return fit(law, arguments, law == "goldsmith" ? goldsmith_length : 1.0);
  } catch (const ModelError&) {
    return std::nullopt;
  }
}

/// One unit of the last of `digits` digits of `value`. The paper rounds some columns and truncates
/// others, so that is how far a right entry may be off.
double last_digit(double value, int digits) {
  return std::pow(10.0, std::floor(std::log10(value)) - (digits - 1));
}

bool differs(double printed, double found, double unit) {
  return std::abs(printed - found) > unit * (1.0 + 1e-9);
}

ReproducedEntry reproduce(const PublishedTable& table, const PublishedFit& row) {
  const Material material = table.is_steel ? steel : aluminium;
  const ElasticArguments arguments{.pin = material,
                                   .wall = material,
                                   .pin_radius = 1e-3 * (outer_radius - row.DR),
                                   .wall_radius = 1e-3 * outer_radius};
  ReproducedEntry e{.table = table.number,
                    .law = table.law,
                    .material = material.name,
                    .DR = row.DR,
                    .published = {row.K, row.n, row.error},
                    .reproduced = tabulated(table.law, arguments),
                    .corrected = corrected(table.law, arguments),
                    .misprint = row.misprint ? row.misprint : ""};
  e.K_differs = differs(row.K, e.reproduced.K, table.is_steel ? last_digit(row.K, 3) : 1.0);
  e.n_differs = differs(row.n, e.reproduced.n, 1e-3);
  e.error_differs = differs(row.error, e.reproduced.error, 0.1);
  return e;
}

ReproducedEntry reproduce(const PublishedWall& wall, const PublishedConstants& printed) {
  ElasticArguments arguments{.pin_radius = 1e-3 * wall.used_pin,
                             .wall_radius = 1e-3 * wall.wall_radius,
                             .conformity = wall.conformity};
  ReproducedEntry e{.table = 11,
                    .law = printed.law,
                    .material = steel.name,
                    .wall = wall.name,
                    .DR = wall.DR,
                    .published = {printed.K, printed.n},
                    .reproduced = tabulated(printed.law, arguments),
                    .misprint = wall.misprint ? wall.misprint : ""};
  arguments.pin_radius = 1e-3 * wall.stated_pin;
  e.corrected = corrected(printed.law, arguments);
  e.K_differs = differs(printed.K, e.reproduced.K, last_digit(printed.K, 4));
  e.n_differs = differs(printed.n, e.reproduced.n, 1e-2);
  return e;
}

// ---- document

std::string front(const std::vector<ReproducedEntry>& entries) {
  const auto count = [&](auto&& property) {
    return std::count_if(entries.begin(), entries.end(), property);
  };
  std::string text = fmt::format(R"(# Tables of the paper, made again

Printed by `yoke reproduce tables`: the fits F = K d^n of Tables 2 to 9 and 11 of Machines 2022, 10,
966 from the laws they were made of. Per entry three values of K, n and the error:

- *published*: as printed; in bold where it is more than one unit of its last digit away from
- *reproduced*: the reading `tabulated` of the law, fitted as the paper does (the force itself by
  least squares, loads from 0 to 1000 N/mm at 10001 even steps); the law of the tables, right or not;
- *corrected*: the reading `consistent`, dimensionally and physically right, fitted the same way.

K is in (N/mm)/mm^n: of the force per millimetre of pin, which the paper does not say. The error is
|K d^n/F - 1| at the first of these loads that presses 1 micrometre deep or more, which is what the
columns "Max Error %" hold; it is no maximum, for as the load goes to zero it goes to 100 %. K and n
belong to the range of loads as much as to the law. Where each law departs from its right form, and
the evidence, is in [errata.md](../errata.md).

{} entries. K as published: {}. n as published: {}. Error as published, of the {} given: {}. Entries
with a known misprint: {}.
)",
                                 entries.size(), count([](auto& e) { return !e.K_differs; }),
                                 count([](auto& e) { return !e.n_differs; }),
                                 count([](auto& e) { return e.table != 11; }),
                                 count([](auto& e) { return e.table != 11 && !e.error_differs; }),
                                 count([](auto& e) { return !e.misprint.empty(); }));
  for (const char* law : {"radzimovsky", "goldsmith", "esdu-78035", "lankarani-nikravesh"})
    text +=
        fmt::format("\n`{}` as tabulated: {}.\n", law, elastic_warning(law, Reading::tabulated));
  return text;
}

std::string mark(const ReproducedEntry& e) {
  std::string text = e.misprint;
  const auto add = [&](const std::string& more) { text += (text.empty() ? "" : "; ") + more; };
  const bool explained = !e.misprint.empty();
  if ((e.K_differs || e.n_differs) && !explained) add("not explained");
  if (e.error_differs) add("error: not explained");
  if (!e.corrected) add("the right law ends below 1000 N/mm");
  return text;
}

std::string printed(double value, int decimals, bool bold) {
  return fmt::format(fmt::runtime(bold ? "**{:.{}f}**" : "{:.{}f}"), value, decimals);
}

std::string or_none(const std::optional<TableFit>& found, double TableFit::*member, int decimals) {
  return found ? fmt::format("{:.{}f}", *found.*member, decimals) : "none";
}

Texts cells(const ReproducedEntry& e) {
  const int n_decimals = e.table == 11 ? 2 : 3;
  Texts row{printed(e.published.K, 0, e.K_differs), fmt::format("{:.1f}", e.reproduced.K),
            or_none(e.corrected, &TableFit::K, 1),  printed(e.published.n, n_decimals, e.n_differs),
            fmt::format("{:.4f}", e.reproduced.n),  or_none(e.corrected, &TableFit::n, 4)};
  if (e.table != 11) {
    row.push_back(printed(e.published.error, 1, e.error_differs));
    row.push_back(fmt::format("{:.2f}", e.reproduced.error));
    row.push_back(or_none(e.corrected, &TableFit::error, 2));
  }
  row.push_back(mark(e));
  return row;
}

const Texts value_columns{"K published", "K reproduced", "K corrected",
                          "n published", "n reproduced", "n corrected"};

Texts columns(const Texts& first, bool with_error) {
  Texts all = first;
  all.insert(all.end(), value_columns.begin(), value_columns.end());
  if (with_error)
    for (const char* which : {"published", "reproduced", "corrected"})
      all.push_back(fmt::format("error {} [%]", which));
  all.push_back("misprint");
  return all;
}

std::string document(const std::vector<ReproducedEntry>& entries) {
  Document doc;
  doc.print("{}", front(entries));
  int table = 0;
  for (const ReproducedEntry& e : entries) {
    const bool eleven = e.table == 11;
    if (e.table != table) {
      table = e.table;
      doc.heading(
          eleven ? std::string("Table 11: the scotch-yoke, steel")
                 : fmt::format("Table {}: {}, {}", table, find_elastic(e.law).title, e.material));
      if (e.law == "goldsmith")
        doc.print(
            "Wall of {:g} mm, from the way the published values depend on DR; corrected: a pin of "
            "{:g} mm, whose law has its end near the fitted loads where n is far from 1.\n\n",
            outer_radius, goldsmith_length);
      if (eleven)
        doc.print(
            "Pin of 7.9 mm in a slot with walls of 52 mm (Ri, external), 68 mm (Ro, internal) and "
            "ends of 8 mm (Rc, internal). The corrected constants of `lankarani-nikravesh`, a law "
            "of spheres, are of the whole force whatever the length, those of `goldsmith` of a pin "
            "of {:g} mm.\n\n",
            goldsmith_length);
      doc.head(eleven ? columns({"wall", "DR [mm]", "law"}, false) : columns({"DR [mm]"}, true));
    }
    Texts row =
        eleven ? Texts{e.wall, fmt::format("{:g}", e.DR), e.law} : Texts{fmt::format("{:g}", e.DR)};
    std::ranges::move(cells(e), std::back_inserter(row));
    doc.row(row);
  }
  return doc.plain();
}

std::string csv(const std::vector<ReproducedEntry>& entries) {
  std::string text =
      "table,law,material,wall,DR_mm,K_published,K_reproduced,K_corrected,n_published,n_reproduced,"
      "n_corrected,error_published_percent,error_reproduced_percent,error_corrected_percent,"
      "misprint\n";
  const auto number = [](double x) { return fmt::format("{:.10g}", x); };
  for (const ReproducedEntry& e : entries) {
    const auto right = [&](double TableFit::*member) {
      return e.corrected ? number(*e.corrected.*member) : std::string();
    };
    text +=
        fmt::format("{},{},{},{},{:g},{},{},{},{},{},{},{},{},{},\"{}\"\n", e.table, e.law,
                    e.material, e.wall, e.DR, number(e.published.K), number(e.reproduced.K),
                    right(&TableFit::K), number(e.published.n), number(e.reproduced.n),
                    right(&TableFit::n), e.table == 11 ? std::string() : number(e.published.error),
                    number(e.reproduced.error), right(&TableFit::error), e.misprint);
  }
  return text;
}

}  // namespace

std::vector<ReproducedEntry> reproduce_tables() {
  std::vector<ReproducedEntry> entries;
  for (const PublishedTable& table : published_tables)
    for (const PublishedFit& row : table.rows) entries.push_back(reproduce(table, row));
  for (const PublishedWall& wall : published_table11)
    for (const PublishedConstants& constants : wall.constants)
      entries.push_back(reproduce(wall, constants));
  return entries;
}

std::string tables_document() { return document(reproduce_tables()); }

void write_tables(const std::filesystem::path& folder) {
  const std::vector<ReproducedEntry> entries = reproduce_tables();
  make_output_folder(folder);
  const auto write = [&](const char* name, std::string text) {
    text.pop_back();  // write_text ends the last line
    write_text(folder / name, text);
  };
  write("tables.md", document(entries));
  write("tables.csv", csv(entries));
}

}  // namespace yoke::cases
