// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include <yoke/cases/case.hpp>
#include <yoke/cases/jobs/markdown.hpp>
#include <yoke/cases/scotch_yoke.hpp>
#include <yoke/cases/validation/validation.hpp>
#include <yoke/integrators/simulate.hpp>

namespace yoke::cases {

namespace {

constexpr const char* law = "table11-johnson";
constexpr double reference_tolerance = 1e-13;
constexpr double perturbation = 1e-9;  // [m/s] of the slider at the start

struct Bench {
  Model model;
  double end;
  Eigen::Index slider_x;
};

Bench bench() {
  const Case& c = find_case("scotch_yoke");
  const Parameters parameters(c.parameters, {});
  const ScotchYoke choices(parameters);
  Model model = make_model(c, parameters, law);
  const Eigen::Index slider_x = 3 * (model.find_body("slider").index - 1);
  return {std::move(model), choices.end_time(), slider_x};
}

Result run(const Bench& b, const std::string& formulation, double rtol, double nudge = 0.0) {
  State start = b.model.start_state();
  start.v[b.slider_x] += nudge;
  return simulate(b.model, start,
                  {.until = b.end, .relative_tolerance = rtol, .formulation = formulation});
}

double largest_difference(const Result& a, const Result& b, const char* column) {
  return (a[column] - b[column]).cwiseAbs().maxCoeff();
}

std::string number(double x) { return fmt::format("{:.1e}", x); }

// Slope of log10(error) over log10(tolerance) between two rows.
std::string order(double error, double last_error, double factor) {
  return last_error > 0.0 ? fmt::format("{:.2f}", std::log(last_error / error) / std::log(factor))
                          : "";
}

void print_convergence(Document& doc, const Bench& b, const Result& reference,
                       const std::string& formulation) {
  doc.print("\n### {}\n\n", formulation);
  doc.head({"rtol", "slider x [m]", "order", "slider v [m/s]", "order", "contacts", "steps",
            "ledger [J]", "ledger / exchanged", "drift before projection [m, rad]",
            "violation in results [m, rad]"});
  double last_x = 0.0, last_v = 0.0, first_x = 0.0, first_v = 0.0;
  for (const double rtol : {1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11}) {
    const Result r = run(b, formulation, rtol);
    const double x = largest_difference(r, reference, "slider.x_m");
    const double v = largest_difference(r, reference, "slider.vx_m_per_s");
    const Summary& s = r.summary;
    doc.row({fmt::format("{:.0e}", rtol), number(x), order(x, last_x, 10.0), number(v),
             order(v, last_v, 10.0), std::to_string(r.events.size()), std::to_string(s.steps),
             number(s.energy_balance), number(s.energy_balance / s.energy_exchanged),
             number(std::max(s.position_drift, s.angle_drift)),
             number(std::max(s.position_violation, s.angle_violation))});
    if (first_x == 0.0) {
      first_x = x;
      first_v = v;
    }
    last_x = x;
    last_v = v;
  }
  doc.print("\nMean order from 1e-05 to 1e-11: {} in position, {} in velocity.\n",
            order(last_x, first_x, 1e6), order(last_v, first_v, 1e6));
}

void print_amplification(Document& doc, const Bench& b, const Result& reference) {
  const Result nudged = run(b, "arkode-projection", reference_tolerance, perturbation);
  doc.heading("Amplification of a small perturbation");
  doc.print(
      "The slider starts {:.0e} m/s faster; largest difference of its velocity to the run "
      "without, up to the time given, over the perturbation. This is what any error of the "
      "integration is amplified by on its way.\n\n",
      perturbation);
  doc.head({"revolutions", "velocity difference / perturbation"});
  const Eigen::VectorXd difference =
      (nudged["slider.vx_m_per_s"] - reference["slider.vx_m_per_s"]).cwiseAbs();
  for (const double share : {0.125, 0.25, 0.5, 0.75, 1.0}) {
    const auto rows = static_cast<Eigen::Index>(share * static_cast<double>(difference.size()));
    doc.row({fmt::format("{:.2f}", 2.0 * share),
             fmt::format("{:.1f}", difference.head(rows).maxCoeff() / perturbation)});
  }
}

}  // namespace

std::string convergence_document() {
  const Bench b = bench();
  const Result reference = run(b, "arkode-projection", reference_tolerance);
  const Result other = run(b, "ida-ggl", 1e-12);
  Document doc;
  doc.print(
      "# Convergence of the formulations\n\n"
      "Printed by `yoke validate convergence`. The scotch-yoke with its defaults and {} over "
      "2 revolutions; differences are the largest over 1001 samples to a run of "
      "arkode-projection at rtol {:.0e}. A train of bounces amplifies errors, see below, and "
      "a bounce moved in time makes a difference of velocity as large as its jump allows: so "
      "position converges more evenly than velocity. Order is the slope of the error over "
      "the tolerance: 1 where the solution is smooth. Here every touch starts with a force K "
      "d^1.1, "
      "whose second derivative is infinite at d = 0, which costs both methods part of their order "
      "in "
      "the first steps of each contact.\n\n",
      law, reference_tolerance);
  doc.print(
      "The two integrators, at their tightest (arkode-projection {:.0e}, ida-ggl 1e-12), "
      "differ by {} m in slider position and {} m/s in velocity.\n",
      reference_tolerance, number(largest_difference(other, reference, "slider.x_m")),
      number(largest_difference(other, reference, "slider.vx_m_per_s")));
  doc.heading("Error, energy ledger and drift by tolerance");
  doc.print(
      "Ledger: largest |kinetic + potential + stored + dissipated - work - initial|. Drift "
      "is the largest constraint violation of the integrator's own interpolated state, "
      "violation that of the projected state in the results.\n");
  for (const FormulationNote& f : formulations())
    print_convergence(doc, b, reference, std::string(f.name));
  print_amplification(doc, b, reference);
  return doc.plain();
}

}  // namespace yoke::cases
