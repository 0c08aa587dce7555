// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/tests/random/build.hpp>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include <yoke/contact/geometry/arc_slot.hpp>
#include <yoke/contact/laws/friction/coulomb.hpp>
#include <yoke/contact/laws/friction/regularised_coulomb.hpp>
#include <yoke/contact/pin_in_slot.hpp>
#include <yoke/joints/distance.hpp>
#include <yoke/joints/drivers/angle_driver.hpp>
#include <yoke/joints/drivers/displacement_driver.hpp>
#include <yoke/joints/forces/applied_force.hpp>
#include <yoke/joints/forces/applied_torque.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/forces/torsional_spring.hpp>
#include <yoke/joints/forces/translational_spring.hpp>
#include <yoke/joints/gear.hpp>
#include <yoke/joints/point_on_line.hpp>
#include <yoke/joints/prismatic.hpp>
#include <yoke/joints/revolute.hpp>
#include <yoke/joints/weld.hpp>

namespace yoke::tests::random {

namespace {

// ---- laws in other units: what goes in is converted to SI, what comes out back

struct ElasticInUnits {
  ElasticLaw law;
  Units u;

  ElasticResponse operator()(double penetration) const {
    const ElasticResponse r = law.response(penetration / u.length);
    return {r.force * u.force(), r.stiffness * u.force() / u.length, r.energy * u.energy()};
  }
  double limit() const { return law.limit() * u.length; }
};

struct DampingInUnits {
  ContactLaw law;
  Units u;

  ContactMemory in_si(ContactMemory memory) const {
    memory.onset_time /= u.time;
    memory.approach_velocity /= u.speed();
    memory.effective_mass /= u.mass;
    memory.largest_penetration /= u.length;
    memory.permanent_set /= u.length;
    memory.release_penetration /= u.length;
    return memory;
  }
  ContactOutput operator()(const ContactInput& in, const ElasticLaw&) const {
    const ContactMemory memory = in_si(in.memory);
    const ContactOutput r = law.evaluate({in.penetration / u.length, in.rate / u.speed(), memory});
    return {.force = r.force * u.force(),
            .dforce_dpenetration = r.dforce_dpenetration * u.force() / u.length,
            .dforce_drate = r.dforce_drate * u.force() / u.speed(),
            .stored_energy = r.stored_energy * u.energy(),
            .dissipated_power = r.dissipated_power * u.energy() / u.time};
  }
  bool needs_largest_penetration() const { return law.dissipation.needs_largest_penetration(); }
  Release release() const { return law.dissipation.release(); }
  double permanent_set(const ContactMemory& memory, const ElasticLaw&) const {
    return law.dissipation.permanent_set(in_si(memory), law.elastic) * u.length;
  }
};

struct KinkedDampingInUnits : DampingInUnits {
  double kink(const ContactInput& in, const ElasticLaw&) const {
    const ContactMemory memory = in_si(in.memory);
    return law.dissipation.kink({in.penetration / u.length, in.rate / u.speed(), memory},
                                law.elastic) *
           u.length;
  }
};

ContactLaw in_units(const ContactLaw& law, const Units& u) {
  if (u.si()) return law;
  const ElasticLaw elastic = ElasticInUnits{law.elastic, u};
  if (law.dissipation.none()) return {elastic};
  if (law.dissipation.has_kink()) return {elastic, KinkedDampingInUnits{{law, u}}};
  return {elastic, DampingInUnits{law, u}};
}

// ---- parts

/// f(t) in the unit of what is driven, from `start` on.
TimeFunction wave(const Wave& w, double start, double size, double time) {
  return time_function([=](auto t) {
    return start +
           size * ((w.rate / time) * t + w.amplitude * (1.0 - cos((w.frequency / time) * t)));
  });
}

class Builder {
 public:
  explicit Builder(const Description& d) : d_(d), u_(d.units) {}

