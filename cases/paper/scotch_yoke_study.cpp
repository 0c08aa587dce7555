// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// yoke study scotch_yoke: what section 4 of the paper says in words, tested. Prints Markdown. A
// verdict is computed from the numbers above it; nothing is tuned to obtain one.
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include <yoke/cases/jobs/progress.hpp>
#include <yoke/cases/paper/scotch_yoke_study.hpp>
#include <yoke/integrators/studies/work_pool.hpp>

namespace yoke::cases {

namespace {

using namespace scotch_yoke_data;
using Column = Eigen::VectorXd;

constexpr double degree = pi / 180.0;

/// [deg] from the start of the last revolution; the ramp of the speed is over by then.
double angle_at(const ScotchYoke& choices, double t) {
  return (t - choices.last_revolution_start()) * speed / degree;
}

}  // namespace

std::string_view short_name(std::string_view law) {
  if (law.starts_with("table11-")) law.remove_prefix(8);
  return law;
}

std::vector<Flight> flights_by_angle(const ScotchYoke& choices, const LawRun& run) {
  std::vector<Flight> all;
  for (Flight f : flights(run)) {
    f.from = angle_at(choices, f.from);
    f.to = angle_at(choices, f.to);
    if (f.to > 0.0) all.push_back(f);
  }
  return all;
}

RunRequest with(RunRequest request, const std::vector<std::pair<std::string, std::string>>& set) {
  for (const auto& [name, value] : set) request.parameters.set(name, value);
  return request;
}

Separations separations(const std::vector<Flight>& all, double from, double to) {
  Separations s;
  for (const Flight& f : all) {
    const double overlap = std::min(f.to, to) - std::max(f.from, from);
    if (overlap <= 0.0) continue;
    s.share += overlap / (to - from);
    if (f.from >= from) ++s.count;
  }
  return s;
}

namespace {

// ---- what is measured of a run ----

Revolution last_revolution(const ScotchYoke& choices, const LawRun& run) {
  const Column t = run.motion()["t_s"];
  const auto first =
      std::lower_bound(t.begin(), t.end(), choices.last_revolution_start() * (1 - 1e-12)) -
      t.begin();
  const auto tail = [&](const char* name) -> Column {
    return run.motion()[name].tail(t.size() - first);
  };
  Revolution r{.law = run.law,
               .angle = tail("t_s"),
               .force = tail("normal_force_N"),
               .penetration = tail("penetration_m").cwiseMax(0.0),
               .x = tail("slider_x_m"),
               .v = tail("slider_v_m_per_s"),
               .a = tail("slider_a_m_per_s2"),
               .flights = flights_by_angle(choices, run)};
  for (double& angle : r.angle) angle = angle_at(choices, angle);
  return r;
}

/// What is measured are means and shares of rows: uniform in time, 50 or more in the shortest impact; long
/// runs less densely, to bound the memory.
RunRequest with_dense_rows(RunRequest request) {
  const double revolutions = ScotchYoke(request.parameters).revolutions;
  request.samples = static_cast<int>(std::min(20000.0 * revolutions, 80000.0)) + 1;
  return request;
}

/// Runs all laws with some settings on top of the user's. Interrupted: what is missing is empty.
std::vector<LawRun> run_laws(const RunRequest& request, const Texts& laws) {
  std::vector<LawRun> runs(laws.size());
  ProgressLine progress(laws);
  run_parallel(laws.size(), request.jobs, [&](std::size_t i) {
    if (!interrupted())
      runs[i] = run_law(find_case("scotch_yoke"), with_dense_rows(request), laws[i],
                        progress.observer(i));
  });
  return runs;
}

bool complete(const std::vector<LawRun>& runs) {
  return std::ranges::all_of(runs, [](const LawRun& run) { return run.summary.ok(); });
}

double largest_in(const Revolution& r, const Column& values, double from, double to) {
  double largest = 0.0;
  for (Eigen::Index i = 0; i < values.size(); ++i)
    if (r.angle[i] >= from && r.angle[i] <= to) largest = std::max(largest, values[i]);
  return largest;
}

/// Stiffness [N/m] of the outer wall's elastic law under a force.
double stiffness_at(const ScotchYoke& choices, std::string_view law, double force) {
  const ElasticLaw elastic = scotch_yoke_laws(choices, law).outer->elastic;
  return elastic.response(elastic.penetration_at(force)).stiffness;
}

/// Names in descending order of a value.
Texts ranked(const Texts& names, const std::function<double(const std::string&)>& value) {
  Texts sorted = names;
  std::ranges::stable_sort(sorted,
                           [&](const auto& a, const auto& b) { return value(a) > value(b); });
  for (std::string& name : sorted) name = short_name(name);
  return sorted;
}

// ---- the statements ----

/// What is studied, as on the pages of the other cases.
constexpr const char* mechanism = R"(
```sh
yoke run scotch_yoke --set crank_length=50mm --law johnson
```

```text
                   1 kg
                 .-(o)
              .-' .-'            o   crank pivot, origin
            .'  .'               P   pin, radius 7.9 mm, at r = crank_length from the pivot
           /   /                 C   centre of the slot's arc, fixed in the slider: its x is what
          |   | P                    the results call slider_x_m, its y is 0
   o------+-(#)+ - - - C
    phi   |   |    R_m           R_m 60 mm to the middle of the slot; walls at 52 mm (inner) and
           \   \                     68 mm (outer, the far one from C), over 120 deg, caps 8 mm
            '.  '.               slider: 0.353 kg and 1 kg at each end of the slot
              '-. '-.            24 pi rad/s, no gravity, no friction
                 '-(o)
                   1 kg          without clearance X = r cos(phi) + sqrt(R_m^2 - r^2 sin^2(phi))
```

Without clearance X'' = 0, where the force changes sides, is at 63.6 and 296.4 deg for a crank of 45 mm. A run
prints as a check whether the slider stays within gap and penetration of X, and the balance of energy for
each law. Its plots: Figures 11 to 16 of the paper ([figures](../figures.md)), motion, velocities, reactions,
energy, contact force, penetration and the loop of the hardest contact.

`slot=spline` describes the slot by a spline through 200 points of the arc and prints how far it is
from the arc, and the order in which a coarser one converges; `slot=ideal` is the arc without clearance, a
`PointOnCurve`, whose motion is compared with X.
)";

std::string front_matter(const Study& s) {
  return fmt::format(
      "# The scotch-yoke and what the paper says about it\n\n"
      "Written by `yoke study scotch_yoke > docs/cases/scotch_yoke.md`; do not edit by hand. The paper "
      "is "
      "Autiero et al., Machines 2022, 10, 966, section 4. The runs are those of `yoke run "
      "scotch_yoke`, by {} at rtol {:g}. Angles count from the start of the last revolution. A "
      "verdict follows from the numbers beside it; no parameter was tuned.\n{}",
      s.request.formulation, s.request.relative_tolerance, mechanism);
}

/// [N] with the slider on the ideal path.
double largest_rigid_force(const ScotchYoke& choices) {
  double most = 0.0;
  for (double phi = 0.0; phi < 2.0 * pi; phi += 0.01)
    most = std::max(most, std::abs(ideal_scotch_yoke(choices.crank_length, phi, speed).force));
  return most;
}

void print_runs(Study& s) {
  s.doc.heading("The runs");
  s.doc.head({"parameter", "value"});
  const auto parameters = s.request.parameters.to_json();
  for (const auto& [name, value] : parameters.items()) s.doc.row({name, value.get<std::string>()});
  s.doc.print("\n");
  s.doc.head({"law", "largest force [N]", "largest penetration [µm]", "contacts",
              "contacts in the last revolution", "energy balance [J]"});
  for (const LawRun& run : s.runs) {
    const auto onsets = std::ranges::count_if(run.events, [&](const EventRecord& e) {
      return e.kind == "onset" && e.t >= s.choices.last_revolution_start();
    });
    s.doc.row({run.law, fmt::format("{:.0f}", run.peak_force()),
               fmt::format("{:.1f}", 1e6 * run.largest_penetration()),
               fmt::format("{}", run.onsets()), fmt::format("{}", onsets),
               fmt::format("{:.1e}", run.summary.energy_balance)});
  }
  s.doc.print(
      "\nWithout clearance the contact force would be at most {:.0f} N: what is above it is "
      "impact.\n",
      largest_rigid_force(s.choices));
}

std::string angles(const Flight* f) {
  return f == nullptr ? "none" : fmt::format("{:.1f} to {:.1f}", f->from, f->to);
}

/// The n-th flight from wall to wall.
const Flight* crossing(const std::vector<Flight>& all, int n) {
  for (const Flight& f : all)
    if (f.crosses && f.from >= 0.0 && n-- == 0) return &f;
  return nullptr;
}

/// [deg] where the slider without clearance changes from being pushed to being pulled.
std::vector<double> force_changes(const ScotchYoke& choices) {
  std::vector<double> all;
  double before = 0.0;
  for (double angle = 0.0; angle <= 360.0; angle += 0.01) {
    const double phi = choices.start_angle + angle * degree;
    const double force = ideal_scotch_yoke(choices.crank_length, phi, speed).force;
    if (before * force < 0.0) all.push_back(angle);
    before = force;
  }
  return all;
}

void print_friction(Study& s) {
  const Case& c = find_case("scotch_yoke");
  s.doc.heading("With friction");
  s.doc.print(
      "`yoke run scotch_yoke --law johnson --friction brown-mcphee:mu=0.05`: the impacts hardly change but "
      "the energy does, because the pin, fixed to the crank, slides all the time.\n\n");
  s.doc.head({"mu", "largest force [N]", "contacts", "dissipated [J]"});
  for (const char* mu : {"none", "0.05", "0.1"}) {
    if (interrupted()) return;
    const std::string friction =
        mu == std::string_view("none") ? "" : fmt::format("brown-mcphee:mu={}", mu);
    const Texts laws = choose_laws(c, s.request.parameters, {"johnson"}, friction);
    const LawRun run = run_law(c, s.request, laws.front(), {});
    if (!run.summary.ok()) continue;
    const Column dissipated = run.samples["dissipated_J"];
    s.doc.row({mu, fmt::format("{:.0f}", run.peak_force()), fmt::format("{}", run.onsets()),
               fmt::format("{:.3g}", dissipated[dissipated.size() - 1])});
  }
}

void print_gaps(Study& s) {
  s.doc.heading("No contact near 100 deg, and a second gap");
  const std::vector<double> changes = force_changes(s.choices);
  s.doc.print("Without clearance the force changes its side at {:.1f} deg.\n\n",
              fmt::join(changes, " and "));
  s.doc.head({"law", "first gap [deg]", "landing [m/s]", "second gap [deg]", "landing [m/s]"});
  const auto holds = [](const Flight* f, double angle) {
    return f != nullptr && f->from < angle && f->to > angle;
  };
  bool at_100 = true, second_too = true;
  for (const Revolution& r : s.laws) {
    const Flight *first = crossing(r.flights, 0), *second = crossing(r.flights, 1);
    const auto landing = [](const Flight* f) {
      return f == nullptr ? std::string("-") : fmt::format("{:.3f}", f->landing_speed);
    };
    s.doc.row({r.law, angles(first), landing(first), angles(second), landing(second)});
    at_100 = at_100 && holds(first, 100.0);
    second_too = second_too && changes.size() > 1 && holds(second, changes[1] + 5.0);
  }
  s.doc.verdict(
      "No contact around 100 deg", at_100 ? "Holds for every law" : "Does not hold",
      fmt::format("A second gap, which the paper does not mention, {} 5 deg after the second "
                  "change of side.",
                  second_too ? "is there for every law" : "is not there for every law"));
}

void print_start_angles(Study& s) {
  s.doc.print(
      "\nThe paper prints 31 deg without sign or direction. Gaps of `table11-johnson` for the "
      "four readings:\n\n");
  s.doc.head({"start_angle", "first gap [deg]", "second gap [deg]"});
  for (const char* start : {"-31deg", "31deg", "149deg", "-149deg"}) {
    RunRequest request = with(s.request, {{"start_angle", start}});
    request.samples = 0;
    const ScotchYoke choices(request.parameters);
    const auto all = flights_by_angle(
        choices, run_law(find_case("scotch_yoke"), request, "table11-johnson", {}));
    s.doc.row({start, angles(crossing(all, 0)), angles(crossing(all, 1))});
  }
}

/// The longest stretch of the last revolution in which every column of the table is in contact.
std::pair<double, double> common_contact(const Study& s) {
  std::vector<std::pair<double, double>> apart;
  for (const std::string& law : s.columns())
    for (const Flight& f : s.of(law).flights) apart.emplace_back(f.from, f.to);
  std::ranges::sort(apart);
  std::pair<double, double> best{0.0, 0.0};
  double end = 0.0;
  for (const auto& [from, to] : apart) {
    if (from - end > best.second - best.first) best = {end, from};
    end = std::max(end, to);
  }
  return best;
}

/// Means and ripple over a window.
struct Ripple {
  double mean_force = 0.0, ripple = 0.0;  // [N] ripple: root mean square about the rigid force
  double mean_penetration = 0.0;          // [m]
  double frequency = 0.0;                 // [Hz] from the maxima of the penetration
};

Ripple ripple_in(const Study& s, const Revolution& r, double from, double to) {
  Ripple out;
  int n = 0, peaks = 0;
  double first_peak = 0.0, last_peak = 0.0;
  for (Eigen::Index i = 1; i + 1 < r.angle.size(); ++i) {
    if (r.angle[i] < from || r.angle[i] > to) continue;
    const double phi = s.choices.start_angle + r.angle[i] * degree;
    const double rigid = std::abs(ideal_scotch_yoke(s.choices.crank_length, phi, speed).force);
    out.mean_force += r.force[i];
    out.ripple += (r.force[i] - rigid) * (r.force[i] - rigid);
    out.mean_penetration += r.penetration[i];
    ++n;
    if (r.penetration[i] > r.penetration[i - 1] && r.penetration[i] >= r.penetration[i + 1]) {
      if (peaks++ == 0) first_peak = r.angle[i];
      last_peak = r.angle[i];
    }
  }
  out.mean_force /= n;
  out.ripple = std::sqrt(out.ripple / n);
  out.mean_penetration /= n;
  if (peaks > 1) out.frequency = (peaks - 1) * speed / ((last_peak - first_peak) * degree);
  return out;
}

void print_continuous_contact(Study& s) {
  s.doc.heading("Continuous contact: the force, the penetration, the frequency of its ripple");
  const auto [from, to] = common_contact(s);
  double rigid = 0.0, mass = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const double phi = s.choices.start_angle + (from + (to - from) * (i + 0.5) / 1000) * degree;
    const double sine = s.choices.crank_length * std::sin(phi) / arc_radius;
    rigid += std::abs(ideal_scotch_yoke(s.choices.crank_length, phi, speed).force) / 1000;
    mass += moving_mass / (1.0 - sine * sine) / 1000;  // along the normal: m / cos^2 psi
  }
  s.doc.print(
      "The longest stretch in which all five columns are in contact is {:.1f} to {:.1f} deg. "
      "Without clearance the mean force there is {:.1f} N. The predicted frequency is "
      "sqrt(k/m)/(2 pi) with the law's stiffness under that force and m = {:.3f} kg, the slider "
      "as seen along the normal.\n\n",
      from, to, rigid, mass);
  s.doc.head({"law", "mean force [N]", "ripple, rms [N]", "mean penetration [µm]",
              "ripple frequency [Hz]", "predicted [Hz]"});
  double least = 1e9, most = 0.0, shallow = 1e9, deep = 0.0, wiggle = 0.0, slow = 1e9, fast = 0.0;
  for (const std::string& law : s.columns()) {
    const Ripple r = ripple_in(s, s.of(law), from, to);
    const double predicted = std::sqrt(stiffness_at(s.choices, law, rigid) / mass) / (2.0 * pi);
    s.doc.row({law, fmt::format("{:.1f}", r.mean_force), fmt::format("{:.1f}", r.ripple),
               fmt::format("{:.2f}", 1e6 * r.mean_penetration), fmt::format("{:.0f}", r.frequency),
               fmt::format("{:.0f}", predicted)});
    least = std::min(least, r.mean_force), most = std::max(most, r.mean_force);
    shallow = std::min(shallow, r.mean_penetration), deep = std::max(deep, r.mean_penetration);
    slow = std::min(slow, r.frequency), fast = std::max(fast, r.frequency);
    wiggle = std::max(wiggle, r.ripple / rigid);
  }
  const bool same_force = most - least < 0.1 * rigid && wiggle < 0.1;
  const bool same_mean = most - least < 0.1 * rigid && deep > 1.2 * shallow;
  s.doc.verdict(
      "In continuous contact the same force for all laws, not the same penetration",
      same_force  ? "Holds"
      : same_mean ? "Holds for the mean over the ripple"
                  : "Does not hold",
      fmt::format("The mean force of the laws differs by {:.1f} % of that without clearance, "
                  "the penetration by a factor {:.1f}. The force at an instant is not common: "
                  "it ripples by up to {:.0f} % (rms), each law in its own time.",
                  100.0 * (most - least) / rigid, deep / shallow, 100.0 * wiggle));
  s.doc.verdict(
      "The frequency of the penetration's ripple depends on the law",
      fast > 1.2 * slow ? "Holds" : "Does not hold",
      fmt::format("From {:.0f} to {:.0f} Hz; it follows from the stiffness.", slow, fast));
}

