// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/contact/wall_law.hpp>

#include <algorithm>
#include <cmath>

#include <yoke/contact/laws/graded_law.hpp>
#include <yoke/core/error.hpp>

namespace yoke {

namespace {

constexpr double alike = 1e-9;       // shares of a curvature that are none
constexpr double exactness = 1e-12;  // of a dissipative law, where one formula is meant

bool same(double a, double b, double size) { return std::abs(a - b) <= exactness * size; }

/// What a dissipative law that is to follow the curvature must be, looked at with the exact laws of the
/// two ends of the wall.
class DissipationCheck {
 public:
  DissipationCheck(const ContactLaw& low, const ContactLaw& high, double reference_force)
      : low_(low),
        high_(high),
        penetration_(low.elastic.penetration_at(reference_force)),
        memory_{
            .phase = ContactPhase::compressing, .approach_velocity = 0.3, .effective_mass = 1.0} {}

  /// Empty if nothing.
  std::string what_is_wrong() const {
    const DissipativeLaw& law = low_.dissipation;
    if (law.needs_largest_penetration()) return "unloads on another path than it loads";
    if (law.has_kink()) return "has a kink";
    for (const double rate : {0.3, -0.1, 0.0}) {
      const double force = this->force(law, low_.elastic, rate), size = std::abs(force);
      if (!same(this->force(high_.dissipation, low_.elastic, rate), force, size))
        return "is another one at one end of the wall than at the other";
      const ElasticResponse elastic = low_.elastic.response(penetration_);
      const double stored = law.evaluate({penetration_, rate, memory_}, low_.elastic).stored_energy;
      if (!same(stored, elastic.energy, elastic.energy))
        return "stores another energy than the elastic law";
      if (!law.knows_force_change() && !sums(rate))
        return "is no sum of multiples of the elastic force, and does not declare force_change()";
    }
    return {};
  }

 private:
  double force(const DissipativeLaw& law, const ElasticLaw& elastic, double rate) const {
    return law.evaluate({penetration_, rate, memory_}, elastic).force;
  }
  /// Is the force of the sum of two elastic laws the sum of their forces, but for a constant?
  bool sums(double rate) const {
    const ElasticLaw a = low_.elastic, b = high_.elastic;
    const ElasticLaw sum([a, b](double d) {
      const ElasticResponse x = a.response(d), y = b.response(d);
      return ElasticResponse{x.force + y.force, x.stiffness + y.stiffness, x.energy + y.energy};
    });
    const ElasticLaw none([](double) { return ElasticResponse{}; });
    const DissipativeLaw& law = low_.dissipation;
    const double whole = force(law, sum, rate);
    return same(whole + force(law, none, rate), force(law, a, rate) + force(law, b, rate),
                std::abs(whole));
  }

  const ContactLaw &low_, &high_;
  double penetration_;  // [m]
  ContactMemory memory_;
};

}  // namespace

ContactLaw WallLaw::at(const std::string& owner, const Slot& slot, int region, SlotRegion kind,
                       const CurvatureRange& range, double disc_radius,
                       double reference_force) const {
  if (law_) return *law_;
  const auto law_at = [&](double curvature) {
    return of_wall_({.region = kind, .curvature = curvature});
  };
  if (range.low == range.high) return law_at(range.low);
  const double size = std::max(
      {std::abs(range.low), std::abs(range.high), disc_radius > 0.0 ? 1.0 / disc_radius : 0.0});
  if (radii_ == Radii::mean || range.high - range.low <= alike * size) return law_at(range.mean);
  const std::string wall = fmt::format("{}: wall '{}'", owner, region_name(kind));
  if (!slot.follows(region))
    throw ModelError(fmt::format(
        "{}: a law that follows its curvature needs a shape that tells how it changes; this one does "
        "not. Take Radii::mean, or a law for each wall",
        wall));
  const ContactLaw low = law_at(range.low), high = law_at(range.high);
  const std::string wrong = DissipationCheck(low, high, reference_force).what_is_wrong();
  if (!wrong.empty())
    throw ModelError(fmt::format(
        "{}: the law '{}' cannot follow the curvature of the wall: it {}. Take Radii::mean, or a law "
        "for each wall",
        wall, low.dissipation.name(), wrong));
  return {graded_law(wall, [&](double curvature) { return law_at(curvature).elastic; },
                     {.low = range.low,
                      .high = range.high,
                      .disc_radius = disc_radius,
                      .reference_force = reference_force}),
          low.dissipation, law_at(range.mean).friction};
}

std::vector<ContactLaw> laws_along(const std::string& owner, const Slot& slot, double disc_radius,
                                   double reference_force,
                                   const std::function<WallLaw(SlotRegion)>& law_of) {
  const std::vector<SlotRegion> kinds = slot.regions();
  const std::vector<CurvatureRange> ranges = slot.curvatures();
  std::vector<ContactLaw> laws;
  for (std::size_t i = 0; i < kinds.size(); ++i)
    laws.push_back(law_of(kinds[i]).at(owner, slot, static_cast<int>(i), kinds[i], ranges[i],
                                       disc_radius, reference_force));
  return laws;
}

}  // namespace yoke
