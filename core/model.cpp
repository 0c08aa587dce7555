// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/core/model.hpp>

#include <algorithm>
#include <cmath>
#include <functional>

namespace yoke {

Constraint::Constraint(std::string name, std::vector<BodyId> bodies,
                       std::vector<Equation> equations, std::vector<bool> pattern)
    : name_(std::move(name)),
      bodies_(std::move(bodies)),
      equations_(std::move(equations)),
      pattern_(std::move(pattern)) {}

Vec2 Constraint::reaction_point(const Motion& motion) const {
  return motion[bodies_[reaction_body()]].position();
}

ForceElement::ForceElement(std::string name, std::vector<BodyId> bodies, Dependence dependence)
    : name_(std::move(name)), bodies_(std::move(bodies)), dependence_(dependence) {}

Body with_point_mass(Body body, double mass, const Vec2& at) {
  require_positive(fmt::format("body '{}'", body.name), "point mass", mass, "kg");
  const double total = body.mass + mass;
  const Vec2 centre = (body.mass * body.pose.position + mass * at) / total;
  body.inertia +=
      body.mass * (body.pose.position - centre).squaredNorm() + mass * (at - centre).squaredNorm();
  body.twist.velocity += body.twist.omega * perp(centre - body.pose.position);
  body.pose.position = centre;
  body.mass = total;
  return body;
}

namespace {

/// Names head columns of CSV files.
void check_name(const char* what, const std::string& name) {
  const auto separates = [](char c) { return c == ',' || c == '"' || (c >= 0 && c < ' '); };
  if (name.empty()) throw ModelError(fmt::format("{} needs a name that is not empty", what));
  if (std::ranges::any_of(name, separates))
    throw ModelError(
        fmt::format("{} '{}': a name must not contain commas, quotation marks or "
                    "control characters",
                    what, name));
}

std::string known_names(const std::vector<Body>& bodies) {
  std::string list;
  for (const Body& body : bodies) list += (list.empty() ? "'" : ", '") + body.name + "'";
  return list;
}

void require_accepted(const std::string& owner, std::string_view name, const Parameter& p,
                      double value) {
  require_finite(owner, name, value);
  if (value >= p.low && value <= p.high) return;
  const std::string accepted =
      std::isfinite(p.low) && std::isfinite(p.high)
          ? fmt::format("{:g} to {}", p.low, in_unit(p.high, p.unit))
          : fmt::format("at {} {}", std::isfinite(p.low) ? "least" : "most",
                        in_unit(std::isfinite(p.low) ? p.low : p.high, p.unit));
  throw ModelError(fmt::format("{}: {} = {} is outside the accepted range, {}", owner, name,
                               in_unit(value, p.unit), accepted));
}

void require_accepted(const std::string& element, const std::vector<Parameter>& parameters) {
  for (const Parameter& p : parameters)
    require_accepted(fmt::format("'{}'", element), p.name, p, p.value);
}

void check_together(const ForceElement& element, const double* values) {
  try {
    element.check_parameters(values);
  } catch (const ModelError& error) {
    throw ModelError(fmt::format("'{}': {}", element.name(), error.what()));
  }
}

std::uint32_t hash_of(std::string_view name) {
  const std::uint64_t hash = std::hash<std::string_view>{}(name);
  return static_cast<std::uint32_t>(hash ^ (hash >> 32));
}

void check_finite(const std::string& owner, const Body& body) {
  require_finite(owner, "pose x", body.pose.position.x());
  require_finite(owner, "pose y", body.pose.position.y());
  require_finite(owner, "pose angle", body.pose.angle);
  require_finite(owner, "velocity x", body.twist.velocity.x());
  require_finite(owner, "velocity y", body.twist.velocity.y());
  require_finite(owner, "angular velocity", body.twist.omega);
  for (const Vec2& p : body.outline) {
    require_finite(owner, "outline x", p.x());
    require_finite(owner, "outline y", p.y());
  }
}

}  // namespace

Model::Model() {
  bodies_.push_back(Body{.name = "ground"});
  take_name(Owner::body, 0);
}

BodyId Model::add(Body body) {
  const std::string owner = "body '" + body.name + "'";
  check_name("a body", body.name);
  require_free("body", body.name);
  require_not_negative(owner, "mass", body.mass, "kg");
  require_not_negative(owner, "inertia", body.inertia, "kg m^2");
  check_finite(owner, body);
  bodies_.push_back(std::move(body));
  take_name(Owner::body, body_count());
  return BodyId{body_count()};
}

const Body& Model::body(BodyId id) const {
  if (id.index < 0 || id.index > body_count())
    throw ModelError(fmt::format("unknown body {}: the model has bodies 0 to {} ({})", id.index,
                                 body_count(), known_names(bodies_)));
  return bodies_[static_cast<std::size_t>(id.index)];
}

BodyId Model::find_body(std::string_view name) const {
  if (const Taken& found = names_[place_of(name)]; found.owner == Owner::body)
    return BodyId{found.index};
  throw ModelError(fmt::format("unknown body '{}': the model has {}", name, known_names(bodies_)));
}

void Model::check_new_element(const std::string& name, const std::vector<BodyId>& bodies) const {
  check_name("a joint or force", name);
  for (const BodyId id : bodies)
    if (id.index < 0 || id.index > body_count())
      throw ModelError(fmt::format("'{}': unknown body {}: the model has bodies 0 to {}", name,
                                   id.index, body_count()));
  std::vector<int> indices;
  indices.reserve(bodies.size());
  for (const BodyId id : bodies) indices.push_back(id.index);
  std::ranges::sort(indices);
  if (const auto twice = std::ranges::adjacent_find(indices); twice != indices.end())
    throw ModelError(fmt::format(
        "'{}': body '{}' is given twice; a joint or force acts between different bodies", name,
        body(BodyId{*twice}).name));
  require_free("joint or force", name);
}

void Model::require_free(std::string_view what, const std::string& name) const {
  const Owner owner = names_[place_of(name)].owner;
  if (owner == Owner::nobody) return;
  throw ModelError(
      fmt::format("{} '{}': this name is taken by a {}; names of a model are unique, because "
                  "columns of results are found by them",
                  what, name, owner == Owner::body ? "body" : "joint or force"));
}

const std::string& Model::name_of(const Taken& taken) const {
  const auto i = static_cast<std::size_t>(taken.index);
  if (taken.owner == Owner::body) return bodies_[i].name;
  return taken.owner == Owner::constraint ? constraints_[i]->name() : forces_[i]->name();
}

/// In names_: of this name, or of the empty entry where it would be.
std::size_t Model::place_of(std::string_view name) const {
  const std::uint32_t hash = hash_of(name);
  const std::size_t mask = names_.size() - 1;
  for (std::size_t i = hash & mask;; i = (i + 1) & mask) {
    const Taken& taken = names_[i];
    const bool empty = taken.owner == Owner::nobody;
    if (empty || (taken.hash == hash && name_of(taken) == name)) return i;
  }
}

/// Of a body or element that the model has now, and whose name was free.
void Model::take_name(Owner owner, int index) {
  if (2 * (name_count_ + 1) > names_.size()) grow_names();
  ++name_count_;
  Taken taken{.owner = owner, .index = index};
  const std::string& name = name_of(taken);
  taken.hash = hash_of(name);
  names_[place_of(name)] = taken;
}

void Model::grow_names() {
  const std::vector<Taken> before = std::move(names_);
  names_.assign(std::max<std::size_t>(64, 2 * before.size()), {});
  const std::size_t mask = names_.size() - 1;
  for (const Taken& taken : before) {
    if (taken.owner == Owner::nobody) continue;
    std::size_t i = taken.hash & mask;
    while (names_[i].owner != Owner::nobody) i = (i + 1) & mask;
    names_[i] = taken;
  }
}

void Model::insert(Elements elements) {
  for (auto& constraint : elements.constraints) insert(std::move(constraint));
  for (auto& force : elements.forces) insert(std::move(force));
}

/// Its parameters, those it has, after the others.
std::size_t Model::add_parameters(const std::string& element, std::vector<Parameter> parameters,
                                  bool of_constraint) {
  const std::size_t first = parameters_.size();
  for (Parameter& p : parameters) parameters_.push_back({std::move(p), element, of_constraint});
  return first;
}

void Model::insert(std::unique_ptr<Constraint> constraint) {
  if (std::ranges::all_of(constraint->bodies(), [](BodyId id) { return id == ground; }))
    throw ModelError(
        fmt::format("joint '{}': at least one of its bodies must move", constraint->name()));
  const std::vector<Parameter> parameters = constraint->parameters();
  require_accepted(constraint->name(), parameters);
  check_new_element(constraint->name(), constraint->bodies());
  of_constraints_.push_back(add_parameters(constraint->name(), parameters, true));
  constraints_.push_back(std::move(constraint));
  take_name(Owner::constraint, static_cast<int>(constraints_.size()) - 1);
}

void Model::insert(std::unique_ptr<ForceElement> force) {
  const std::vector<Parameter> parameters = force->parameters();
  require_accepted(force->name(), parameters);
  check_new_element(force->name(), force->bodies(*this));
  of_forces_.push_back(add_parameters(force->name(), parameters, false));
  forces_.push_back(std::move(force));
  take_name(Owner::force, static_cast<int>(forces_.size()) - 1);
}

Vec2 Model::to_local(BodyId id, const Vec2& global_point) const {
  return direction_to_local(id, global_point - body(id).pose.position);
}

Vec2 Model::direction_to_local(BodyId id, const Vec2& global_direction) const {
  return rotate(-body(id).pose.angle, global_direction);
}

void Model::update_parameters(double t, std::vector<double>& values) const {
  for (std::size_t i = 0; i < constraints_.size(); ++i)
    constraints_[i]->update_parameters(t, values.data() + of_constraints_[i]);
}

State Model::start_state() const {
  const Eigen::Index n = 3 * body_count();
  State state;
  state.q.resize(n);
  state.v.resize(n);
  state.a = Eigen::VectorXd::Zero(n);
  for (int i = 0; i < body_count(); ++i) {
    const Body& b = bodies_[static_cast<std::size_t>(i) + 1];
    state.q.segment<3>(3 * i) << b.pose.position, b.pose.angle;
    state.v.segment<3>(3 * i) << b.twist.velocity, b.twist.omega;
  }
  Eigen::Index multipliers = 0, states = 0, quadratures = 0;
  std::size_t contacts = 0;
  for (const auto& c : constraints_) {
    multipliers += c->rows();
    quadratures += c->rheonomic() ? 1 : 0;
  }
  for (const auto& f : forces_) {
    states += static_cast<Eigen::Index>(f->states().size());
    quadratures += (f->dissipates() ? 1 : 0) + (f->supplies() ? 1 : 0);
    contacts += static_cast<std::size_t>(f->contacts());
    multipliers += f->may_hold() ? 1 : 0;
  }
  for (const OwnedParameter& p : parameters_) state.parameters.push_back(p.parameter.value);
  state.lambda = Eigen::VectorXd::Zero(multipliers);
  state.energy = Eigen::VectorXd::Zero(quadratures);
  state.z = Eigen::VectorXd::Zero(states);
  state.contacts.resize(contacts);
  Eigen::Index offset = 0;
  for (const auto& f : forces_) {
    const auto count = static_cast<Eigen::Index>(f->states().size());
    if (count > 0) f->initial_states(state.z.data() + offset);
    offset += count;
  }
  return state;
}

std::optional<std::size_t> Model::parameter_index(std::string_view name) const {
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    const std::string& owner = parameters_[i].element;
    if (name.starts_with(owner) && name.substr(owner.size()).starts_with(".") &&
        name.substr(owner.size() + 1) == parameters_[i].parameter.name)
      return i;
  }
  return std::nullopt;
}