void print_impact_forces(Study& s) {
  s.doc.heading("Stiffer laws give higher forces in impacts");
  s.doc.head({"law", "K outer wall [N/mm^n]", "stiffness at 1 kN [kN/mm]",
              "largest force to 100 deg [N]", "largest force of the revolution [N]"});
  const auto until_100 = [&](const std::string& law) {
    return largest_in(s.of(law), s.of(law).force, 0.0, 100.0);
  };
  const auto whole = [&](const std::string& law) {
    return largest_in(s.of(law), s.of(law).force, 0.0, 360.0);
  };
  const auto stiffness = [&](const std::string& law) { return stiffness_at(s.choices, law, 1e3); };
  for (const std::string& law : s.columns()) {
    const PowerLaw printed = table11(law).outer;
    s.doc.row({law,
               fmt::format("{:.4g}, n = {:.2f}", printed.K / std::pow(1e3, printed.n), printed.n),
               fmt::format("{:.1f}", 1e-6 * stiffness(law)), fmt::format("{:.0f}", until_100(law)),
               fmt::format("{:.0f}", whole(law))});
  }
  Texts close_n = s.columns();
  close_n.erase(close_n.begin());  // Lankarani and Nikravesh, n = 1.5, which the paper excepts
  const Texts by_k = ranked(close_n, stiffness);
  const auto holds = [&](const Texts& order) { return order == by_k ? "holds" : "does not hold"; };
  const Texts a = ranked(close_n, until_100), b = ranked(close_n, whole);
  const bool stiff_above_soft =
      std::min(until_100("table11-johnson"), until_100("table11-radzimovsky")) >
      std::max(until_100("table11-goldsmith"), until_100("table11-esdu-78035"));
  s.doc.verdict(
      "Stiffer laws give higher impact forces (until 100 deg)",
      a == by_k          ? "Holds"
      : stiff_above_soft ? "Holds for stiff against soft"
                         : "Does not hold",
      fmt::format(
          "Without Lankarani and Nikravesh, which the paper excepts, by stiffness: {}. By the "
          "largest force until 100 deg: {} (the order {}); of the whole revolution: {} (the order "
          "{}).",
          fmt::join(by_k, ", "), fmt::join(a, ", "), holds(a), fmt::join(b, ", "), holds(b)));
}

