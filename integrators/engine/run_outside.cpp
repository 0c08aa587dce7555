// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What is done to a run from outside: looks, changes of parameters, going back.
#include <yoke/integrators/engine/run.hpp>

#include <yoke/core/equations/grips/grips.hpp>
#include <yoke/integrators/run/failure_messages.hpp>
#include <yoke/integrators/run/start/start_checks.hpp>

namespace yoke {

Run::Look::Look(const Model& model) : dynamics(model), recorder(dynamics, row, 1) {}

/// Fresh factors each time, so that what is seen does not depend on what was looked at before.
void Run::calc_look() {
  if (!look_) look_ = std::make_unique<Look>(dynamics_.system().model());
  Look& look = *look_;
  if (look.known) return;
  look.dynamics.leave_out(dynamics_.system().left_out_rows());
  look.dynamics.system().set_scales(dynamics_.system().scales());
  look.dynamics.reset();
  look.state = state_;
  if (t_shown_ != state_.t) {
    look.dynamics.system().bind(look.state);
    formulation_->look(t_shown_, look.state, look.dynamics);
    State projected = look.state;  // at an impasse there may be none
    if (look.dynamics.project(projected)) look.state = std::move(projected);
  }
  look.known = true;
}

/// state_ has the accelerations of its parameters.
void Run::settle() {
  if (!stale_) return;
  stale_ = false;  // at the motion of the factors there are, most often
  if (!dynamics_.calc_accelerations(state_))
    fail(fmt::format("accelerations at t = {:.9g} s are not finite{}", state_.t,
                     blame_element(dynamics_.system())));
}

const State& Run::shown() {
  if (t_shown_ == state_.t) {
    if (stale_) guarded([this] { settle(); });
    return state_;
  }
  calc_look();
  return look_->state;
}

const Table& Run::columns() {
  if (options_.columns.empty()) return result_.samples;
  if (!look_) look_ = std::make_unique<Look>(dynamics_.system().model());
  return look_->row.samples;
}

const Table& Run::outputs() {
  const State& state = shown();
  if (look_ && look_->recorded) return look_->row.samples;
  calc_look();
  look_->row.samples.keep(0);
  look_->dynamics.system().bind(state);
  look_->recorder.resume(samples_->ledger());
  look_->recorder.record(state);
  look_->recorded = true;
  return look_->row.samples;
}

/// The formulation is to start from state_, which becomes that of the time shown.
void Run::disturb() {
  if (t_shown_ != state_.t) {
    calc_look();
    state_ = look_->state;
    stale_ = false;
  }
  if (look_) look_->known = look_->recorded = false;
  ahead_ = false;
  disturbed_ = true;
}

double Run::parameter(std::size_t index) const {
  std::vector<double> values = state_.parameters;
  dynamics_.system().model().update_parameters(t_shown_, values);
  return values.at(index);
}

void Run::set_parameter(std::size_t index, double value) {
  const Model& model = dynamics_.system().model();
  const Parameter parameter = model.parameter(index);
  model.check_parameter(index, value);
  std::vector<double> values = state_.parameters;
  values.at(index) = value;
  model.check_parameters(values);
  if (ended_ || value == this->parameter(index)) return;
  if (model.parameters()[index].of_constraint) {
    values = state_.parameters;
    model.update_parameters(t_shown_, values);
    values.at(index) = value;
    return drive(values);
  }
  disturb();
  System& system = dynamics_.system();
  const auto elastic = [&] {
    system.bind(state_);
    system.set_motion(state_.t, state_.q.data(), state_.v.data());
    const EnergyTerms energy = system.calc_energy();
    return energy.potential + energy.stored;
  };
  const double before = elastic();
  state_.parameters[index] = value;
  Recorder::Ledger ledger = samples_->ledger();
  ledger.initial += elastic() - before;
  samples_->set_ledger(ledger);
  stale_ = true;
  stiffness_changed_ = stiffness_changed_ || !parameter.load;
}

/// Parameters of drivers. If joints cannot follow, nothing has happened; what else the blow of a new speed
/// leads to happens at once.
void Run::drive(const std::vector<double>& values) {
  disturb();
  settle();
  if (stopped_) return;
  const State before = state_;
  try {
    elements_.drive(values);
  } catch (...) {
    state_ = before;
    dynamics_.system().bind(state_);
    throw;
  }
  stale_ = true;
  result_.summary.t_end = state_.t;
  guarded([this] {
    elements_.handle_consequences();
    if (result_.summary.stop == Stop::by_event) {
      settle();
      samples_->record_end(state_);
    }
    if (stopped_) end();
  });
}

// False if the run ends here.
bool Run::restart_if_disturbed() {
  disturbed_ = false;
  const bool changed = stale_;
  if (reaches_end(state_.t) || !take_samples_due()) return false;
  settle();
  if (stopped_) return false;
  if (changed) elements_.settle();  // friction that held may hold no longer
  if (stopped_) return false;
  standstill_.restart(state_.t);
  if (stiffness_changed_) choose_formulation_anew();
  stiffness_changed_ = false;
  start_formulation();
  return true;
}

Snapshot Run::snapshot() {
  return {.state = shown(),
          .initial_energy = samples_->ledger().initial,
          .formulation = std::string(entry_.name),
          .tolerance_kept = result_.summary.tolerance_kept,
          .left_out = dynamics_.system().left_out_rows(),
          .v_taken = shown().v};
}

void Run::restore(const Snapshot& s) {
  const Model& model = dynamics_.system().model();
  check_state(model, s.state);
  require_range("restore", "t", s.state.t, t_start_, options_.until, "s");
  if (checkpoints_.wanted())
    throw ModelError("restore: a run that writes checkpoints cannot be taken back");
  const FormulationEntry& entry = find_formulation(s.formulation);
  State state = s.state;
  const std::vector<int> left_out = dynamics_.system().left_out_rows();
  dynamics_.leave_out(s.left_out);
  dynamics_.reset();
  // A velocity that has been given is a blow, which friction does not hold.
  const bool struck = state.v != s.v_taken;
  if ((struck && !let_go_of_grips(dynamics_, state)) || !dynamics_.project(state)) {
    dynamics_.leave_out(left_out);
    dynamics_.system().bind(state_);
    throw ModelError(not_projected("restored ", state.t));
  }
  entry_ = entry;
  state_ = std::move(state);
  dynamics_.system().bind(state_);
  t_shown_ = state_.t;
  Summary& summary = result_.summary;
  summary.t_end = state_.t;
  summary.tolerance_kept = s.tolerance_kept;
  summary.formulation = s.formulation;
  summary.stop = Summary().stop;
  summary.reason = Summary().reason;
  std::erase_if(summary.singular_positions,
                [&](const SingularPosition& p) { return p.t > state_.t; });
  std::erase_if(result_.events, [&](const EventRecord& e) { return e.t > state_.t; });
  samples_->go_back(state_, s.initial_energy);
  if (formulation_) {
    cost_.write(dynamics_, *formulation_, summary);
    cost_.close(dynamics_, summary);
  }
  stopped_ = ended_ = stale_ = stiffness_changed_ = false;
  standstill_.start(state_.t, {.start = state_.t});
  disturb();
  if (struck) elements_.settle();
  largest_independence_ = 0.0;  // what it saw on other ways says nothing of the one from here
  make_formulation();
}

Run::Run(Run& original, const SimulationOptions& options)
    : Run(original.dynamics_.system().model(), original.shown(), options, original.t_start_) {
  const Snapshot here = original.snapshot();
  entry_ = find_formulation(here.formulation);
  dynamics_.system().set_scales(original.dynamics_.system().scales());
  samples_ = std::make_unique<RunSamples>(dynamics_, result_, options_, t_start_);
  result_ = original.result_so_far();
  samples_->resume(original.samples_->ledger(), original.samples_->next());
  cost_.resume(result_.summary);
  const bool ended = original.ended_;
  const Stop stop = result_.summary.stop;
  const std::string reason = result_.summary.reason;
  restore(here);
  ended_ = stopped_ = ended;
  result_.summary.stop = stop;
  result_.summary.reason = reason;
}

Result Run::result_so_far() {
  const State& state = shown();
  if (ended_) return result_;
  Result result = result_;
  result.summary.t_end = t_shown_;
  result.summary.events = static_cast<long>(result.events.size());
  cost_.write(dynamics_, *formulation_, result.summary);
  result.final = state;
  return result;
}

}  // namespace yoke
