// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The problems in Simbody: joints as mobilizers, loops closed by constraints, contact by a force element
// of its own, the integrator its manual recommends, only the accuracy given.
#include <Simbody.h>

#include <yoke/tests/bench/clock.hpp>
#include <yoke/tests/bench/peer/problems.hpp>

namespace yoke::bench::peer {

namespace {

using namespace SimTK;

/// What every problem has.
struct Machine {
  MultibodySystem system;
  SimbodyMatterSubsystem matter{system};
  GeneralForceSubsystem forces{system};

  Machine() { matter.setShowDefaultGeometry(false); }
};

/// Uniform, of 1 m and 1 kg, along x.
Body::Rigid uniform_link() {
  const Real inertia = 1.0 / 12.0;
  return Body::Rigid(MassProperties(1.0, Vec3(0), Inertia(0.0, inertia, inertia)));
}

/// take(state, values) appends what is compared.
template <class Take>
Trajectory run_simbody(const MultibodySystem& system, const State& start, double end,
                       double accuracy, Take take) {
  Trajectory trajectory;
  const auto begin = Clock::now();
  try {
    RungeKuttaMersonIntegrator integrator(system);
    integrator.setAccuracy(accuracy);
    TimeStepper stepper(system, integrator);
    stepper.initialize(start);
    for (int i = 0; i < samples; ++i) {
      if (i > 0) stepper.stepTo(sample_time(i, end));
      const State& state = stepper.getState();
      system.realize(state, Stage::Position);
      take(state, trajectory.values);
    }
  } catch (const std::exception&) {
    trajectory.values.clear();
  }
  trajectory.seconds = seconds_since(begin);
  return trajectory;
}

/// Pin in a slot along an arc: what presses the two apart.
class PinInArc : public Force::Custom::Implementation {
 public:
  PinInArc(MobilizedBody crank, MobilizedBody slider)
      : crank_(std::move(crank)), slider_(std::move(slider)) {}

  void calcForce(const State& state, Vector_<SpatialVec>& body_forces, Vector_<Vec3>&,
                 Vector&) const override {
    const Vec3 pin_in_crank(yoke_data::crank, 0.0, 0.0);
    const Vec3 pin = crank_.findStationLocationInGround(state, pin_in_crank);
    const Vec3 to_pin = pin - slider_.getBodyOriginLocation(state);
    const Real distance = to_pin.norm();
    const bool outer = distance > yoke_data::radius;
    const Real penetration = std::abs(distance - yoke_data::radius) - yoke_data::clearance;
    if (penetration <= 0.0) return;
    const UnitVec3 outwards(to_pin);
    const Vec3 velocity = crank_.findStationVelocityInGround(state, pin_in_crank) -
                          slider_.getBodyOriginVelocity(state);
    const Real rate = (outer ? 1.0 : -1.0) * dot(velocity, outwards);
    const Real force = yoke_data::stiffness(outer) * std::pow(penetration, 1.1) *
                       (1.0 + 1.5 * yoke_data::alpha * rate);
    const Vec3 on_slider = (outer ? force : -force) * outwards;
    slider_.applyForceToBodyPoint(state, slider_.findStationAtGroundPoint(state, pin), on_slider,
                                  body_forces);
    crank_.applyForceToBodyPoint(state, pin_in_crank, -on_slider, body_forces);
  }
  Real calcPotentialEnergy(const State&) const override { return 0.0; }

 private:
  MobilizedBody crank_, slider_;
};

/// Disc on the floor y = 0.
class DiscOnFloor : public Force::Custom::Implementation {
 public:
  explicit DiscOnFloor(MobilizedBody disc) : disc_(std::move(disc)) {}

  void calcForce(const State& state, Vector_<SpatialVec>& body_forces, Vector_<Vec3>&,
                 Vector&) const override {
    const Real penetration = disc_data::radius - disc_.getBodyOriginLocation(state)[1];
    if (penetration <= 0.0) return;
    const Real rate = -disc_.getBodyOriginVelocity(state)[1];
    const Real force =
        disc_data::stiffness * std::pow(penetration, 1.5) * (1.0 + 1.5 * disc_data::alpha * rate);
    disc_.applyBodyForce(state, SpatialVec(Vec3(0), Vec3(0.0, force, 0.0)), body_forces);
  }
  Real calcPotentialEnergy(const State&) const override { return 0.0; }