void print_loops(Study& s) {
  s.doc.heading("Steepness of the loops");
  const double loads[] = {100.0, 500.0, 1000.0, 2000.0};
  s.doc.print(
      "Stiffness dF/dd of the outer wall's law [kN/mm], at a named force because the ranking "
      "depends on it.\n\n");
  Texts head{"law"};
  for (const double load : loads) head.push_back(fmt::format("{:.0f} N", load));
  s.doc.head(head);
  for (const Revolution& r : s.laws) {
    Texts row{r.law};
    for (const double load : loads)
      row.push_back(fmt::format("{:.1f}", 1e-6 * stiffness_at(s.choices, r.law, load)));
    s.doc.row(row);
  }
  s.doc.print("\n");
  std::vector<std::string> holds, fails;
  for (const double load : loads) {
    const Texts order = ranked(
        s.columns(), [&](const std::string& law) { return stiffness_at(s.choices, law, load); });
    s.doc.print("- {:.0f} N, steepest first: {}\n", load, fmt::join(order, ", "));
    (order[2] == "lankarani-nikravesh" ? holds : fails).push_back(fmt::format("{:.0f} N", load));
  }
  const auto listed = [](const Texts& texts) {
    return texts.empty() ? std::string("no force tried")
                         : fmt::format("{}", fmt::join(texts, ", "));
  };
  s.doc.verdict(
      "Loops: Johnson and Radzimovsky steepest, Goldsmith and ESDU gentle, "
      "Lankarani-Nikravesh between",
      fails.empty()   ? "Holds"
      : holds.empty() ? "Does not hold"
                      : "Holds at light load",
      fmt::format("Lankarani and Nikravesh is third at {}; not at {}.", listed(holds),
                  listed(fails)));
}

