// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/contact/laws/catalog/calibrated.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include <yoke/contact/laws/forms/proportional_damping.hpp>
#include <yoke/core/error.hpp>

namespace yoke {

DissipativeArguments calibrated_arguments(std::string_view name, double e,
                                          DissipativeArguments arguments) {
  const std::string owner = fmt::format("calibrated law '{}'", find_dissipative(name).name);
  require_range(owner, "e", e, 0.0, 1.0);
  if (name == "none")
    throw ModelError(fmt::format("{}: it has no coefficient to solve for", owner));
  if (name == "herbert-mcwhannell" && arguments.empirical)
    throw ModelError(
        fmt::format("{}: the empirical restitution leaves nothing to solve for", owner));
  if (name == "hunt-crossley" && arguments.alpha)
    throw ModelError(
        fmt::format("{}: alpha = {:g} s/m is given; a constant alpha delivers e at one speed only",
                    owner, *arguments.alpha));

  const double v_i = std::max(1.0, arguments.slowest_approach);  // any above the floor
  const auto delivered = [&](double asked) {
    arguments.restitution = asked;
    return closed_form_restitution(name, arguments, 1.0, v_i);
  };
  const std::optional<double> most = delivered(1.0);
  if (!most)
    throw ModelError(fmt::format("{}: it has no closed form of the restitution delivered", owner));

  // Every law delivers more if more is asked. The least it accepts: 0, a margin above it, or 1/3.
  double low = 0.0, high = 1.0;
  if (name == "marhefka-orin-simplified") {
    low = 1.0 / 3.0 + 1e-9;
  } else {
    try {
      delivered(low);
    } catch (const ModelError&) {
      low = least_restitution;
    }
  }
  const double least = *delivered(low);
  if (!(e >= least && e <= *most))
    throw ModelError(
        fmt::format("{}: e = {:g} is outside what it can deliver, {:.6g} to {:.6g}, whatever its "
                    "coefficient",
                    owner, e, least, *most));
  while (true) {
    const double middle = 0.5 * (low + high);
    if (!(middle > low && middle < high)) break;
    (*delivered(middle) >= e ? high : low) = middle;
  }
  arguments.restitution = high;
  return arguments;
}

DissipativeLaw calibrated(std::string_view name, double e, const DissipativeArguments& others) {
  return make_dissipative(name, calibrated_arguments(name, e, others));
}

HuntCrossley calibrated_alpha(double e, double approach_velocity) {
  require_range("calibrated law 'hunt-crossley'", "e", e, least_restitution, 1.0);
  require_positive("calibrated law 'hunt-crossley'", "approach velocity", approach_velocity, "m/s");
  return {damping_for_restitution(e) / (1.5 * approach_velocity)};
}

}  // namespace yoke
