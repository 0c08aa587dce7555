// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Laws whose numbers may be changed during a run: what they give, and to whom their numbers belong.
// Runs with them: tests/integrators/contacts/changed_law_test.cpp.
#include <doctest/doctest.h>

#include <string>

#include <yoke/contact/disc_on_curve.hpp>
#include <yoke/contact/geometry/arc_slot.hpp>
#include <yoke/contact/laws/dissipative/exact_restitution.hpp>
#include <yoke/contact/laws/dissipative/lee_wang_2.hpp>
#include <yoke/contact/laws/elastic/power_law.hpp>
#include <yoke/contact/laws/friction/coulomb.hpp>
#include <yoke/contact/laws/friction/lugre.hpp>
#include <yoke/contact/pin_in_slot.hpp>
#include <yoke/core/curves/lines_and_arcs.hpp>
#include <yoke/tests/messages.hpp>

namespace {

using namespace yoke;
using namespace yoke::tests;

/// A law of a user's own, with an end.
struct Ending {
  double K = 1.0;
  static constexpr LawField<Ending> fields[] = {{"K", "N/m", &Ending::K}};
  ElasticResponse operator()(double d) const { return {K * d, K, 0.5 * K * d * d}; }
  double limit() const { return 1e-3; }
};

std::vector<std::string> names_of(const Model& m) {
  std::vector<std::string> names;
  for (const OwnedParameter& p : m.parameters()) names.push_back(p.name());
  return names;
}

Model disc_on_floor(const ContactLaw& law) {
  Model m;
  const BodyId disc =
      m.add(Body{.name = "disc", .mass = 1.0, .inertia = 0.01, .pose = {{0.0, 0.1}, 0.0}});
  m.add(DiscOnCurve{.name = "floor",
                    .disc = {.body = disc, .at = {0.0, 0.1}, .radius = 0.1},
                    .body = ground,
                    .curve = straight_line({-5.0, 0.0}, {5.0, 0.0}),
                    .law = law});
  return m;
}

}  // namespace

TEST_CASE("a changeable law with other numbers is the law made with these") {
  const ContactLaw law{changeable(PowerLaw{1e7, 1.2}), changeable(LeeWang2{.e = 0.7}),
                       changeable(Coulomb{.mu = 0.1, .mu_static = 0.2})};
  const double values[] = {3e7, 0.4, 0.3, 0.5};
  const ContactLaw now = law.bound(values);
  const ContactLaw made{PowerLaw{3e7, 1.2}, LeeWang2{.e = 0.4},
                        Coulomb{.mu = 0.3, .mu_static = 0.5}};
  const ContactMemory memory{.approach_velocity = 0.3, .effective_mass = 2.0};
  for (const double d : {-1e-5, 1e-6, 1e-4}) {
    const ContactInput in{d, 0.05, memory};
    CHECK(now.evaluate(in).force == made.evaluate(in).force);
    CHECK(now.evaluate(in).dforce_drate == made.evaluate(in).dforce_drate);
    CHECK(now.evaluate(in).stored_energy == made.evaluate(in).stored_energy);
    CHECK(now.dissipation.kink(in, now.elastic) == made.dissipation.kink(in, made.elastic));
    CHECK(now.evaluate(in).force != law.evaluate(in).force);
  }
  CHECK(now.dissipation.has_kink());
  CHECK(now.dissipation.release() == made.dissipation.release());
  CHECK(now.friction.evaluate({.normal_force = 10.0, .direction = 1.0}).force == 3.0);
  CHECK(now.friction.holding_force(10.0) == 5.0);
  CHECK(law.friction.holding_force(10.0) == 2.0);
}

TEST_CASE("numbers of laws are parameters of the contact that has them") {
  const ContactLaw law{changeable(per_mm(49070, 1.1)), ExactRestitution{0.5},
                       changeable(LuGre{.mu = 0.1, .mu_static = 0.2})};
  const Model m = disc_on_floor(law);
  const std::vector<std::string> names = names_of(m);
  REQUIRE(names.size() == 7);
  CHECK(names[0] == "floor.stiffness");
  CHECK(names[1] == "floor.mu");
  CHECK(m.start_state().parameters[0] == per_mm(49070, 1.1).K);
  CHECK(m.parameter(0).unit == "N/m^n");
  const ContactLaw fixed{per_mm(49070, 1.1), ExactRestitution{0.5}, Coulomb{0.1, 0.2}};
  CHECK(disc_on_floor(fixed).start_state().parameters.empty());
}

TEST_CASE("walls with one law share its numbers, walls with several have their own") {
  const auto slot = [](const SlotLaws& laws) {
    Model m;
    const BodyId pin =
        m.add(Body{.name = "pin", .mass = 1.0, .inertia = 0.01, .pose = {{1.0, 0.0}, 0.0}});
    m.add(PinInSlot{.name = "slot",
                    .pin = {pin, {1.0, 0.0}, 7.9e-3},
                    .slot = {ground, arc_slot({.radius = 1.0, .angle = 1.0, .half_width = 8e-3})},
                    .law = laws});
    return names_of(m);
  };
  const ContactLaw law{per_mm(49070, 1.1), changeable(ExactRestitution{0.5})};
  CHECK(slot(law) == std::vector<std::string>{"slot.restitution"});
  const ContactLaw other{per_mm(49070, 1.1), changeable(ExactRestitution{0.6})};
  const std::vector<std::string> names = slot({law, other, other});
  REQUIRE(names.size() == 2);
  CHECK(names[0].starts_with("slot."));
  CHECK(names[0].ends_with(".restitution"));
  CHECK(names[0] != names[1]);
}

TEST_CASE("numbers that a law does not take are refused with contact, law, value and range") {
  const Model m = disc_on_floor({changeable(per_mm(49070, 1.1)), changeable(ExactRestitution{0.5}),
                                 changeable(Coulomb{0.1, 0.2})});
  const auto refused = [&](std::size_t index, double value) {
    std::vector<double> values = m.start_state().parameters;
    values[index] = value;
    return message_of([&] { m.check_parameters(values); });
  };
  CHECK(refused(1, 0.6) == "no error");
  CHECK(refused(1, 2.0) ==
        "'floor': law 'exact-restitution': e = 2 is outside the accepted range 0.001 to 1");
  CHECK(contains(refused(0, -1.0), "'floor': law 'power-law': K = -1 N/m^n must be"));
  CHECK(contains(refused(2, 0.3), "mu_static = 0.2 must be at least mu = 0.3"));
  CHECK(contains(message_of([] { disc_on_floor({changeable(Ending{1e7})}); }),
                 "contact 'floor': the law 'elastic law' ends at 0.001 m; its stiffness cannot be "
                 "changeable"));
}