/// Largest difference between any two columns of the table, relative to the range of the quantity.
double spread(const Study& s, Column Revolution::*quantity) {
  const Texts names = s.columns();
  Column high = s.of(names[0]).*quantity, low = high;
  for (const std::string& name : names) {
    high = high.cwiseMax(s.of(name).*quantity);
    low = low.cwiseMin(s.of(name).*quantity);
  }
  return (high - low).maxCoeff() / (high.maxCoeff() - low.minCoeff());
}

void print_kinematics(Study& s) {
  s.doc.heading("Position hardly depends on the law, velocity and acceleration do");
  const double x = spread(s, &Revolution::x), v = spread(s, &Revolution::v),
               a = spread(s, &Revolution::a);
  s.doc.head({"", "largest difference among the columns, of the range of the quantity"});
  s.doc.row({"position", fmt::format("{:.2f} %", 100 * x)});
  s.doc.row({"velocity", fmt::format("{:.2f} %", 100 * v)});
  s.doc.row({"acceleration", fmt::format("{:.1f} %", 100 * a)});
  s.doc.verdict(
      "Position hardly depends on the law, velocity and acceleration do",
      x < 0.02 && v > 2.0 * x && a > v ? "Holds" : "Does not hold",
      fmt::format("The relative differences of velocity and acceleration are {:.0f} and {:.0f} "
                  "times that of the position.",
                  v / x, a / x));
}

