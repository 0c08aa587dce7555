// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/joints/friction/joint_friction.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <yoke/core/equations/grips/grip_rules.hpp>
#include <yoke/joints/rows/checks.hpp>

namespace yoke {
namespace {

constexpr std::size_t width = 6;  // columns of two bodies
constexpr std::size_t most_rows = 3;

class JointFriction final : public ForceElement {
 public:
  JointFriction(const Constraint& joint, JointFrictionLaw law,
                std::unique_ptr<const JointSurface> surface)
      : ForceElement(joint.name() + ".friction", joint.bodies()),
        joint_(joint),
        law_(std::move(law.law)),
        preload_(law.preload),
        reference_force_(law.reference_force),
        surface_(std::move(surface)),
        holds_(law_.holds()) {}

  const Constraint* loaded_by() const override { return &joint_; }
  bool dissipates() const override { return true; }
  std::string signature() const override { return law_.name(); }
  std::vector<Parameter> parameters() const override { return law_.parameters(); }
  void check_parameters(const double* values) const override { law_.check(values); }

  std::vector<Channel> states() const override {
    if (!law_.has_state()) return {};
    return {{.name = "bristles", .unit = "m", .scale = law_.state_scale(reference_force_)}};
  }

  void evaluate(const ForceInput& in, const ForceRequest& out) const override {
    if (!slides(in)) return;
    const Slip slip = calc_slip(in.motion, out.dQ_dq != nullptr || out.dz_dq != nullptr);
    const Load load = calc_load(in);
    const FrictionOutput f = calc_law(in, load.force, slip.speed);
    if (out.energy != nullptr) {
      out.energy->stored = f.stored_energy;
      out.energy->dissipated_power = f.dissipated_power;
    }
    for (std::size_t i = 0; out.Q != nullptr && i < width; ++i) out.Q[i] = -f.force * slip.row[i];
    const auto rows = static_cast<std::size_t>(joint_.rows());
    for (std::size_t l = 0; out.dQ_dlambda != nullptr && l < rows; ++l)
      for (std::size_t i = 0; i < width; ++i)
        out.dQ_dlambda[i * rows + l] = -f.dforce_dnormal * load.slope[l] * slip.row[i];
    if (out.dQ_dq != nullptr || out.dQ_dv != nullptr)
      for (std::size_t i = 0; i < width; ++i) write_row(i, slip, f, out);
    if (law_.has_state()) write_state(slip, load, f, out);
  }

  int contacts() const override { return holds_ ? 1 : 0; }
  int events() const override { return holds_ ? 1 : 0; }
  bool may_hold() const override { return holds_; }
  bool may_hide(int) const override { return false; }
  void initialise_contacts(EventContext& context) const override {
    context.contact->grip = grip_at_onset(Grip::none, sliding(context.input).speed);
  }
  void calc_events(const ForceInput& in, double* g) const override {
    *g = calc_grip_event(*this, in, [&] { return sliding(in); });
  }
  void handle_event(int, EventContext& context) const override {
    context.contact->grip = grip_after_event(context.input, [&] { return sliding(context.input); });
  }
  void grip_changed(Grip before, EventContext& context) const override {
    const Grip now = context.contact->grip;
    if (before == Grip::none || rests(now) == rests(before)) return;
    EventRecord record;
    record.kind = rests(now) ? "stick" : "slip";
    context.record(std::move(record));
  }
  void calc_hold(const ForceInput& in, const ConstraintRequest& out) const override {
    const Slip slip = calc_slip(in.motion, true);
    if (out.G != nullptr) std::ranges::copy(slip.row, out.G);
    if (out.phi_t != nullptr) *out.phi_t = 0.0;
    if (out.H != nullptr) std::ranges::copy(slip.turned, out.H);
    if (out.gamma != nullptr) *out.gamma = -dot(slip.turned, velocity(in.motion));
    for (std::size_t i = 0; out.K != nullptr && i < width * width; ++i)
      out.K[i] += *out.lambda * slip.slope[i];
  }
  double holding_force(const ForceInput& in) const override {
    return law_.bound(in.parameters).holding_force(calc_load(in).force);
  }

  std::vector<Channel> channels() const override {
    return {{"load", "N"}, {"sliding_velocity", "m/s"}, {"friction_force", "N"}};
  }
  void calc_channels(const ForceInput& in, double* values) const override {
    values[0] = calc_load(in).force;
    values[1] = sliding(in).speed;
    values[2] = slides(in)           ? calc_law(in, values[0], values[1]).force
                : in.hold != nullptr ? *in.hold
                                     : 0.0;
  }

