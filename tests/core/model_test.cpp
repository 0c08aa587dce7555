// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Mistakes in a model are refused with a message that names the body or joint, the value and what
// is accepted. Messages of the joints are in tests/joints, of slots and laws in tests/contact.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include <yoke/core/authoring/auto_constraint.hpp>
#include <yoke/core/authoring/auto_force.hpp>
#include <yoke/core/model.hpp>
#include <yoke/tests/messages.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

Body good(const std::string& name = "crank") {
  return {.name = name, .mass = 0.09, .inertia = 3e-5, .pose = {{0.3, -0.2}, 0.4}};
}

std::string refusal(const Body& body) {
  Model model;
  const std::string message = message_of([&] { model.add(body); });
  CHECK(model.body_count() == 0);  // nothing half done
  return message;
}

/// A constraint that does not check its bodies itself: x_a - x_b = 0.
class Level : public AutoConstraint<Level, 1, 2> {
 public:
  Level(const std::string& name, BodyId a, BodyId b)
      : AutoConstraint(name, {a, b}, {{"level", Measure::length}}) {}
  template <class T>
  T phi(const AutoPose<T>& a, const AutoPose<T>& b, const T&) const {
    return a.x - b.x;
  }
};

class Push : public AutoForce<Push, 2> {
 public:
  Push(const std::string& name, BodyId a, BodyId b, double size = 0.0)
      : AutoForce(name, {a, b}), size_(size) {}
  template <class T>
  void apply(AutoBody<T>&, AutoBody<T>&, AutoElement<T>&) const {}
  std::vector<Parameter> parameters() const override { return {{"size", "N", size_}}; }

 private:
  double size_;
};

}  // namespace

TEST_CASE("mass and inertia must be finite and not negative") {
  Body body = good();
  body.mass = -0.09;
  CHECK(refusal(body) == "body 'crank': mass = -0.09 kg must be finite and at least 0 kg");
  body.mass = not_a_number;
  CHECK(refusal(body) == "body 'crank': mass = nan kg must be finite and at least 0 kg");
  body.mass = infinity;
  CHECK(refusal(body) == "body 'crank': mass = inf kg must be finite and at least 0 kg");
  body = good();
  body.inertia = -3e-5;
  CHECK(refusal(body) ==
        "body 'crank': inertia = -3e-05 kg m^2 must be finite and at least 0 kg m^2");
  body = good();
  body.inertia = not_a_number;
  CHECK(refusal(body) == "body 'crank': inertia = nan kg m^2 must be finite and at least 0 kg m^2");
}

TEST_CASE("a body may be without mass or inertia: joints that are added later may determine it") {
  Model model;
  model.add(Body{.name = "massless rod"});
  model.add(Body{.name = "point mass", .mass = 1.0});
  model.add(Body{.name = "wheel", .inertia = 1.0});
  CHECK(model.body_count() == 3);
}

TEST_CASE("where a body starts must be finite") {
  const auto with = [](const auto& change) {
    Body body = good();
    change(body);
    return refusal(body);
  };
  CHECK(with([](Body& b) { b.pose.position.x() = not_a_number; }) ==
        "body 'crank': pose x = nan must be a finite number");
  CHECK(with([](Body& b) { b.pose.position.y() = infinity; }) ==
        "body 'crank': pose y = inf must be a finite number");
  CHECK(with([](Body& b) { b.pose.angle = not_a_number; }) ==
        "body 'crank': pose angle = nan must be a finite number");
  CHECK(with([](Body& b) { b.twist.velocity.x() = -infinity; }) ==
        "body 'crank': velocity x = -inf must be a finite number");
  CHECK(with([](Body& b) { b.twist.velocity.y() = not_a_number; }) ==
        "body 'crank': velocity y = nan must be a finite number");
  CHECK(with([](Body& b) { b.twist.omega = not_a_number; }) ==
        "body 'crank': angular velocity = nan must be a finite number");
}

