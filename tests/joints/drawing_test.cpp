// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Every joint, driver and force of the folder is seen, where it is.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include <yoke/core/curves/lines_and_arcs.hpp>
#include <yoke/core/drawing/drawing.hpp>
#include <yoke/joints/distance.hpp>
#include <yoke/joints/drivers/angle_driver.hpp>
#include <yoke/joints/drivers/displacement_driver.hpp>
#include <yoke/joints/forces/applied_force.hpp>
#include <yoke/joints/forces/applied_torque.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/forces/torsional_spring.hpp>
#include <yoke/joints/forces/translational_spring.hpp>
#include <yoke/joints/gear.hpp>
#include <yoke/joints/point_on_curve.hpp>
#include <yoke/joints/point_on_line.hpp>
#include <yoke/joints/prismatic.hpp>
#include <yoke/joints/revolute.hpp>
#include <yoke/joints/weld.hpp>
#include <yoke/tests/files.hpp>

using namespace yoke;

namespace {

struct Pair {
  Model model;
  BodyId a = model.add({.name = "a", .mass = 1.0, .inertia = 1.0, .pose = {{1.0, 2.0}, 0.7}});
  BodyId b = model.add({.name = "b", .mass = 2.0, .inertia = 0.1, .pose = {{-3.0, 0.5}, -1.2}});

  /// A point of a body, in its axes, back in the start pose.
  Vec2 global(BodyId id, const Vec2& p) const {
    const Pose& pose = model.body(id).pose;
    return pose.position + rotate(pose.angle, p);
  }
};

const Shape* find(const Drawing& drawing, ShapeKind kind) {
  const auto found = std::ranges::find(drawing.shapes(), kind, &Shape::kind);
  return found == drawing.shapes().end() ? nullptr : &*found;
}

void check_point(const Vec2& p, const Vec2& expected) { CHECK((p - expected).norm() < 1e-12); }

template <class Description>
Drawing drawn(Pair& t, const Description& description) {
  t.model.add(description);
  Drawing drawing = draw(t.model);
  CHECK(!drawing.shapes().empty());
  for (const Shape& s : drawing.shapes()) CHECK(s.element == description.name);
  return drawing;
}

const Vec2 p(0.4, -0.3), r(2.5, 1.5);

}  // namespace

TEST_CASE("joints of two points are drawn at both") {
  for (const ShapeKind kind :
       {ShapeKind::pin, ShapeKind::weld, ShapeKind::rod, ShapeKind::spring}) {
    Pair t;
    Drawing drawing;
    if (kind == ShapeKind::pin)
      drawing = drawn(t, Revolute{.name = "x", .a = t.a, .b = t.b, .at = p});
    else if (kind == ShapeKind::weld)
      drawing = drawn(t, Weld{.name = "x", .a = t.a, .b = t.b, .at = p});
    else if (kind == ShapeKind::rod)
      drawing = drawn(t, Distance{.name = "x", .a = t.a, .b = t.b, .at_a = p, .at_b = r});
    else
      drawing =
          drawn(t, TranslationalSpring{.name = "x", .a = t.a, .b = t.b, .at_a = p, .at_b = r});
    const Shape* shape = find(drawing, kind);
    REQUIRE(shape != nullptr);
    REQUIRE(shape->points.size() == 2);
    const bool one = kind == ShapeKind::pin || kind == ShapeKind::weld;
    check_point(t.global(shape->body, shape->points[0]), p);
    check_point(t.global(shape->other, shape->points[1]), one ? p : r);
  }
}