void print_one_wall(Study& s) {
  s.doc.heading("One stiffness for both walls");
  Texts names = s.columns();
  names.push_back("johnson");
  const auto one = run_laws(with(s.request, {{"walls", "one"}}), names);
  const auto nudged_offset = s.choices.pin_offset > 0.0 ? "0mm" : "0.0001mm";
  const auto nudged = run_laws(with(s.request, {{"pin_offset", nudged_offset}}), names);
  if (!complete(one) || !complete(nudged)) return;
  s.doc.print(
      "`walls=one` gives the inner wall the law of the outer one. Beside it, what the pin moved "
      "by 0.1 µm at the start does: a train of bounces amplifies. The inner row of Table 11 was "
      "made with a wrong pin radius (see the errata), so `johnson`, with the radii as they are, "
      "is the cleaner test.\n\n");
  s.doc.head({"law", "force inner / outer at 20 µm", "largest force, own and one [N]",
              "separations, own and one", "path changes by, rms [µm]",
              "by 0.1 µm at the start, rms [µm]"});
  double force = 0.0, close_path = 0.0, other_path = 0.0;
  bool same_count = true;
  for (std::size_t i = 0; i < one.size(); ++i) {
    const Revolution &own = s.of(one[i].law), shared = last_revolution(s.choices, one[i]),
                     moved = last_revolution(s.choices, nudged[i]);
    const auto rms = [&](const Revolution& other) {
      return 1e6 * std::sqrt((own.x - other.x).squaredNorm() / static_cast<double>(own.x.size()));
    };
    const SlotLaws laws = scotch_yoke_laws(s.choices, own.law);
    const double ratio =
        laws.inner->elastic.response(20e-6).force / laws.outer->elastic.response(20e-6).force;
    const double before = own.force.maxCoeff(), after = shared.force.maxCoeff();
    const int n = separations(own.flights, 0, 360).count,
              m = separations(shared.flights, 0, 360).count;
    force = std::max(force, std::abs(after / before - 1.0));
    double& path = std::abs(ratio - 1.0) < 0.005 ? close_path : other_path;
    path = std::max(path, rms(shared));
    same_count = same_count && n == m;
    s.doc.row({own.law, fmt::format("{:.3f}", ratio), fmt::format("{:.0f}, {:.0f}", before, after),
               fmt::format("{}, {}", n, m), fmt::format("{:.2f}", rms(shared)),
               fmt::format("{:.2f}", rms(moved))});
  }
  s.doc.verdict(
      "One stiffness for both walls is enough at small clearance",
      force < 0.05 && same_count ? "Holds for forces; for the path where the two agree"
                                 : "Does not hold",
      fmt::format(
          "The largest force changes by at most {:.1f} %, the number of separations {}. The path "
          "changes by at most {:.2f} µm where the walls differ by less than 0.5 %, by up to {:.0f} "
          "µm otherwise, because the bounces come at other times.",
          100.0 * force, same_count ? "not at all" : "too", close_path, other_path));
}

