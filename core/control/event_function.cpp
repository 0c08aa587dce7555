// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/core/control/event_function.hpp>

#include <yoke/core/error.hpp>

namespace yoke {

namespace {

class EventFunctionElement final : public ForceElement {
 public:
  explicit EventFunctionElement(EventFunction description)
      : ForceElement(description.name, {}, {.position = false, .velocity = false}),
        event_(std::move(description)) {}

  void check(const Model& model) const override {
    for (const ParameterChange& change : event_.set)
      model.check_parameter(fmt::format("event '{}'", name()), change.parameter, change.value);
  }

  void evaluate(const ForceInput&, const ForceRequest&) const override {}
  bool supplies() const override { return !event_.set.empty() || event_.action; }

  int events() const override { return event_.crossing == Crossing::both ? 2 : 1; }
  void calc_events(const ForceInput& in, double* g) const override {
    const double value = event_.function(in.motion);
    g[0] = event_.crossing == Crossing::downwards ? -value : value;
    if (event_.crossing == Crossing::both) g[1] = -value;
  }

  bool events_settle() const override { return true; }
  std::string signature() const override {
    std::string text = fmt::format("{} {} {}", static_cast<int>(event_.crossing), event_.stop,
                                   event_.action != nullptr);
    for (const ParameterChange& c : event_.set)
      text += fmt::format(" {}={:.17g}", c.parameter, c.value);
    return text;
  }

  void handle_event(int slot, EventContext& context) const override {
    const bool upwards =
        event_.crossing == Crossing::both ? slot == 0 : event_.crossing == Crossing::upwards;
    EventRecord record;
    record.kind = "event";
    record.region = upwards ? "upwards" : "downwards";
    context.record(record);
    for (const ParameterChange& change : event_.set)
      context.parameter(change.parameter) = change.value;
    if (event_.action)
      event_.action({.motion = context.input.motion,
                     .parameter = context.parameter,
                     .stop = context.stop,
                     .impulse = context.impulse});
    if (event_.stop) context.stop();
  }

 private:
  EventFunction event_;
};

}  // namespace

std::unique_ptr<ForceElement> EventFunction::build(const Model&) const {
  if (!function) throw ModelError(fmt::format("event '{}': it has no function", name));
  for (const ParameterChange& change : set)
    require_finite(fmt::format("event '{}'", name), change.parameter, change.value);
  return std::make_unique<EventFunctionElement>(*this);
}

}  // namespace yoke