  Model model() {
    for (const BodyData& b : d_.bodies)
      m_.add(Body{.name = b.name,
                  .mass = b.mass * u_.mass,
                  .inertia = b.inertia * u_.mass * u_.length * u_.length,
                  .pose = {b.at * u_.length, b.angle},
                  .twist = {b.velocity * u_.speed(), b.omega / u_.time}});
    for (const JointData& joint : d_.joints) add(joint);
    for (const ForceData& force : d_.forces) add(force);
    for (const SlotData& slot : d_.slots) add(slot);
    return std::move(m_);
  }

 private:
  static BodyId id(int body) { return BodyId{body}; }
  double angle_of(int body) const {
    return body == 0 ? 0.0 : d_.bodies[static_cast<std::size_t>(body) - 1].angle;
  }

  std::optional<PinFriction> friction(const JointData& j) const {
    if (!(j.friction > 0.0)) return std::nullopt;
    PinFriction friction{.law = Coulomb{j.friction, 1.2 * j.friction},
                         .radius = j.radius * u_.length,
                         .reference_force = u_.force()};
    if (j.threshold > 0.0) friction.law = RegularisedCoulomb{j.friction, j.threshold * u_.speed()};
    return friction;
  }

  void add(const JointData& j) {
    const BodyId a = id(j.a), b = id(j.b);
    const Vec2 at = j.at * u_.length, other = j.other * u_.length;
    switch (j.kind) {
      case JointKind::revolute:
        return m_.add(Revolute{
            .name = j.name, .a = a, .b = b, .at = at, .clearance = {}, .friction = friction(j)});
      case JointKind::prismatic:
        return m_.add(Prismatic{.name = j.name, .a = a, .b = b, .along = j.along});
      case JointKind::weld:
        return m_.add(Weld{.name = j.name, .a = a, .b = b});
      case JointKind::distance:
        return m_.add(Distance{.name = j.name, .a = a, .b = b, .at_a = at, .at_b = other});
      case JointKind::point_on_line:
        return m_.add(PointOnLine{
            .name = j.name, .a = a, .at = at, .b = b, .through = other, .along = j.along});
      case JointKind::gear:
        return m_.add(
            Gear{.name = j.name, .a = a, .b = b, .carrier = id(j.carrier), .ratio = j.ratio});
      case JointKind::angle_driver:
        return m_.add(
            AngleDriver{.name = j.name,
                        .body = b,
                        .relative_to = a,
                        .angle = wave(j.wave, angle_of(j.b) - angle_of(j.a), 1.0, u_.time)});
      case JointKind::displacement_driver:
        return m_.add(DisplacementDriver{.name = j.name,
                                         .body = b,
                                         .at = at,
                                         .along = j.along,
                                         .relative_to = a,
                                         .displacement = wave(j.wave, 0.0, u_.length, u_.time)});
    }
  }

  void add(const ForceData& f) {
    const Vec2 at = f.at * u_.length, other = f.other * u_.length;
    const double rate = f.frequency / u_.time, phase = f.phase;
    switch (f.kind) {
      case ForceKind::gravity:
        return m_.add(
            Gravity{.name = f.name, .acceleration = f.vector * (u_.length / (u_.time * u_.time))});
      case ForceKind::spring:
        return m_.add(TranslationalSpring{
            .name = f.name,
            .a = id(f.a),
            .b = id(f.b),
            .at_a = at,
            .at_b = other,
            .stiffness = f.stiffness * u_.force() / u_.length,
            .damping = f.damping * u_.force() / u_.speed(),
            .free_length = std::max(0.0, (f.other - f.at).norm() - f.stretch) * u_.length});
      case ForceKind::torsion:
        return m_.add(TorsionalSpring{.name = f.name,
                                      .a = id(f.a),
                                      .b = id(f.b),
                                      .stiffness = f.stiffness * u_.energy(),
                                      .damping = f.damping * u_.energy() * u_.time,
                                      .free_angle = angle_of(f.b) - angle_of(f.a) - f.stretch});
      case ForceKind::load: {
        const Vec2 amplitude = f.vector * u_.force();
        return m_.add(AppliedForce{
            .name = f.name,
            .body = id(f.b),
            .at = at,
            .force = [=](double t) { return Vec2(amplitude * std::cos(rate * t + phase)); },
            .frame = f.body_frame ? Frame::body : Frame::global});
      }
      case ForceKind::torque: {
        const double amplitude = f.magnitude * u_.energy();
        return m_.add(AppliedTorque{.name = f.name, .body = id(f.b), .torque = [=](double t) {
                                      return amplitude * std::cos(rate * t + phase);
                                    }});
      }
      case ForceKind::drag: {
        const double c = f.damping * u_.force() / u_.speed();
        return m_.add(applied_force(f.name, id(f.b), at, [c](auto, const auto& body) {
          return vec(-c * body.vx, -c * body.vy);
        }));
      }
    }
  }

