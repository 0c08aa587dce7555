// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Which of two explicit pairs a run goes on with. Order 7 makes few steps where the motion is smooth and
// the tolerance tight; where forces have corners, as at the begin of a contact, or where the tolerance is
// loose, order 5 is cheaper. The tolerance gives the first choice, and the run itself the next: now and then
// a step is repeated with the other pair, and both say how long a step they could make there.
#pragma once

#include <array>

namespace yoke {

class OrderChoice {
 public:
  static constexpr int low = 5, high = 7;

  /// `wanted`: one of the two orders, or 0 for the better one.
  OrderChoice(double relative_tolerance, int wanted);
  /// From here on, to the next call, something touches or nothing does: each has a choice of its own.
  void start(bool touching) { span_ = &spans_[touching ? 1 : 0]; }
  int order() const { return span_->order; }
  /// Counts a step. Is it one to compare the orders at? More and more seldom.
  bool count();
  /// What they cost there: evaluations per time [1/s].
  void compare(double cost_of_low, double cost_of_high);

 private:
  struct Span {
    int order = low;
    double lead = 0.0;  // of the higher order: logarithm of the ratio of costs, smoothed
    long steps = 0, next = 0;
  };

  bool free_;
  std::array<Span, 2> spans_;  // apart, touching
  Span* span_ = spans_.data();
};

}  // namespace yoke
