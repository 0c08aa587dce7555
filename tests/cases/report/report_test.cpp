// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What a report holds: rows, contacts, text that cannot become anything else.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include <yoke/cases/report/base64.hpp>
#include <yoke/cases/report/page.hpp>
#include <yoke/cases/report/page_text.hpp>
#include <yoke/cases/report/replay.hpp>
#include <yoke/cases/report/thinning.hpp>
#include <yoke/cases/results/contact_spans.hpp>
#include <yoke/joints/forces/applied_force.hpp>
#include <yoke/joints/gear.hpp>
#include <yoke/joints/revolute.hpp>
#include <yoke/tests/files.hpp>
#include <yoke/tests/messages.hpp>

namespace {

using namespace yoke;
using namespace yoke::cases;
using yoke::tests::contains;

/// A long smooth motion with a peak three rows wide.
Table long_run(std::size_t rows, std::size_t peak) {
  Table table;
  table.add_column("t", "s");
  table.add_column("body.x", "m");
  table.add_column("stop.penetration", "m");
  table.add_column("stop.normal_force", "N");
  table.reserve(rows);
  for (std::size_t i = 0; i < rows; ++i) {
    const double t = 1e-6 * static_cast<double>(i);
    const double near = std::abs(static_cast<double>(i) - static_cast<double>(peak));
    double* row = table.append();
    row[0] = t;
    row[1] = std::sin(200.0 * t);
    row[2] = near < 2.0 ? 1e-6 * (2.0 - near) : -1e-3;
    row[3] = near < 2.0 ? 500.0 * (2.0 - near) : 0.0;
  }
  return table;
}

std::vector<EventRecord> one_impact(std::size_t peak) {
  const double t = 1e-6 * static_cast<double>(peak);
  return {{.t = t - 1.9e-6, .element = "stop", .kind = "onset", .region = "wall", .speed = 2.0},
          {.t = t + 1.9e-6, .element = "stop", .kind = "release", .region = "wall", .speed = -0.5}};
}

Case named(const std::string& name) {
  return {.name = name, .description = "</script><b>", .parameters = {}};
}

/// Draws every kind of shape in every role.
class Everything : public ForceElement {
 public:
  explicit Everything(BodyId b) : ForceElement("everything", {b}), b_(b) {}
  void evaluate(const ForceInput&, const ForceRequest&) const override {}
  void draw(Drawing& d) const override {
    const Vec2 o(0.0, 0.0), x(1.0, 0.0);
    d.pin(ground, o, b_, o);
    d.weld(ground, o, b_, o);
    d.line(ground, o, x);
    d.block(b_, o, x);
    d.point(b_, o);
    d.curve(b_, {o, x}, false);
    d.rod(ground, o, b_, o);
    d.spring(ground, x, b_, o);
    d.disc(b_, o, 1.0);
    d.wall(b_, {o, x}, false);
    d.endless_wall(b_, o, x);
    for (const ShapeRole role : {ShapeRole::joint, ShapeRole::spring, ShapeRole::driver,
                                 ShapeRole::load, ShapeRole::contact}) {
      d.turn(ground, b_, role);
      d.arrow(b_, o, ground, x, role);
    }
  }

