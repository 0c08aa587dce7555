// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <yoke/cases/impact.hpp>
#include <yoke/cases/law_options.hpp>
#include <yoke/cases/markdown.hpp>
#include <yoke/cases/parallel.hpp>
#include <yoke/cases/validation.hpp>
#include <yoke/contact/dissipative_catalog.hpp>
#include <yoke/contact/elastic_catalog.hpp>
#include <yoke/core/error.hpp>
#include <yoke/core/result.hpp>
#include <yoke/integrators/simulate.hpp>

namespace yoke::cases {

namespace {

constexpr double speed = 0.37;  // [m/s]
constexpr double mass = 1.3;    // [kg]
constexpr double tolerance = 1e-12;
constexpr double promise = 1e-8;  // relative difference to a closed form
constexpr double asked[] = {0.1, 0.3, 0.5, 0.7, 0.9, 0.99};

struct Spring {
  std::string name;
  ElasticLaw law;
};

std::vector<Spring> springs() {
  const ElasticArguments round{.pin_radius = 7.9e-3, .wall_radius = 8e-3, .length = 10e-3};
  return {{"K d", make_elastic("power:K=1e8,n=1", round)},
          {"K d^1.5", make_elastic("power:K=1e8,n=1.5", round)},
          {"johnson", make_elastic("johnson", round)}};
}

/// One law, spring and restitution by every formulation.
struct Row {
  std::string law, spring;
  double e = 0.0;
  std::optional<double> closed_form{};
  std::vector<ImpactOutcome> outcomes{};  // in the order of integrators()
  std::string refused{};                  // why there are none

