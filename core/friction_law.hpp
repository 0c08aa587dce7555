// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Friction laws as values: the force along a surface for a normal force and a sliding velocity. A
// law knows neither the shape of the surfaces nor where the normal force comes from.
//
//   T(N, v, z)     friction force [N], against v: the surface that slides with v > 0 feels -T
//   z' = f(N, v, z)   of laws that have a state, the deflection of bristles, say
//   ledger         T v = dS/dt + D    at every instant, S(z) [J] stored energy, D [W] >= 0
//
// A law that holds is one of dry friction itself: at rest it is not a force but a constraint, as long as
// that needs no more than holding_force(N). It is evaluated only where the surfaces slide, or begin to.
//
// A law needs no base class: anything callable with a FrictionInput. Laws that ship are in
// contact/laws/friction/.
#pragma once

#include <concepts>
#include <memory>
#include <string>
#include <utility>

#include <yoke/core/law_parameters.hpp>

namespace yoke {

/// What a friction law sees.
struct FrictionInput {
  double normal_force = 0.0;  // [N] N >= 0
  double sliding = 0.0;       // [m/s] v, of one surface relative to the other
  double state = 0.0;         // z of a law that has one
  double direction = 0.0;  // +1 or -1: which way it slides, also where v is zero; of laws that hold
  double reference_force =
      1.0;  // [N] a light load of this pair of surfaces: what is small beside it
};

/// What it gives. Derivatives are partial ones.
struct FrictionOutput {
  double force = 0.0;             // [N] T
  double dforce_dnormal = 0.0;    // [1]
  double dforce_dsliding = 0.0;   // [N s/m]
  double dforce_dstate = 0.0;     // [N/m] if z is a length
  double rate = 0.0;              // z'
  double drate_dnormal = 0.0;     // of z' by N
  double drate_dsliding = 0.0;    // of z' by v
  double drate_dstate = 0.0;      // [1/s] of z' by z
  double stored_energy = 0.0;     // [J] S(z)
  double dissipated_power = 0.0;  // [W] T v - dS/dt, from the law's formula
};

/// What a friction law is made from: anything callable with what it sees.
template <class F>
concept FrictionFunction = requires(const F& law, const FrictionInput& in) {
  { law(in) } -> std::convertible_to<FrictionOutput>;
};

/// A friction law as a value; copies share one immutable object. Optional members of the function:
///   double state_scale(double reference_force) const
///                              the law has a state z; its typical size, which error weights are
///                              made from, under a light load [N]
///   double holding_force(double normal_force) const
///                              [N] the law holds, with up to this force
///   std::string name() const   for results and errors
///   void check() const         throws ModelError if a parameter is wrong; called once, here
class FrictionLaw {
 public:
  /// No friction.
  FrictionLaw() = default;

  template <FrictionFunction F>
  FrictionLaw(F law) : function_(std::make_shared<const Holder<F>>(std::move(law))) {}

  /// No friction.
  bool none() const { return !function_; }
  /// Only if not none().
  FrictionOutput evaluate(const FrictionInput& in) const {
    return function_->evaluate(in, values_);
  }
  /// Whether it has a z.
  bool has_state() const { return function_ && function_->has_state(); }
  /// Only if has_state().
  double state_scale(double reference_force) const {
    return function_->state_scale(reference_force);
  }
  /// At rest it is a constraint.
  bool holds() const { return function_ && function_->holds(); }
  /// Only if holds().
  double holding_force(double normal_force) const {
    return function_->holding_force(normal_force, values_);
  }
  /// Changeable numbers, see core/law_parameters.hpp.
  std::vector<Parameter> parameters() const {
    return function_ ? function_->parameters() : std::vector<Parameter>();
  }
  /// Throws ModelError.
  void check(const double* values) const {
    if (function_) function_->check(values);
  }
  /// The law with these numbers, while `this` and they exist; costs no allocation.
  FrictionLaw bound(const double* values) const {
    FrictionLaw law;
    law.function_ = std::shared_ptr<const Function>(std::shared_ptr<void>(), function_.get());
    law.values_ = values;
    return law;
  }
  /// Whether it is a copy of that one.
  bool is_same(const FrictionLaw& other) const { return function_ == other.function_; }
  /// As the law calls itself; "none".
  std::string name() const { return function_ ? function_->name() : "none"; }

 private:
  struct Function {
    virtual ~Function() = default;
    virtual FrictionOutput evaluate(const FrictionInput&, const double* values) const = 0;
    virtual bool has_state() const = 0;
    virtual double state_scale(double reference_force) const = 0;
    virtual bool holds() const = 0;
    virtual double holding_force(double normal_force, const double* values) const = 0;
    virtual std::vector<Parameter> parameters() const = 0;
    virtual void check(const double* values) const = 0;
    virtual std::string name() const = 0;
  };

  template <class F>
  struct Holder final : Function {
    explicit Holder(F given) : law(std::move(given)) {
      if constexpr (requires { law.check(); }) law.check();
    }
    FrictionOutput evaluate(const FrictionInput& in, const double* values) const override {
      return use_law(law, values, [&](const auto& now) -> FrictionOutput { return now(in); });
    }
    bool has_state() const override { return stateful; }
    double state_scale(double reference_force) const override {
      if constexpr (stateful)
        return law.state_scale(reference_force);
      else
        return 0.0 * reference_force;
    }
    bool holds() const override { return holding; }
    std::vector<Parameter> parameters() const override { return parameters_of_law(law); }
    void check(const double* values) const override { check_law(law, values); }
    double holding_force(double normal_force, const double* values) const override {
      if constexpr (holding)
        return use_law(law, values,
                       [&](const auto& now) -> double { return now.holding_force(normal_force); });
      else
        return 0.0 * normal_force;
    }
    std::string name() const override {
      if constexpr (requires { law.name(); })
        return law.name();
      else
        return "friction law";
    }
    static constexpr bool holding = requires(const F& f, double x) {
      { f.holding_force(x) } -> std::convertible_to<double>;
    };
    static constexpr bool stateful = requires(const F& f, double x) {
      { f.state_scale(x) } -> std::convertible_to<double>;
    };
    F law;
  };

  std::shared_ptr<const Function> function_;
  const double* values_ = nullptr;  // of changeable numbers
};

}  // namespace yoke
