// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/run/start/automatic_choice.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace yoke {

namespace {

// The stability bound of Dormand and Prince's pair on the negative real axis and, about, on the
// imaginary one: steps of length stable / rate.
constexpr double stable = 3.0;
// Only where stability costs this many times the steps of accuracy does an implicit method, with
// its lower order, pay.
constexpr double worth_it = 4.0;

struct Rate {
  double value = 0.0;  // [1/s]
  std::string element;
};

/// What a force on the coordinate has to move: its mass, or what the joints tie to it.
double mass_of(Dynamics& dynamics, int dof) {
  const double mass = dynamics.system().mass()[static_cast<std::size_t>(dof)];
  return mass > 0.0 ? mass : 1.0 / dynamics.mobility(dof);
}

/// The fastest rate of one force element, by the diagonal blocks of its derivatives.
double rate_of(Dynamics& dynamics, const ForceSlot& f, std::vector<double>& scratch) {
  const System& system = dynamics.system();
  const auto k = static_cast<std::size_t>(f.columns), nz = static_cast<std::size_t>(f.states);
  scratch.assign(k + 2 * k * k + nz + nz * nz + k * nz + 2 * nz * k, 0.0);
  double* next = scratch.data();
  const auto block = [&](std::size_t size) {
    double* p = next;
    next += size;
    return p;
  };
  ForceRequest out;
  out.Q = block(k);
  out.dQ_dq = block(k * k);
  out.dQ_dv = block(k * k);
  if (nz > 0) {
    out.z_dot = block(nz);
    out.dz_dz = block(nz * nz);
    out.dQ_dz = block(k * nz);
    out.dz_dq = block(nz * k);
    out.dz_dv = block(nz * k);
  }
  f.element->evaluate(system.force_input(f), out);
  double rate = 0.0;
  for (std::size_t j = 0; j < k; ++j) {
    const int dof = system.dof()[static_cast<std::size_t>(f.dofs) + j];
    if (dof < 0) continue;
    const double mass = mass_of(dynamics, dof);
    rate = std::max({rate, std::abs(out.dQ_dv[j * k + j]) / mass,
                     std::sqrt(std::abs(out.dQ_dq[j * k + j]) / mass)});
  }
  for (std::size_t i = 0; i < nz; ++i) rate = std::max(rate, std::abs(out.dz_dz[i * nz + i]));
  return rate;
}

// The derivatives of forces on all bodies, like gravity, would be a matrix over the whole model.
bool worth_asking(const ForceSlot& f) {
  constexpr int most_columns = 64;
  const Dependence depends = f.element->dependence();
  return f.element->contacts() == 0 && f.columns <= most_columns &&
         (depends.position || depends.velocity || f.states > 0);
}

Rate fastest_rate(Dynamics& dynamics, const State& given) {
  System& system = dynamics.system();
  State state = given;
  if (system.has_massless() && !dynamics.calc_accelerations(state)) return {};
  system.bind(given);
  system.set_motion(state.t, state.q.data(), state.v.data());
  system.set_multipliers(given.lambda.data());
  std::vector<double> scratch;
  Rate fastest;
  for (const ForceSlot& f : system.forces()) {
    if (!worth_asking(f)) continue;
    const double rate = rate_of(dynamics, f, scratch);
    if (rate > fastest.value) fastest = {rate, f.element->name()};
  }
  system.set_multipliers(nullptr);
  return fastest;
}

}  // namespace

Choice choose_formulation(Dynamics& dynamics, const State& state, double relative_tolerance) {
  const System& system = dynamics.system();
  const Rate fastest = fastest_rate(dynamics, state);
  // About the step that accuracy allows a method of order 5.
  const double accurate = system.scales().time * std::pow(relative_tolerance, 0.2);
  const bool has_contacts = !state.contacts.empty();
  if (fastest.value * accurate > worth_it * stable)
    return {
        "cvode-projection",
        fmt::format("'{}' is stiff: its rate of {:.2g} 1/s would bound explicit steps to {:.1g} "
                    "s, accuracy asks for about {:.1g} s",
                    fastest.element, fastest.value, stable / fastest.value, accurate)};
  return {"arkode-projection",
          fmt::format("no force is stiff at this tolerance{}{}",
                      fastest.element.empty() ? std::string()
                                              : fmt::format(" (fastest: '{}', {:.2g} 1/s)",
                                                            fastest.element, fastest.value),
                      has_contacts ? "; impacts are followed by the most accurate steps" : "")};
}

}  // namespace yoke
