// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The contact laws of a case: the walls it has, the laws it offers by name, and any law of the
// catalogue for any wall. What a user writes after --law is a specification:
//
//   NAME                        a law of the case: johnson
//   ELASTIC+DISSIPATIVE         laws of the catalogue, each with its arguments, if any:
//                               johnson+hunt-crossley:alpha=0.32s/m
//                               power:K=1e8,n=1.5+flores:restitution=0.8
//   ELASTIC or DISSIPATIVE      the other part is that of the case's base law: hertz
//   SPEC+FRICTION               any of these with a friction law, or FRICTION alone for the base law:
//                               johnson+brown-mcphee:mu=0.1,mu_static=0.12
//   SPEC,WALL=SPEC,WALL=SPEC    a law for all walls (optional if each is named), then for single
//                               ones: johnson,outer=hertz+none
//
// The part before the "+" may also be a law of the case, whose elastic part is then taken.
// Arguments of an elastic law: reading, length, material, pin_material, wall_material
// (material=steel, material=E=207GPa/nu=0.3); of power: K, n, unit. Arguments of a dissipative law:
// those that `yoke law show NAME` lists, `e` for restitution, and `delivers`, the restitution that
// a free impact is to deliver (contact/laws/catalog/calibrated.hpp). Those of a friction law are
// likewise listed by `yoke law show NAME`.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <yoke/cases/choices/parameters.hpp>
#include <yoke/contact/laws/law.hpp>
#include <yoke/contact/laws/material.hpp>

namespace yoke::cases {

/// A place where two surfaces touch, as an elastic law needs to know it.
struct Wall {
  std::string name;     // "inner"; a word, without '=', ',' and '+'
  RoundPair pair{};     // radii [m], conformity and materials
  double length = 0.0;  // [m] of the line of contact
};

/// The law of each wall of a case.
class WallLaws {
 public:
  void set(std::string wall, ContactLaw law);
  /// Throws ModelError that lists the walls.
  const ContactLaw& operator[](std::string_view wall) const;
  const std::vector<std::pair<std::string, ContactLaw>>& all() const { return laws_; }
  bool have_friction() const;

 private:
  std::vector<std::pair<std::string, ContactLaw>> laws_;
};

/// A law that a case offers by name.
struct NamedLaw {
  std::string name;
  std::string description;  // one line
  std::function<ContactLaw(const Parameters&, const Wall&)> make;
};

struct ContactChoice {
  std::function<std::vector<Wall>(const Parameters&)> walls{};
  std::vector<NamedLaw> laws{};
  std::string base{};  // the law that completes half a specification; "": the first of `laws`
};

/// The name of the law that completes half a specification; "" if there are no laws.
std::string base_law_name(const ContactChoice& contact);

/// See cases::choose_laws(const Case&, ...).
std::vector<std::string> choose_laws(const ContactChoice& contact,
                                     const std::vector<std::string>& laws);

/// The law of every wall for one specification; "" is the base law. Throws ModelError for an
/// unknown name, wall or argument, a missing restitution, a value out of range.
WallLaws make_laws(const ContactChoice& contact, const Parameters& parameters,
                   std::string_view specification);

/// A specification with friction put into it, "" for the base law. `friction` is FRICTION for all walls,
/// or FRICTION,WALL=FRICTION, "none" for none: the same commas as in a specification. Throws ModelError
/// for an unknown law or wall.
std::string with_friction(const ContactChoice& contact, const Parameters& parameters,
                          std::string_view specification, std::string_view friction);

/// A folder for each specification: its text with '_' for what shells and file systems take for
/// their own, and a number behind it where two would be equal.
std::vector<std::string> folder_names(const std::vector<std::string>& specifications);

}  // namespace yoke::cases