  void add(const SlotData& s) {
    std::vector<ContactLaw> laws;
    for (const LawData& law : s.laws) laws.push_back(in_units(make_law(law), u_));
    m_.add(
        PinInSlot{.name = s.name,
                  .pin = {id(s.pin_body), s.pin * u_.length, s.radius * u_.length},
                  .slot = {id(s.slot_body), arc_slot({.center = s.center * u_.length,
                                                      .radius = s.arc_radius * u_.length,
                                                      .direction = s.direction,
                                                      .angle = s.angle,
                                                      .half_width = s.half_width * u_.length})},
                  .law = laws.size() == 1 ? SlotLaws(laws[0]) : SlotLaws(laws[0], laws[1], laws[2]),
                  .reference_force = s.reference_force * u_.force()});
  }

  const Description& d_;
  Units u_;
  Model m_;
};

/// Bodies at a pose, as elements read them.
struct Instant {
  std::vector<BodyMotion> bodies;
  Motion motion;

  Instant(const Model& model, const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t)
      : bodies(model.bodies().size()) {
    for (std::size_t i = 1; i < bodies.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(3 * (i - 1));
      bodies[i] = {q[k], q[k + 1], q[k + 2], std::cos(q[k + 2]), std::sin(q[k + 2]),
                   v[k], v[k + 1], v[k + 2]};
    }
    motion = {t, bodies, model.bodies()};
  }
};

struct Rows {
  Eigen::VectorXd phi, rate;  // Phi and G v + Phi_t
  Eigen::MatrixXd G;
  std::vector<Measure> measures;
};

Rows rows_of(const Model& model, const Eigen::VectorXd& q, const Eigen::VectorXd& v, double t) {
  int count = 0;
  for (const auto& joint : model.constraints()) count += joint->rows();
  Rows rows{Eigen::VectorXd::Zero(count),
            Eigen::VectorXd::Zero(count),
            Eigen::MatrixXd::Zero(count, q.size()),
            {}};
  const Instant now(model, q, v, t);
  Eigen::Index first = 0;
  for (const auto& joint : model.constraints()) {
    const int n = joint->rows(), columns = joint->columns();
    Eigen::VectorXd phi = Eigen::VectorXd::Zero(n), phi_t = phi;
    Eigen::Matrix<double, -1, -1, Eigen::RowMajor> G(n, columns);
    G.setZero();
    joint->evaluate(now.motion, {.phi = phi.data(), .G = G.data(), .phi_t = phi_t.data()});
    for (std::size_t k = 0; k < joint->bodies().size(); ++k) {
      const int body = joint->bodies()[k].index;
      if (body > 0)
        rows.G.block(first, 3 * (body - 1), n, 3) += G.middleCols(3 * static_cast<int>(k), 3);
    }
    rows.phi.segment(first, n) = phi;
    rows.rate.segment(first, n) = phi_t;
    for (const Equation& e : joint->equations()) rows.measures.push_back(e.measure);
    first += n;
  }
  rows.rate += rows.G * v;
  return rows;
}

/// Springs at a pose.
class Placed {
 public:
  Placed(const Description& d, const Eigen::VectorXd& q) : d_(d), q_(q) {}

  /// Beyond the free length or angle; 0 for what is no spring.
  double stretch(const ForceData& f) const {
    if (f.kind == ForceKind::spring)
      return (point(f.b, f.other) - point(f.a, f.at)).norm() -
             std::max(0.0, (f.other - f.at).norm() - f.stretch);
    if (f.kind == ForceKind::torsion) return turned(f.b) - turned(f.a) + f.stretch;
    return 0.0;
  }

