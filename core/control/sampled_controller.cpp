// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/core/control/sampled_controller.hpp>

#include <algorithm>
#include <cmath>

#include <yoke/core/error.hpp>

namespace yoke {

namespace {

class SampledControllerElement final : public ForceElement {
 public:
  SampledControllerElement(SampledController c, std::vector<std::size_t> outputs, std::size_t first)
      : ForceElement(c.name, {}, {.position = false, .velocity = false}),
        controller_(std::move(c)),
        outputs_(std::move(outputs)),
        first_(first) {}

  void evaluate(const ForceInput&, const ForceRequest&) const override {}
  bool supplies() const override { return true; }

  std::vector<Parameter> parameters() const override {
    std::vector<Parameter> all = {{"samples", "1", 0.0, 0.0}};
    all.insert(all.end(), controller_.memory.begin(), controller_.memory.end());
    return all;
  }

  double next_sample(const ForceInput& in) const override {
    return time_of(next_number(in.parameters[0], in.motion.t));
  }

  void sample(EventContext& context) const override {
    double* own = context.parameters + first_;
    const double number = next_number(own[0], context.input.motion.t);
    controller_.update({.motion = context.input.motion,
                        .number = static_cast<long>(number),
                        .period = controller_.period,
                        .stop = context.stop,
                        .parameters = context.parameters,
                        .outputs = &outputs_,
                        .remembered = own + 1});
    own[0] = number + 1.0;
  }

  std::string signature() const override {
    std::string text = fmt::format("{:.17g} {:.17g}", controller_.period, controller_.offset);
    for (const std::string& output : controller_.outputs) text += " " + output;
    return text;
  }

 private:
  double time_of(double number) const { return controller_.offset + number * controller_.period; }

  /// The first that is not taken yet and not before t. Numbers are whole, as in exact arithmetic.
  double next_number(double taken, double t) const {
    if (time_of(taken) >= t) return taken;
    const double exact = (t - controller_.offset) / controller_.period;
    const double rounding = 8.0 * std::numeric_limits<double>::epsilon() * std::abs(exact);
    return std::max(taken, std::ceil(exact - rounding));
  }

  SampledController controller_;
  std::vector<std::size_t> outputs_;  // indices into State::parameters
  std::size_t first_;                 // of its own
};

}  // namespace

std::unique_ptr<ForceElement> SampledController::build(const Model& model) const {
  const std::string owner = fmt::format("controller '{}'", name);
  require_positive(owner, "period", period, "s");
  require_finite(owner, "offset", offset);
  if (!update) throw ModelError(owner + ": it has no update");
  std::vector<std::size_t> indices;
  for (const std::string& output : outputs) {
    const auto index = model.parameter_index(output);
    if (!index)
      throw ModelError(fmt::format("{}: outputs: {}; add it before the controller", owner,
                                   model.unknown_parameter(output)));
    indices.push_back(*index);
  }
  return std::make_unique<SampledControllerElement>(*this, std::move(indices),
                                                    model.start_state().parameters.size());
}

}  // namespace yoke
