// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Contact laws as values: the force between two surfaces for given penetration and rate. A law does
// not know the shape of the surfaces.
//
//   elastic part      F_e(d), dF_e/dd, U(d) = int F_e dd          d penetration [m], > 0 in contact
//   dissipative part  F(d, d', memory; F_e), d' rate [m/s], > 0 while approaching
//   ledger            F d' = dS/dt + D    at every instant, S [J] stored energy, D [W] dissipated
//   friction          along the wall, core/friction_law.hpp: it sees N = max(F, 0)
//
// Laws need no base class: an elastic law is anything callable with a penetration, a dissipative
// law anything callable with (ContactInput, ElasticLaw). A law declares what it needs from the
// contact element by optional members, listed at ElasticLaw and DissipativeLaw.
#pragma once

#include <cmath>
#include <concepts>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <yoke/core/contact_memory.hpp>
#include <yoke/core/friction_law.hpp>

namespace yoke {

/// The response of an elastic law to a penetration.
struct ElasticResponse {
  double force = 0.0;      // [N], > 0 pushes apart
  double stiffness = 0.0;  // [N/m] dforce/dpenetration
  double energy = 0.0;     // [J] integral of the force from 0
};

/// Of a law that follows the curvature k [1/m] of the wall, > 0 convex as the disc sees it.
struct GradedResponse {
  ElasticResponse here{};     // force = denergy/dpenetration, stiffness = dforce/dpenetration
  double force_slope = 0.0;   // [N m] dforce/dk
  double energy_slope = 0.0;  // [J m] denergy/dk
  double energy_bend = 0.0;   // [J m^2] d2energy/dk2
};

/// What an elastic law is made from: anything callable with a penetration [m] >= 0.
template <class F>
concept ElasticFunction = requires(const F& law, double penetration) {
  { law(penetration) } -> std::convertible_to<ElasticResponse>;
};

/// An elastic law as a value; copies share one immutable object. Optional members of the function:
///   double limit() const       largest penetration it is valid for [m]; default: none
///   std::string name() const   for results and errors
///   void check() const         throws ModelError if a parameter is wrong; called once, here
///   GradedResponse operator()(double penetration, double curvature) const
///                              the law follows the local curvature of the wall. Without a curvature
///                              it is then taken for a typical one, for scales. Made from a function
///                              of the wall where one is given (contact/wall_law.hpp).
class ElasticLaw {
 public:
  /// From a function. Throws what its check() throws.
  template <ElasticFunction F>
  ElasticLaw(F law) : function_(std::make_shared<const Holder<F>>(std::move(law))) {
    fields_ = function_->parameters().size();
    limit_ = function_->limit();
    follows_ = function_->follows();
  }

  /// Force, stiffness and energy at a penetration of either sign. Below zero it is the odd
  /// extension -F_e(-d), which integrators see only inside a step that ends at a located event; the
  /// law itself is never evaluated there. Beyond the limit everything is NaN.
  ElasticResponse response(double penetration) const {
    const double size = std::abs(penetration);
    if (size > limit_) return {not_a_number, not_a_number, not_a_number};
    ElasticResponse r =
        values_ == nullptr ? function_->respond(size) : function_->respond_with(size, values_);
    if (penetration < 0.0) r.force = -r.force;
    return r;
  }

  /// Whether it depends on the curvature of the wall where it is touched.
  bool follows_curvature() const { return follows_; }
  /// The same where the curvature of the wall is `curvature` [1/m]; only if follows_curvature().
  GradedResponse response(double penetration, double curvature) const {
    const double size = std::abs(penetration);
    if (size > limit_) return {response(penetration), not_a_number, not_a_number, not_a_number};
    GradedResponse r = function_->respond(size, curvature);
    if (penetration < 0.0) r.here.force = -r.here.force, r.force_slope = -r.force_slope;
    return r;
  }

  /// Changeable numbers, see core/law_parameters.hpp.
  std::vector<Parameter> parameters() const { return function_->parameters(); }
  /// Throws ModelError.
  void check(const double* values) const { function_->check(values); }
  /// The law with these numbers, while `this` and they exist; costs no allocation.
  ElasticLaw bound(const double* values) const {
    ElasticLaw law;
    law.function_ = std::shared_ptr<const Function>(std::shared_ptr<void>(), function_.get());
    law.limit_ = limit_;
    law.follows_ = follows_;
    law.values_ = values;
    return law;
  }
  std::size_t fields() const { return fields_; }  ///< how many changeable numbers
  /// Whether both are copies of one law.
  bool is_same(const ElasticLaw& other) const { return function_ == other.function_; }

