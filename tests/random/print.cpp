// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/tests/random/print.hpp>

#include <fmt/format.h>

#include <yoke/tests/random/changes.hpp>
#include <yoke/tests/random/checks.hpp>
#include <yoke/tests/random/held.hpp>

namespace yoke::tests::random {

namespace {

/// With a decimal point, so that automatic differentiation sees a double.
std::string number(double x) { return fmt::format("{:#}", x); }
std::string point(const Vec2& p) { return fmt::format("{{{}, {}}}", p.x(), p.y()); }

/// In SI units: units are a remark.
class Printer {
 public:
  explicit Printer(const Description& d) : d_(d) {}

  std::string text() {
    line("Model m;");
    for (const BodyData& b : d_.bodies)
      line(fmt::format(
          "const BodyId {0} = m.add(Body{{.name = \"{0}\", .mass = {1}, .inertia = {2}, "
          ".pose = {{{3}, {4}}}, .twist = {{{5}, {6}}}}});",
          b.name, b.mass, b.inertia, point(b.at), b.angle, point(b.velocity), b.omega));
    for (const JointData& j : d_.joints) joint(j);
    for (const ForceData& f : d_.forces) force(f);
    for (const SlotData& s : d_.slots) slot(s);
    if (!d_.units.si())
      line(fmt::format("// in units of {} m, {} kg, {} s: every length times the first, and so on",
                       1.0 / d_.units.length, 1.0 / d_.units.mass, 1.0 / d_.units.time));
    return text_;
  }

 private:
  void line(const std::string& s) { text_ += s + "\n"; }
  std::string id(int body) const {
    return body == 0 ? "ground" : d_.bodies[static_cast<std::size_t>(body) - 1].name;
  }
  double angle(int body) const {
    return body == 0 ? 0.0 : d_.bodies[static_cast<std::size_t>(body) - 1].angle;
  }
  static std::string wave(const Wave& w, double start) {
    return fmt::format(
        "time_function([](auto t) {{ return {} + {} * t + {} * (1.0 - cos({} * t)); }})",
        number(start), number(w.rate), number(w.amplitude), number(w.frequency));
  }
  std::string ends(const std::string& name, int a, int b) const {
    return fmt::format(".name = \"{}\", .a = {}, .b = {}", name, id(a), id(b));
  }

  static std::string friction(const JointData& j) {
    if (!(j.friction > 0.0)) return "";
    const std::string law =
        j.threshold > 0.0
            ? fmt::format("RegularisedCoulomb{{{}, {}}}", number(j.friction), number(j.threshold))
            : fmt::format("Coulomb{{{}, {}}}", number(j.friction), number(1.2 * j.friction));
    return fmt::format(", .friction = PinFriction{{.law = {}, .radius = {}}}", law,
                       number(j.radius));
  }

  void joint(const JointData& j) {
    const std::string both = ends(j.name, j.a, j.b);
    switch (j.kind) {
      case JointKind::revolute:
        return line(
            fmt::format("m.add(Revolute{{{}, .at = {}{}}});", both, point(j.at), friction(j)));
      case JointKind::prismatic:
        return line(fmt::format("m.add(Prismatic{{{}, .along = {}}});", both, point(j.along)));
      case JointKind::weld:
        return line(fmt::format("m.add(Weld{{{}}});", both));
      case JointKind::distance:
        return line(fmt::format("m.add(Distance{{{}, .at_a = {}, .at_b = {}}});", both, point(j.at),
                                point(j.other)));
      case JointKind::point_on_line:
        return line(fmt::format(
            "m.add(PointOnLine{{.name = \"{}\", .a = {}, .at = {}, .b = {}, .through = {}, .along = {}}});",
            j.name, id(j.a), point(j.at), id(j.b), point(j.other), point(j.along)));
      case JointKind::gear:
        return line(fmt::format("m.add(Gear{{{}, .carrier = {}, .ratio = {}}});", both,
                                id(j.carrier), j.ratio));
      case JointKind::angle_driver:
        return line(fmt::format(
            "m.add(AngleDriver{{.name = \"{}\", .body = {}, .relative_to = {}, .angle = {}}});",
            j.name, id(j.b), id(j.a), wave(j.wave, angle(j.b) - angle(j.a))));
      case JointKind::displacement_driver:
        return line(
            fmt::format("m.add(DisplacementDriver{{.name = \"{}\", .body = {}, .at = {}, "
                        ".along = {}, .relative_to = {}, .displacement = {}}});",
                        j.name, id(j.b), point(j.at), point(j.along), id(j.a), wave(j.wave, 0.0)));
    }
  }

