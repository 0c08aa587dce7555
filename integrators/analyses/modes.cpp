// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/analyses/modes.hpp>

#include <algorithm>
#include <cmath>

#include <yoke/core/equations/dynamics.hpp>
#include <yoke/integrators/analyses/details/linearisation.hpp>
#include <yoke/integrators/analyses/details/lowest_modes.hpp>
#include <yoke/integrators/analyses/details/spectrum.hpp>
#include <yoke/integrators/run/start/start_checks.hpp>

namespace yoke {

namespace {

constexpr int largest_dense = 300;  // coordinates and states, if only the lowest modes are wanted
constexpr int default_lowest = 10;
constexpr double symmetric_below = 1e-10;  // of the largest entry
constexpr double zero_frequency = 1e-12;   // of the largest squared frequency
constexpr double zero_eigenvalue = 1e-7;   // of the largest, in the general problem

Mode make_mode(std::complex<double> s, Eigen::VectorXcd shape, const Eigen::VectorXd& mass) {
  Mode mode;
  mode.eigenvalue = s;
  const double size = std::abs(s);
  mode.frequency = size / (2.0 * pi);
  mode.damped_frequency = std::abs(s.imag()) / (2.0 * pi);
  mode.damping_ratio = size > 0.0 ? 0.0 - s.real() / size : 0.0;
  double square = 0.0;
  Eigen::Index largest = 0;
  for (Eigen::Index i = 0; i < shape.size(); ++i) {
    square += mass[i] * std::norm(shape[i]);
    if (std::abs(shape[i]) > (1.0 + 1e-9) * std::abs(shape[largest])) largest = i;
  }
  if (square > 0.0) {
    const std::complex<double> phase = std::abs(shape[largest]) / shape[largest];
    shape *= phase / std::sqrt(square);
  }
  mode.shape = std::move(shape);
  return mode;
}

bool undamped(const Linearisation& l) {
  const double size = std::max(l.K_reduced.cwiseAbs().maxCoeff(), 1e-300);
  if (l.z_z.rows() > 0) return false;
  if (l.C_reduced.cwiseAbs().maxCoeff() > symmetric_below * std::sqrt(size)) return false;
  return (l.K_reduced - l.K_reduced.transpose()).cwiseAbs().maxCoeff() < symmetric_below * size;
}

void solve_undamped(Modes& found) {
  const Linearisation& l = found.linearisation;
  const auto [square, shapes] = symmetric_spectrum(0.5 * (l.K_reduced + l.K_reduced.transpose()));
  const double zero = zero_frequency * std::max(square.cwiseAbs().maxCoeff(), 1e-12);
  for (Eigen::Index i = 0; i < square.size(); ++i) {
    const Eigen::VectorXcd shape = (l.basis * shapes.col(i)).cast<std::complex<double>>();
    if (std::abs(square[i]) <= zero) {
      found.modes.push_back(make_mode(0.0, shape, l.mass));
    } else if (square[i] > 0.0) {
      found.modes.push_back(make_mode({0.0, std::sqrt(square[i])}, shape, l.mass));
    } else {
      found.stable = false;
      const double rate = std::sqrt(-square[i]);
      found.modes.push_back(make_mode(rate, shape, l.mass));
      found.modes.push_back(make_mode(-rate, shape, l.mass));
    }
  }
}

void solve_general(Modes& found) {
  const Linearisation& l = found.linearisation;
  const Eigen::Index f = l.basis.cols();
  const auto [s, vectors] = general_spectrum("modes", l.A);
  const double largest = s.cwiseAbs().maxCoeff();
  int zeros = 0;
  for (Eigen::Index i = 0; i < s.size(); ++i) {
    const bool zero = std::abs(s[i]) <= zero_eigenvalue * largest;
    if (!zero && s[i].imag() < 0.0) continue;  // the other one of a pair
    if (zero && ++zeros % 2 == 0) continue;    // position and velocity of one motion
    const std::complex<double> value = zero ? 0.0 : s[i];
    if (value.real() > 1e-9 * largest) found.stable = false;
    const Eigen::VectorXcd p = vectors.col(i).head(f);
    found.modes.push_back(make_mode(value, l.basis * p, l.mass));
  }
}

bool undamped_at_rest(const Linearisation& l) {
  if (l.z_z.rows() > 0 || l.C.norm() > 0.0) return false;
  const Linearisation::Sparse transpose = l.K.transpose();
  return (l.K - transpose).norm() <= symmetric_below * l.K.norm();
}

/// Empty, or how many were found.
std::string find_lowest(Modes& found, int count) {
  const Linearisation& l = found.linearisation;
  if (undamped_at_rest(l)) {
    const LowestModes lowest = lowest_undamped(l, std::min(count, l.degrees_of_freedom()));
    for (std::size_t i = 0; i < lowest.values.size(); ++i) {
      const std::complex<double> s = lowest.values[i];
      found.modes.push_back(make_mode(s, lowest.shapes[i], l.mass));
      if (s.real() <= 0.0) continue;
      found.stable = false;
      found.modes.push_back(make_mode(-s, lowest.shapes[i], l.mass));
    }
    return {};
  }
  const int states = 2 * l.degrees_of_freedom() + static_cast<int>(l.z_z.rows());
  const LowestModes lowest = lowest_general(l, std::min(2 * count, states));
  double largest = 0.0;
  for (const std::complex<double>& s : lowest.values) largest = std::max(largest, std::abs(s));
  int zeros = 0;
  for (std::size_t i = 0; i < lowest.values.size(); ++i) {
    const bool zero = std::abs(lowest.values[i]) <= zero_eigenvalue * largest;
    const std::complex<double> s = zero ? 0.0 : lowest.values[i];
    if (s.imag() < 0.0 || (zero && ++zeros % 2 == 0)) continue;
    if (s.real() > 1e-9 * largest) found.stable = false;
    found.modes.push_back(make_mode(s, lowest.shapes[i], l.mass));
  }
  if (lowest.complete) return {};
  return fmt::format(
      "only {} modes were found, the others that are wanted lie too close together to be told "
      "apart, as overdamped motions do about -stiffness/damping",
      found.modes.size());
}

Modes lowest_modes(Dynamics& dynamics, const State& state, int count) {
  Modes found;
  const System& system = dynamics.system();
  if (state.v.cwiseAbs().maxCoeff() > 0.0)
    throw ModelError(
        fmt::format("modes: {} coordinates and element states are too many for the modes of a "
                    "motion, which need dense matrices (at most {}); those at rest are found",
                    system.dofs() + system.states(), largest_linearisation));
  found.linearisation = linearise_sparse(dynamics, state);
  if (found.linearisation.degrees_of_freedom() == 0) return found;
  const std::string crowded = find_lowest(found, count);
  double rate = 0.0;
  for (const Mode& mode : found.modes) rate = std::max(rate, std::abs(mode.eigenvalue));
  std::string& warning = found.linearisation.warning;
  warning = restlessness(system, state, rate);
  if (!crowded.empty()) warning += (warning.empty() ? "" : "; ") + crowded;
  return found;
}

void sort_by_frequency(std::vector<Mode>& list) {
  std::ranges::stable_sort(list,
                           [](const Mode& a, const Mode& b) { return a.frequency < b.frequency; });
}

}  // namespace

Linearisation linearise(const Model& model, const State& given) {
  check_model(model);
  check_state(model, given);
  check_linearisable(model);
  Dynamics dynamics(model);
  Linearisation l;
  l.state = given;
  if (const Outcome outcome = dynamics.assemble(l.state); !outcome) throw ModelError(outcome.why);
  return linearise_at(dynamics, l.state);
}

Modes modes(const Model& model, const State& given, const ModesOptions& options) {
  if (options.lowest < 0)
    throw ModelError(fmt::format("modes: lowest = {} must be at least 0", options.lowest));
  check_model(model);
  check_state(model, given);
  Dynamics dynamics(model);
  State state = given;
  if (const Outcome outcome = dynamics.assemble(state); !outcome) throw ModelError(outcome.why);
  const int size = dynamics.system().dofs() + dynamics.system().states();
  const int dense = options.lowest > 0 ? largest_dense : largest_linearisation;
  Modes found;
  if (size > dense) {
    found = lowest_modes(dynamics, state, options.lowest > 0 ? options.lowest : default_lowest);
  } else {
    found.linearisation = linearise_at(dynamics, state);
    if (found.linearisation.degrees_of_freedom() == 0) return found;
    if (undamped(found.linearisation))
      solve_undamped(found);
    else
      solve_general(found);
  }
  sort_by_frequency(found.modes);
  const auto wanted = static_cast<std::size_t>(options.lowest);
  if (wanted > 0 && found.modes.size() > wanted) found.modes.resize(wanted, Mode{});
  return found;
}

}  // namespace yoke
