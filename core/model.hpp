// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A mechanism: bodies, constraints, force elements. Built by add(...), constant during a run, may
// be shared by threads.
#pragma once

#include <concepts>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <yoke/core/constraint.hpp>
#include <yoke/core/error.hpp>
#include <yoke/core/force.hpp>
#include <yoke/core/state.hpp>

namespace yoke {

/// What a description with more than one element makes, in the order in which they are added.
struct Elements {
  std::vector<std::unique_ptr<Constraint>> constraints{};  // joints and drivers
  std::vector<std::unique_ptr<ForceElement>> forces{};     // forces, contacts, events
};

/// Something Model::add accepts: a description with build(model) giving a constraint or a force
/// element, or with elements(model) giving any number of both. Every joint and force of the library
/// is one; so is a user's own.
template <class D>
concept ElementDescription = requires(const D& d, const Model& m) {
  { d.build(m) } -> std::convertible_to<std::unique_ptr<Constraint>>;
}
|| requires(const D& d, const Model& m) {
  { d.build(m) } -> std::convertible_to<std::unique_ptr<ForceElement>>;
}
|| requires(const D& d, const Model& m) {
  { d.elements(m) } -> std::convertible_to<Elements>;
};

/// A changeable parameter and the element it belongs to.
struct OwnedParameter {
  Parameter parameter;         // its name is without that of the element
  std::string element;         // its name
  bool of_constraint = false;  // of a driver: it changes a motion
  /// "element.parameter".
  std::string name() const { return element + "." + parameter.name; }
};

class Model {
 public:
  /// With the ground alone.
  Model();

  /// Adds a body. Throws ModelError if its name is empty or taken, its mass or inertia not
  /// positive, or a number not finite.
  BodyId add(Body body);

  /// Adds a joint or force from its description, placed by global geometry in the start pose.
  /// Throws ModelError for a name that is empty or taken (by a body, joint or force: columns
  /// and messages use the names), an unknown body, a body given twice.
  template <ElementDescription D>
  void add(const D& description) {
    if constexpr (requires { description.elements(*this); })
      insert(description.elements(*this));
    else
      insert(description.build(*this));
  }
  /// Adds elements that are built already; add() calls it. Throws ModelError.
  void insert(Elements elements);
  void insert(std::unique_ptr<Constraint> constraint);
  void insert(std::unique_ptr<ForceElement> force);

  /// Without the ground.
  int body_count() const { return static_cast<int>(bodies_.size()) - 1; }
  /// All bodies, index 0 is the ground.
  const std::vector<Body>& bodies() const { return bodies_; }
  /// As it was added. Throws ModelError for an unknown one.
  const Body& body(BodyId id) const;
  /// Throws ModelError that lists the known names.
  BodyId find_body(std::string_view name) const;
  /// In the order in which they were added.
  const std::vector<std::unique_ptr<Constraint>>& constraints() const { return constraints_; }
  /// In the order in which they were added.
  const std::vector<std::unique_ptr<ForceElement>>& forces() const { return forces_; }

  /// Geometry of the start pose, for placing elements: a global point in the frame of a body [m].
  Vec2 to_local(BodyId id, const Vec2& global_point) const;
  /// A global direction in the frame of a body.
  Vec2 direction_to_local(BodyId id, const Vec2& global_direction) const;

  /// The state the bodies were described in: not yet assembled, z and parameters at their defaults.
  State start_state() const;
  /// Index into State::parameters of "element.parameter", if there is such a parameter.
  std::optional<std::size_t> parameter_index(std::string_view name) const;
  /// The parameter of this index. Throws ModelError.
  Parameter parameter(std::size_t index) const;
  /// All of State::parameters, in the order in which their elements were added.
  const std::vector<OwnedParameter>& parameters() const { return parameters_; }
  /// Of constraint or force number i: the index of its first parameter.
  std::size_t first_parameter_of_constraint(std::size_t i) const { return of_constraints_.at(i); }
  /// The same of a force.
  std::size_t first_parameter_of_force(std::size_t i) const { return of_forces_.at(i); }
  /// Writes `values`, a State::parameters, in the form they have at t [s], of the same motion.
  void update_parameters(double t, std::vector<double>& values) const;
  /// For messages: that there is none of this name, and which there are.
  std::string unknown_parameter(std::string_view name) const;
  /// As parameter_index(). Throws ModelError that lists the parameters there are.
  std::size_t find_parameter(std::string_view name) const;
  /// Throws ModelError, in the name of `owner`, unless "element.parameter" may have this value.
  void check_parameter(std::string_view owner, std::string_view name, double value) const;
  void check_parameter(std::size_t index, double value) const;
  /// The same for all of State::parameters.
  void check_parameters(const std::vector<double>& values) const;

 private:
  enum class Owner : unsigned char { nobody, body, constraint, force };
  /// A name that is taken: its hash and whose it is.
  struct Taken {
    std::uint32_t hash = 0;
    Owner owner = Owner::nobody;
    int index = 0;  // of the owner
  };

  std::size_t add_parameters(const std::string& element, std::vector<Parameter> parameters,
                             bool of_constraint);
  void require_free(std::string_view what, const std::string& name) const;
  void check_new_element(const std::string& name, const std::vector<BodyId>& bodies) const;
  std::size_t place_of(std::string_view name) const;
  const std::string& name_of(const Taken& taken) const;
  void take_name(Owner owner, int index);
  void grow_names();

  std::vector<Body> bodies_;
  // Open addressing, the size a power of two: one look into memory a name, where nodes of a map are two or three.
  std::vector<Taken> names_;
  std::size_t name_count_ = 0;
  std::vector<std::unique_ptr<Constraint>> constraints_;
  std::vector<std::unique_ptr<ForceElement>> forces_;
  std::vector<OwnedParameter> parameters_;
  std::vector<std::size_t> of_constraints_, of_forces_;  // their first parameters
};

}  // namespace yoke