  double limit() const { return limit_; }  ///< [m], infinite if the law has none
  std::string name() const { return function_->name(); }

  /// Inverse of the law: the penetration [m] under `force` [N] >= 0; the limit, or the largest
  /// penetration tried (1e100 m), if the law does not reach that force.
  double penetration_at(double force) const;

 private:
  friend class LocalLaw;  // makes laws that last as long as an evaluation
  ElasticLaw() = default;

  static constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

  struct Function {
    virtual ~Function() = default;
    virtual ElasticResponse respond(double penetration) const = 0;
    virtual ElasticResponse respond_with(double penetration, const double* /*values*/) const {
      return respond(penetration);
    }
    virtual std::vector<Parameter> parameters() const { return {}; }
    virtual void check(const double* /*values*/) const {}
    virtual bool follows() const { return false; }
    virtual GradedResponse respond(double penetration, double /*curvature*/) const {
      return {.here = respond(penetration)};
    }
    virtual double limit() const = 0;
    virtual std::string name() const = 0;
  };

  template <class F>
  struct Holder final : Function {
    explicit Holder(F given) : law(std::move(given)) {
      if constexpr (requires { law.check(); }) law.check();
    }
    ElasticResponse respond(double penetration) const override { return law(penetration); }
    ElasticResponse respond_with(double penetration, const double* values) const override {
      return use_law(law, values,
                     [&](const auto& now) -> ElasticResponse { return now(penetration); });
    }
    std::vector<Parameter> parameters() const override { return parameters_of_law(law); }
    void check(const double* values) const override { check_law(law, values); }
    bool follows() const override { return graded; }
    GradedResponse respond(double penetration, double curvature) const override {
      if constexpr (graded)
        return law(penetration, curvature);
      else
        return {.here = law(penetration)};
    }
    double limit() const override {
      if constexpr (requires { law.limit(); })
        return law.limit();
      else
        return std::numeric_limits<double>::infinity();
    }
    std::string name() const override {
      if constexpr (requires { law.name(); })
        return law.name();
      else
        return "elastic law";
    }
    static constexpr bool graded = requires(const F& f, double x) {
      { f(x, x) } -> std::convertible_to<GradedResponse>;
    };
    F law;
  };

  std::shared_ptr<const Function> function_;
  const double* values_ = nullptr;  // of changeable numbers
  std::size_t fields_ = 0;
  double limit_ = 0.0;
  bool follows_ = false;
};

/// The input of a dissipative law.
struct ContactInput {
  double penetration;           // [m]
  double rate;                  // [m/s]
  const ContactMemory& memory;  // phase, approach velocity, effective mass, largest penetration ...
};

/// Its output.
struct ContactOutput {
  double force = 0.0;                // [N], > 0 pushes apart
  double dforce_dpenetration = 0.0;  // [N/m]
  double dforce_drate = 0.0;         // [N s/m]
  double stored_energy = 0.0;        // [J] what the contact would return if it unloaded now
  double dissipated_power = 0.0;  // [W] force * rate - d(stored energy)/dt, from the law's formula
};

/// When a contact ends before it reaches its permanent set (zero for most laws).
enum class Release {
  at_zero_force,        ///< as soon as the force would become tensile (default)
  at_zero_penetration,  ///< the tensile phase is part of the law
};

/// What a dissipative law is made from: anything callable with what a contact knows and the elastic
/// part.
template <class F>
concept DissipativeFunction = requires(const F& law, const ContactInput& input,
                                       const ElasticLaw& elastic) {
  { law(input, elastic) } -> std::convertible_to<ContactOutput>;
};

/// A dissipative law as a value; copies share one immutable object. Optional members of the
/// function:
///   bool needs_largest_penetration() const
///       the end of compression is located and written to memory.largest_penetration; the phase is
///       `compressing` until then, `restituting` after it, and `compressing` again when a reload
///       passes the largest penetration. Without it the phase is `compressing` until release.
///   double permanent_set(const ContactMemory&, const ElasticLaw&) const
///       [m], computed at the end of compression (implies the former); the contact ends there,
///       and a reload begins there until the surfaces have been apart.
///   Release release() const
///   double kink(const ContactInput&, const ElasticLaw&) const
///       [m] changes sign where the formula has a corner (of the force or its derivatives), about
///       the distance from it: no step then passes over the corner, and the accuracy of the method
///       is kept. Without it the formula is smooth while in contact.
///   double force_change(const ContactInput&, const ElasticLaw&, const ElasticLaw& change) const
///       [N m] derivative of the force while the elastic law changes by `change`, whose force and
///       energy are N m and J m, and whose stiffness is not known (0): for laws that are to follow the curvature of a wall though their
///       force is not a sum of multiples of the elastic response
///   std::string name() const, void check() const     as for ElasticLaw
class DissipativeLaw {
 public:
  /// No dissipation.
  DissipativeLaw() = default;