TEST_CASE("guides are drawn along their direction, what slides on its point") {
  Pair t;
  const Vec2 along = Vec2(3.0, 4.0).normalized();
  Drawing drawing = drawn(t, Prismatic{.name = "x", .a = t.a, .b = t.b, .along = along, .at = p});
  const Shape *line = find(drawing, ShapeKind::line), *block = find(drawing, ShapeKind::block);
  REQUIRE(line != nullptr);
  REQUIRE(block != nullptr);
  const auto along_of = [&](const Shape& s) {
    return Vec2(rotate(t.model.body(s.body).pose.angle, s.points[1]));
  };
  CHECK(std::abs(cross(along_of(*line), along)) < 1e-12);
  CHECK(std::abs(cross(along_of(*block), along)) < 1e-12);
  check_point(t.global(t.b, block->points[0]), p);
  CHECK(std::abs(cross(t.global(t.a, line->points[0]) - p, along)) < 1e-12);

  Pair u;
  drawing =
      drawn(u, PointOnLine{.name = "x", .a = u.a, .at = p, .b = u.b, .through = r, .along = along});
  line = find(drawing, ShapeKind::line);
  REQUIRE(line != nullptr);
  CHECK(std::abs(cross(u.global(u.b, line->points[0]) - r, along)) < 1e-12);
  check_point(u.global(u.a, find(drawing, ShapeKind::point)->points[0]), p);

  Pair v;
  drawing =
      drawn(v, PointOnCurve{.name = "x", .a = v.a, .at = p, .b = v.b, .curve = circle(r, 0.7)});
  const Shape* curve = find(drawing, ShapeKind::curve);
  REQUIRE(curve != nullptr);
  CHECK(curve->closed);
  CHECK(curve->points.size() > 50);
  for (const Vec2& q : curve->points) CHECK((v.global(v.b, q) - r).norm() == doctest::Approx(0.7));
  Pair w;
  CHECK(find(drawn(w,
                   PointOnCurve{
                       .name = "x", .a = w.a, .at = p, .b = w.b, .curve = straight_line(r, along)}),
             ShapeKind::line) != nullptr);
}

TEST_CASE("what turns a body is drawn at its pin, what pushes it at its point") {
  for (const ShapeRole role : {ShapeRole::driver, ShapeRole::load, ShapeRole::spring}) {
    Pair t;
    t.model.add(Revolute{.name = "pin", .a = ground, .b = t.b, .at = p});
    if (role == ShapeRole::driver)
      t.model.add(AngleDriver{.name = "x", .body = t.b, .angle = constant_speed(0.0, 1.0)});
    else if (role == ShapeRole::load)
      t.model.add(AppliedTorque{.name = "x", .body = t.b, .torque = [](double) { return 1.0; }});
    else
      t.model.add(TorsionalSpring{.name = "x", .a = ground, .b = t.b});
    const Drawing drawing = draw(t.model);
    const Shape* turn = find(drawing, ShapeKind::turn);
    REQUIRE(turn != nullptr);
    CHECK(turn->role == role);
    CHECK(turn->other == t.b);
    check_point(t.global(t.b, turn->points[0]), p);
  }
  Pair t;
  Drawing drawing = drawn(t, DisplacementDriver{.name = "x",
                                                .body = t.a,
                                                .at = p,
                                                .along = {0.0, 1.0},
                                                .displacement = constant_speed(0.0, 1.0)});
  const Shape* arrow = find(drawing, ShapeKind::arrow);
  REQUIRE(arrow != nullptr);
  CHECK(arrow->role == ShapeRole::driver);
  check_point(t.global(t.a, arrow->points[0]), p);
  check_point(arrow->points[1], {0.0, 1.0});
  Pair u;
  drawing = drawn(u, AppliedForce{.name = "x", .body = u.a, .at = p, .force = [](double) {
                                    return Vec2(1.0, 0.0);
                                  }});
  CHECK(find(drawing, ShapeKind::arrow)->role == ShapeRole::load);
}

