// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <yoke/contact/laws/dissipative/hunt_crossley.hpp>
#include <yoke/contact/laws/elastic/johnson.hpp>
#include <yoke/contact/laws/elastic/power_law.hpp>

#include <yoke/tests/contact/laws/test_laws.hpp>

using namespace yoke;
using namespace yoke::tests;
using doctest::Approx;

namespace {

constexpr double mass = 0.83;         // [kg]
constexpr double approach = 0.19;     // [m/s]
const PowerLaw hertzian{2.7e9, 1.5};  // [N/m^1.5]
const PowerLaw linear{3.1e7, 1.0};    // [N/m]
const Johnson exact{1.137e11, 60.1e-3, 10e-3};

/// A single mass that meets a fixed wall: m d'' = -F, by classical Runge-Kutta with a step far
/// below need and bisection for the transitions. Knows nothing of the contact element.
class Impact {
 public:
  Impact(ContactLaw law, double m, double v) : law_(std::move(law)), m_(m), now_{0.0, v} {
    memory_ = {.phase = ContactPhase::compressing, .approach_velocity = v, .effective_mass = m};
  }

  /// Separation speed over approach speed.
  double restitution() {
    const double v_i = now_.v;
    const double h = law_.elastic.penetration_at(1e-3) / v_i + 2e-8;
    while (true) {
      const Point next = step(h);
      if (wants_turn(next)) {
        now_ = locate(h, [](const Point& p) { return p.v < 0.0; });
        memory_.largest_penetration = now_.d;
        memory_.permanent_set = law_.dissipation.permanent_set(memory_, law_.elastic);
        memory_.phase = ContactPhase::restituting;
      } else if (has_left(next)) {
        return -locate(h, [this](const Point& p) { return has_left(p); }).v / v_i;
      } else {
        now_ = next;
      }
    }
  }

 private:
  struct Point {
    double d, v;
  };

  double force(const Point& p) const { return law_.evaluate({p.d, p.v, memory_}).force; }
  Point slope(const Point& p) const { return {p.v, -force(p) / m_}; }
  static Point along(const Point& p, double h, const Point& s) {
    return {p.d + h * s.d, p.v + h * s.v};
  }

  Point step(double h) const {
    const Point k1 = slope(now_), k2 = slope(along(now_, 0.5 * h, k1));
    const Point k3 = slope(along(now_, 0.5 * h, k2)), k4 = slope(along(now_, h, k3));
    return {now_.d + h / 6.0 * (k1.d + 2.0 * k2.d + 2.0 * k3.d + k4.d),
            now_.v + h / 6.0 * (k1.v + 2.0 * k2.v + 2.0 * k3.v + k4.v)};
  }

  template <class Condition>
  Point locate(double h, Condition reached) const {
    double low = 0.0;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + h);
      (reached(step(middle)) ? h : low) = middle;
    }
    return step(h);
  }

  bool wants_turn(const Point& p) const {
    return law_.dissipation.needs_largest_penetration() &&
           memory_.phase == ContactPhase::compressing && p.v < 0.0;
  }
  bool has_left(const Point& p) const {
    if (p.v >= 0.0) return false;
    if (p.d <= memory_.permanent_set) return true;
    return law_.dissipation.release() == Release::at_zero_force && force(p) <= 0.0;
  }

  ContactLaw law_;
  double m_;
  Point now_;
  ContactMemory memory_;
};

double restitution(const ContactLaw& law) { return Impact(law, mass, approach).restitution(); }

std::vector<ContactLaw> one_law_of_each_kind() {
  return {{linear},
          {hertzian, HuntCrossley{0.32}},
          {exact, HuntCrossleyRestitution{0.57}},
          {linear, KelvinVoigt{0.63, TensilePhase::clamp}},
          {hertzian, Tsuji{0.63, TensilePhase::clamp}},
          {exact, ExactRestitution{0.63}},
          {linear, LeeWang2{0.63, 3.0, 0.5}},
          {exact, PermanentSet{0.71}}};
}

}  // namespace

TEST_CASE("derivatives and energy ledger of a law of each kind, loading and unloading") {
  for (const ContactLaw& law : one_law_of_each_kind()) {
    for (const ContactPhase phase : {ContactPhase::compressing, ContactPhase::restituting}) {
      ContactMemory memory{.phase = phase, .approach_velocity = 0.173, .effective_mass = 0.83};
      memory.largest_penetration = 3.7e-5;
      memory.permanent_set = law.dissipation.permanent_set(memory, law.elastic);
      for (const double d : {1.1e-6, 2.29e-5, 3.6e-5, -2.3e-6}) {
        for (const double rate : {0.131, -0.117}) {
          CAPTURE(law.name());
          CAPTURE(d);
          CAPTURE(rate);
          const double h = 1e-11, u = 1e-6;
          const ContactOutput at = law.evaluate({d, rate, memory});
          const ContactOutput up = law.evaluate({d + h, rate, memory});
          const ContactOutput down = law.evaluate({d - h, rate, memory});
          CHECK(at.dforce_dpenetration ==
                Approx((up.force - down.force) / (2.0 * h)).epsilon(1e-5));
          const double faster = law.evaluate({d, rate + u, memory}).force;
          const double slower = law.evaluate({d, rate - u, memory}).force;
          CHECK(at.dforce_drate == Approx((faster - slower) / (2.0 * u)).epsilon(1e-6).scale(1.0));
          // F d' = dS/dt + D, S a function of d alone.
          const double dS_dt = (up.stored_energy - down.stored_energy) / (2.0 * h) * rate;
          CHECK(at.force * rate == Approx(dS_dt + at.dissipated_power).epsilon(1e-5));
        }
      }
    }
  }
}