 private:
  using Row = std::array<double, width>;
  struct Slip {
    Row row{}, turned{};  // s, and S^T v = d(s v)/dq
    std::array<double, width * width> slope{};
    double speed = 0.0;
  };
  struct Load {
    double force = 0.0;  // [N] with the preload
    std::array<double, most_rows> slope{};
  };

  static double dot(const Row& a, const Row& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < width; ++i) sum += a[i] * b[i];
    return sum;
  }

  bool slides(const ForceInput& in) const {
    return !holds_ || direction_of(in.contact->grip) != 0.0;
  }

  Row velocity(const Motion& motion) const {
    const BodyMotion& a = motion[joint_.bodies()[0]];
    const BodyMotion& b = motion[joint_.bodies()[1]];
    return {a.vx, a.vy, a.omega, b.vx, b.vy, b.omega};
  }

  Slip calc_slip(const Motion& motion, bool want_slope) const {
    Slip slip;
    surface_->calc_slip(motion, slip.row.data(), want_slope ? slip.slope.data() : nullptr);
    const Row v = velocity(motion);
    slip.speed = dot(slip.row, v);
    for (std::size_t i = 0; want_slope && i < width; ++i)
      for (std::size_t j = 0; j < width; ++j) slip.turned[j] += v[i] * slip.slope[width * i + j];
    return slip;
  }

  Sliding sliding(const ForceInput& in) const {
    const Slip slip = calc_slip(in.motion, false);
    const Row v = velocity(in.motion);
    double terms = 0.0;
    for (std::size_t i = 0; i < width; ++i) terms += std::abs(slip.row[i] * v[i]);
    return {slip.speed, slowest_sliding(in.scales, terms)};
  }

  Load calc_load(const ForceInput& in) const {
    Load load;
    if (in.multipliers != nullptr)
      load.force = surface_->calc_load(in.multipliers, load.slope.data());
    load.force += preload_;
    return load;
  }

  FrictionOutput calc_law(const ForceInput& in, double load, double speed) const {
    return law_.bound(in.parameters)
        .evaluate({.normal_force = load,
                   .sliding = speed,
                   .state = law_.has_state() ? in.z[0] : 0.0,
                   .direction = holds_ ? direction_of(in.contact->grip) : 0.0,
                   .reference_force = reference_force_});
  }

  void write_state(const Slip& slip, const Load& load, const FrictionOutput& f,
                   const ForceRequest& out) const {
    if (out.z_dot != nullptr) out.z_dot[0] = f.rate;
    if (out.dz_dz != nullptr) out.dz_dz[0] = f.drate_dstate;
    for (std::size_t i = 0; i < width; ++i) {
      if (out.dQ_dz != nullptr) out.dQ_dz[i] = -f.dforce_dstate * slip.row[i];
      if (out.dz_dq != nullptr) out.dz_dq[i] = f.drate_dsliding * slip.turned[i];
      if (out.dz_dv != nullptr) out.dz_dv[i] = f.drate_dsliding * slip.row[i];
    }
    for (int l = 0; out.dz_dlambda != nullptr && l < joint_.rows(); ++l)
      out.dz_dlambda[l] = f.drate_dnormal * load.slope[static_cast<std::size_t>(l)];
  }

  void write_row(std::size_t i, const Slip& slip, const FrictionOutput& f,
                 const ForceRequest& out) const {
    for (std::size_t j = 0; j < width; ++j) {
      const std::size_t entry = i * width + j;
      const double push = f.dforce_dsliding * slip.row[i];
      if (out.dQ_dq != nullptr)
        out.dQ_dq[entry] = -push * slip.turned[j] - f.force * slip.slope[entry];
      if (out.dQ_dv != nullptr) out.dQ_dv[entry] = -push * slip.row[j];
    }
  }

  const Constraint& joint_;
  FrictionLaw law_;
  double preload_, reference_force_;  // [N]
  std::unique_ptr<const JointSurface> surface_;
  bool holds_;
};

}  // namespace

std::unique_ptr<ForceElement> joint_friction(const Constraint& joint, JointFrictionLaw law,
                                             std::unique_ptr<const JointSurface> surface) {
  const std::string owner = "friction of '" + joint.name() + "'";
  if (law.law.none()) throw ModelError(owner + ": law is missing");
  require_not_negative(owner, "preload", law.preload, "N");
  require_positive(owner, "reference_force", law.reference_force, "N");
  return std::make_unique<JointFriction>(joint, std::move(law), std::move(surface));
}

}  // namespace yoke
