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

#include <yoke/cases/choices/quantity.hpp>
#include <yoke/cases/jobs/impact.hpp>
#include <yoke/cases/jobs/markdown.hpp>
#include <yoke/cases/validation/validation.hpp>
#include <yoke/contact/laws/catalog/dissipative_catalog.hpp>
#include <yoke/contact/laws/catalog/elastic_catalog.hpp>
#include <yoke/core/error.hpp>
#include <yoke/core/result.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/integrators/studies/work_pool.hpp>

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
  double n;  // NaN: not a power law
};

/// Every law of the catalog; the power law with n = 1 and 1.5.
std::vector<Spring> springs() {
  const ElasticArguments round{.pin_radius = 7.9e-3, .wall_radius = 8e-3, .length = 10e-3};
  std::vector<std::string> names{"power:K=1e8,n=1", "power:K=1e8,n=1.5"};
  for (const ElasticNote& note : elastic_catalog())
    if (note.name != "power") names.push_back(note.name);
  std::vector<Spring> all;
  for (const std::string& name : names) {
    const ElasticLaw law = make_elastic(name, round);
    all.push_back({name, law, power_of(law).value_or(std::numeric_limits<double>::quiet_NaN())});
  }
  return all;
}

/// A dissipative law, with its tensile phase kept or clamped if it has one.
struct Damper {
  const DissipativeNote* note;
  bool pulls = false;
  TensilePhase tensile = TensilePhase::keep;

  std::string name() const {
    return note->name + (!pulls                          ? ""
                         : tensile == TensilePhase::keep ? ", tensile = keep"
                                                         : ", tensile = clamp");
  }
  DissipativeArguments arguments(double e) const { return {.restitution = e, .tensile = tensile}; }
};

std::vector<Damper> dampers() {
  std::vector<Damper> all;
  for (const DissipativeNote& note : dissipative_catalog()) {
    const bool pulls =
        make_dissipative(note.name, {.restitution = 0.9}).release() == Release::at_zero_penetration;
    all.push_back({&note, pulls});
    if (pulls) all.push_back({&note, pulls, TensilePhase::clamp});
  }
  return all;
}

/// Without constraints arkode-baumgarte is the same as arkode-projection.
constexpr const char* integrators[] = {"arkode-projection", "ida-ggl"};

/// One law, spring, restitution and geometry by every formulation.
struct Row {
  Damper damper;
  const Spring* spring;
  CentralImpact::Setup setup;
  double e = 0.0;
  std::optional<double> closed_form{};
  std::vector<ImpactOutcome> outcomes{};  // in the order of integrators
  std::string refused{};                  // why there are none

  double reference() const { return closed_form.value_or(outcomes.front().restitution); }
  double error_of(std::size_t i) const {
    return std::abs(outcomes[i].restitution / reference() - 1.0);
  }
  /// The integrator farther from the closed form, or from the other one if there is none.
  std::size_t farther() const { return error_of(1) >= error_of(0) ? 1 : 0; }
  double error() const { return error_of(farther()); }
  double energy_error() const {
    double largest = 0.0;
    for (const ImpactOutcome& x : outcomes)
      largest =
          std::max(largest, std::abs(x.dissipated - x.kinetic_loss) / (0.5 * mass * speed * speed));
    return largest;
  }
};

void measure(Row& row) {
  const DissipativeArguments arguments = row.damper.arguments(row.e);
  try {
    const ContactLaw contact{row.spring->law, make_dissipative(row.damper.note->name, arguments)};
    row.closed_form =
        closed_form_restitution(row.damper.note->name, arguments, row.spring->n, speed);
    for (const char* formulation : integrators)
      row.outcomes.push_back(simulate_impact({.law = contact,
                                              .speed = speed,
                                              .mass = mass,
                                              .setup = row.setup,
                                              .relative_tolerance = tolerance,
                                              .formulation = formulation}));
  } catch (const ModelError& error) {
    row.refused = error.what();
    row.outcomes.clear();
  }
}

/// Ordered by law, restitution, geometry, elastic law.
std::vector<Row> measure_all(const std::vector<Spring>& all) {
  std::vector<Row> rows;
  for (const Damper& damper : dampers())
    for (const double e : asked) {
      if (damper.note->name == "none" && e != asked[0]) continue;
      for (const CentralImpact::Setup setup : all_setups)
        for (const Spring& spring : all) {
          if (damper.note->linear_only && spring.n != 1.0) continue;
          rows.push_back({damper, &spring, setup, damper.note->name == "none" ? 1.0 : e});
        }
    }
  run_parallel(rows.size(), static_cast<int>(std::max(1u, std::thread::hardware_concurrency())),
               [&](std::size_t i) { measure(rows[i]); });
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
      "{} impacts. Against the closed form: {} of {} combinations within {:.0e}, the worst {:.1e}. "
      "Without a closed form (lee-wang-2), {} combinations: the two integrators differ by at most "
      "{:.1e}. Refused by the law itself: {} combinations, listed at the end. Dissipated energy "
      "against the loss of kinetic energy: at most {:.1e} of the energy of the impact. Momentum, "
      "where nothing is fixed: {:.1e}.\n",
      impacts, kept, with_closed_form, promise, worst, others, worst_other, refused, worst_energy,
      worst_momentum);
}

