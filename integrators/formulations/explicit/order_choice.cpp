// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/formulations/explicit/order_choice.hpp>

#include <algorithm>
#include <cmath>

namespace yoke {

namespace {

// Relative tolerances from which on the higher order is the first choice, by the table of
// docs/cost.md; and how sure that is, a logarithm of costs.
constexpr double tight_apart = 1e-5, tight_touching = 1e-8;
constexpr double first_lead = 0.2;
constexpr long first_comparison = 4;  // [steps]
constexpr long longer = 4;            // to the next one
constexpr double smoothing = 0.4;     // weight of a new comparison
constexpr double most = 1.5;          // of one comparison
constexpr double worth_it = 0.1;      // lead for which the order is changed

}  // namespace

OrderChoice::OrderChoice(double relative_tolerance, int wanted) : free_(wanted == 0) {
  const double tight[] = {tight_apart, tight_touching};
  for (std::size_t i = 0; i < spans_.size(); ++i) {
    const bool is_tight = relative_tolerance <= tight[i] * (1.0 + 1e-9);
    spans_[i] = {.order = free_ ? (is_tight ? high : low) : wanted,
                 .lead = is_tight ? first_lead : -first_lead,
                 .next = first_comparison};
  }
}

bool OrderChoice::count() {
  if (!free_ || ++span_->steps < span_->next) return false;
  span_->next *= longer;
  return true;
}

void OrderChoice::compare(double cost_of_low, double cost_of_high) {
  const double lead = std::log(cost_of_low / cost_of_high);
  if (std::isnan(lead)) return;
  span_->lead += smoothing * (std::clamp(lead, -most, most) - span_->lead);
  if (span_->order == low && span_->lead > worth_it) span_->order = high;
  if (span_->order == high && span_->lead < -worth_it) span_->order = low;
}

}  // namespace yoke