TEST_CASE("gears are drawn as pitch circles that touch, a belt around two wheels") {
  for (const double ratio : {-0.5, 3.0, 1.0}) {
    Pair t;
    t.model.add(Revolute{.name = "axis a", .a = ground, .b = t.a, .at = {1.0, 2.0}});
    t.model.add(Revolute{.name = "axis b", .a = ground, .b = t.b, .at = {-3.0, 0.5}});
    t.model.add(Gear{.name = "x", .a = t.a, .b = t.b, .ratio = ratio});
    const Drawing drawing = draw(t.model);
    std::vector<double> radii;
    for (const Shape& s : drawing.shapes())
      if (s.kind == ShapeKind::gear) radii.push_back(s.radius);
    REQUIRE(radii.size() == 2);
    CHECK(radii[0] / radii[1] == doctest::Approx(std::abs(ratio)));
    const double distance = std::hypot(4.0, 1.5);
    if (ratio < 0.0) CHECK(radii[0] + radii[1] == doctest::Approx(distance));
    if (ratio == 3.0) CHECK(radii[0] - radii[1] == doctest::Approx(distance));
    CHECK((find(drawing, ShapeKind::belt) != nullptr) == (ratio == 1.0));
  }
}

TEST_CASE("no element of the folder is left out here: only gravity has no place") {
  std::set<std::string> files;
  for (const char* folder : {"joints", "joints/drivers", "joints/forces"})
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(YOKE_SOURCE_DIR) / folder))
      if (entry.path().extension() == ".cpp") files.insert(entry.path().stem().string());
  for (const auto& entry : std::filesystem::recursive_directory_iterator(
           std::filesystem::path(YOKE_SOURCE_DIR) / "joints")) {
    const std::string stem = entry.path().stem().string();
    if (entry.path().extension() != ".cpp" || files.count(stem) == 0 || stem == "gravity") continue;
    const std::string path =
        std::filesystem::relative(entry.path(), YOKE_SOURCE_DIR).generic_string();
    CHECK_MESSAGE(yoke::tests::source(path).find("draw(Drawing") != std::string::npos, path);
  }
  CHECK(files.count("revolute") == 1);
}

TEST_CASE("a body is the hull of what is attached to it, a rod through its centre, or as given") {
  Model m;
  const BodyId rod =
      m.add({.name = "rod", .mass = 1.0, .inertia = 1.0 / 12.0, .pose = {{0.5, 0.0}, 0.0}});
  m.add(Revolute{.name = "pivot", .a = ground, .b = rod, .at = {0.0, 0.0}});
  const BodyId plate = m.add({.name = "plate", .mass = 1.0, .inertia = 1.0});
  for (const Vec2& at : {Vec2(0, 0), Vec2(2, 0), Vec2(2, 2), Vec2(0, 2), Vec2(1, 1)})
    m.add(Revolute{
        .name = "pin" + std::to_string(m.constraints().size()), .a = ground, .b = plate, .at = at});
  m.add({.name = "given",
         .mass = 1.0,
         .inertia = 1.0,
         .pose = {{1.0, 0.0}, 0.5 * pi},
         .outline = {{1.0, 1.0}, {2.0, 1.0}, {1.0, 2.0}}});
  const BodyId mass =
      m.add({.name = "mass", .mass = 1.0, .inertia = 1.0, .pose = {{3.0, 0.0}, 0.0}});
  m.add(Distance{
      .name = "rod to it", .a = ground, .b = mass, .at_a = {0.0, 0.0}, .at_b = {3.0, 0.0}});
  const Drawing drawing = draw(m);
  CHECK(drawing.bodies()[4].outline.size() == 1);  // no length of its own
  REQUIRE(drawing.bodies()[1].outline.size() == 2);
  check_point(drawing.bodies()[1].outline[0], {-0.5, 0.0});
  check_point(drawing.bodies()[1].outline[1], {0.5, 0.0});
  CHECK(drawing.bodies()[2].outline.size() == 4);
  REQUIRE(drawing.bodies()[3].given);
  check_point(drawing.bodies()[3].outline[0], {1.0, 0.0});
  CHECK_THROWS_AS(m.add({.name = "bad", .mass = 1.0, .inertia = 1.0, .outline = {{NAN, 0.0}}}),
                  ModelError);
}