/// Of the rows that differ in the elastic law only, the one farthest from the closed form.
void print_scores(Document& doc, const std::vector<Row>& rows) {
  std::string law;
  for (std::size_t i = 0; i < rows.size();) {
    const Row& first = rows[i];
    const Row* worst = nullptr;
    double energy = 0.0;
    for (; i < rows.size() && rows[i].damper.name() == first.damper.name() &&
           rows[i].e == first.e && rows[i].setup == first.setup;
         ++i) {
      if (!rows[i].refused.empty()) continue;
      energy = std::max(energy, rows[i].energy_error());
      if (!worst || rows[i].error() > worst->error()) worst = &rows[i];
    }
    if (!worst) continue;
    if (first.damper.name() != law) {
      law = first.damper.name();
      doc.print("\n### {}\n\n", law);
      doc.head({"asked", "geometry", "closed form", "delivered", "digits", "with", "by",
                "digits of the energy"});
    }
    const std::size_t by = worst->farther();
    doc.row({fmt::format("{:g}", worst->e), name_of(worst->setup), number(worst->closed_form),
             number(worst->outcomes[by].restitution),
             digits(worst->error()) + (worst->closed_form ? "" : " (between them)"),
             worst->spring->name, integrators[by], digits(energy)});
  }
}

void print_springs(Document& doc, const std::vector<Row>& rows, const std::vector<Spring>& all) {
  doc.heading("By elastic law");
  doc.print(
      "The fewest digits of the restitution over all laws of damping with a closed form.\n\n");
  Texts head{"elastic law"};
  for (const CentralImpact::Setup setup : all_setups) head.push_back(name_of(setup));
  doc.head(head);
  for (const Spring& spring : all) {
    Texts cells{spring.name};
    for (const CentralImpact::Setup setup : all_setups) {
      double worst = 0.0;
      for (const Row& row : rows)
        if (row.spring == &spring && row.setup == setup && row.refused.empty() && row.closed_form)
          worst = std::max(worst, row.error());
      cells.push_back(digits(worst));
    }
    doc.row(cells);
  }
}

void print_numbers(Document& doc, const std::vector<Row>& rows) {
  doc.heading("Numbers");
  doc.print(
      "Two free bodies by arkode-projection, with K d^1.5, or K d for the laws that need it.\n\n");
  doc.head({"law", "asked", "delivered", "largest penetration [m]", "largest force [N]",
            "duration [s]", "dissipated [J]", "permanent set [m]"});
  for (const Row& row : rows) {
    if (!row.refused.empty() || row.setup != CentralImpact::Setup::two_bodies) continue;
    if (row.spring->name !=
        (row.damper.note->linear_only ? "power:K=1e8,n=1" : "power:K=1e8,n=1.5"))
      continue;
    const ImpactOutcome& x = row.outcomes.front();
    doc.row({row.damper.name(), fmt::format("{:g}", row.e), number(x.restitution),
             fmt::format("{:.9e}", x.max_penetration), fmt::format("{:.9e}", x.max_force),
             fmt::format("{:.9e}", x.duration), fmt::format("{:.9e}", x.dissipated),
             fmt::format("{:.9e}", x.permanent_set)});
  }
}

void print_refusals(Document& doc, const std::vector<Row>& rows) {
  doc.heading("Refused");
  doc.head({"law", "asked", "combinations", "why"});
  for (std::size_t i = 0; i < rows.size();) {
    const Row& first = rows[i];
    std::size_t count = 0;
    for (; i < rows.size() && rows[i].damper.name() == first.damper.name() &&
           rows[i].e == first.e && rows[i].refused == first.refused;
         ++i)
      ++count;
    if (!first.refused.empty())
      doc.row({first.damper.name(), fmt::format("{:g}", first.e), fmt::format("{}", count),
               first.refused});
  }
}

