// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/run/failure_messages.hpp>

#include <cmath>

namespace yoke {

namespace {

std::string last_event(const std::vector<EventRecord>& events) {
  if (events.empty()) return "";
  return fmt::format(" (last event: {} of '{}' at t = {:.9g} s)", events.back().kind,
                     events.back().element, events.back().t);
}

// The coordinate that is accelerated most, angles times the length scale.
Eigen::Index most_accelerated(const Eigen::VectorXd& a, double length) {
  Eigen::Index most = 0;
  double largest = 0.0;
  for (Eigen::Index i = 0; i < a.size(); ++i) {
    const double size = std::abs(a[i]) / (i % 3 == 2 ? 1.0 : length);
    if (size > largest) {
      largest = size;
      most = i;
    }
  }
  return most;
}

std::string most_violent(Dynamics& dynamics, State& there) {
  if (!there.q.allFinite() || !dynamics.calc_accelerations(there)) return "";
  const System& system = dynamics.system();
  const Eigen::Index most = most_accelerated(there.a, system.scales().length);
  const auto& body = system.model().bodies()[static_cast<std::size_t>(most / 3) + 1];
  std::string text = fmt::format("; the largest acceleration is that of '{}', {:.2g} {}", body.name,
                                 there.a[most], most % 3 == 2 ? "rad/s^2" : "m/s^2");
  if (system.rows() == 0) return text;
  dynamics.position_violation(there);
  return text + fmt::format("; the equation violated most is '{}'",
                            system.equation_name(dynamics.worst_row()));
}

// Friction may wedge a moment later: the last good state is the last that has a solution. Looked for
// along the motion as it is there, in steps that grow.
std::string blame_wedge_ahead(Dynamics& dynamics, State& there) {
  System& system = dynamics.system();
  if (system.loaded().empty() || !there.q.allFinite() || !there.v.allFinite()) return "";
  bool solved = dynamics.calc_accelerations(there);
  State ahead = there;
  for (double share = 1e-12; solved && share <= 1e-6; share *= 10.0) {
    const double h = share * system.scales().time;
    ahead.t = there.t + h;
    ahead.q = there.q + h * there.v;
    ahead.v = there.v + h * there.a;
    solved = dynamics.calc_accelerations(ahead);
  }
  system.bind(there);
  return !solved && system.wedged() ? blame_element(system) : "";
}

}  // namespace

std::string not_projected(std::string_view place, double t) {
  return fmt::format("the state {}at t = {:.9g} s cannot be projected on the constraints", place,
                     t);
}

std::string not_projected_equation(const Dynamics& dynamics, double t) {
  return fmt::format("{}; worst equation '{}'", not_projected("", t),
                     dynamics.system().equation_name(dynamics.worst_row()));
}

std::string drifted(const Dynamics& dynamics, double t, double tolerance) {
  const double drift = dynamics.worst_residual();
  return fmt::format(
      "at t = {:.9g} s '{}' is violated by {:.1e} of the length scale (or rad), {:.0e} "
      "times the tolerance: a driver or joint jumps, or the formulation drifts; try another",
      t, dynamics.system().equation_name(dynamics.worst_row()), drift, drift / tolerance);
}

std::string chattering(long most, double window, double t, const std::vector<EventRecord>& events) {
  return fmt::format(
      "more than {} events within {:g} s before t = {:.9g} s, the last of '{}': a contact that "
      "chatters; give it more damping or a softer law",
      most, window, t, events.empty() ? "?" : events.back().element);
}

std::string blame_element(const System& system) {
  const std::string& culprit = system.not_finite();
  if (culprit.empty()) return "";
  if (system.wedged())
    return fmt::format(
        ": '{}' wedges there: it makes the reaction that makes it, and no force satisfies both",
        culprit);
  return fmt::format(": '{}' gives a value that is not finite there", culprit);
}

std::string blame_surroundings(Dynamics& dynamics, State& there,
                               const std::vector<EventRecord>& events,
                               std::span<const double, 3> last_steps, bool too_tight) {
  if (!too_tight)
    if (std::string wedge = blame_wedge_ahead(dynamics, there); !wedge.empty()) return wedge;
  return fmt::format(
      ": {}{}; last steps {:.1e}, {:.1e}, {:.1e} s{}",
      too_tight ? "the tolerance is too tight for this formulation: a looser one gets on from there"
                : "a force, driver or joint has no limit there; try another formulation",
      last_event(events), last_steps[0], last_steps[1], last_steps[2],
      most_violent(dynamics, there));
}

}  // namespace yoke
