// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// yoke reproduce figures: Figures 3, 6 and 10, from the laws themselves.
#include <fmt/format.h>

#include <cmath>

#include <yoke/cases/plot.hpp>
#include <yoke/cases/reproduce.hpp>
#include <yoke/contact/elastic_catalog.hpp>
#include <yoke/contact/lee_wang_2.hpp>
#include <yoke/contact/power_law.hpp>
#include <yoke/contact/tsuji.hpp>
#include <yoke/core/result.hpp>

namespace yoke::cases {

namespace {

constexpr double K = 1e8, m_r = 1.3, v_i = 0.37;  // of any impact: the curves do not depend on them

/// dF/dd' [N s/m] of a law, at penetration d.
double damper(const DissipativeLaw& law, const ElasticLaw& elastic, double d) {
  const ContactMemory memory{
      .phase = ContactPhase::compressing, .approach_velocity = v_i, .effective_mass = m_r};
  return law.evaluate({d, 0.1, memory}, elastic).dforce_drate;
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
  write_text(folder / "figure3.csv", transition_data());
  write_text(folder / "figure6.csv", tsuji_data());
  for (const Material& material : {steel, aluminium})
    write_text(folder / ("figure10-" + material.name + ".csv"), one_stiffness_data(material));
  return draw_figures({transition_figure(), tsuji_figure(), one_stiffness_figure()}, folder, 1);
}

}  // namespace yoke::cases