std::string document(const std::vector<Row>& rows, const std::vector<Spring>& all) {
  Document doc;
  doc.print(
      R"(# Impacts

Printed by `yoke validate impacts`; `-o DIR` writes it with every single impact as CSV and JSON. An
effective mass of {} kg meets a contact at {} m/s; contact element, located events and integrator are
those of every other run, at rtol {:.0e} with error weights of a tenth of the elastic penetration.

Geometries: `bodies`, two free bodies on a line; `wall`, a ball on a fixed wall; `slot`, a pin on the
wall of a slot in a free body; `pendulum`, a physical pendulum on a stop, effective mass by its
inertia, no gravity, normal perpendicular to the arm, penetration below 1e-5 of the arm. Elastic laws:
K d and K d^1.5 with K = 1e8 (N, m), and every law of the catalog for a steel pin of 7.9 mm in a bore
of 8 mm, 10 mm long.

`asked` is the restitution the law is given, `closed form` what its equation of motion returns,
`delivered` what the engine returns: of all elastic laws and both integrators the value farthest from
the closed form, which is named beside it. `digits` is -log10 of its relative difference. `digits of
the energy` compares the dissipated energy, integrated along the run, with the loss of kinetic energy.

The other numbers (largest penetration and force, duration, dissipated energy, permanent set) are
compared with closed forms and quadratures that share no code with the laws by the tests
`tests/validation/impacts_test.cpp`, for all these combinations, within {:.0e}; they measure the order
of convergence too. The command takes about half a minute on 2 cores, the tests (`./dev validate`,
label `validation`) about a minute on one. A part of a second or two, every law of damping and every
elastic law at least once and every geometry with each law of damping, is among the default tests:
`tests/cases/jobs/impacts_test.cpp`, which also has impacts that are not central (a heavy pendulum striking
obliquely, a bar falling on its end) against their own equations of motion.

)",
      mass, speed, tolerance, promise);
  print_summary(doc, rows);
  doc.heading("Scores");
  print_scores(doc, rows);
  print_springs(doc, rows, all);
  print_numbers(doc, rows);
  if (std::ranges::any_of(rows, [](const Row& row) { return !row.refused.empty(); }))
    print_refusals(doc, rows);
  return doc.plain();
}

const char* tensile_text(const Damper& damper) {
  return !damper.pulls ? "" : damper.tensile == TensilePhase::keep ? "keep" : "clamp";
}

std::string csv(const std::vector<Row>& rows) {
  std::string text =
      "dissipation,tensile,elastic,geometry,formulation,restitution_asked,restitution_closed_form,"
      "restitution_engine,max_penetration_m,max_force_N,duration_s,dissipated_J,kinetic_loss_J,"
      "permanent_set_m,momentum_error,steps\n";
  for (const Row& row : rows)
    for (std::size_t i = 0; i < row.outcomes.size(); ++i) {
      const ImpactOutcome& x = row.outcomes[i];
      text += fmt::format("{},{},\"{}\",{},{},{},{},{},{},{},{},{},{},{},{},{}\n",
                          row.damper.note->name, tensile_text(row.damper), row.spring->name,
                          name_of(row.setup), integrators[i], exactly(row.e),
                          row.closed_form ? exactly(*row.closed_form) : "", exactly(x.restitution),
                          exactly(x.max_penetration), exactly(x.max_force), exactly(x.duration),
                          exactly(x.dissipated), exactly(x.kinetic_loss), exactly(x.permanent_set),
                          exactly(x.momentum_error), x.steps);
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
      engine[integrators[i]] = {{"restitution", x.restitution},
                                {"max_penetration_m", x.max_penetration},
                                {"max_force_N", x.max_force},
                                {"duration_s", x.duration},
                                {"dissipated_J", x.dissipated},
                                {"kinetic_loss_J", x.kinetic_loss},
                                {"permanent_set_m", x.permanent_set},
                                {"momentum_error", x.momentum_error},
                                {"steps", x.steps}};
    }
    all.push_back({{"dissipation", row.damper.note->name},
                   {"tensile", tensile_text(row.damper)},
                   {"elastic", row.spring->name},
                   {"geometry", name_of(row.setup)},
                   {"asked", row.e},
                   {"closed_form", row.closed_form ? Json(*row.closed_form) : Json(nullptr)},
                   {"engine", engine},
                   {"refused", row.refused.empty() ? Json(nullptr) : Json(row.refused)}});
  }
  return all.dump(2) + "\n";
}

}  // namespace

std::string impacts_document() {
  const std::vector<Spring> all = springs();
  return document(measure_all(all), all);
}

void write_impacts(const std::filesystem::path& folder) {
  const std::vector<Spring> all = springs();
  const std::vector<Row> rows = measure_all(all);
  make_output_folder(folder);
  write_text(folder / "impacts.md", document(rows, all));
  write_text(folder / "impacts.csv", csv(rows));
  write_text(folder / "impacts.json", json(rows));
}

}  // namespace yoke::cases