  template <DissipativeFunction F>
  DissipativeLaw(F law) : function_(std::make_shared<const Holder<F>>(std::move(law))) {
    fields_ = function_->parameters().size();
    needs_largest_penetration_ = function_->needs_largest_penetration();
    release_ = function_->release();
    has_kink_ = function_->has_kink();
    knows_force_change_ = function_->knows_force_change();
  }

  /// Force, derivatives and energies of both parts together.
  ContactOutput evaluate(const ContactInput& in, const ElasticLaw& elastic) const {
    if (function_) return function_->evaluate(in, elastic, values_);
    const ElasticResponse e = elastic.response(in.penetration);
    return {.force = e.force, .dforce_dpenetration = e.stiffness, .stored_energy = e.energy};
  }

  bool needs_largest_penetration() const { return needs_largest_penetration_; }
  Release release() const { return release_; }
  /// Whether the formula has a corner.
  bool has_kink() const { return has_kink_; }
  /// Changes sign at the corner of the formula; only if has_kink().
  double kink(const ContactInput& in, const ElasticLaw& elastic) const {
    return function_->kink(in, elastic, values_);
  }
  double permanent_set(const ContactMemory& memory, const ElasticLaw& elastic) const {
    return function_ ? function_->permanent_set(memory, elastic, values_) : 0.0;
  }
  /// Whether it may follow the curvature of a wall though its force is no multiple of the elastic
  /// one.
  bool knows_force_change() const { return knows_force_change_; }
  /// Only if knows_force_change().
  double force_change(const ContactInput& in, const ElasticLaw& elastic,
                      const ElasticLaw& change) const {
    return function_->force_change(in, elastic, change, values_);
  }
  /// No dissipation.
  bool none() const { return !function_; }
  /// Changeable numbers, see core/law_parameters.hpp.
  std::vector<Parameter> parameters() const {
    return function_ ? function_->parameters() : std::vector<Parameter>();
  }
  /// Throws ModelError.
  void check(const double* values) const {
    if (function_) function_->check(values);
  }
  /// The law with these numbers, while `this` and they exist; costs no allocation.
  DissipativeLaw bound(const double* values) const {
    DissipativeLaw law;
    law.function_ = std::shared_ptr<const Function>(std::shared_ptr<void>(), function_.get());
    law.values_ = values;
    law.needs_largest_penetration_ = needs_largest_penetration_;
    law.has_kink_ = has_kink_;
    law.knows_force_change_ = knows_force_change_;
    law.release_ = release_;
    return law;
  }
  std::size_t fields() const { return fields_; }  ///< how many changeable numbers
  /// Whether both are copies of one law.
  bool is_same(const DissipativeLaw& other) const { return function_ == other.function_; }
  std::string name() const { return function_ ? function_->name() : "none"; }

 private:
  struct Function {
    virtual ~Function() = default;
    virtual ContactOutput evaluate(const ContactInput&, const ElasticLaw&,
                                   const double* values) const = 0;
    virtual bool needs_largest_penetration() const = 0;
    virtual Release release() const = 0;
    virtual double permanent_set(const ContactMemory&, const ElasticLaw&,
                                 const double* values) const = 0;
    virtual bool has_kink() const = 0;
    virtual double kink(const ContactInput&, const ElasticLaw&, const double* values) const = 0;
    virtual bool knows_force_change() const = 0;
    virtual double force_change(const ContactInput&, const ElasticLaw&, const ElasticLaw&,
                                const double* values) const = 0;
    virtual std::vector<Parameter> parameters() const = 0;
    virtual void check(const double* values) const = 0;
    virtual std::string name() const = 0;
  };

