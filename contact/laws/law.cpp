// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/contact/laws/law.hpp>

#include <algorithm>

namespace yoke {

namespace {
constexpr double shallowest = 1e-100, deepest = 1e100;  // [m] beyond any unit
}  // namespace

double ElasticLaw::penetration_at(double force) const {
  double low = shallowest, high = std::min(limit_, deepest);
  if (!(force > response(low).force)) return low;
  if (!(response(high).force > force)) return high;
  // Forces span many decades, so the bisection halves the ratio, not the difference; to the last
  // bit, so that where it began is not seen in where it ends.
  while (true) {
    double middle = std::sqrt(low) * std::sqrt(high);
    if (!(middle > low && middle < high)) middle = 0.5 * (low + high);
    if (!(middle > low && middle < high)) return low;
    (response(middle).force > force ? high : low) = middle;
  }
}

std::vector<Parameter> ContactLaw::parameters() const {
  std::vector<Parameter> all = elastic.parameters();
  for (const Parameter& p : dissipation.parameters()) all.push_back(p);
  for (const Parameter& p : friction.parameters()) all.push_back(p);
  return all;
}

void ContactLaw::check(const double* values) const {
  elastic.check(values);
  dissipation.check(values + elastic.fields());
  friction.check(values + elastic.fields() + dissipation.fields());
}

ContactLaw ContactLaw::bound(const double* values) const {
  const double* const for_dissipation = values + elastic.fields();
  return {elastic.bound(values), dissipation.bound(for_dissipation),
          friction.bound(for_dissipation + dissipation.fields())};
}

std::string ContactLaw::name() const {
  std::string name = elastic.name();
  if (!dissipation.none()) name += " with " + dissipation.name();
  if (!friction.none()) name += (dissipation.none() ? " with " : " and ") + friction.name();
  return name;
}

}  // namespace yoke