std::size_t Model::find_parameter(std::string_view name) const {
  if (const auto index = parameter_index(name)) return *index;
  throw ModelError(unknown_parameter(name));
}

Parameter Model::parameter(std::size_t index) const {
  if (index < parameters_.size()) return parameters_[index].parameter;
  throw ModelError(
      fmt::format("unknown parameter {}: the model has {}", index, parameters_.size()));
}

std::string Model::unknown_parameter(std::string_view name) const {
  std::string known;
  for (const OwnedParameter& p : parameters_)
    if (!p.parameter.own) known += (known.empty() ? "'" : ", '") + p.name() + "'";
  return fmt::format("unknown parameter '{}': the model has {}", name,
                     known.empty() ? "no changeable parameters" : known);
}

void Model::check_parameter(std::string_view owner, std::string_view name, double value) const {
  require_accepted(std::string(owner), name, parameter(find_parameter(name)), value);
}

void Model::check_parameter(std::size_t index, double value) const {
  const auto& [p, element, of_constraint] = parameters_.at(index);
  require_accepted(fmt::format("'{}'", element), p.name, p, value);
  if (p.own)
    throw ModelError(
        fmt::format("'{}': {} is kept by the element itself and cannot be set", element, p.name));
}

void Model::check_parameters(const std::vector<double>& values) const {
  for (std::size_t i = 0; i < parameters_.size(); ++i)
    require_accepted(fmt::format("'{}'", parameters_[i].element), parameters_[i].parameter.name,
                     parameters_[i].parameter, values.at(i));
  for (std::size_t i = 0; i < forces_.size(); ++i)
    check_together(*forces_[i], values.data() + of_forces_[i]);
}

}  // namespace yoke
