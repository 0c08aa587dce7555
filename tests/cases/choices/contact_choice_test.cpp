// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What a user may write after --law.
#include <doctest/doctest.h>

#include <yoke/cases/choices/contact_choice.hpp>
#include <yoke/contact/laws/catalog/calibrated.hpp>
#include <yoke/contact/laws/catalog/dissipative_catalog.hpp>
#include <yoke/contact/laws/catalog/elastic_catalog.hpp>
#include <yoke/contact/laws/dissipative/flores.hpp>
#include <yoke/contact/laws/dissipative/hunt_crossley.hpp>
#include <yoke/contact/laws/elastic/hertz.hpp>
#include <yoke/contact/laws/elastic/johnson.hpp>
#include <yoke/contact/laws/elastic/power_law.hpp>
#include <yoke/tests/messages.hpp>

namespace {

using namespace yoke;
using namespace yoke::cases;
using yoke::tests::contains;
using yoke::tests::message_of;

const RoundPair bore{.pin_radius = 7.9e-3, .wall_radius = 8e-3, .conformity = Conformity::internal};
const RoundPair bulge{
    .pin_radius = 7.9e-3, .wall_radius = 52e-3, .conformity = Conformity::external};

/// Two walls, two laws: "soft" is the base.
ContactChoice choice() {
  return {.walls =
              [](const Parameters&) {
                return std::vector<Wall>{{"bore", bore, 10e-3}, {"bulge", bulge, 10e-3}};
              },
          .laws = {{"stiff", "",
                    [](const Parameters&, const Wall&) {
                      return ContactLaw{PowerLaw{3e9, 1.5, "stiff"}};
                    }},
                   {"soft", "",
                    [](const Parameters&, const Wall&) {
                      return ContactLaw{PowerLaw{1e7, 1.0, "soft"}, HuntCrossley{.alpha = 0.4}};
                    }}},
          .base = "soft"};
}

const Parameters none{std::vector<CaseParameter>{}};

WallLaws laws(std::string_view specification) { return make_laws(choice(), none, specification); }

std::string refusal(std::string_view specification) {
  return message_of([&] { laws(specification); });
}

constexpr double d = 12e-6;

/// The force of a law at a penetration, approaching with 0.2 m/s.
double force(const ContactLaw& law) {
  ContactMemory memory;
  memory.phase = ContactPhase::compressing;
  memory.approach_velocity = 0.3;
  memory.effective_mass = 1.0;
  return law.evaluate({d, 0.2, memory}).force;
}

TEST_SUITE("choice of laws") {
  TEST_CASE("a name of the case is its law on every wall, and nothing is its base law") {
    CHECK(force(laws("stiff")["bore"]) == force(ContactLaw{PowerLaw{3e9, 1.5}}));
    CHECK(force(laws("stiff")["bulge"]) == force(laws("stiff")["bore"]));
    CHECK(force(laws("")["bore"]) ==
          force(ContactLaw{PowerLaw{1e7, 1.0}, HuntCrossley{.alpha = 0.4}}));
  }

  TEST_CASE("laws of the catalogue take the radii and the length of the wall") {
    const WallLaws both = laws("johnson+flores:e=0.8");
    CHECK(force(both["bore"]) == force(ContactLaw{johnson(bore, 10e-3), Flores{.e = 0.8}}));
    CHECK(force(both["bulge"]) == force(ContactLaw{johnson(bulge, 10e-3), Flores{.e = 0.8}}));
    CHECK(force(laws("johnson:length=4mm+none")["bore"]) == force(ContactLaw{johnson(bore, 4e-3)}));
    RoundPair mixed = bore;
    mixed.pin = aluminium;
    mixed.wall = {.E = 100e9, .nu = 0.25};
    CHECK(
        force(laws("johnson:pin_material=aluminium,wall_material=E=100GPa/nu=0.25+none")["bore"]) ==
        force(ContactLaw{johnson(mixed, 10e-3)}));
    CHECK(force(laws("power:K=2e+9,n=1.5+none")["bore"]) == force(ContactLaw{PowerLaw{2e9, 1.5}}));
  }

  TEST_CASE("half a specification is completed from the base law") {
    CHECK(force(laws("hertz")["bore"]) ==
          force(ContactLaw{hertz(bore), HuntCrossley{.alpha = 0.4}}));
    CHECK(force(laws("flores:restitution=0.7")["bore"]) ==
          force(ContactLaw{PowerLaw{1e7, 1.0}, Flores{.e = 0.7}}));
    CHECK(force(laws("stiff+hunt-crossley:alpha=0.1s/m")["bore"]) ==
          force(ContactLaw{PowerLaw{3e9, 1.5}, HuntCrossley{.alpha = 0.1}}));
  }

  TEST_CASE("walls have laws of their own") {
    const WallLaws mixed = laws("stiff,bulge=power:K=1e8,n=1.2+none");
    CHECK(force(mixed["bore"]) == force(ContactLaw{PowerLaw{3e9, 1.5}}));
    CHECK(force(mixed["bulge"]) == force(ContactLaw{PowerLaw{1e8, 1.2}}));
    const WallLaws each = laws("bulge=stiff,bore=johnson+flores:e=0.6");
    CHECK(force(each["bulge"]) == force(ContactLaw{PowerLaw{3e9, 1.5}}));
    CHECK(force(each["bore"]) == force(ContactLaw{johnson(bore, 10e-3), Flores{.e = 0.6}}));
    // A wall that is not named has the base law.
    CHECK(force(laws("bulge=stiff")["bore"]) == force(laws("soft")["bore"]));
    CHECK(contains(message_of([&] { each["cap"]; }), "unknown wall 'cap'"));
  }

  TEST_CASE("`delivers` makes a law return what is asked") {
    CHECK(force(laws("soft+lankarani-nikravesh:delivers=0.8")["bore"]) ==
          force(ContactLaw{PowerLaw{1e7, 1.0}, calibrated("lankarani-nikravesh", 0.8)}));
  }

  TEST_CASE("every law of the catalogues can be written") {
    for (const ElasticNote& note : elastic_catalog()) {
      INFO(note.name);
      const std::string arguments = note.name == "power" ? ":K=1e8,n=1.5" : "";
      CHECK(force(laws("bore=" + note.name + arguments + "+none")["bore"]) > 0.0);
    }
    for (const DissipativeNote& note : dissipative_catalog()) {
      INFO(note.name);
      bool has_restitution = false;
      for (const auto& [name, range] : note.parameters)
        has_restitution = has_restitution || name == "restitution";
      CHECK(force(laws("soft+" + note.name + (has_restitution ? ":e=0.7" : ""))["bore"]) > 0.0);
    }
  }

  TEST_CASE("mistakes are explained by name, value and what is accepted") {
    CHECK(contains(refusal("sofd"), "unknown law 'sofd'; did you mean 'soft'? Known: 'stiff'"));
    CHECK(contains(refusal("herz+none"), "unknown elastic law 'herz'; did you mean 'hertz'?"));
    CHECK(contains(refusal("hertz+florse:e=0.8"),
                   "unknown dissipative law 'florse'; did you mean 'flores'?"));
    CHECK(contains(refusal("hertz+flores"),
                   "law 'flores': its restitution is missing; for instance flores:e=0.8"));
    CHECK(contains(refusal("hertz+flores:e=1.8"), "1.8"));
    CHECK(contains(refusal("hertz+flores:e=0.8m"), "has the unit 'm'"));
    CHECK(contains(refusal("hertz+flores:alpha=1"), "law 'flores': unknown argument 'alpha'"));
    CHECK(contains(refusal("hertz:lenght=1mm+none"), "did you mean 'length'?"));
    CHECK(contains(refusal("johnson:length=0mm+none"), "length = 0"));
    CHECK(contains(refusal("soft:e=1"), "law 'soft' takes no arguments, not 'e'"));
    CHECK(contains(refusal("pereira-2011"),
                   "wall 'bulge': law 'pereira-2011': conformity = external must be internal"));
    CHECK(contains(refusal("power+none"), "give its constants"));
    CHECK(contains(refusal("bor=stiff"), "unknown wall 'bor'; did you mean 'bore'?"));
    CHECK(contains(refusal("bore=stiff,bore=soft"), "wall 'bore' is given twice"));
    CHECK(contains(refusal("lankarani-nikravesh"),
                   "is the name of an elastic and of a dissipative law"));
    CHECK(contains(refusal("hertz+kelvin-voigt:e=0.8,tensile=maybe"),
                   "'maybe' is not keep or clamp"));
    CHECK(contains(message_of([] { choose_laws(choice(), {"sofd"}); }), "did you mean 'soft'?"));
  }

  TEST_CASE("chosen laws: those of the case in its order, then the others, none twice") {
    const std::vector<std::string> all{"stiff", "soft"};
    CHECK(choose_laws(choice(), {}) == all);
    const std::vector<std::string> mixed{"stiff", "soft", "hertz", "hertz+none"};
    CHECK(choose_laws(choice(), {"hertz", "soft", "hertz+none", "stiff", "hertz"}) == mixed);
  }

  TEST_CASE("folders of specifications are plain and differ") {
    const std::vector<std::string> names =
        folder_names({"soft", "a:x=1/2", "a_x=1/2", "plots", std::string(300, 'z')});
    CHECK(names[0] == "soft");
    CHECK(names[1] == "a_x=1_2");
    CHECK(names[2] == "a_x=1_2-2");
    CHECK(names[3] != "plots");
    CHECK(names[4].size() == 200);
  }
}

}  // namespace
