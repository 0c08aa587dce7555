// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/core/assembly.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include <yoke/core/equations/dynamics.hpp>
#include <yoke/core/equations/least_change.hpp>
#include <yoke/core/equations/linear/index.hpp>

namespace yoke {

namespace {

const char* name_of(Coordinate c) {
  return c == Coordinate::x ? "x" : c == Coordinate::y ? "y" : "angle";
}
const char* unit_of(Coordinate c) { return c == Coordinate::angle ? "rad" : "m"; }

class Assembly {
 public:
  Assembly(const Model& model, const State& rough, const AssemblyOptions& options)
      : model_(model), options_(options), dynamics_(model), rough_(rough), q0_(rough.q) {
    check_options();
    const System& system = dynamics_.system();
    held_.assign(at(system.dofs()), 0);
    weights_ = metric_of_masses(system);
    for (const auto& [name, weight] : options.weights) {
      require_positive(fmt::format("assembly, body '{}'", name), "weight", weight, "");
      const auto first = at(3 * (model.find_body(name).index - 1));
      const double mass = system.mass()[first];
      for (std::size_t k = 0; k < 3; ++k)
        weights_[first + k] = mass > 0.0 ? weights_[first + k] * (weight / mass)
                                         : weight * dynamics_.length_metric()[first + k];
    }
    for (const CoordinateValue& h : options.hold) {
      q0_[index(h.body, h.coordinate, h.value)] = h.value;
      held_[at(index(h.body, h.coordinate, h.value))] = 1;
    }
    for (const Near& n : options.near) q0_[index(n.body, n.coordinate, n.value)] = n.value;
  }

  State solve() {
    dynamics_.system().bind(rough_);
    State state = rough_;
    state.q = find_pose();
    find_rates(state);
    if (const Outcome outcome = dynamics_.assemble(state); !outcome) throw ModelError(outcome.why);
    return state;
  }

 private:
  int index(const std::string& body, Coordinate coordinate, double value) const {
    require_finite(fmt::format("assembly, body '{}'", body), name_of(coordinate), value);
    const BodyId id = model_.find_body(body);
    if (id == ground) throw ModelError("assembly: the ground cannot be held or moved");
    return 3 * (id.index - 1) + static_cast<int>(coordinate);
  }

  void check_options() const {
    for (const Near& n : options_.near)
      require_not_negative(fmt::format("assembly, near, body '{}'", n.body), "within", n.within,
                           unit_of(n.coordinate));
    if (options_.starts < 0)
      throw ModelError(fmt::format("assembly: starts = {} must be at least 0", options_.starts));
  }

  // Of a coordinate from where it is asked to be, in units of what is allowed.
  double off_side(const Near& n, double value) const {
    double d = value - n.value;
    if (n.coordinate == Coordinate::angle) d = std::remainder(d, 2.0 * pi);
    const double within = n.within > 0.0 ? n.within
                          : n.coordinate == Coordinate::angle
                              ? 0.5 * pi
                              : 0.5 * dynamics_.system().scales().length;
    return std::abs(d) / within;
  }

  Eigen::VectorXd find_pose() {
    System& system = dynamics_.system();
    std::vector<char> resisting = held_;
    for (const Near& n : options_.near) resisting[at(index(n.body, n.coordinate, n.value))] = 1;
    LeastChange first(system, weights_, resisting), free(system, weights_, held_);
    std::mt19937_64 random(1);
    Outcome failure{};
    std::optional<double> nearest;
    const Near* wrong = nullptr;
    double wrong_value = 0.0, least = std::numeric_limits<double>::infinity();
    for (int start = 0; start <= options_.starts; ++start) {
      Eigen::VectorXd q = q0_;
      if (start > 0)
        for (Eigen::Index i = 0; i < q.size(); ++i) {
          const double unit = 2.0 * static_cast<double>(random() >> 11) * 0x1p-53 - 1.0;
          if (resisting[static_cast<std::size_t>(i)] == 0)
            q[i] += unit * (i % 3 == 2 ? pi : 0.5 * system.scales().length);
        }
      // With the asked-for coordinates where they are asked to be, as far as that goes; then free.
      if (!options_.near.empty()) first.solve_positions(rough_.t, q.data());
      if (!free.solve_positions(rough_.t, q.data())) {
        if (free.norm() < least) {
          least = free.norm();
          const int row = free.worst_row();
          failure = {false, fmt::format("no pose was found that satisfies all joints{}: '{}' stays "
                                        "violated by {:g} {}",
                                        options_.hold.empty() ? "" : " and holds",
                                        system.equation_name(row), free.residual()[at(row)],
                                        system.measure(row) == Measure::length ? "m" : "rad")};
        }
        continue;
      }
      const auto bad = std::ranges::find_if(options_.near, [&](const Near& n) {
        return off_side(n, q[index(n.body, n.coordinate, n.value)]) > 1.0;
      });
      if (bad == options_.near.end()) return q;
      const double off = off_side(*bad, q[index(bad->body, bad->coordinate, bad->value)]);
      if (nearest && off >= *nearest) continue;
      nearest = off;
      wrong = &*bad;
      wrong_value = q[index(bad->body, bad->coordinate, bad->value)];
    }
    if (wrong != nullptr)
      throw ModelError(
          fmt::format("assembly: no pose was found with {} of '{}' near {:g} {}; the "
                      "nearest has {:g} {}",
                      name_of(wrong->coordinate), wrong->body, wrong->value,
                      unit_of(wrong->coordinate), wrong_value, unit_of(wrong->coordinate)));
    throw ModelError("assembly: " + failure.why);
  }

  void find_rates(State& state) {
    if (options_.rates.empty()) return;
    System& system = dynamics_.system();
    std::vector<char> given(held_.size(), 0);
    for (const CoordinateValue& r : options_.rates) {
      const int i = index(r.body, r.coordinate, r.value);
      state.v[i] = r.value;
      given[at(i)] = 1;
    }
    LeastChange change(system, weights_, given);
    if (change.solve_velocities(state.t, state.q.data(), state.v.data())) return;
    const int row = change.worst_row();
    throw ModelError(fmt::format(
        "assembly: the rates given cannot be had: the rate of '{}' stays violated by {:g} {}/s",
        system.equation_name(row), change.residual()[at(row)],
        system.measure(row) == Measure::length ? "m" : "rad"));
  }

  const Model& model_;
  const AssemblyOptions& options_;
  Dynamics dynamics_;
  State rough_;
  Eigen::VectorXd q0_;
  std::vector<char> held_;
  std::vector<double> weights_;
};

}  // namespace

State assemble(const Model& model, const State& rough, const AssemblyOptions& options) {
  return Assembly(model, rough, options).solve();
}

State assemble(const Model& model, const AssemblyOptions& options) {
  return assemble(model, model.start_state(), options);
}

}  // namespace yoke
