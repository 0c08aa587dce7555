// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A contact that was let go within the wall, as the damping would have pulled, ends where the
// penetration is zero. The law's slope jumps there, so two event functions cross within rounding;
// the end of the contact may not be lost behind the other: the pin would pass through the next wall.
// A case that random mechanisms found.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include <yoke/contact/geometry/arc_slot.hpp>
#include <yoke/contact/laws/catalog/dissipative_catalog.hpp>
#include <yoke/contact/laws/catalog/elastic_catalog.hpp>
#include <yoke/contact/pin_in_slot.hpp>
#include <yoke/integrators/simulate.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/revolute.hpp>

using namespace yoke;

namespace {

Model lever_in_a_slot() {
  Model m;
  const BodyId body1 = m.add(Body{.name = "body1",
                                  .mass = 0.76,
                                  .inertia = 4.4999999999999996e-05,
                                  .pose = {{0.022, -0.021}, -1.9534070469423583},
                                  .twist = {{0, 0}, -2.8000000000000003}});
  m.add(Revolute{.name = "pin1", .a = ground, .b = body1, .at = {0.025, -0.017}});
  m.add(PinInSlot{
      .name = "slot2",
      .pin = {body1, {0.017226628051638986, -0.00843650541114788}, 0.0009588628204126467},
      .slot = {ground, arc_slot({.center = {-0.015872503426795276, -0.01232152407479959},
                                 .radius = 0.03335147315982378,
                                 .direction = 0.1568169679434348,
                                 .angle = 1.5220529116926018,
                                 .half_width = 0.0009916093542935408})},
      .law = SlotLaws(
          ContactLaw{
              make_elastic("dubowsky-freudenstein", {.pin = {628221719760.8478, 0.3},
                                                     .wall = {628221719760.8478, 0.3},
                                                     .pin_radius = 0.0009588628204126467,
                                                     .wall_radius = 0.032359863805530235,
                                                     .conformity = Conformity::external,
                                                     .length = 0.00151343076525754}),
              make_dissipative("herbert-mcwhannell", {.restitution = 0.7167974728116105,
                                                      .slowest_approach = 0.0002462250146874669,
                                                      .q = 3.337642799817905,
                                                      .epsilon = 0.1,
                                                      .tensile = TensilePhase::clamp})},
          ContactLaw{make_elastic("radzimovsky", {.pin = {115012023577.58788, 0.3},
                                                  .wall = {115012023577.58788, 0.3},
                                                  .pin_radius = 0.0009588628204126467,
                                                  .wall_radius = 0.0009916093542935408,
                                                  .conformity = Conformity::internal,
                                                  .length = 0.0016229673409405918}),
                     make_dissipative("tsuji", {.restitution = 0.6648339005650071,
                                                .slowest_approach = 0.00013800592885326464,
                                                .q = 3.3940803376811557,
                                                .epsilon = 0.1,
                                                .tensile = TensilePhase::clamp})},
          ContactLaw{make_elastic("pereira-2011", {.pin = {563411445215.1232, 0.3},
                                                   .wall = {563411445215.1232, 0.3},
                                                   .pin_radius = 0.0009588628204126467,
                                                   .wall_radius = 0.0009916093542935408,
                                                   .conformity = Conformity::internal,
                                                   .length = 0.0009836811050975992}),
                     make_dissipative("hu-guo", {.restitution = 0.7531118139163425,
                                                 .slowest_approach = 0.0002557231852014697,
                                                 .q = 3.929687605648858,
                                                 .epsilon = 0.1,
                                                 .tensile = TensilePhase::clamp})}),
      .reference_force = 10.745626530235581});
  m.add(
      PinInSlot{.name = "slot3",
                .pin = {body1, {0.00394068645191464, -0.01031178371198102}, 0.0012111902027650274},
                .slot = {ground, arc_slot({.center = {-0.002679053044748736, -0.052376052744603725},
                                           .radius = 0.04249335032867328,
                                           .direction = 2.0093132849650583,
                                           .angle = 2.7799619964486766,
                                           .half_width = 0.0014968783395926967})},
                .law = SlotLaws(ContactLaw{
                    make_elastic("radzimovsky", {.pin = {3458457438.1624985, 0.3},
                                                 .wall = {3458457438.1624985, 0.3},
                                                 .pin_radius = 0.0012111902027650274,
                                                 .wall_radius = 0.0014968783395926967,
                                                 .conformity = Conformity::internal,
                                                 .length = 0.0015681460790605024}),
                    make_dissipative("hunt-crossley", {.restitution = 0.8715987362238184,
                                                       .slowest_approach = 0.00022274232973889627,
                                                       .q = 2.330090576663238,
                                                       .epsilon = 0.1,
                                                       .tensile = TensilePhase::keep})}),
                .reference_force = 2.7237957482157937});
  return m;
}

}  // namespace

TEST_CASE("a contact let go within the wall ends at the wall, and the next wall is met") {
  const Model m = lever_in_a_slot();
  double first = 0.0;
  for (const std::string formulation :
       {"arkode-projection", "generalised-alpha", "ida-ggl", "adams-baumgarte"})
    for (const double tolerance : {1e-7, 1e-8, 1e-9}) {
      INFO(formulation << " at " << tolerance);
      const Result run = simulate(m, {.until = 0.0125,
                                      .relative_tolerance = tolerance,
                                      .formulation = formulation,
                                      .samples = 2});
      REQUIRE(run.summary.ok());
      std::string sequence;
      for (const EventRecord& event : run.events)
        sequence += event.kind + " " + event.region + ", ";
      CHECK(sequence == "onset outer, release outer, onset inner, release inner, ");
      const double omega = run["body1.omega_rad_per_s"](1);
      if (first == 0.0) first = omega;
      CHECK(omega == doctest::Approx(first).epsilon(1e-4));
    }
}