TEST_CASE("names of bodies are given and given once") {
  CHECK(refusal(good("")) == "a body needs a name that is not empty");
  CHECK(refusal(good("ground")) ==
        "body 'ground': this name is taken by a body; names of a model are unique, because columns "
        "of "
        "results are found by them");
  Model model;
  model.add(good());
  CHECK(message_of([&] {
          model.add(good());
        }).starts_with("body 'crank': this name is taken by a body"));
  CHECK(model.body_count() == 1);
}

TEST_CASE("a joint or force cannot have the name of a body, nor a body theirs") {
  // 'crank.x_m' would be found twice if an element of this name reported an 'x' of its own.
  Model model;
  const BodyId crank = model.add(good());
  const BodyId slider = model.add(good("slider"));
  CHECK(message_of([&] {
          model.add(Level("crank", crank, slider));
        }).starts_with("joint or force 'crank': this name is taken by a body"));
  CHECK(message_of([&] {
          model.add(Push("slider", crank, slider));
        }).starts_with("joint or force 'slider': this name is taken by a body"));
  CHECK(message_of([&] {
          model.add(Push("ground", crank, slider));
        }).starts_with("joint or force 'ground': this name is taken by a body"));
  model.add(Level("level", crank, slider));
  CHECK(message_of([&] {
          model.add(good("level"));
        }).starts_with("body 'level': this name is taken by a joint or force"));
  CHECK(model.body_count() == 2);
  CHECK(model.forces().empty());
}

TEST_CASE("of very many names each is found, and none is given twice") {
  constexpr int count = 3000;
  const auto link = [](int i) { return "link " + std::to_string(i); };
  const auto level = [](int i) { return "level " + std::to_string(i); };
  Model model;
  for (int i = 0; i < count; ++i) {
    const BodyId body = model.add(good(link(i)));
    model.add(Level(level(i), ground, body));
  }
  int found = 0, taken = 0;
  for (int i = 0; i < count; ++i) found += model.find_body(link(i)).index == i + 1 ? 1 : 0;
  for (int i = 0; i < count; i += 50) {
    for (const std::string& message :
         {message_of([&] { model.add(good(link(i))); }),
          message_of([&] { model.add(good(level(i))); }),
          message_of([&] { model.add(Level(level(i), ground, BodyId{1})); })})
      taken += contains(message, "this name is taken") ? 1 : 0;
  }
  CHECK(found == count);
  CHECK(taken == 3 * count / 50);
  CHECK(model.body_count() == count);
  CHECK(model.find_body("ground") == ground);
  CHECK_THROWS_AS(model.find_body(level(7)), ModelError);
}

TEST_CASE("a body that is not there is refused with the ones that are") {
  Model model;
  model.add(good("crank"));
  model.add(good("slider"));
  CHECK(model.find_body("slider") == BodyId{2});
  CHECK(model.find_body("ground") == ground);
  CHECK(message_of([&] { model.find_body("slide"); }) ==
        "unknown body 'slide': the model has 'ground', 'crank', 'slider'");
  CHECK(message_of([&] { model.body(BodyId{3}); }) ==
        "unknown body 3: the model has bodies 0 to 2 ('ground', 'crank', 'slider')");
  CHECK(message_of([&] {
          model.to_local(BodyId{-1}, {0.1, 0.2});
        }) == "unknown body -1: the model has bodies 0 to 2 ('ground', 'crank', 'slider')");
}

