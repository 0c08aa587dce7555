// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Where on the map of damping, stiffness, crank length and start the pin separates from the slot
// between 120 and 300 deg, for each column of Table 11.
#include <atomic>

#include <yoke/cases/jobs/progress.hpp>
#include <yoke/cases/paper/scotch_yoke_study.hpp>
#include <yoke/integrators/studies/work_pool.hpp>

namespace yoke::cases {

namespace {

struct MapPoint {
  std::string crank, start, alpha;
  bool times_10 = false;
  std::vector<Separations> columns;  // in the order of the table
};

std::vector<MapPoint> map_points() {
  std::vector<MapPoint> points;
  for (const char* crank : {"40mm", "45mm", "50mm"})
    for (const char* start : {"rest", "consistent"})
      for (const bool times_10 : {false, true})
        for (const char* alpha : {"0.08s/m", "0.32s/m", "1s/m", "3.2s/m", "10s/m", "32s/m"})
          points.push_back({crank, start, alpha, times_10, {}});
  return points;
}

void calc_map(const Study& s, std::vector<MapPoint>& points) {
  const Texts names = s.columns();
  std::atomic<std::size_t> done = 0;
  ProgressLine progress({"map of separations"});
  run_parallel(points.size(), s.request.jobs, [&](std::size_t i) {
    MapPoint& p = points[i];
    RunRequest request = with(s.request, {{"crank_length", p.crank},
                                          {"slider_start", p.start},
                                          {"alpha", p.alpha},
                                          {"contact_length", p.times_10 ? "10mm" : "as_printed"}});
    request.samples = 0;
    const ScotchYoke choices(request.parameters);
    for (const std::string& name : names) {
      if (interrupted()) return;
      const LawRun run = run_law(find_case("scotch_yoke"), request, name,
                                 [](const Progress&) { return !interrupted(); });
      p.columns.push_back(run.summary.ok()
                              ? separations(flights_by_angle(choices, run), 120.0, 300.0)
                              : Separations{-1, 0.0});
    }
    progress.report(0, static_cast<double>(++done) / static_cast<double>(points.size()));
  });
}

/// How many points of the map satisfy a condition on the five columns.
int count_points(const std::vector<MapPoint>& points,
                 const std::function<bool(const std::vector<Separations>&)>& condition) {
  return static_cast<int>(
      std::ranges::count_if(points, [&](const MapPoint& p) { return condition(p.columns); }));
}

/// A point with K times 10 against the same with K as printed, column by column.
struct StiffnessEffect {
  int steadier = 0, equal = 0, looser = 0;
};

StiffnessEffect compare_stiffness(const std::vector<MapPoint>& points) {
  StiffnessEffect effect;
  for (const MapPoint& p : points) {
    if (p.times_10) continue;
    const auto stiff = std::ranges::find_if(points, [&](const MapPoint& q) {
      return q.times_10 && q.crank == p.crank && q.start == p.start && q.alpha == p.alpha;
    });
    for (std::size_t i = 0; i < p.columns.size(); ++i) {
      const double change = stiff->columns[i].share - p.columns[i].share;
      ++(change < 0.0 ? effect.steadier : change > 0.0 ? effect.looser : effect.equal);
    }
  }
  return effect;
}

void judge_map(Study& s, const std::vector<MapPoint>& points) {
  constexpr std::size_t lankarani = 0, radzimovsky = 1, johnson = 2, goldsmith = 3;
  const auto separates = [](const Separations& c) { return c.count != 0; };
  const int all =
      count_points(points, [&](const auto& c) { return std::ranges::all_of(c, separates); });
  const int none =
      count_points(points, [&](const auto& c) { return std::ranges::none_of(c, separates); });
  const int only_goldsmith = count_points(points, [&](const auto& c) {
    return separates(c[goldsmith]) && std::ranges::count_if(c, separates) == 1;
  });
  s.doc.verdict(
      "Only Goldsmith separates between 120 and 300 deg",
      only_goldsmith == 0 ? "Holds nowhere on the map" : "Holds at some points of the map",
      fmt::format("It is so at {} of {} points; at {} every column separates, at {} none.",
                  only_goldsmith, points.size(), all, none));
  const StiffnessEffect k = compare_stiffness(points);
  s.doc.verdict(
      "High K steadies the contact",
      k.steadier == 0 ? "Does not hold: the contrary" : "Holds at some points",
      fmt::format("K times 10 with all else equal: the share without contact is smaller in {} "
                  "pairs, larger in {}, equal in {} (mostly none at all).",
                  k.steadier, k.looser, k.equal));
  const int moving = static_cast<int>(points.size()) - none;
  const int steadier = count_points(points, [&](const auto& c) {
    return std::ranges::any_of(c, separates) && c[lankarani].share < c[johnson].share &&
           c[lankarani].share < c[radzimovsky].share;
  });
  s.doc.verdict(
      "A high exponent steadies the contact (conclusions of the paper)",
      2 * steadier > moving ? "Holds at most points" : "Does not hold at most points",
      fmt::format("Lankarani and Nikravesh (n = 1.5) is apart for a smaller share than Johnson "
                  "and Radzimovsky, of like stiffness, at {} of the {} points where anything "
                  "separates.",
                  steadier, moving));
}

}  // namespace

void print_map(Study& s) {
  s.doc.heading("Separations between 120 and 300 deg");
  auto points = map_points();
  calc_map(s, points);
  if (interrupted()) return;
  s.doc.print(
      "Number of separations that begin between 120 and 300 deg of the last revolution, and the "
      "share of these 180 deg without contact. alpha from Hunt and Crossley's lower value for "
      "steel to a hundred times their upper one.\n\n");
  Texts head{"crank", "slider_start", "K", "alpha"};
  for (const std::string& name : s.columns()) head.emplace_back(short_name(name));
  s.doc.head(head);
  for (const MapPoint& p : points) {
    Texts row{p.crank, p.start, p.times_10 ? "x 10" : "as printed", p.alpha};
    for (const Separations& c : p.columns)
      row.push_back(c.count < 0 ? "failed"
                    : c.count == 0 && c.share == 0.0
                        ? "-"
                        : fmt::format("{} ({:.0f} %)", c.count, 100.0 * c.share));
    s.doc.row(row);
  }
  judge_map(s, points);
}

}  // namespace yoke::cases