TEST_CASE("no law of any kind creates energy while it loads or unloads") {
  for (const ContactLaw& law : one_law_of_each_kind()) {
    CAPTURE(law.name());
    const ContactMemory memory{
        .phase = ContactPhase::compressing, .approach_velocity = 0.173, .effective_mass = 0.83};
    for (const double d : {0.0, 1.1e-7, 2.29e-5})
      CHECK(law.evaluate({d, 0.131, memory}).dissipated_power >= 0.0);
  }
}

TEST_CASE("Hunt and Crossley's laws return what their closed form says, not the nominal e") {
  // X (1 + e') = ln((1 + X)/(1 - e' X)), X = 3/2 (1 - e), for any elastic law; 10 digits.
  const auto nominal = [](double e) { return hunt_crossley_restitution(e); };
  CHECK(restitution({hertzian, nominal(0.9)}) == Approx(0.9090157413).epsilon(1e-7));
  CHECK(restitution({exact, nominal(0.5)}) == Approx(0.6629622000).epsilon(1e-7));
  CHECK(restitution({linear, nominal(0.1)}) == Approx(0.5158326164).epsilon(1e-7));
  // Constant alpha is the same law at this one speed.
  CHECK(restitution({exact, HuntCrossley{0.5 / approach}}) == Approx(0.6629622000).epsilon(1e-7));
}

TEST_CASE("the approach velocity has a floor, so that a contact at rest is not infinitely damped") {
  const ContactLaw law{linear, hunt_crossley_restitution(0.5)};
  const ContactMemory rest{.phase = ContactPhase::compressing, .approach_velocity = 0.0};
  const ContactMemory slow{.phase = ContactPhase::compressing, .approach_velocity = 1e-3};
  const ContactOutput at_rest = law.evaluate({1e-5, 1e-4, rest});
  CHECK(at_rest.force == law.evaluate({1e-5, 1e-4, slow}).force);
  CHECK(at_rest.dforce_drate == Approx(1.5 * 500.0 * 310.0));
}

TEST_CASE("Tsuji's and Kelvin and Voigt's damping return e, more if let go at zero force") {
  const auto clamp = TensilePhase::clamp;
  CHECK(restitution({hertzian, Tsuji{0.5}}) == Approx(0.5).epsilon(1e-6));
  CHECK(restitution({linear, KelvinVoigt{0.5}}) == Approx(0.5).epsilon(1e-7));
  CHECK(restitution({hertzian, Tsuji{0.5, clamp}}) == Approx(0.5502831696).epsilon(1e-6));
  CHECK(restitution({linear, KelvinVoigt{0.5, clamp}}) == Approx(0.5502831696).epsilon(1e-7));
}

TEST_CASE("damping by force over root of stored energy returns e for any elastic law") {
  for (const ElasticLaw& elastic : {ElasticLaw(hertzian), ElasticLaw(linear), ElasticLaw(exact)})
    CHECK(restitution({elastic, ExactRestitution{0.7}}) == Approx(0.7).epsilon(2e-5));
}

TEST_CASE("Lee and Wang's second law returns what its integration says") {
  CHECK(restitution({linear, LeeWang2{0.5, 2.0, 0.1}}) == Approx(0.548624).epsilon(3e-6));
  CHECK(restitution({linear, LeeWang2{0.5, 3.0, 0.5}}) == Approx(0.754865).epsilon(3e-6));
}

TEST_CASE("a permanent set of d_m (1 - e^2) returns e exactly for any elastic law") {
  for (const ElasticLaw& elastic : {ElasticLaw(hertzian), ElasticLaw(linear), ElasticLaw(exact)})
    CHECK(restitution({elastic, PermanentSet{0.7}}) == Approx(0.7).epsilon(1e-6));
}

TEST_CASE("what a law needs is read from the members it has") {
  const DissipativeLaw none, damped = HuntCrossley{0.1}, dented = PermanentSet{0.5};
  CHECK(none.none());
  CHECK_FALSE(damped.needs_largest_penetration());
  CHECK(damped.release() == Release::at_zero_force);
  CHECK(dented.needs_largest_penetration());
  const ContactMemory memory{.largest_penetration = 4e-5};
  CHECK(dented.permanent_set(memory, linear) == Approx(3e-5));
  CHECK(damped.permanent_set(memory, linear) == 0.0);
  CHECK(ContactLaw{linear, damped}.name() == "power-law with hunt-crossley");
}

TEST_CASE("wrong parameters of a dissipative law are refused") {
  CHECK_THROWS_WITH(DissipativeLaw{HuntCrossley{-0.1}},
                    "law 'hunt-crossley': alpha = -0.1 s/m must be finite and at least 0 s/m");
  CHECK_THROWS(DissipativeLaw{HuntCrossley{std::numeric_limits<double>::quiet_NaN()}});
  CHECK_THROWS(DissipativeLaw{hunt_crossley_restitution(1.2)});
  CHECK_THROWS(DissipativeLaw{hunt_crossley_restitution(0.9, 0.0)});
}
