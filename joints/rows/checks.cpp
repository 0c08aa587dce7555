// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/joints/rows/checks.hpp>

#include <algorithm>
#include <cmath>

namespace yoke {

std::string element_name(std::string_view kind, std::string_view name) {
  std::string owner;  // every joint of a large model makes one: without a look at a format
  owner.reserve(kind.size() + name.size() + 3);
  owner.append(kind).append(" '").append(name).append("'");
  return owner;
}

namespace {

void require_known(const std::string& owner, const Model& model, const NamedBody& body) {
  if (body.id.index < 0 || body.id.index > model.body_count())
    throw ModelError(fmt::format("{}: {} = body {} is unknown; the model has bodies 0 to {}", owner,
                                 body.field, body.id.index, model.body_count()));
}

}  // namespace

void require_different_bodies(const std::string& owner, const Model& model,
                              std::initializer_list<NamedBody> bodies) {
  for (const NamedBody& body : bodies) require_known(owner, model, body);
  for (auto i = bodies.begin(); i != bodies.end(); ++i)
    for (auto j = std::next(i); j != bodies.end(); ++j)
      if (i->id == j->id)
        throw ModelError(fmt::format("{}: {} and {} are both body '{}'; give different bodies",
                                     owner, i->field, j->field, model.body(i->id).name));
}

void require_moving_body(const std::string& owner, const Model& model, const NamedBody& body) {
  require_known(owner, model, body);
  if (body.id == ground)
    throw ModelError(
        fmt::format("{}: {} is the ground; give a body that moves", owner, body.field));
}

void require_finite_vector(const std::string& owner, std::string_view parameter,
                           const Vec2& value) {
  if (!value.allFinite())
    throw ModelError(fmt::format("{}: {} = ({:g}, {:g}) must have finite components", owner,
                                 parameter, value.x(), value.y()));
}

Vec2 unit_direction(const std::string& owner, std::string_view parameter, const Vec2& direction) {
  require_finite_vector(owner, parameter, direction);
  const double length = std::hypot(direction.x(), direction.y());
  if (!(length > 0.0) || !std::isfinite(length))
    throw ModelError(fmt::format("{}: {} = ({:g}, {:g}) must have a finite length greater than 0",
                                 owner, parameter, direction.x(), direction.y()));
  return direction / length;
}

double require_apart(const std::string& owner, std::string_view first, const Vec2& p,
                     std::string_view second, const Vec2& q) {
  require_finite_vector(owner, first, p);
  require_finite_vector(owner, second, q);
  const double distance = std::hypot(q.x() - p.x(), q.y() - p.y());
  const double size = std::max(p.lpNorm<Eigen::Infinity>(), q.lpNorm<Eigen::Infinity>());
  if (!(distance > 1e-14 * size))
    throw ModelError(
        fmt::format("{}: the distance from {} = ({:g}, {:g}) to {} = ({:g}, {:g}) is "
                    "{:g} m; it must be greater than 0 m",
                    owner, first, p.x(), p.y(), second, q.x(), q.y(), distance));
  return distance;
}

void require_ideal_for_friction(const std::string& owner, bool friction, bool clearance) {
  if (friction && clearance)
    throw ModelError(
        owner +
        ": friction is that of the joint without clearance; with clearance, give it to the "
        "contact law");
}

}  // namespace yoke