void print_johnson(Study& s) {
  s.doc.heading("Johnson's law itself and its fit");
  s.doc.print("Force of the fit against the law's at the same penetration, outer wall:\n\n");
  s.doc.head({"", "at 10 N", "at 100 N", "at 1000 N", "largest force, fit and law [N]",
              "contacts, fit and law"});
  for (const auto& [name, fit, law] :
       {std::tuple{"as printed; L = 1 mm", "table11-johnson", "johnson"},
        std::tuple{"K times 10; L = 10 mm", "table11-johnson-10mm", "johnson-10mm"}}) {
    const ElasticLaw f = scotch_yoke_laws(s.choices, fit).outer->elastic,
                     j = scotch_yoke_laws(s.choices, law).outer->elastic;
    Texts row{name};
    for (const double load : {10.0, 100.0, 1000.0})
      row.push_back(fmt::format("{:+.1f} %",
                                100.0 * (f.response(j.penetration_at(load)).force / load - 1.0)));
    const LawRun &a = *std::ranges::find(s.runs, fit, &LawRun::law),
                 &b = *std::ranges::find(s.runs, law, &LawRun::law);
    row.push_back(fmt::format("{:.0f}, {:.0f}", a.peak_force(), b.peak_force()));
    row.push_back(fmt::format("{}, {}", a.onsets(), b.onsets()));
    s.doc.row(row);
  }
}

