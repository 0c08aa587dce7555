// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/choices/contact_choice.hpp>

#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <optional>

#include <yoke/cases/choices/material.hpp>
#include <yoke/contact/laws/catalog/calibrated.hpp>
#include <yoke/contact/laws/catalog/dissipative_catalog.hpp>
#include <yoke/contact/laws/catalog/elastic_catalog.hpp>
#include <yoke/contact/laws/catalog/friction_catalog.hpp>
#include <yoke/core/error.hpp>

namespace yoke::cases {

namespace {

using Texts = std::vector<std::string>;

/// "name:a=1,b=2" taken apart.
struct Part {
  std::string name;
  std::string arguments;  // "a=1,b=2"
};

Part part_of(std::string_view text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos) return {std::string(text), {}};
  return {std::string(text.substr(0, colon)), std::string(text.substr(colon + 1))};
}

Texts split(std::string_view text, char separator) {
  Texts items;
  while (true) {
    const std::size_t end = text.find(separator);
    items.emplace_back(text.substr(0, end));
    if (end == std::string_view::npos) return items;
    text.remove_prefix(end + 1);
  }
}

/// The "+" between two laws; that of a number such as 1e+8 has a digit behind it.
std::size_t find_plus(std::string_view text) {
  for (std::size_t i = 0; i + 1 < text.size(); ++i)
    if (text[i] == '+' && std::isalpha(static_cast<unsigned char>(text[i + 1])) != 0) return i;
  return std::string_view::npos;
}

const NamedLaw* find_named(const ContactChoice& contact, std::string_view name) {
  const auto found = std::ranges::find(contact.laws, name, &NamedLaw::name);
  return found == contact.laws.end() ? nullptr : &*found;
}

const NamedLaw& base_law(const ContactChoice& contact) {
  const NamedLaw* base = find_named(contact, contact.base);
  return base != nullptr ? *base : contact.laws.front();
}

template <class Notes>
bool lists(const Notes& notes, std::string_view name) {
  return std::ranges::any_of(notes, [&](const auto& note) { return note.name == name; });
}
bool is_elastic(std::string_view name) { return lists(elastic_catalog(), name); }
bool is_dissipative(std::string_view name) { return lists(dissipative_catalog(), name); }
bool is_friction(std::string_view name) { return lists(friction_catalog(), name); }

/// Ends the message about an unknown name. All names may be near, only those of the case are
/// listed.
std::string hint(std::string_view name, const Texts& own, const Texts& catalogue,
                 const char* where) {
  Texts all = own;
  all.insert(all.end(), catalogue.begin(), catalogue.end());
  const std::string nearest = nearest_word(name, all);
  return fmt::format("{} Known: '{}'{}",
                     nearest.empty() ? ";" : fmt::format("; did you mean '{}'?", nearest),
                     fmt::join(own.empty() ? catalogue : own, "', '"), own.empty() ? "" : where);
}

Texts names_of(const ContactChoice& contact) {
  Texts names;
  for (const NamedLaw& law : contact.laws) names.push_back(law.name);
  return names;
}

Texts elastic_names() {
  Texts names;
  for (const ElasticNote& note : elastic_catalog()) names.push_back(note.name);
  return names;
}

Texts dissipative_names() {
  Texts names;
  for (const DissipativeNote& note : dissipative_catalog()) names.push_back(note.name);
  return names;
}

Texts friction_names() {
  Texts names;
  for (const FrictionNote& note : friction_catalog()) names.push_back(note.name);
  return names;
}

[[noreturn]] void throw_unknown(const ContactChoice& contact, std::string_view name) {
  Texts catalogue = elastic_names();
  for (const std::string& other : dissipative_names()) catalogue.push_back(other);
  for (const std::string& other : friction_names()) catalogue.push_back(other);
  throw ModelError(fmt::format("unknown law '{}'{}", name,
                               hint(name, names_of(contact), catalogue,
                                    ", and the laws of 'yoke law list', as hertz+flores:e=0.8")));
}

// ---- arguments

struct Argument {
  std::string name, value;
};

std::vector<Argument> arguments_of(const std::string& law, const std::string& text) {
  std::vector<Argument> all;
  if (text.empty()) return all;
  for (const std::string& item : split(text, ',')) {
    const std::size_t equals = item.find('=');
    if (equals == std::string::npos || equals == 0)
      throw ModelError(fmt::format("law '{}': '{}' is not an argument name=value", law, item));
    all.push_back({item.substr(0, equals), item.substr(equals + 1)});
  }
  return all;
}

[[noreturn]] void throw_argument(const std::string& law, const std::string& name,
                                 const Texts& known) {
  throw ModelError(known.empty() ? fmt::format("law '{}' takes no arguments, not '{}'", law, name)
                                 : fmt::format("law '{}': unknown argument '{}'{}", law, name,
                                               suggestion(name, known)));
}

ElasticLaw elastic_of(const Part& part, const Wall& wall) {
  ElasticArguments a{.pin = wall.pair.pin,
                     .wall = wall.pair.wall,
                     .pin_radius = wall.pair.pin_radius,
                     .wall_radius = wall.pair.wall_radius,
                     .conformity = wall.pair.conformity,
                     .length = wall.length};
  if (part.name == "power") {
    // The constants are all it has; make_elastic() explains what is wrong with them.
    return make_elastic(part.arguments.empty() ? part.name : part.name + ":" + part.arguments, a);
  }
  const std::string owner = fmt::format("law '{}'", part.name);
  const auto material = [](std::string value) {
    std::ranges::replace(value, '/', ',');
    return parse_material(value);
  };
  for (const auto& [name, value] : arguments_of(part.name, part.arguments)) {
    if (name == "reading") {
      a.reading = reading_named(value);
    } else if (name == "length") {
      a.length = parse_metres(owner + ": length", value);
      require_positive(owner, "length", a.length, "m");
    } else if (name == "material") {
      a.pin = a.wall = material(value);
    } else if (name == "pin_material") {
      a.pin = material(value);
    } else if (name == "wall_material") {
      a.wall = material(value);
    } else {
      throw_argument(part.name, name,
                     {"reading", "length", "material", "pin_material", "wall_material"});
    }
  }
  try {
    return make_elastic(part.name, a);
  } catch (const ModelError& error) {  // another wall may suit it
    throw ModelError(fmt::format("wall '{}': {}", wall.name, error.what()));
  }
}

bool parse_yes(const std::string& owner, const std::string& value) {
  if (value != "yes" && value != "no")
    throw ModelError(fmt::format("{}: '{}' is not yes or no", owner, value));
  return value == "yes";
}

DissipativeLaw dissipative_of(const Part& part) {
  const DissipativeNote& note = find_dissipative(part.name);
  Texts known;
  for (const auto& [name, range] : note.parameters) known.push_back(name);
  const bool takes_restitution = std::ranges::find(known, "restitution") != known.end();
  if (takes_restitution) known.insert(known.end(), {"e", "delivers"});

  DissipativeArguments a;
  std::optional<double> delivers;
  bool has_restitution = false;
  for (const auto& [name, value] : arguments_of(part.name, part.arguments)) {
    if (std::ranges::find(known, name) == known.end()) throw_argument(part.name, name, known);
    const std::string owner = fmt::format("law '{}': {}", part.name, name);
    if (name == "restitution" || name == "e") {
      a.restitution = parse_in(owner, value, "");
      has_restitution = true;
    } else if (name == "delivers") {
      delivers = parse_in(owner, value, "");
    } else if (name == "alpha") {
      a.alpha = parse_quantity(owner, Quantity::time_per_length,
                               parse_number(owner, value).unit.empty() ? value + "s/m" : value);
    } else if (name == "slowest_approach") {
      a.slowest_approach = parse_in(owner, value, "m/s");
    } else if (name == "q") {
      a.q = parse_in(owner, value, "");
    } else if (name == "epsilon") {
      a.epsilon = parse_in(owner, value, "");
    } else if (name == "empirical") {
      a.empirical = parse_yes(owner, value);
    } else if (name == "tensile") {
      if (value != "keep" && value != "clamp")
        throw ModelError(fmt::format("{}: '{}' is not keep or clamp", owner, value));
      a.tensile = value == "keep" ? TensilePhase::keep : TensilePhase::clamp;
    }
  }
  if (delivers) return calibrated(part.name, *delivers, a);
  if (takes_restitution && !has_restitution && !a.alpha && !a.empirical)
    throw ModelError(
        fmt::format("law '{0}': its restitution is missing; for instance {0}:e=0.8", part.name));
  return make_dissipative(part.name, a);
}

FrictionLaw friction_of(const Part& part) {
  const FrictionNote& note = find_friction(part.name);
  Texts known;
  for (const FrictionParameter& p : note.parameters) known.push_back(p.name);
  std::vector<std::pair<std::string, double>> values;
  for (const auto& [name, value] : arguments_of(part.name, part.arguments)) {
    const auto parameter = std::ranges::find(note.parameters, name, &FrictionParameter::name);
    if (parameter == note.parameters.end()) throw_argument(part.name, name, known);
    values.emplace_back(
        name, parse_in(fmt::format("friction '{}': {}", part.name, name), value, parameter->unit));
  }
  return make_friction(part.name, values);
}

// ---- specifications

/// Where the friction begins in a specification for one wall, behind its last "+" if it has one; npos if
/// there is none. A case may name a law after its friction.
std::size_t find_friction_part(const ContactChoice& contact, std::string_view text) {
  std::size_t begin = 0;
  for (std::size_t plus = 0; plus != std::string_view::npos; plus = find_plus(text.substr(begin)))
    begin += plus > 0 ? plus + 1 : 0;
  if (begin == 0 && find_named(contact, text) != nullptr) return std::string_view::npos;
  return is_friction(part_of(text.substr(begin)).name) ? begin : std::string_view::npos;
}

ContactLaw make_normal_law(const ContactChoice& contact, const Parameters& parameters,
                           const Wall& wall, std::string_view text);

/// The law of one wall.
ContactLaw make_law(const ContactChoice& contact, const Parameters& parameters, const Wall& wall,
                    std::string_view text) {
  const std::size_t friction = find_friction_part(contact, text);
  if (friction == std::string_view::npos) return make_normal_law(contact, parameters, wall, text);
  const std::string_view before = text.substr(0, friction > 0 ? friction - 1 : 0);
  ContactLaw law = make_normal_law(contact, parameters, wall, before);
  law.friction = friction_of(part_of(text.substr(friction)));
  return law;
}

/// Its part along the normal.
ContactLaw make_normal_law(const ContactChoice& contact, const Parameters& parameters,
                           const Wall& wall, std::string_view text) {
  const auto base = [&] { return base_law(contact).make(parameters, wall); };
  const std::size_t plus = find_plus(text);
  const Part first = part_of(text.substr(0, plus));
  const NamedLaw* named = find_named(contact, first.name);
  const bool bare_name = named != nullptr && first.arguments.empty();
  if (plus == std::string_view::npos) {
    if (text.empty()) return base();
    if (bare_name) return named->make(parameters, wall);
    const bool elastic = is_elastic(first.name), dissipative = is_dissipative(first.name);
    if (elastic && dissipative)
      throw ModelError(
          fmt::format("law '{0}' is the name of an elastic and of a dissipative law; write "
                      "{0}+DISSIPATIVE or ELASTIC+{0}:e=0.8",
                      first.name));
    if (elastic) return {elastic_of(first, wall), base().dissipation};
    if (dissipative) return {base().elastic, dissipative_of(first)};
    if (named != nullptr)
      throw_argument(first.name, arguments_of(first.name, first.arguments)[0].name, {});
    throw_unknown(contact, first.name);
  }
  const Part second = part_of(text.substr(plus + 1));
  if (!bare_name && !is_elastic(first.name)) {
    if (named != nullptr)
      throw_argument(first.name, arguments_of(first.name, first.arguments)[0].name, {});
    throw ModelError(fmt::format("unknown elastic law '{}'{}", first.name,
                                 hint(first.name, names_of(contact), elastic_names(),
                                      ", and the elastic laws of 'yoke law list'")));
  }
  if (!is_dissipative(second.name)) {
    Texts known = dissipative_names();
    for (const std::string& name : friction_names()) known.push_back(name);
    throw ModelError(
        fmt::format("unknown dissipative law '{}'{}", second.name, suggestion(second.name, known)));
  }
  if (find_plus(second.arguments) != std::string_view::npos)
    throw ModelError(fmt::format(
        "unknown friction law '{}'{}",
        part_of(std::string_view(second.arguments).substr(find_plus(second.arguments) + 1)).name,
        suggestion("", friction_names())));
  return {bare_name ? named->make(parameters, wall).elastic : elastic_of(first, wall),
          dissipative_of(second)};
}

/// A specification by walls: that of all ("" if none), and those of single ones.
struct ByWall {
  std::string all;
  std::vector<std::pair<std::string, std::string>> single;
};

// A comma also separates the arguments of a law, so a piece begins another wall only if it starts
// with the name of one.
ByWall split_by_wall(std::string_view text, const std::vector<Wall>& walls) {
  ByWall by_wall;
  std::string* current = &by_wall.all;
  for (const std::string& piece : split(text, ',')) {
    const std::size_t equals = piece.find('=');
    const auto wall = std::ranges::find(walls, piece.substr(0, equals), &Wall::name);
    if (equals != std::string::npos && wall != walls.end()) {
      if (std::ranges::find(by_wall.single, wall->name,
                            &std::pair<std::string, std::string>::first) != by_wall.single.end())
        throw ModelError(fmt::format("--law {}: wall '{}' is given twice", text, wall->name));
      by_wall.single.emplace_back(wall->name, piece.substr(equals + 1));
      current = &by_wall.single.back().second;
    } else {
      if (!current->empty()) *current += ',';
      *current += piece;
    }
  }
  return by_wall;
}

/// The text for one wall of what was split.
std::string_view of_wall(const ByWall& by_wall, std::string_view wall) {
  for (const auto& [name, text] : by_wall.single)
    if (name == wall) return text;
  return by_wall.all;
}

/// A first piece such as "iner=hertz" is meant for a wall that does not exist.
void check_wall_names(const std::string& all, const std::vector<Wall>& walls) {
  const std::size_t equals = all.find('='), colon = all.find(':');
  if (equals == std::string::npos || colon < equals) return;
  Texts known;
  for (const Wall& wall : walls) known.push_back(wall.name);
  const std::string name = all.substr(0, equals);
  throw ModelError(fmt::format("unknown wall '{}'{}", name, suggestion(name, known)));
}

}  // namespace