  template <class F>
  struct Holder final : Function {
    explicit Holder(F given) : law(std::move(given)) {
      if constexpr (requires { law.check(); }) law.check();
    }
    ContactOutput evaluate(const ContactInput& in, const ElasticLaw& elastic,
                           const double* values) const override {
      return use_law(law, values,
                     [&](const auto& now) -> ContactOutput { return now(in, elastic); });
    }
    std::vector<Parameter> parameters() const override { return parameters_of_law(law); }
    void check(const double* values) const override { check_law(law, values); }
    bool needs_largest_penetration() const override {
      if constexpr (requires { law.needs_largest_penetration(); })
        return law.needs_largest_penetration();
      else
        return has_permanent_set;
    }
    Release release() const override {
      if constexpr (requires { law.release(); })
        return law.release();
      else
        return Release::at_zero_force;
    }
    double permanent_set(const ContactMemory& memory, const ElasticLaw& elastic,
                         const double* values) const override {
      if constexpr (has_permanent_set)
        return use_law(law, values, [&](const auto& now) -> double {
          return now.permanent_set(memory, elastic);
        });
      else
        return 0.0;
    }
    bool has_kink() const override { return kinked; }
    double kink(const ContactInput& in, const ElasticLaw& elastic,
                const double* values) const override {
      if constexpr (kinked)
        return use_law(law, values,
                       [&](const auto& now) -> double { return now.kink(in, elastic); });
      else
        return -1.0;
    }
    bool knows_force_change() const override { return changes; }
    double force_change(const ContactInput& in, const ElasticLaw& elastic, const ElasticLaw& change,
                        const double* values) const override {
      if constexpr (changes)
        return use_law(law, values, [&](const auto& now) -> double {
          return now.force_change(in, elastic, change);
        });
      else
        return 0.0;
    }
    std::string name() const override {
      if constexpr (requires { law.name(); })
        return law.name();
      else
        return "dissipative law";
    }
    static constexpr bool kinked =
        requires(const F& f, const ContactInput& in, const ElasticLaw& e) {
      { f.kink(in, e) } -> std::convertible_to<double>;
    };
    static constexpr bool changes =
        requires(const F& f, const ContactInput& in, const ElasticLaw& e) {
      { f.force_change(in, e, e) } -> std::convertible_to<double>;
    };
    static constexpr bool has_permanent_set =
        requires(const F& f, const ContactMemory& m, const ElasticLaw& e) {
      { f.permanent_set(m, e) } -> std::convertible_to<double>;
    };
    F law;
  };

  std::shared_ptr<const Function> function_;
  const double* values_ = nullptr;  // of changeable numbers
  std::size_t fields_ = 0;
  bool needs_largest_penetration_ = false;
  bool has_kink_ = false;
  bool knows_force_change_ = false;
  Release release_ = Release::at_zero_force;
};

/// The law of one contact: ContactLaw{per_mm(49070, 1.10), HuntCrossley{0.32}}, with friction
/// ContactLaw{per_mm(49070, 1.10), HuntCrossley{0.32}, BrownMcPhee{.mu = 0.1, .mu_static = 0.12}}.
struct ContactLaw {
  ElasticLaw elastic;            // force and stored energy of a penetration
  DissipativeLaw dissipation{};  // none unless given
  FrictionLaw friction{};        // none unless given

  /// The normal force with its derivatives and energies.
  ContactOutput evaluate(const ContactInput& in) const { return dissipation.evaluate(in, elastic); }
  double penetration_limit() const { return elastic.limit(); }  ///< [m]
  std::string name() const;

  /// Those of its three parts, one after the other.
  std::vector<Parameter> parameters() const;
  /// Throws ModelError.
  void check(const double* values) const;
  /// The law with these numbers, while `this` and they exist; costs no allocation.
  ContactLaw bound(const double* values) const;
  /// Whether all parts are copies of the same.
  bool is_same(const ContactLaw& other) const {
    return elastic.is_same(other.elastic) && dissipation.is_same(other.dissipation) &&
           friction.is_same(other.friction);
  }
};

/// A law, or the law with the numbers it has now. Valid while `law` and the numbers exist.
class BoundLaw {
 public:
  /// `values` as parameters() lists them; null: the law as it is.
  BoundLaw(const ContactLaw& law, const double* values) : law_(&law) {
    if (values == nullptr) return;
    bound_.emplace(law.bound(values));
    law_ = &*bound_;
  }
  BoundLaw(const BoundLaw&) = delete;
  BoundLaw& operator=(const BoundLaw&) = delete;
  /// The law.
  const ContactLaw& operator*() const { return *law_; }
  /// The law.
  const ContactLaw* operator->() const { return law_; }

 private:
  std::optional<ContactLaw> bound_;
  const ContactLaw* law_;
};

/// F = F_e (1 + chi d'), chi [s/m] constant during a contact: the form of most published laws,
/// which differ in chi only. S = U and D = chi F_e d'^2. The factor is not clamped; in a free
/// impact it stays positive, and if a third body separates the surfaces faster than 1/chi, the
/// contact element ends the contact where the force reaches zero.
inline ContactOutput damped_in_proportion(const ElasticResponse& e, double chi, double rate) {
  const double factor = 1.0 + chi * rate;
  return {.force = e.force * factor,
          .dforce_dpenetration = e.stiffness * factor,
          .dforce_drate = chi * e.force,
          .stored_energy = e.energy,
          .dissipated_power = chi * e.force * rate * rate};
}

}  // namespace yoke