  void force(const ForceData& f) {
    switch (f.kind) {
      case ForceKind::gravity:
        return line(fmt::format("m.add(Gravity{{.name = \"{}\", .acceleration = {}}});", f.name,
                                point(f.vector)));
      case ForceKind::spring:
        return line(fmt::format(
            "m.add(TranslationalSpring{{{}, .at_a = {}, .at_b = {}, .stiffness = {}, .damping = {}, "
            ".free_length = {}}});",
            ends(f.name, f.a, f.b), point(f.at), point(f.other), f.stiffness, f.damping,
            std::max(0.0, (f.other - f.at).norm() - f.stretch)));
      case ForceKind::torsion:
        return line(fmt::format(
            "m.add(TorsionalSpring{{{}, .stiffness = {}, .damping = {}, .free_angle = {}}});",
            ends(f.name, f.a, f.b), f.stiffness, f.damping, angle(f.b) - angle(f.a) - f.stretch));
      case ForceKind::load:
        return line(
            fmt::format("m.add(AppliedForce{{.name = \"{}\", .body = {}, .at = {}, .force = "
                        "[](double t) {{ return Vec2(Vec2{} * std::cos({} * t + {})); }}, "
                        ".frame = Frame::{}}});",
                        f.name, id(f.b), point(f.at), point(f.vector), f.frequency, f.phase,
                        f.body_frame ? "body" : "global"));
      case ForceKind::torque:
        return line(
            fmt::format("m.add(AppliedTorque{{.name = \"{}\", .body = {}, .torque = [](double "
                        "t) {{ return {} * std::cos({} * t + {}); }}}});",
                        f.name, id(f.b), f.magnitude, f.frequency, f.phase));
      case ForceKind::drag:
        return line(
            fmt::format("m.add(applied_force(\"{}\", {}, Vec2{}, [](auto, const auto& b) {{ "
                        "return vec(-{} * b.vx, -{} * b.vy); }}));",
                        f.name, id(f.b), point(f.at), f.damping, f.damping));
    }
  }

  static std::string law(const LawData& l) {
    const ElasticArguments& a = l.arguments;
    const DissipativeArguments& d = l.damping;
    const std::string elastic =
        l.elastic == "power"
            ? fmt::format("PowerLaw{{{}, {}}}", l.K, l.n)
            : fmt::format(
                  "make_elastic(\"{}\", {{.pin = {{{}, {}}}, .wall = {{{}, {}}}, "
                  ".pin_radius = {}, .wall_radius = {}, .conformity = Conformity::{}, "
                  ".length = {}, .reading = Reading::{}}})",
                  l.elastic, a.pin.E, a.pin.nu, a.wall.E, a.wall.nu, a.pin_radius, a.wall_radius,
                  a.conformity == Conformity::internal ? "internal" : "external", a.length,
                  name_of(a.reading));
    if (l.dissipative == "none") return "ContactLaw{" + elastic + "}";
    return fmt::format(
        "ContactLaw{{{}, make_dissipative(\"{}\", {{.restitution = {}, "
        ".slowest_approach = {}, .q = {}, .epsilon = {}, .empirical = {}, .tensile = "
        "TensilePhase::{}}})}}",
        elastic, l.dissipative, d.restitution, d.slowest_approach, d.q, d.epsilon, d.empirical,
        d.tensile == TensilePhase::keep ? "keep" : "clamp");
  }

  void slot(const SlotData& s) {
    std::string laws;
    for (const LawData& l : s.laws) laws += (laws.empty() ? "" : ", ") + law(l);
    line(fmt::format(
        "m.add(PinInSlot{{.name = \"{}\", .pin = {{{}, {}, {}}}, .slot = {{{}, "
        "arc_slot({{.center = {}, .radius = {}, .direction = {}, .angle = {}, "
        ".half_width = {}}})}}, .law = SlotLaws({}), .reference_force = {}}});",
        s.name, id(s.pin_body), point(s.pin), s.radius, id(s.slot_body), point(s.center),
        s.arc_radius, s.direction, s.angle, s.half_width, laws, s.reference_force));
  }

  const Description& d_;
  std::string text_;
};

}  // namespace

std::string as_code(const Description& d, const std::string& kind) {
  if (kind.starts_with("equilibrium")) {
    const Description held = make_held(d);
    return Printer(held).text() +
           "const Equilibrium e = equilibrium(m, {.allow_neutral = true});\n";
  }
  std::string text = Printer(d).text();
  const Method method = method_of(d, kind.substr(0, kind.find(' ')));
  text += fmt::format(
      "const Result r = simulate(m, {{.until = {}, .relative_tolerance = {}, .formulation = "
      "\"{}\", .samples = 33}});  // {}\n",
      d.duration, method.tolerance, method.formulation, kind);
  for (const Change change : all_changes())
    if (kind.starts_with(name_of(change) + " ") && change != Change::bystanders) {
      const Changed c = changed(d, change);
      text += fmt::format("\n// {}: turned by {} rad, shifted by {} m\n", name_of(change), c.angle,
                          point(c.offset)) +
              Printer(c.d).text();
    }
  return text;
}

}  // namespace yoke::tests::random