 private:
  MobilizedBody disc_;
};

}  // namespace

Trajectory simbody_chain(int links, double accuracy) {
  Machine m;
  Force::Gravity(m.forces, m.matter, Vec3(0.0, -9.81, 0.0));
  std::vector<MobilizedBody> chain = {m.matter.Ground()};
  for (int i = 0; i < links; ++i)
    chain.push_back(MobilizedBody::Pin(chain.back(), Vec3(i == 0 ? 0.0 : 0.5, 0.0, 0.0),
                                       uniform_link(), Vec3(-0.5, 0.0, 0.0)));
  const State start = m.system.realizeTopology();
  return run_simbody(
      m.system, start, chain_end, accuracy, [&](const State& state, std::vector<double>& values) {
        for (std::size_t i = 1; i < chain.size(); ++i)
          values.push_back(chain[i].findStationLocationInGround(state, Vec3(0.5, 0.0, 0.0))[1]);
      });
}

Trajectory simbody_four_bar(int loops, double accuracy) {
  Machine m;
  Force::Gravity(m.forces, m.matter, Vec3(0.0, -9.81, 0.0));
  const Vec3 foot(-0.5, 0.0, 0.0), tip(0.5, 0.0, 0.0);
  std::vector<MobilizedBody::Pin> links, bars;
  for (int i = 0; i <= loops; ++i) {
    links.emplace_back(m.matter.Ground(), Vec3(i, 0.0, 0.0), uniform_link(), foot);
    if (i == 0) continue;
    const std::size_t k = static_cast<std::size_t>(i);
    bars.emplace_back(links[k - 1], tip, uniform_link(), foot);
    for (const UnitVec3& across : {UnitVec3(1.0, 0.0, 0.0), UnitVec3(0.0, 1.0, 0.0)})
      Constraint::PointInPlane(links[k], across, across[0] > 0.5 ? 0.5 : 0.0, bars.back(), tip);
  }
  m.system.realizeTopology();
  State start = m.system.getDefaultState();
  for (MobilizedBody::Pin& link : links) {
    link.setAngle(start, 0.5 * Pi);
    link.setRate(start, -1.0);
  }
  for (MobilizedBody::Pin& bar : bars) {
    bar.setAngle(start, -0.5 * Pi);
    bar.setRate(start, 1.0);
  }
  return run_simbody(m.system, start, four_bar_end, accuracy,
                     [&](const State& state, std::vector<double>& values) {
                       values.push_back(links.front().findStationLocationInGround(state, tip)[0]);
                     });
}

Trajectory simbody_scotch_yoke(double accuracy) {
  Machine m;
  const Body::Rigid crank_body(MassProperties(0.105, Vec3(0), Inertia(30.4e-6)));
  const Body::Rigid slider_body(
      MassProperties(yoke_data::slider_mass, Vec3(0), Inertia(3.4956e-3)));
  MobilizedBody::Pin crank(m.matter.Ground(), Vec3(0), crank_body, Vec3(0));
  MobilizedBody::Slider slider(m.matter.Ground(), Vec3(0), slider_body, Vec3(0));
  Motion::Steady(crank, yoke_data::speed);
  Force::Custom(m.forces, new PinInArc(crank, slider));
  m.system.realizeTopology();
  State start = m.system.getDefaultState();
  crank.setAngle(start, yoke_data::start);
  crank.setRate(start, yoke_data::speed);
  slider.setLength(start, yoke_data::slider_x());
  slider.setRate(start, yoke_data::slider_v());
  return run_simbody(m.system, start, yoke_data::end, accuracy,
                     [&](const State& state, std::vector<double>& values) {
                       values.push_back(slider.getLength(state));
                     });
}

Trajectory simbody_disc(double accuracy) {
  namespace d = disc_data;
  Machine m;
  Force::Gravity(m.forces, m.matter, Vec3(0.0, -d::gravity, 0.0));
  const Real inertia = 0.5 * d::mass * d::radius * d::radius;
  const Body::Rigid body(
      MassProperties(d::mass, Vec3(0), Inertia(0.5 * inertia, 0.5 * inertia, inertia)));
  MobilizedBody::Planar disc(m.matter.Ground(), Vec3(0), body, Vec3(0));
  Force::Custom(m.forces, new DiscOnFloor(disc));
  m.system.realizeTopology();
  State start = m.system.getDefaultState();
  disc.setQ(start, Vec3(0.0, 0.0, d::height));
  return run_simbody(m.system, start, d::end, accuracy,
                     [&](const State& state, std::vector<double>& values) {
                       values.push_back(disc.getBodyOriginLocation(state)[1]);
                     });
}

}  // namespace yoke::bench::peer