 private:
  BodyId b_;
};

TEST_SUITE("report") {
  TEST_CASE("base64 as in RFC 4648") {
    const auto text = [](const char* s) { return base64(s, std::strlen(s)); };
    CHECK(text("") == "");
    CHECK(text("f") == "Zg==");
    CHECK(text("fo") == "Zm8=");
    CHECK(text("foo") == "Zm9v");
    CHECK(text("foobar") == "Zm9vYmFy");
  }

  TEST_CASE("a contact from onset to release, its peak from the rows, its restitution") {
    const Table table = long_run(1000, 500);
    std::vector<EventRecord> events = one_impact(500);
    events.push_back(
        {.t = 9e-4, .element = "stop", .kind = "onset", .region = "wall", .speed = 1.0});
    const std::vector<ContactSpan> impacts = contact_spans(table, events);
    REQUIRE(impacts.size() == 2);
    CHECK(impacts[0].peak_force == 1000.0);
    CHECK(impacts[0].deepest == doctest::Approx(2e-6));
    CHECK(impacts[0].peak == 500);
    CHECK(impacts[0].restitution == doctest::Approx(0.25));
    CHECK(impacts[1].release == doctest::Approx(999e-6));  // lasts
    CHECK(std::isnan(impacts[1].restitution));
  }

  TEST_CASE("of a million rows few are kept, and no extreme or impact is lost") {
    const std::size_t rows = 1000000, peak = 654321;
    const Table table = long_run(rows, peak);
    const std::vector<ContactSpan> impacts = contact_spans(table, one_impact(peak));
    const std::vector<std::size_t> kept = thinned_rows(table, impacts, 3000);
    CHECK(kept.size() <= 3000);
    CHECK(kept.size() > 1000);
    CHECK(std::ranges::is_sorted(kept));
    CHECK(kept.front() == 0);
    CHECK(kept.back() == rows - 1);
    const auto has = [&](std::size_t row) { return std::ranges::binary_search(kept, row); };
    CHECK(has(peak));
    CHECK(has(peak - 1));
    CHECK(has(peak + 1));
    for (std::size_t j = 0; j < table.names().size(); ++j) {
      double least = INFINITY, most = -INFINITY, kept_least = INFINITY, kept_most = -INFINITY;
      for (std::size_t i = 0; i < rows; ++i) {
        least = std::min(least, table.value(i, j));
        most = std::max(most, table.value(i, j));
      }
      for (const std::size_t i : kept) {
        kept_least = std::min(kept_least, table.value(i, j));
        kept_most = std::max(kept_most, table.value(i, j));
      }
      CHECK(kept_least == least);
      CHECK(kept_most == most);
    }
    CHECK(thinned_rows(long_run(100, 50), {}, 3000).size() == 100);
  }

  TEST_CASE("the replay of a run: drawing, columns with units, loads, contacts") {
    Model m;
    const BodyId rod =
        m.add({.name = "rod", .mass = 1.0, .inertia = 1.0, .pose = {{1.0, 0.0}, 0.0}});
    m.add(Revolute{.name = "pivot", .a = ground, .b = rod, .at = {0.0, 0.0}});
    m.add(AppliedForce{.name = "push", .body = rod, .at = {2.0, 0.0}, .force = [](double t) {
                         return Vec2(0.0, 3.0 + t);
                       }});
    Table table;
    table.add_column("t", "s");
    for (const auto& [name, unit] : {std::pair{"rod.x", "m"},
                                     {"rod.y", "m"},
                                     {"rod.angle", "rad"},
                                     {"rod.vx", "m/s"},
                                     {"rod.vy", "m/s"},
                                     {"rod.omega", "rad/s"}})
      table.add_column(name, unit);
    for (const double t : {0.0, 1.0}) {
      double* row = table.append();
      row[0] = t;
      row[1] = 1.0;
      row[3] = 0.5 * t;
    }
    const Case c = named("<script>");
    const Parameters none({});
    const std::vector<EventRecord> events;
    const Summary summary;
    const nlohmann::json json = nlohmann::json::parse(to_json(Replay{.c = c,
                                                                     .parameters = none,
                                                                     .command = "yoke run x",
                                                                     .model = m,
                                                                     .samples = table,
                                                                     .events = events,
                                                                     .summary = summary}));
    CHECK(json["case"] == "<script>");
    CHECK(json["command"] == "yoke run x");
    CHECK(json["rows"] == 2);
    CHECK(json["drawing"]["bodies"][1]["name"] == "rod");
    CHECK(json["drawing"]["shapes"][0]["kind"] == "pin");
    const auto column = [&](const std::string& name) {
      for (const auto& found : json["columns"])
        if (found["name"] == name) return found;
      FAIL("no column " << name);
      return nlohmann::json();
    };
    CHECK(column("rod.vx")["unit"] == "m/s");
    CHECK(column("rod.x")["constant"] == 1.0);
    const double angles[] = {0.0, 0.5};
    CHECK(column("rod.angle")["f8"] == base64(angles, sizeof angles));
    const float loads[] = {3.0f, 4.0f};
    CHECK(column("push.fy")["f4"] == base64(loads, sizeof loads));
    CHECK(column("push.fx")["constant"] == 0.0);
    CHECK(column("push.moment")["unit"] == "N m");
  }

  TEST_CASE("every shape has a function of the page that draws it, every role a colour") {
    Model m;
    const BodyId body = m.add({.name = "body", .mass = 1.0, .inertia = 1.0});
    const BodyId other =
        m.add({.name = "other", .mass = 1.0, .inertia = 1.0, .pose = {{1.0, 0.0}, 0.0}});
    m.add(Revolute{.name = "pivot", .a = ground, .b = body, .at = {0.0, 0.0}});
    m.add(Revolute{.name = "axis", .a = ground, .b = other, .at = {1.0, 0.0}});
    m.add(Gear{.name = "gear", .a = body, .b = other, .ratio = -1.0});
    m.add(Gear{.name = "belt", .a = body, .b = other, .ratio = 1.0});
    m.insert(std::make_unique<Everything>(body));
    const Case c = named("x");
    const Parameters none({});
    const std::vector<EventRecord> events;
    const Summary summary;
    const Table table;
    const nlohmann::json json = nlohmann::json::parse(to_json(Replay{.c = c,
                                                                     .parameters = none,
                                                                     .command = "",
                                                                     .model = m,
                                                                     .samples = table,
                                                                     .events = events,
                                                                     .summary = summary}));
    const std::string page = yoke::tests::source("cases/report/page/mechanism.js");
    std::set<std::string> kinds, roles;
    for (const auto& shape : json["drawing"]["shapes"]) {
      kinds.insert(shape["kind"]);
      roles.insert(shape["role"]);
    }
    for (const std::string& kind : kinds)
      CHECK_MESSAGE(contains(page, "\n  " + kind + "(s) {"), kind);
    const std::string colors = page.substr(page.find("const roleColor"), 200);
    for (const std::string& role : roles) CHECK_MESSAGE(contains(colors, role + ": "), role);
    CHECK(kinds.size() == 14);
    CHECK(roles.size() == 5);
  }

  TEST_CASE("names are text: nothing in them ends the data or begins an element") {
    const yoke::tests::TemporaryFolder scratch;
    const std::string title = "<script>alert(1)</script>{{data}}";
    const std::string replay = R"({"case":"</script><script>alert(2)</script>{{script}}"})";
    write_page(scratch / "report.html", title, PageKind::report, {replay});
    const std::string page = yoke::tests::content(scratch / "report.html");
    CHECK(!contains(page, "<script>alert"));
    CHECK(!contains(page, "</script><script>"));
    CHECK(contains(page, "&lt;script&gt;alert(1)&lt;/script&gt;{{data}}"));
    CHECK(contains(page,
                   R"({"case":"\u003c/script>\u003cscript>alert(2)\u003c/script>{{script}}"})"));
    // One policy, that names the script and the style by their hashes, and no address.
    CHECK(contains(page, "content=\"default-src 'none'; script-src 'sha256-"));
    CHECK(!contains(page, "unsafe"));
    CHECK(!contains(page, "src=\"http"));
    CHECK(!contains(page, "@import"));
  }

  TEST_CASE("the page holds uPlot as it was published") {
    // cases/report/uplot/SHA256SUMS is checked by CMake, which alone can compute the sums.
    const std::string script = page_text::script();
    CHECK(script.starts_with("/*! https://github.com/leeoniya/uPlot (v1.6.32) */"));
    CHECK(contains(yoke::tests::source("cases/report/uplot/LICENSE"), "MIT License"));
    for (const char* module : {"format", "data", "motion", "camera", "mechanism", "lens", "plots",
                               "xyplots", "tables", "controls", "main"})
      CHECK(contains(script,
                     yoke::tests::source(std::string("cases/report/page/") + module + ".js")));
  }
}

}  // namespace