void WallLaws::set(std::string wall, ContactLaw law) {
  laws_.emplace_back(std::move(wall), std::move(law));
}

bool WallLaws::have_friction() const {
  return std::ranges::any_of(laws_, [](const auto& each) { return !each.second.friction.none(); });
}

const ContactLaw& WallLaws::operator[](std::string_view wall) const {
  std::vector<std::string> known;
  for (const auto& [name, law] : laws_) {
    if (name == wall) return law;
    known.push_back(name);
  }
  throw ModelError(fmt::format("unknown wall '{}'{}", wall, suggestion(wall, known)));
}

std::string base_law_name(const ContactChoice& contact) {
  return contact.laws.empty() ? "" : base_law(contact).name;
}

std::vector<std::string> choose_laws(const ContactChoice& contact,
                                     const std::vector<std::string>& laws) {
  Texts chosen;
  for (const NamedLaw& law : contact.laws)
    if (laws.empty() || std::ranges::find(laws, law.name) != laws.end()) chosen.push_back(law.name);
  for (const std::string& law : laws) {
    const bool specification = law.find_first_of(":+=,") != std::string::npos;
    if (!specification && find_named(contact, law) == nullptr && !is_elastic(law) &&
        !is_dissipative(law) && !is_friction(law))
      throw_unknown(contact, law);
    if (std::ranges::find(chosen, law) == chosen.end()) chosen.push_back(law);
  }
  return chosen;
}

