// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Numbers of laws that may be changed during a run. A law lists them:
//   static constexpr LawField<Law> fields[] = {{"restitution", "", &Law::e}};
// and is made changeable where it is used, `changeable(Law{...})`. Its numbers are then changeable
// parameters of the element that has the law. What is not made changeable costs nothing.
#pragma once

#include <concepts>
#include <type_traits>
#include <utility>
#include <vector>

#include <yoke/core/parameter.hpp>

namespace yoke {

/// A number of a law. What values it may have, the law's check() says.
template <class Law>
struct LawField {
  const char* name;    // as "stiffness"
  const char* unit;    // "" for a number without one
  double Law::*value;  // where the law keeps it
};

/// A law and, for given values of its fields, the same law with these.
template <class Law>
struct Changeable : Law {
  /// Of a law that lists its `fields`.
  explicit Changeable(Law law) : Law(std::move(law)) {}

  /// The fields with their values at the start.
  std::vector<Parameter> parameters() const {
    std::vector<Parameter> all;
    for (const LawField<Law>& field : Law::fields)
      all.push_back({.name = field.name, .unit = field.unit, .value = this->*field.value});
    return all;
  }
  /// `values` in the order of the fields. Allocates nothing: a law that is not plain numbers has a
  /// member Law with_fields(const double* values) const of its own.
  Law with(const double* values) const {
    if constexpr (requires(const Law& law) { law.with_fields(values); }) {
      return this->with_fields(values);
    } else {
      static_assert(std::is_trivially_copyable_v<Law>);
      Law law = *this;
      for (const LawField<Law>& field : Law::fields) law.*field.value = *values++;
      return law;
    }
  }
};

/// The numbers that `law` lists may be changed during a run.
template <class Law>
Changeable<Law> changeable(Law law) {
  return Changeable<Law>(std::move(law));
}

/// A law whose numbers may be changed during a run.
template <class F>
concept ChangeableLaw = requires(const F& law, const double* values) {
  law.with(values);
  { law.parameters() } -> std::convertible_to<std::vector<Parameter>>;
};

/// use(law), or use(the law with these values) if it is changeable and there are any.
template <class F, class Use>
auto use_law(const F& law, const double* values, const Use& use) {
  if constexpr (ChangeableLaw<F>) {
    if (values != nullptr) return use(law.with(values));
  }
  return use(law);
}

/// Empty if it is not changeable.
template <class F>
std::vector<Parameter> parameters_of_law(const F& law) {
  if constexpr (ChangeableLaw<F>)
    return law.parameters();
  else
    return {};
}

/// Throws ModelError, as the law does for wrong numbers.
template <class F>
void check_law(const F& law, const double* values) {
  use_law(law, values, [](const auto& now) {
    if constexpr (requires { now.check(); }) now.check();
  });
}

}  // namespace yoke