// ---- the choices the paper leaves open ----

void print_choices(Study& s) {
  s.doc.heading("The choices the paper leaves open");
  s.doc.print("`table11-johnson`, last revolution, one parameter changed at a time.\n\n");
  s.doc.head(
      {"changed", "largest force [N]", "separations", "first gap [deg]", "second gap [deg]"});
  const std::pair<std::string, std::string> changes[] = {{"", ""},
                                                         {"slider_start", "rest"},
                                                         {"spin_up", "50ms"},
                                                         {"pin_offset", "0.1mm"},
                                                         {"pin_offset", "-0.1mm"},
                                                         {"pin", "rolling"},
                                                         {"walls", "one"},
                                                         {"crank_length", "40mm"},
                                                         {"crank_length", "50mm"},
                                                         {"contact_length", "10mm"},
                                                         {"revolutions", "3"},
                                                         {"revolutions", "10"}};
  for (const auto& [name, value] : changes) {
    if (interrupted()) return;
    const RunRequest request = name.empty() ? s.request : with(s.request, {{name, value}});
    const ScotchYoke choices(request.parameters);
    const LawRun run =
        run_law(find_case("scotch_yoke"), with_dense_rows(request), "table11-johnson", {});
    if (!run.summary.ok()) continue;
    const Revolution r = last_revolution(choices, run);
    s.doc.row({name.empty() ? "nothing" : fmt::format("{}={}", name, value),
               fmt::format("{:.0f}", r.force.maxCoeff()),
               fmt::format("{}", separations(r.flights, 0, 360).count),
               angles(crossing(r.flights, 0)), angles(crossing(r.flights, 1))});
  }
}

}  // namespace

RunStatus study_scotch_yoke(const RunRequest& request) {
  Study s{.request = request, .choices = ScotchYoke(request.parameters), .runs = {}, .laws = {}};
  s.runs = run_laws(request, request.laws);
  if (interrupted()) return RunStatus::interrupted;
  if (!complete(s.runs)) return RunStatus::failed;
  for (const LawRun& run : s.runs) s.laws.push_back(last_revolution(s.choices, run));
  for (const auto& part :
       {print_runs, print_friction, print_gaps, print_start_angles, print_continuous_contact,
        print_impact_forces, print_loops, print_kinematics, print_one_wall, print_johnson,
        print_choices, print_map})
    if (!interrupted()) part(s);
  if (interrupted()) return RunStatus::interrupted;
  fmt::print("{}", s.doc.text(front_matter(s)));
  return RunStatus::completed;
}

}  // namespace yoke::cases