TEST_CASE("elements of users that check nothing are checked by the model") {
  Model model;
  const BodyId crank = model.add(good());
  const BodyId slider = model.add(good("slider"));
  CHECK(message_of([&] { model.add(Level("", crank, slider)); }) ==
        "a joint or force needs a name that is not empty");
  CHECK(message_of([&] { model.add(Level("level", crank, BodyId{9})); }) ==
        "'level': unknown body 9: the model has bodies 0 to 2");
  CHECK(message_of([&] { model.add(Push("push", crank, BodyId{-2})); }) ==
        "'push': unknown body -2: the model has bodies 0 to 2");
  CHECK(message_of([&] { model.add(Level("level", crank, crank)); }) ==
        "'level': body 'crank' is given twice; a joint or force acts between different bodies");
  CHECK(message_of([&] { model.add(Level("level", ground, ground)); }) ==
        "joint 'level': at least one of its bodies must move");
  CHECK(message_of([&] { model.add(Push("push", crank, slider, not_a_number)); }) ==
        "'push': size = nan must be a finite number");

  // What was refused left nothing behind, its name is free.
  CHECK(model.constraints().empty());
  CHECK(model.forces().empty());
  model.add(Level("level", crank, slider));
  CHECK(message_of([&] {
          model.add(Level("level", crank, ground));
        }).starts_with("joint or force 'level': this name is taken by a joint or force"));
  CHECK(message_of([&] {
          model.add(Push("level", crank, slider));
        }).starts_with("joint or force 'level': this name is taken by a joint or force"));
  model.add(Push("push", crank, slider, 3.0));
  CHECK(model.constraints().size() == 1);
  CHECK(model.forces().size() == 1);
}

TEST_CASE("a changeable parameter is found by its full name or the known ones are told") {
  Model model;
  const BodyId a = model.add(good("a")), b = model.add(good("b"));
  CHECK(message_of([&] { model.find_parameter("push.size"); }) ==
        "unknown parameter 'push.size': the model has no changeable parameters");
  model.add(Push("push", a, b, 3.0));
  model.add(Push("pull", a, b, 7.0));
  CHECK(model.find_parameter("pull.size") == 1);
  CHECK(model.start_state().parameters == std::vector<double>{3.0, 7.0});
  CHECK(message_of([&] { model.find_parameter("size"); }) ==
        "unknown parameter 'size': the model has 'push.size', 'pull.size'");
}

TEST_CASE("a point mass moves the centre of mass and adds by the parallel axis theorem") {
  // About a common point P, here the pivot of a crank, moments of inertia simply add.
  const Vec2 pivot(0.11, -0.23);
  const Body rod{.name = "rod",
                 .mass = 1.7,
                 .inertia = 0.031,
                 .pose = {{0.42, 0.05}, 0.3},
                 .twist = {3.1 * perp(Vec2(0.42, 0.05) - pivot), 3.1}};
  const Vec2 tip(0.77, 0.29);
  const Body both = with_point_mass(rod, 0.6, tip);
  const auto about_pivot = [&](const Body& b) {
    return b.inertia + b.mass * (b.pose.position - pivot).squaredNorm();
  };
  CHECK(both.mass == doctest::Approx(2.3).epsilon(1e-15));
  CHECK(about_pivot(both) ==
        doctest::Approx(about_pivot(rod) + 0.6 * (tip - pivot).squaredNorm()).epsilon(1e-14));
  // First moment, and the new centre goes on turning about the pivot.
  CHECK(both.pose.position.x() == doctest::Approx((1.7 * 0.42 + 0.6 * 0.77) / 2.3).epsilon(1e-15));
  const Vec2 velocity = 3.1 * perp(both.pose.position - pivot);
  CHECK(both.twist.velocity.x() == doctest::Approx(velocity.x()).epsilon(1e-14));
  CHECK(both.twist.velocity.y() == doctest::Approx(velocity.y()).epsilon(1e-14));
  CHECK(both.twist.omega == 3.1);
  CHECK(both.pose.angle == 0.3);
  CHECK(message_of([&] { with_point_mass(rod, 0.0, tip); }) ==
        "body 'rod': point mass = 0 kg must be finite and greater than 0 kg");
  // A place that is nowhere: refused here or, at the latest, by the model.
  Model model;
  CHECK_THROWS_AS(model.add(with_point_mass(rod, 0.6, {not_a_number, 0.0})), ModelError);
}
