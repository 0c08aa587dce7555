// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/core/authoring/check.hpp>

#include <algorithm>
#include <random>

#include <yoke/core/authoring/check_tools.hpp>

namespace yoke {
namespace {

// Uniform in +-(0.2 to 1): the same on every machine, and never near zero.
class Random {
 public:
  explicit Random(unsigned seed) : bits_(seed) {}
  double operator()() {
    const double u = static_cast<double>(bits_()) / 4294967296.0;
    const double size = 0.2 + 0.8 * static_cast<double>(bits_()) / 4294967296.0;
    return u < 0.5 ? -size : size;
  }

 private:
  std::mt19937 bits_;
};

template <class Element>
ElementCheck check_states(const Element& element, const Model& model,
                          const std::vector<State>& states, const CheckOptions& options) {
  ElementCheck check;
  check.element = element.name();
  bool seen = false;
  for (const State& state : states)
    if (checking::check_at(element, model, state, options, check)) seen = true;
  if (!seen && check.problem.empty())
    check.problem = "only zeros were seen: nothing has been checked at these states";
  return check;
}

std::vector<State> ugly_states(const Model& model, const CheckOptions& options) {
  std::vector<State> states;
  for (int i = 0; i < options.states; ++i)
    states.push_back(ugly_state(model, options.seed + static_cast<unsigned>(i)));
  return states;
}

double spread(const Model& model) {
  double size = 0.3;  // [m] for models whose bodies start in one place
  for (std::size_t i = 2; i < model.bodies().size(); ++i)
    size =
        std::max(size, (model.bodies()[i].pose.position - model.bodies()[1].pose.position).norm());
  return size;
}

}  // namespace

std::string ElementCheck::message() const {
  std::string text = fmt::format(
      "'{}': {} entries compared, worst error {:.2g} in {}({}, {}): {:.15g}, by differences "
      "{:.15g}",
      element, entries, worst_error, block, row, column, analytic, numeric);
  return problem.empty() ? text : text + "; " + problem;
}

ElementCheck check_element(const Constraint& element, const Model& model, const State& state,
                           const CheckOptions& options) {
  return check_states(element, model, {state}, options);
}

ElementCheck check_element(const ForceElement& element, const Model& model, const State& state,
                           const CheckOptions& options) {
  return check_states(element, model, {state}, options);
}

ElementCheck check_element(const Constraint& element, const Model& model,
                           const CheckOptions& options) {
  return check_states(element, model, ugly_states(model, options), options);
}

ElementCheck check_element(const ForceElement& element, const Model& model,
                           const CheckOptions& options) {
  return check_states(element, model, ugly_states(model, options), options);
}

std::vector<ElementCheck> check_elements(const Model& model, const CheckOptions& options) {
  std::vector<ElementCheck> checks;
  for (const auto& constraint : model.constraints())
    checks.push_back(check_element(*constraint, model, options));
  for (const auto& force : model.forces()) checks.push_back(check_element(*force, model, options));
  return checks;
}

State ugly_state(const Model& model, unsigned seed) {
  Random random(seed);
  State state = model.start_state();
  const double size = spread(model);
  state.t = 0.5 + 0.4 * random();
  for (Eigen::Index i = 0; i < state.q.size(); ++i) {
    const bool angle = i % 3 == 2;
    state.q[i] += (angle ? 2.0 : size) * random();
    state.v[i] += (angle ? 7.0 : 3.0) * random();
  }
  for (Eigen::Index i = 0; i < state.z.size(); ++i) state.z[i] += random();
  return state;
}

}  // namespace yoke
