// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/run/event_locator.hpp>

#include <boost/math/tools/toms748_solve.hpp>
#include <cstdint>
#include <limits>

namespace yoke {

EventLocator::EventLocator(System& system)
    : system_(system), values_(static_cast<std::size_t>(system.events()), 0.0) {
  fired_.reserve(values_.size());
}

double EventLocator::locate(Formulation& formulation, double from, State& scratch) {
  double t = formulation.time();
  fired_ = formulation.fired();
  for (const int slot : formulation.passed()) {
    const double crossing = locate_crossing(formulation, slot, from, scratch);
    if (crossing < t) {
      t = crossing;
      fired_.clear();
    }
    if (crossing == t) fired_.push_back(slot);
  }
  return t;
}

double EventLocator::locate_crossing(Formulation& formulation, int slot, double from,
                                     State& scratch) {
  const double to = formulation.time();
  const auto function = [&](double t) {
    formulation.interpolate(t, scratch);
    system_.set_motion(t, scratch.q.data(), scratch.v.data());
    system_.set_states(scratch.z.data());
    system_.calc_events(values_.data());
    return values_[static_cast<std::size_t>(slot)];
  };
  const double at_from = function(from), at_to = function(to);
  if (!(at_from < 0.0 && at_to > 0.0)) return to;
  std::uintmax_t iterations = 100;
  const auto bracket = boost::math::tools::toms748_solve(
      function, from, to, at_from, at_to,
      boost::math::tools::eps_tolerance<double>(std::numeric_limits<double>::digits), iterations);
  return bracket.second;
}

}  // namespace yoke