  /// Largest relative difference to the closed form, or between the integrators if there is none.
  double error() const {
    const double reference = closed_form.value_or(outcomes.front().restitution);
    double largest = 0.0;
    for (const ImpactOutcome& x : outcomes)
      largest = std::max(largest, std::abs(x.restitution / reference - 1.0));
    return largest;
  }
  double energy_error() const {
    double largest = 0.0;
    for (const ImpactOutcome& x : outcomes)
      largest =
          std::max(largest, std::abs(x.dissipated - x.kinetic_loss) / (0.5 * mass * speed * speed));
    return largest;
  }
};

/// Without constraints arkode-baumgarte is the same as arkode-projection.
std::vector<std::string> integrators() { return {"arkode-projection", "ida-ggl"}; }

Row measure(const std::string& law, const Spring& spring, double e) {
  Row row{.law = law, .spring = spring.name, .e = e};
  const DissipativeArguments arguments{.restitution = e};
  try {
    const ContactLaw contact{spring.law, make_dissipative(law, arguments)};
    const double n = power_of(spring.law).value_or(std::numeric_limits<double>::quiet_NaN());
    row.closed_form = closed_form_restitution(law, arguments, n, speed);
    for (const std::string& formulation : integrators())
      row.outcomes.push_back(simulate_impact({.law = contact,
                                              .speed = speed,
                                              .mass = mass,
                                              .relative_tolerance = tolerance,
                                              .formulation = formulation}));
  } catch (const ModelError& error) {
    row.refused = error.what();
    row.outcomes.clear();
  }
  return row;
}

std::vector<Row> measure_all() {
  const std::vector<Spring> all = springs();
  std::vector<Row> rows;
  std::vector<const Spring*> spring_of;
  for (const DissipativeNote& note : dissipative_catalog()) {
    for (const Spring& spring : all) {
      if (note.linear_only && power_of(spring.law) != 1.0) continue;
      for (const double e : asked) {
        if (note.name == "none" && e != asked[0]) continue;
        rows.push_back(
            {.law = note.name, .spring = spring.name, .e = note.name == "none" ? 1.0 : e});
        spring_of.push_back(&spring);
      }
    }
  }
  run_parallel(rows.size(), static_cast<int>(std::max(1u, std::thread::hardware_concurrency())),
               [&](std::size_t i) { rows[i] = measure(rows[i].law, *spring_of[i], rows[i].e); });
  return rows;
}

std::string digits(double error) {
  return fmt::format("{:.1f}", error > 0.0 ? std::min(16.0, -std::log10(error)) : 16.0);
}

std::string number(const std::optional<double>& x) {
  return x ? fmt::format("{:.10f}", *x) : std::string("-");
}

void print_summary(Document& doc, const std::vector<Row>& rows) {
  std::size_t impacts = 0, with_closed_form = 0, kept = 0, refused = 0, others = 0;
  double worst = 0.0, worst_other = 0.0, worst_energy = 0.0, worst_momentum = 0.0;
  for (const Row& row : rows) {
    if (!row.refused.empty()) {
      ++refused;
      continue;
    }
    impacts += row.outcomes.size();
    worst_energy = std::max(worst_energy, row.energy_error());
    for (const ImpactOutcome& x : row.outcomes)
      worst_momentum = std::max(worst_momentum, x.momentum_error);
    if (row.closed_form) {
      ++with_closed_form;
      worst = std::max(worst, row.error());
      if (row.error() <= promise) ++kept;
    } else {
      ++others;
      worst_other = std::max(worst_other, row.error());
    }
  }
  doc.print(
      "{} impacts. Against the closed form: {} of {} rows within {:.0e}, the worst {:.1e}. Without "
      "a closed form, {} rows: the two integrators differ by at most {:.1e}. Refused by the law "
      "itself: {} rows, listed at the end. Dissipated energy against the loss of kinetic energy: "
      "at most {:.1e} of the energy of the impact. Momentum: {:.1e}.\n",
      impacts, kept, with_closed_form, promise, worst, others, worst_other, refused, worst_energy,
      worst_momentum);
}

void print_rows(Document& doc, const std::vector<Row>& rows) {
  std::string law, spring;
  for (const Row& row : rows) {
    if (!row.refused.empty()) continue;
    if (row.law != law) doc.print("\n### {}\n", row.law);
    if (row.law != law || row.spring != spring) {
      doc.print("\n{}\n\n", row.spring);
      doc.head({"asked", "closed form", "arkode-projection", "ida-ggl", "digits",
                "largest penetration [m]", "largest force [N]", "duration [s]", "dissipated [J]"});
    }
    law = row.law;
    spring = row.spring;
    const ImpactOutcome& x = row.outcomes.front();
    doc.row({fmt::format("{:g}", row.e), number(row.closed_form), number(x.restitution),
             number(row.outcomes.back().restitution),
             digits(row.error()) + (row.closed_form ? "" : " (between them)"),
             fmt::format("{:.9e}", x.max_penetration), fmt::format("{:.9e}", x.max_force),
             fmt::format("{:.9e}", x.duration), fmt::format("{:.9e}", x.dissipated)});
  }
}

void print_refusals(Document& doc, const std::vector<Row>& rows) {
  doc.heading("Refused");
  doc.head({"law", "spring", "asked", "why"});
  for (const Row& row : rows)
    if (!row.refused.empty())
      doc.row({row.law, row.spring, fmt::format("{:g}", row.e), row.refused});
}

std::string document(const std::vector<Row>& rows) {
  Document doc;
  doc.print(
      "# Impacts\n\nPrinted by `yoke validate impacts`. Two free bodies (effective mass {} kg) "
      "meet centrally at {} m/s; contact element, located events and integrator are those of every "
      "other run, at rtol {:.0e} with error weights of a tenth of the elastic penetration. "
      "Springs: K d with K = 1e8 N/m, K d^1.5 with K = 1e8 N/m^1.5, Johnson's law of a steel pin "
      "of 7.9 mm in a bore of 8 mm, 10 mm long. `asked` is the restitution the law is given, "
      "`closed form` what its equation of motion returns, then what the engine delivers; `digits` "
      "is -log10 of the larger relative difference. Laws that pull at the end keep their tensile "
      "phase. Penetration, force, duration and energy are those of arkode-projection.\n\n",
      mass, speed, tolerance);
  print_summary(doc, rows);
  doc.heading("Scores");
  print_rows(doc, rows);
  if (std::ranges::any_of(rows, [](const Row& row) { return !row.refused.empty(); }))
    print_refusals(doc, rows);
  return doc.plain();
}

std::string csv(const std::vector<Row>& rows) {
  std::string text =
      "dissipation,elastic,formulation,restitution_asked,restitution_closed_form,restitution_"
      "engine,max_penetration_m,max_force_N,duration_s,dissipated_J,kinetic_loss_J,permanent_set_m,"
      "steps\n";
  for (const Row& row : rows)
    for (std::size_t i = 0; i < row.outcomes.size(); ++i) {
      const ImpactOutcome& x = row.outcomes[i];
      text += fmt::format(
          "{},{},{},{},{},{},{},{},{},{},{},{},{}\n", row.law, row.spring, integrators()[i],
          exactly(row.e), row.closed_form ? exactly(*row.closed_form) : "", exactly(x.restitution),
          exactly(x.max_penetration), exactly(x.max_force), exactly(x.duration),
          exactly(x.dissipated), exactly(x.kinetic_loss), exactly(x.permanent_set), x.steps);
    }
  return text;
}

std::string json(const std::vector<Row>& rows) {
  using Json = nlohmann::ordered_json;
  Json all = Json::array();
  for (const Row& row : rows) {
    Json engine = Json::object();
    for (std::size_t i = 0; i < row.outcomes.size(); ++i) {
      const ImpactOutcome& x = row.outcomes[i];
      engine[integrators()[i]] = {
          {"restitution", x.restitution},       {"max_penetration_m", x.max_penetration},
          {"max_force_N", x.max_force},         {"duration_s", x.duration},
          {"dissipated_J", x.dissipated},       {"kinetic_loss_J", x.kinetic_loss},
          {"permanent_set_m", x.permanent_set}, {"steps", x.steps}};
    }
    all.push_back({{"dissipation", row.law},
                   {"elastic", row.spring},
                   {"asked", row.e},
                   {"closed_form", row.closed_form ? Json(*row.closed_form) : Json(nullptr)},
                   {"engine", engine},
                   {"refused", row.refused.empty() ? Json(nullptr) : Json(row.refused)}});
  }
  return all.dump(2) + "\n";
}

}  // namespace

std::string impacts_document() { return document(measure_all()); }

void write_impacts(const std::filesystem::path& folder) {
  const std::vector<Row> rows = measure_all();
  make_output_folder(folder);
  write_text(folder / "impacts.md", document(rows));
  write_text(folder / "impacts.csv", csv(rows));
  write_text(folder / "impacts.json", json(rows));
}

}  // namespace yoke::cases
