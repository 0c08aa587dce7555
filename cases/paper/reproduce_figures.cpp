// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// yoke reproduce figures: Figures 2, 5, 7 and 15 from impacts through the engine, Figures 3, 6 and
// 10 from the laws themselves.
#include <fmt/format.h>

#include <cmath>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include <yoke/cases/jobs/impact.hpp>
#include <yoke/cases/jobs/plot.hpp>
#include <yoke/cases/paper/reproduce.hpp>
#include <yoke/contact/laws/catalog/dissipative_catalog.hpp>
#include <yoke/contact/laws/catalog/elastic_catalog.hpp>
#include <yoke/contact/laws/dissipative/lee_wang_2.hpp>
#include <yoke/contact/laws/dissipative/tsuji.hpp>
#include <yoke/contact/laws/elastic/power_law.hpp>
#include <yoke/core/result.hpp>

namespace yoke::cases {

namespace {

constexpr double K = 1e8, m_r = 1.3, v_i = 0.37;  // one impact for all
constexpr int loop_samples = 801;
constexpr const char* hertzian = "power:K=1e8,n=1.5";

/// A curve of a figure: an impact sampled from touch to release, in a file of its own.
struct Curve {
  std::string file, elastic, dissipation;
  DissipativeArguments arguments{};
  double speed = v_i, mass = m_r;
};

void write_curve(const std::filesystem::path& folder, const Curve& curve) {
  const ImpactOutcome x =
      simulate_impact({.law = {make_elastic(curve.elastic, {}),
                               make_dissipative(curve.dissipation, curve.arguments)},
                       .speed = curve.speed,
                       .mass = curve.mass,
                       .samples = loop_samples});
  write_text(folder / curve.file, loop_csv(x.loop));
}

/// dF/dd' [N s/m] of a law, at penetration d.
double damper(const DissipativeLaw& law, const ElasticLaw& elastic, double d) {
  const ContactMemory memory{
      .phase = ContactPhase::compressing, .approach_velocity = v_i, .effective_mass = m_r};
  return law.evaluate({d, 0.1, memory}, elastic).dforce_drate;
}

// ---- Figure 2: Hunt and Crossley's loop, its area the energy lost

std::vector<Curve> loop_curves() {
  std::vector<Curve> curves;
  for (const double e : {0.9, 0.7, 0.5})
    curves.push_back(
        {fmt::format("figure2-{:g}.csv", e), hertzian, "hunt-crossley", {.restitution = e}});
  return curves;
}

Figure loop_figure() {
  return {
      .name = "figure2",
      .title = "Hysteresis loop of Hunt and Crossley (Figure 2 of the paper)",
      .width = 900,
      .height = 600,
      .body =
          R"(  set title 'Hunt and Crossley: force over penetration; the area is the energy lost'
  set xlabel 'penetration [µm]'; set ylabel 'force [N]'; set xrange [0:*]; set yrange [0:*]; set key inside left top
  plot 1e8*(x*1e-6)**1.5 title 'K d^{1.5} alone' with lines lw 1 dt 2 lc rgb '#808080', \
       'figure2-0.9.csv' every ::1 using ($2*1e6):4 title 'e = 0.9' with lines lw 2 lc rgb '#0072b2', \
       'figure2-0.7.csv' every ::1 using ($2*1e6):4 title 'e = 0.7' with lines lw 2 lc rgb '#009e73', \
       'figure2-0.5.csv' every ::1 using ($2*1e6):4 title 'e = 0.5' with lines lw 2 lc rgb '#d55e00')"};
}

// ---- Figure 5: penetration over time, compression and restitution

std::vector<Curve> indentation_curves() {
  return {
      {"figure5-none.csv", hertzian, "none"},
      {"figure5-lankarani-nikravesh.csv", hertzian, "lankarani-nikravesh", {.restitution = 0.7}}};
}

Figure indentation_figure() {
  return {.name = "figure5",
          .title = "Penetration over time (Figure 5 of the paper)",
          .width = 900,
          .height = 560,
          .body = R"(  set title 'Penetration over time: K d^{1.5}'
  set xlabel 'time since the touch [ms]'; set ylabel 'penetration [µm]'; set yrange [0:400]; set xrange [0:3.2]; set key at graph 0.43,0.3 left top
  stats 'figure5-none.csv' every ::1 using 1:2 nooutput name 'N'
  stats 'figure5-lankarani-nikravesh.csv' every ::1 using 1:2 nooutput name 'L'
  set arrow 1 from (L_pos_max_y-L_min_x)*1e3,0 to (L_pos_max_y-L_min_x)*1e3,L_max_y*1e6 nohead dt 3 lc rgb '#404040'
  set label 1 't^{(m)}' at (L_pos_max_y-L_min_x)*1e3+0.03,20
  set label 2 'compression' at 0.55,375 center
  set label 3 'restitution' at 2.0,375 center
  plot 'figure5-none.csv' every ::1 using (($1-N_min_x)*1e3):($2*1e6) title 'elastic' with lines lw 2 dt 2 lc rgb '#0072b2', \
       'figure5-lankarani-nikravesh.csv' every ::1 using (($1-L_min_x)*1e3):($2*1e6) title 'lankarani-nikravesh, e = 0.7' with lines lw 2 lc rgb '#d55e00'
  unset arrow; unset label)"};
}

// ---- Figure 7: permanent indentation

std::vector<Curve> permanent_curves() {
  return {{"figure7.csv", hertzian, "lankarani-nikravesh-1994", {.restitution = 0.7}}};
}

Figure permanent_figure() {
  return {.name = "figure7",
          .title = "Permanent indentation (Figure 7 of the paper)",
          .width = 1300,
          .height = 460,
          .body = R"(  stats 'figure7.csv' every ::1 using 1:2 nooutput name 'P'
  set multiplot layout 1,3 title 'Permanent indentation (lankarani-nikravesh-1994, e = 0.7)'
  set key off
  set xlabel 'time since the touch [ms]'; set ylabel 'force [N]'; set title '(a)'; set yrange [0:*]
  plot 'figure7.csv' every ::1 using (($1-P_min_x)*1e3):4 with lines lw 2 lc rgb '#0072b2'
  set ylabel 'penetration [µm]'; set title '(b)'
  set arrow 1 from graph 0,first P_max_y*0.51e6 to graph 1,first P_max_y*0.51e6 nohead dt 3 lc rgb '#404040'
  set label 1 'd_p = d_m (1 - e^2)' at graph 0.3,first P_max_y*0.55e6
  plot 'figure7.csv' every ::1 using (($1-P_min_x)*1e3):($2*1e6) with lines lw 2 lc rgb '#0072b2'
  unset arrow; unset label
  set xlabel 'penetration [µm]'; set ylabel 'force [N]'; set title 'loop'
  plot 'figure7.csv' every ::1 using ($2*1e6):4 with lines lw 2 lc rgb '#0072b2'
  unset multiplot)"};
}

// ---- Figure 15: loops of the elastic laws of Table 11, outer wall, as printed

constexpr double landing_speed = 0.19, slider_mass = 2.353;  // [m/s], [kg] of the scotch-yoke

std::vector<Curve> wall_curves() {
  std::vector<Curve> curves;
  for (const auto& [name, elastic] : std::initializer_list<std::pair<const char*, const char*>>{
           {"lankarani-nikravesh", "power:K=1.424e5,n=1.5,unit=mm"},
           {"radzimovsky", "power:K=4.315e4,n=1.09,unit=mm"},
           {"johnson", "power:K=4.907e4,n=1.10,unit=mm"},
           {"goldsmith", "power:K=1.743e4,n=1.04,unit=mm"},
           {"esdu-78035", "power:K=1.254e4,n=1.09,unit=mm"}})
    curves.push_back({fmt::format("figure15-{}.csv", name),
                      elastic,
                      "hunt-crossley",
                      {.alpha = 0.32},
                      landing_speed,
                      slider_mass});
  return curves;
}

Figure wall_figure() {
  const char* colors[] = {"#cc79a7", "#009e73", "#0072b2", "#d55e00", "#e69f00"};
  std::string body =
      "  set title 'Impact at 0.19 m/s with the constants of Table 11 (outer wall, K as total "
      "force), Hunt and Crossley, α = 0.32 s/m'\n  set xlabel 'penetration [µm]'; set ylabel "
      "'force [N]'; set xrange [0:*]; set yrange [0:*]; set key inside right top\n  plot ";
  int i = 0;
  for (const Curve& curve : wall_curves()) {
    const std::string name = curve.file.substr(9, curve.file.size() - 13);
    body += fmt::format("{}'{}' every ::1 using ($2*1e6):4 title '{}' with lines lw 2 lc rgb '{}'",
                        i == 0 ? "" : ", ", curve.file, name, colors[i]);
    ++i;
  }
  return {.name = "figure15",
          .title = "Hysteresis of the elastic laws of Table 11 (Figure 15 of the paper)",
          .width = 1000,
          .height = 620,
          .body = body};
}

// ---- the loops of all dissipative laws, in one picture

constexpr double loop_restitution = 0.7;

std::string elastic_for(const DissipativeNote& note) {
  if (!note.linear_only) return hertzian;
  // K d with the same largest penetration without damping.
  const double depth = std::pow(1.25 * m_r * v_i * v_i / K, 0.4);
  return fmt::format("power:K={:.17g},n=1", m_r * v_i * v_i / (depth * depth));
}

std::vector<Curve> hysteresis_curves() {
  std::vector<Curve> curves;
  for (const DissipativeNote& note : dissipative_catalog())
    if (note.name != "none")
      curves.push_back({fmt::format("hysteresis-{}.csv", note.name),
                        elastic_for(note),
                        note.name,
                        {.restitution = loop_restitution}});
  return curves;
}

Figure hysteresis_figure() {
  std::string body =
      "  set multiplot layout 5,4 title 'Force [N] over penetration [µm]: every dissipative law, "
      "e = 0.7 asked; dashed: the elastic law'\n  set key off; set xrange [0:360]; set yrange "
      "[-100:800]; set xtics 100; set ytics 200\n";
  for (const Curve& curve : hysteresis_curves()) {
    const std::string elastic =
        curve.elastic == hertzian
            ? "1e8*(x*1e-6)**1.5"
            : curve.elastic.substr(8, curve.elastic.find(',') - 8) + "*x*1e-6";
    body += fmt::format(
        "  set title '{}' offset 0,-0.8\n  plot {} with lines lw 1 dt 2 lc rgb '#808080', '{}' "
        "every ::1 using ($2*1e6):4 with lines lw 2 lc rgb '#0072b2'\n",
        curve.dissipation, elastic, curve.file);
  }
  return {.name = "hysteresis",
          .title = "Hysteresis of every dissipative law",
          .width = 1300,
          .height = 1300,
          .body = body + "  unset multiplot"};
}

// ---- Figure 3: Lee and Wang's transition function, the damper over its final value

std::string transition_data() {
  const ElasticLaw elastic = PowerLaw{K, 1.0, "linear"};
  const double share = 0.1, epsilon = share * v_i * std::sqrt(m_r / K);
  std::string text = "x,q2,q3,q4\n";
  for (int i = 1; i <= 300; ++i) {
    const double x = 0.005 * i;
    text += fmt::format("{:g}", x);
    for (const double q : {2.0, 3.0, 4.0}) {
      const DissipativeLaw law = LeeWang2{.e = 0.5, .q = q, .epsilon = share};
      text += fmt::format(",{:.8g}",
                          damper(law, elastic, x * epsilon) / damper(law, elastic, 10.0 * epsilon));
    }
    text += "\n";
  }
  return text;
}

Figure transition_figure() {
  return {.name = "figure3",
          .title = "Transition function of Lee and Wang (Figure 3 of the paper)",
          .width = 900,
          .height = 560,
          .body = R"(  set title 'Transition function of Lee and Wang'
  set xlabel 'penetration / ε'; set ylabel 'T_2'; set yrange [0:1.1]; set xrange [0:1.5]
  plot 'figure3.csv' every ::1 using 1:2 title 'q = 2' with lines lw 2 lc rgb '#0072b2', \
       '' every ::1 using 1:3 title 'q = 3' with lines lw 2 lc rgb '#009e73', \
       '' every ::1 using 1:4 title 'q = 4' with lines lw 2 lc rgb '#d55e00')"};
}

// ---- Figure 6: Tsuji's coefficient

std::string tsuji_data() {
  const ElasticLaw elastic = PowerLaw{K, 1.5, "hertzian"};
  const double d = 1e-5;
  std::string text = "e,chi\n";
  for (int i = 0; i <= 400; ++i) {
    const double e = i == 0 ? least_restitution : 0.0025 * i;
    text +=
        fmt::format("{:g},{:.8g}\n", e,
                    damper(Tsuji{.e = e}, elastic, d) / (std::sqrt(m_r * K) * std::pow(d, 0.25)));
  }
  return text;
}

Figure tsuji_figure() {
  return {.name = "figure6",
          .title = "Tsuji's coefficient against the restitution (Figure 6 of the paper)",
          .width = 900,
          .height = 560,
          .body = R"(  set title "Tsuji's coefficient"
  set xlabel 'coefficient of restitution e'; set ylabel 'χ'; set xrange [0:1]; set yrange [0:*]; set key inside right top
  plot 'figure6.csv' every ::1 using 1:2 title '-√5 ln e/√(ln² e + π²)' with lines lw 2 lc rgb '#0072b2')"};
}

// ---- Figure 10: the stiffness of one wall used for both

constexpr double differences[] = {5.0, 10.0, 30.0, 60.0};  // [mm] DR of the convex wall

/// Johnson's penetration [m] at 10 kN/mm.
double penetration(const Material& material, double DR) {
  return make_elastic("johnson", {.pin = material,
                                  .wall = material,
                                  .pin_radius = 1e-3,
                                  .wall_radius = 1e-3 * (1.0 + DR),
                                  .length = 1e-3})
      .penetration_at(1e4);
}

std::string one_stiffness_data(const Material& material) {
  std::string text = "clearance_mm,DR5,DR10,DR30,DR60\n";
  for (int i = 0; i <= 100; ++i) {
    const double clearance = 0.01 * i;
    text += fmt::format("{:g}", clearance);
    for (const double DR : differences)
      text += fmt::format(
          ",{:.8g}",
          100.0 * (penetration(material, DR + clearance) / penetration(material, DR) - 1.0));
    text += "\n";
  }
  return text;
}

Figure one_stiffness_figure() {
  std::string body =
      R"(  set multiplot layout 1,2 title "One stiffness for both walls: Johnson's law at 10 kN/mm, ΔR of the inner wall, plus the clearance for the outer"
  set xlabel 'clearance [mm]'; set xrange [0:1]; set yrange [0:4.5]; set key inside left top
)";
  const char* colors[] = {"#d55e00", "#e69f00", "#009e73", "#0072b2"};
  for (const char* material : {"steel", "aluminium"}) {
    body += fmt::format(
        "  set title '{}'\n  set ylabel 'penetration outside over inside, less 1 [%]'\n  plot ",
        material);
    for (int i = 0; i < 4; ++i)
      body += fmt::format(
          "{}'figure10-{}.csv' every ::1 using 1:{} title 'ΔR = {:g} mm' with lines lw 2 lc rgb "
          "'{}'",
          i == 0 ? "" : ", ", material, i + 2, differences[i], colors[i]);
    body += "\n";
  }
  return {.name = "figure10",
          .title = "Error of one stiffness for both walls (Figure 10 of the paper)",
          .width = 1300,
          .height = 600,
          .body = body + "  unset multiplot"};
}

}  // namespace

std::string write_figures(const std::filesystem::path& folder) {
  make_output_folder(folder);
  for (const std::vector<Curve>& curves : {loop_curves(), indentation_curves(), permanent_curves(),
                                           wall_curves(), hysteresis_curves()})
    for (const Curve& curve : curves) write_curve(folder, curve);
  const auto write = [&](const std::string& name, std::string text) {
    text.pop_back();  // write_text ends the last line
    write_text(folder / name, text);
  };
  write("figure3.csv", transition_data());
  write("figure6.csv", tsuji_data());
  for (const Material& material : {steel, aluminium})
    write("figure10-" + material.name + ".csv", one_stiffness_data(material));
  return draw_figures(
      {loop_figure(), transition_figure(), indentation_figure(), tsuji_figure(), permanent_figure(),
       one_stiffness_figure(), wall_figure(), hysteresis_figure()},
      folder, 1);
}

}  // namespace yoke::cases
