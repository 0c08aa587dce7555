// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What every joint and load checks about its description before it is built. All throw ModelError
// and name the element, the parameter, the value and what is accepted.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include <yoke/core/model.hpp>

namespace yoke {

/// A body as it was given: the name of the field and what it holds.
struct NamedBody {
  std::string_view field;
  BodyId id;
};

/// "revolute 'pivot'", as it opens the messages.
std::string element_name(std::string_view kind, std::string_view name);

/// The bodies are known to the model and no two are the same.
void require_different_bodies(const std::string& owner, const Model& model,
                              std::initializer_list<NamedBody> bodies);

/// The body is known to the model and is not the ground.
void require_moving_body(const std::string& owner, const Model& model, const NamedBody& body);

void require_finite_vector(const std::string& owner, std::string_view parameter, const Vec2& value);

/// The unit vector along `direction`, which must be finite and not zero.
Vec2 unit_direction(const std::string& owner, std::string_view parameter, const Vec2& direction);

/// Friction is given to a joint without clearance.
void require_ideal_for_friction(const std::string& owner, bool friction, bool clearance);

/// The two points are further apart than rounding; returns their distance [m].
double require_apart(const std::string& owner, std::string_view first, const Vec2& p,
                     std::string_view second, const Vec2& q);

}  // namespace yoke
