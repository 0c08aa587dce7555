// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Steps of IDA where its order has fallen to 1. The error of a step of order 1 in an equation with
// constraints can be several times what is estimated of it. It stands in the history when the order
// rises to 2, where it passes for a third derivative: the estimate of order 2 becomes too large,
// the more so if the step grows in the same moment, as IDA's do, and the order falls again. IDA
// then goes on at order 1 for ever, with steps a thousand times too short (behind a singular
// position of a mechanism of 40 loops).
//
// So after a fall a few steps are made so short that the error of order 1 is nothing, and the step
// does not grow again before order 2 has forgotten it.
//
// Steps of any order that double and are refused, again and again: a change of the step is itself a
// disturbance where errors of positions are made good by velocities, as in Baumgarte's equations. The order
// is not judged then, since IDA waits for steps of one length. So they get some.
#pragma once

#include <yoke/integrators/sundials/vector.hpp>

#include <limits>

namespace yoke {

class IdaStepControl {
 public:
  /// IDA begins anew.
  void start(void* ida);
  /// After a step that ended at `t`. Scratch is a vector like y.
  void accept(void* ida, double t, N_Vector weights, N_Vector scratch);
  /// The next step is to end here at the latest [s].
  double limit() const { return limit_; }

 private:
  void allow_growth(void* ida, bool allowed);
  bool is_refused_again(void* ida, double h);
  void shorten(void* ida, double t, N_Vector weights, N_Vector scratch);

  static constexpr double none = std::numeric_limits<double>::infinity();
  double limit_ = none;
  long steps_ = 0;
  int same_ = 0;      // steps of this size and order
  int settling_ = 0;  // steps of order 2 or more before the next growth
  double last_h_ = 0.0;
  int last_order_ = 0;
  double shortened_to_ = 0.0;
  long shortened_at_ = 0;
  bool growing_ = true;
  long failures_ = 0;        // of IDA's error test
  int refused_ = 0;          // attempts to grow, one after the other
  double proposed_h_ = 0.0;  // for the step that was accepted now
};

}  // namespace yoke