 private:
  const BodyData& start(int body) const { return d_.bodies[static_cast<std::size_t>(body) - 1]; }
  double turned(int body) const { return body == 0 ? 0.0 : q_[3 * body - 1] - start(body).angle; }
  Vec2 point(int body, const Vec2& at) const {
    if (body == 0) return at;
    return Vec2(q_[3 * body - 3], q_[3 * body - 2]) + rotate(turned(body), at - start(body).at);
  }

  const Description& d_;
  const Eigen::VectorXd& q_;
};

}  // namespace

Model build(const Description& d) { return Builder(d).model(); }

ContactLaw make_law(const LawData& law) {
  const ElasticLaw elastic = law.elastic == "power" ? ElasticLaw(PowerLaw{law.K, law.n, "power"})
                                                    : make_elastic(law.elastic, law.arguments);
  if (law.dissipative == "none") return {elastic};
  return {elastic, make_dissipative(law.dissipative, law.damping)};
}

double mechanical_energy(const Description& d, const Eigen::VectorXd& q, const Eigen::VectorXd& v) {
  const Placed at(d, q);
  double sum = 0.0;
  for (std::size_t i = 0; i < d.bodies.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(3 * i);
    sum += 0.5 * (d.bodies[i].mass * Vec2(v[k], v[k + 1]).squaredNorm() +
                  d.bodies[i].inertia * v[k + 2] * v[k + 2]);
    for (const ForceData& f : d.forces)
      if (f.kind == ForceKind::gravity)
        sum -= d.bodies[i].mass * f.vector.dot(Vec2(q[k], q[k + 1]));
  }
  for (const ForceData& f : d.forces) sum += 0.5 * f.stiffness * std::pow(at.stretch(f), 2);
  return sum;
}

double energy_per_error(const Description& d, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                        double length, double time) {
  const Placed at(d, q);
  double sum = 0.0;
  for (std::size_t i = 0; i < d.bodies.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(3 * i);
    sum += d.bodies[i].mass * Vec2(v[k], v[k + 1]).norm() * length / time +
           d.bodies[i].inertia * std::abs(v[k + 2]) / time;
    for (const ForceData& f : d.forces)
      if (f.kind == ForceKind::gravity) sum += d.bodies[i].mass * f.vector.norm() * length;
  }
  for (const ForceData& f : d.forces)
    sum += f.stiffness * std::abs(at.stretch(f)) * (f.kind == ForceKind::spring ? length : 1.0);
  return sum;
}

Eigen::VectorXd relative_singular_values(const Model& model, const Eigen::VectorXd& q, double t,
                                         double length) {
  Rows rows = rows_of(model, q, Eigen::VectorXd::Zero(q.size()), t);
  if (rows.G.rows() == 0) return {};
  for (Eigen::Index i = 0; i < rows.G.rows(); ++i)
    if (rows.measures[static_cast<std::size_t>(i)] == Measure::angle) rows.G.row(i) *= length;
  for (Eigen::Index j = 2; j < rows.G.cols(); j += 3) rows.G.col(j) /= length;
  const Eigen::VectorXd values = Eigen::JacobiSVD<Eigen::MatrixXd>(rows.G).singularValues();
  return values / std::max(values[0], 1e-300);
}

int rank(const Eigen::VectorXd& values) {
  return static_cast<int>((values.array() > 1e-9).count());
}

Violation violation(const Model& model, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                    double t, double length, double time) {
  const Rows rows = rows_of(model, q, v, t);
  Violation worst;
  for (Eigen::Index i = 0; i < rows.phi.size(); ++i) {
    const bool angle = rows.measures[static_cast<std::size_t>(i)] == Measure::angle;
    const double unit = angle ? 1.0 : length;
    worst.position = std::max(worst.position, std::abs(rows.phi[i]) / unit);
    worst.velocity = std::max(worst.velocity, std::abs(rows.rate[i]) * time / unit);
  }
  return worst;
}

}  // namespace yoke::tests::random
