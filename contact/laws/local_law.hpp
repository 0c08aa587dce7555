// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A contact law at one place of a wall. Of most laws that is the law itself. One that follows the
// curvature k of the wall is bound to k here, for one evaluation, without memory of its own; with U
// its stored energy:
//   F(d, d'), dF/dd, dF/dd'    as of any law, k held
//   dF/dk                      force_slope()
//   U, dU/dk, d2U/dk2, d2U/dd dk    elastic().response(d), graded(d)
#pragma once

#include <yoke/contact/laws/law.hpp>

namespace yoke {

/// Valid while `law` and this exist; neither is copied.
class LocalLaw {
 public:
  /// `curvature` [1/m] of the wall, > 0 convex.
  LocalLaw(const ContactLaw& law, double curvature) : law_(law), bound_(law.elastic, curvature) {
    if (!follows()) return;
    here_ = view(bound_, law.elastic.limit());
    slope_ = view(change_, law.elastic.limit());
  }
  LocalLaw(const LocalLaw&) = delete;
  LocalLaw& operator=(const LocalLaw&) = delete;

  /// Whether the law depends on the curvature.
  bool follows() const { return law_.elastic.follows_curvature(); }
  /// The elastic part at this curvature.
  const ElasticLaw& elastic() const { return follows() ? here_ : law_.elastic; }
  /// The dissipative part, the same everywhere.
  const DissipativeLaw& dissipation() const { return law_.dissipation; }
  /// Normal force, derivatives and energies at this curvature.
  ContactOutput evaluate(const ContactInput& in) const {
    return law_.dissipation.evaluate(in, elastic());
  }
  /// Only if follows().
  GradedResponse graded(double penetration) const {
    return law_.elastic.response(penetration, bound_.curvature);
  }
  /// [N m] derivative of the force by the curvature; only if follows().
  double force_slope(const ContactInput& in) const {
    const DissipativeLaw& d = law_.dissipation;
    if (d.none()) return slope_.response(in.penetration).force;
    if (d.knows_force_change()) return d.force_change(in, here_, slope_);
    // A sum of multiples of the elastic response, and perhaps a constant.
    static const NoForce none{};
    return d.evaluate(in, slope_).force - d.evaluate(in, view(none, slope_.limit())).force;
  }

 private:
  struct Bound final : ElasticLaw::Function {
    Bound(const ElasticLaw& elastic, double at) : law(elastic), curvature(at) {}
    ElasticResponse respond(double penetration) const override {
      return law.response(penetration, curvature).here;
    }
    double limit() const override { return law.limit(); }
    std::string name() const override { return law.name(); }
    const ElasticLaw& law;
    double curvature;
  };
  struct Change final : ElasticLaw::Function {
    explicit Change(const Bound& of) : bound(of) {}
    ElasticResponse respond(double penetration) const override {
      const GradedResponse r = bound.law.response(penetration, bound.curvature);
      return {.force = r.force_slope, .energy = r.energy_slope};
    }
    double limit() const override { return bound.law.limit(); }
    std::string name() const override { return bound.law.name(); }
    const Bound& bound;
  };
  struct NoForce final : ElasticLaw::Function {
    ElasticResponse respond(double) const override { return {}; }
    double limit() const override { return std::numeric_limits<double>::infinity(); }
    std::string name() const override { return "none"; }
  };

  /// Owns nothing, and so costs no allocation.
  static ElasticLaw view(const ElasticLaw::Function& function, double limit) {
    ElasticLaw law;
    law.function_ = std::shared_ptr<const ElasticLaw::Function>(std::shared_ptr<void>(), &function);
    law.limit_ = limit;
    return law;
  }

  const ContactLaw& law_;
  Bound bound_;
  Change change_{bound_};
  ElasticLaw here_, slope_;
};

}  // namespace yoke
