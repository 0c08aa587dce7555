// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <idas/idas.h>

#include <yoke/integrators/formulations/ida_step_control.hpp>

#include <cmath>

namespace yoke {

namespace {

constexpr long starting_steps = 8;    // the order rises by itself
constexpr double harmless = 0.02;     // error of order 1, of the tolerance
constexpr double worth_while = 0.5;   // of the step
constexpr int steps_to_forget = 3;    // of order 2 or more
constexpr int steps_of_patience = 6;  // of order 1
constexpr double usual_growth = 2.0;  // IDA's own: a step that could be this longer is doubled
constexpr double no_growth = 1e6;     // more than IDA ever proposes
constexpr double grown_again = 4.0;   // since the last shortening
constexpr double grown_since = 1.5;   // the same, after this many steps:
constexpr long steps_between = 20;
constexpr int often_refused = 8;       // growth, in as many steps
constexpr int steps_to_be_judged = 2;  // of one length, more than the order

}  // namespace

void IdaStepControl::start(void* ida) {
  *this = {};
  growing_ = false;
  allow_growth(ida, true);
}

void IdaStepControl::allow_growth(void* ida, bool allowed) {
  if (allowed != growing_) IDASetEtaFixedStepBounds(ida, 1.0, allowed ? usual_growth : no_growth);
  growing_ = allowed;
}

void IdaStepControl::accept(void* ida, double t, N_Vector weights, N_Vector scratch) {
  int order = 0, next_order = 0;
  double h = 0.0;
  IDAGetLastOrder(ida, &order);
  IDAGetCurrentOrder(ida, &next_order);
  IDAGetLastStep(ida, &h);
  same_ = h == last_h_ && order == last_order_ ? same_ + 1 : 1;
  last_h_ = h;
  last_order_ = order;
  limit_ = none;
  const bool again = is_refused_again(ida, h);
  if (again && order > 1) settling_ = order + steps_to_be_judged;
  if (++steps_ <= starting_steps) return;
  if (next_order > 1) {
    allow_growth(ida, settling_ == 0);
    if (settling_ > 0) --settling_;
  } else if (settling_ == 0) {
    shorten(ida, t, weights, scratch);
  } else if (same_ >= steps_of_patience) {
    settling_ = 0;
    allow_growth(ida, true);
  }
}

bool IdaStepControl::is_refused_again(void* ida, double h) {
  long failures = 0;
  IDAGetNumErrTestFails(ida, &failures);
  const bool refused = failures > failures_ && proposed_h_ > h;
  failures_ = failures;
  refused_ = refused ? refused_ + 1 : 0;
  IDAGetCurrentStep(ida, &proposed_h_);
  if (refused_ < often_refused) return false;
  refused_ = 0;
  return true;
}

// Steps that noise, not an error of order 1, has made short must not become shorter and shorter.
void IdaStepControl::shorten(void* ida, double t, N_Vector weights, N_Vector scratch) {
  double h = 0.0;
  IDAGetCurrentStep(ida, &h);
  const bool again = steps_ > shortened_at_ + steps_between && h > grown_since * shortened_to_;
  if (!again && !(h > grown_again * shortened_to_)) return;
  IDAGetEstLocalErrors(ida, scratch);
  const double error = N_VWrmsNorm(scratch, weights);
  if (!(error * worth_while * worth_while > harmless)) return;
  shortened_to_ = h * std::sqrt(harmless / error);
  shortened_at_ = steps_;
  limit_ = t + shortened_to_;
  settling_ = steps_to_forget;
  allow_growth(ida, false);
}

}  // namespace yoke
