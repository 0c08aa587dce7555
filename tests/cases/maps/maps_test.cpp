// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// yoke poincare, bifurcation and basins: what is typed, what is written, what is refused.
#include <doctest/doctest.h>

#include <filesystem>
#include <string>

#include <yoke/cases/jobs/progress.hpp>
#include <yoke/cases/maps/map_axis.hpp>
#include <yoke/cases/maps/maps.hpp>
#include <yoke/cases/maps/section_choice.hpp>
#include <yoke/tests/cases/program/program_run.hpp>
#include <yoke/tests/cases/sweep/sweep_rows.hpp>
#include <yoke/tests/files.hpp>
#include <yoke/tests/messages.hpp>

namespace {

using namespace yoke;
using namespace yoke::cases;
using namespace yoke::tests;

Section section_of(const char* case_name, const std::string& text) {
  const Case& c = find_case(case_name);
  return parse_section(text, c, Parameters(c.parameters));
}

std::string refusal(const std::string& text) {
  return message_of([&] { section_of("impact_oscillator", text); });
}

const std::string quick = " --rtol 1e-6 --discard 3 --points 6 --at every:frequency ";

TEST_SUITE("maps") {
  TEST_CASE("sections are what is typed") {
    CHECK(section_of("impact_oscillator", "every:0.1s").period == 0.1);
    CHECK(section_of("impact_oscillator", "every:frequency").period == 1.0 / 0.3);
    const Section later = section_of("impact_oscillator", "every:frequency+0.25");
    CHECK(later.offset == 0.25 / 0.3);
    const Section phase = section_of("slider_crank", "phase:motor=90deg:falling");
    CHECK(phase.kind == SectionKind::phase);
    CHECK(phase.element == "motor");
    CHECK(phase.value == doctest::Approx(0.5 * pi));
    CHECK(phase.crossing == Crossing::downwards);
    const Section event = section_of("table_ball", "event:top.release");
    CHECK(event.element == "top");
    CHECK(event.event_kind == "release");
    const Section plane = section_of("table_ball", "plane:ball.vy_m_per_s=-0.5");
    CHECK(plane.terms.front().column == "ball.vy_m_per_s");
    CHECK(plane.value == -0.5);
    CHECK(plane.crossing == Crossing::upwards);
  }

  TEST_CASE("sections that are none are refused with what is accepted") {
    for (const char* text : {"0.1s", "sometimes:1s", "event:stop", "plane:x", "every:"}) {
      CAPTURE(text);
      CHECK(contains(refusal(text), std::string("--at ") + text + ": "));
      CHECK(contains(refusal(text), "every:PARAMETER"));
    }
    CHECK(contains(refusal("every:10mm"), "accepted: s, ms, us"));
    CHECK(contains(refusal("every:gap"), "neither a time nor a frequency"));
    CHECK(contains(refusal("phase:motor=1"), "accepted: deg, rad"));
  }

  TEST_CASE("an axis is a parameter of the case or a coordinate at the start") {
    const Case& c = find_case("table_ball");
    const MapAxis parameter = parse_map_axis(c, "--grid", "height=1mm:3mm:3");
    CHECK(parameter.axis.values.size() == 3);
    CHECK(parameter.axis.values[1] == 0.002);
    CHECK(parameter.settings_at(1).front() == "height=2mm");
    const MapAxis start = parse_map_axis(c, "--grid", "ball.vy_m_per_s=-1:1:5");
    CHECK(start.column == "ball.vy_m_per_s");
    CHECK(start.axis.values[4] == 1.0);
    CHECK(start.settings_at(1).empty());
    const auto message = [&](const char* text) {
      return message_of([&] { parse_map_axis(c, "--grid", text); });
    };
    CHECK(contains(message("heigth=1mm:3mm:3"), "--grid"));
    CHECK(contains(message("ball.y_m=1:2"), "BODY.COLUMN=LOW:HIGH:N"));
    const Model m = make_model(c, Parameters(c.parameters));
    State at = m.start_state();
    set_start(m, at, "ball.vy_m_per_s", -0.25);
    CHECK(at.v[4] == -0.25);
    CHECK(contains(message_of([&] { set_start(m, at, "ball.up", 1.0); }), "ball.up"));
  }

  TEST_CASE("yoke poincare writes its points, a picture and says their period") {
    const TemporaryFolder scratch;
    const auto run =
        run_yoke(scratch, "poincare impact_oscillator --set force=0.2" + quick +
                              "--set start=-80mm --columns mass.x_m,mass.vx_m_per_s -o out");
    CHECK(run.code == 0);
    CHECK(contains(run.out, "6 points at every 3.33333 s (3 before left out)"));
    CHECK(check_rows(scratch / "out/poincare.csv") == 6);
    CHECK(lines(scratch / "out/poincare.csv").front() == "t_s,mass.x_m,mass.vx_m_per_s");
    CHECK(std::filesystem::exists(scratch / "out/plots/poincare.png"));
    CHECK(std::filesystem::exists(scratch / "out/summary.json"));
  }

  TEST_CASE("at events the picture may show their speed") {
    const TemporaryFolder scratch;
    const auto run =
        run_yoke(scratch,
                 "poincare table_ball --rtol 1e-6 --discard 2 --points 4 --at event:top.onset "
                 "--columns ball.vy_m_per_s --x t_s --y speed_m_per_s -o out");
    INFO(run.out);
    CHECK(run.code == 0);
    CHECK(lines(scratch / "out/poincare.csv").front() ==
          "t_s,ball.vy_m_per_s,speed_m_per_s,penetration_m");
  }

  TEST_CASE("yoke bifurcation writes both directions, and what became of each value") {
    const TemporaryFolder scratch;
    const std::string command =
        "bifurcation impact_oscillator --vary force=0.2:0.3:3 --both --y mass.x_m -o out" + quick;
    const auto run = run_yoke(scratch, command);
    INFO(run.out);
    CHECK(run.code == 0);
    CHECK(check_rows(scratch / "out/bifurcation.csv") == 36);
    CHECK(rows_of_sweep(scratch / "out/periods.csv") == 6);
    CHECK(lines(scratch / "out/bifurcation.csv").front().starts_with("value,direction,point,t_s,"));
    CHECK(std::filesystem::exists(scratch / "out/plots/bifurcation.png"));
    const std::string first = content(scratch / "out/bifurcation.csv");
    CHECK(run_yoke(scratch, command + "--jobs 1 --no-plots").code == 0);
    CHECK(content(scratch / "out/bifurcation.csv") == first);
  }

  TEST_CASE("yoke basins writes attractors and goes on in its folder") {
    const TemporaryFolder scratch;
    const std::string command =
        "basins impact_oscillator --set force=0.2 --set damping=0.5 --grid start=-100mm:50mm:3 "
        "--grid mass.vx_m_per_s=0:0.1:2 -o out --rtol 1e-6 --points 6 --at every:frequency ";
    const auto run = run_yoke(scratch, command + "--discard 12");
    INFO(run.out);
    CHECK(run.code == 0);
    CHECK(check_rows(scratch / "out/basins.csv") == 6);
    CHECK(check_rows(scratch / "out/attractors.csv") == 1);  // below grazing there is one
    CHECK(contains(run.out, "attractor 1   100.0 % of starts"));
    CHECK(std::filesystem::exists(scratch / "out/plots/basins.png"));
    CHECK(contains(run_yoke(scratch, command + "--discard 12").out, "6 done (6 from before)"));
    const auto other = run_yoke(scratch, command + "--discard 13");
    CHECK(other.code == 1);
  }

  TEST_CASE("interrupted, maps write what there is and say so") {
    const TemporaryFolder scratch;
    const MapRequest map{.at = "every:frequency",
                         .relative_tolerance = 1e-6,
                         .output = scratch.path(),
                         .jobs = 1,
                         .plots = false,
                         .quiet = true};
    const Case& c = find_case("impact_oscillator");
    set_interrupted(true);
    CHECK(run_poincare(c, map) == RunStatus::interrupted);
    CHECK(run_bifurcation(c, {.map = map, .vary = "force=0.2:0.3:3"}) == RunStatus::interrupted);
    CHECK(run_basins(c, {.map = map, .grid = {"start=-2mm:2mm:2", "mass.vx_m_per_s=0:1:2"}}) ==
          RunStatus::interrupted);
    set_interrupted(false);
    CHECK(lines(scratch / "poincare.csv").size() <= 2);
    CHECK(lines(scratch / "bifurcation.csv").front().starts_with("value,direction,point"));
    CHECK(lines(scratch / "basins.csv").size() == 1);
  }

  TEST_CASE("maps name what is wrong before they begin") {
    const TemporaryFolder scratch;
    const auto refused = [&](const std::string& arguments, const char* part) {
      const auto run = run_yoke(scratch, arguments);
      CHECK(run.code == 1);
      CHECK_MESSAGE(contains(run.out, part), run.out);
    };
    refused("poincare impact_oscillator", "--at: which section?");
    refused("poincare table_ball --at event:floor.onset", "no element 'floor' has events");
    refused("poincare impact_oscillator --at every:1s --points 0", "--points 0: accepted are 1 to");
    refused("bifurcation impact_oscillator --at every:1s", "--vary: which parameter?");
    refused("bifurcation impact_oscillator --at every:1s --vary forze=1:2:3", "forze");
    refused("basins impact_oscillator --at every:1s --grid start=0mm:1mm:2", "--grid: 1 axes");
    refused("poincare impact_oscillator --at every:1s --rtol 1",
            "--rtol 1: accepted is 1e-13 to 1e-2");
  }
}

}  // namespace
