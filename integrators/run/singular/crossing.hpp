// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The formulation that singular_crossing.hpp describes.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <yoke/core/result.hpp>
#include <yoke/integrators/formulations/event_guard.hpp>
#include <yoke/integrators/formulations/formulation.hpp>
#include <yoke/integrators/run/singular/gauss_collocation.hpp>

namespace yoke {

class SingularCrossing final : public Formulation {
 public:
  SingularCrossing(const FormulationEntry& entry, Dynamics& dynamics, const Tolerances& tolerances,
                   std::function<void(const SingularPosition&)> record, double& largest);

  void start(const State& state) override;
  Step step(double t_stop) override;
  double time() const override { return crossing_ ? t_ : inner_->time(); }
  bool ends_projected() const override { return !crossing_ && inner_->ends_projected(); }
  double last_step() const override { return crossing_ ? segment_.h : inner_->last_step(); }
  void interpolate(double t, State& state) override;
  void sample(double t, State& state) override;
  void glance(double t, State& state) override;
  void look(double t, State& state, Dynamics& equations) override;
  void restart(const State& state) override;
  const std::vector<int>& fired() const override {
    return crossing_ ? guard_.fired() : inner_->fired();
  }
  const std::vector<int>& passed() const override {
    return crossing_ ? guard_.passed() : inner_->passed();
  }
  StepCounters counters() const override;
  std::string failure() const override { return crossing_ ? failure_ : inner_->failure(); }

 private:
  static constexpr double near = 0.02;  // of the largest independence seen: leave the formulation
  // Of the largest: what is reported as crossed.
  static constexpr double was_singular = 1e-6;
  static constexpr double far = 1e300;  // [s] no singular position in sight
  static constexpr int sweeps = 3;      // for a measure that is to be compared with the one beside
  // Of the time scale: steps are not cut below for accuracy; while a contact touches its impact
  // must be followed.
  static constexpr double shortest_apart = 1e-3, shortest_touching = 1e-7;

  Step step_inside(double t_stop, bool looks = true);
  bool has_passed();
  bool has_passed_beside_end(double part);
  double parts_of_step() const;
  double measure_inside(double t);
  bool is_minimum_near(double a, double middle, double b);
  void renew();
  Step cross(double t_stop);
  void watch();
  bool heads_for_zero();
  bool choose_other_rows();
  void begin_crossing();
  bool try_step(double t_stop, double energy_before);
  double allowed_energy_change(double energy) const;
  Step abandon_crossing(double t_stop);
  void record_crossed();
  void record_positions();
  double propose(double rest, double most) const;
  Step accept_segment();
  bool find_event(int& slot, double& t);
  void end_crossing();
  void look_into_segment(double until);
  void look_beside(double t, std::size_t known, double until, double distance);
  double measure_in_segment(double t, int rounds = sweeps);
  double find_minimum(double a, double b);
  void note_position();
  double energy(double t, const double* y);
  void unpack(double t, const double* y, State& state) const;
  void check_redundant(double t, const double* q);

  FormulationEntry entry_;
  Dynamics& dynamics_;
  Tolerances tolerances_;
  double shortest_ = shortest_apart;
  std::function<void(const SingularPosition&)> record_;
  std::unique_ptr<Formulation> inner_;
  GaussCollocation gauss_, check_;
  EventGuard guard_;
  StepCounters before_{}, own_{};
  bool watches_;
  std::vector<bool> is_work_;

  State here_;           // where the last step ended, or a restart began
  State next_, inside_;  // where the step ends that has just been made; scratch
  double m_ = 1.0;       // independence there
  double& largest_;      // seen in the run
  double t_m_ = 0.0, m_before_ = 1.0, dt_ = 1.0;
  bool has_before_ = false;
  bool passed_ = false;    // has a step been taken back that had passed it? inside_ is there
  double hold_off_ = 2.0;  // enter only below this: what has proved to be harmless is above

  bool crossing_ = false, entering_ = false, leaving_ = false;
  bool loads_only_ = false;  // is the start one after which the step size is still good?
  bool forced_ = false;      // because the formulation failed
  GaussCollocation::Segment segment_, trial_;
  double t_ = 0.0, h_ = 0.0, to_singular_ = far;
  int segments_ = 0;
  double m_entry_ = 0.0, m_last_ = 0.0;
  double energy_entry_ = 0.0, kinetic_entry_ = 0.0;
  SingularPosition found_, least_;  // the least of this crossing; of the last find_minimum()
  bool falls_at_end_ = false;       // the independence, in the last segment
  bool has_found_ = false;
  std::vector<SingularPosition> positions_;  // where the rank fell, not yet recorded
  bool has_recorded_ = false;                // any of this crossing
  std::vector<double> y_, g_;
  std::vector<int> found_events_;
  std::string failure_, inner_failure_;
};

}  // namespace yoke