WallLaws make_laws(const ContactChoice& contact, const Parameters& parameters,
                   std::string_view specification) {
  WallLaws laws;
  if (!contact.walls) return laws;
  const std::vector<Wall> walls = contact.walls(parameters);
  const ByWall by_wall = split_by_wall(specification, walls);
  check_wall_names(by_wall.all, walls);
  for (const Wall& wall : walls)
    laws.set(wall.name, make_law(contact, parameters, wall, of_wall(by_wall, wall.name)));
  return laws;
}

std::string with_friction(const ContactChoice& contact, const Parameters& parameters,
                          std::string_view specification, std::string_view friction) {
  const std::vector<Wall> walls = contact.walls(parameters);
  const ByWall laws = split_by_wall(specification, walls), added = split_by_wall(friction, walls);
  check_wall_names(added.all, walls);
  const auto joined = [&](std::string_view law, std::string_view with) {
    const std::string name = part_of(with).name;
    if (with.empty() || with == "none") return std::string(law);
    if (!is_friction(name))
      throw ModelError(fmt::format("--friction: unknown friction law '{}'{}", name,
                                   suggestion(name, friction_names())));
    if (find_friction_part(contact, law) != std::string_view::npos)
      throw ModelError(fmt::format("--friction {}: the law '{}' has friction already", with, law));
    return fmt::format("{}{}{}", law, law.empty() ? "" : "+", with);
  };
  std::string text = joined(laws.all, added.all);
  for (const Wall& wall : walls) {
    const std::string_view law = of_wall(laws, wall.name), with = of_wall(added, wall.name);
    const bool own = law.data() != laws.all.data() || with.data() != added.all.data();
    if (own) text += fmt::format("{}{}={}", text.empty() ? "" : ",", wall.name, joined(law, with));
  }
  return text;
}

std::vector<std::string> folder_names(const std::vector<std::string>& specifications) {
  const auto plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string_view("._+=,-").find(c) != std::string_view::npos;
  };
  constexpr std::size_t longest = 200;  // file systems take 255 bytes
  Texts names;
  for (const std::string& specification : specifications) {
    std::string name = specification.substr(0, longest);
    std::ranges::replace_if(
        name, [&](char c) { return !plain(c); }, '_');
    const std::string stem = name;
    for (int n = 2; name == "plots" || std::ranges::find(names, name) != names.end(); ++n)
      name = fmt::format("{}-{}", stem, n);
    names.push_back(name);
  }
  return names;
}

}  // namespace yoke::cases
