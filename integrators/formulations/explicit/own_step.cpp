// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <cstdio>  // what the header below uses and does not include

#include <arkode/arkode_butcher.h>

#include <yoke/integrators/formulations/explicit/own_step.hpp>

#include <algorithm>
#include <limits>
#include <utility>

namespace yoke {

namespace {

constexpr int most_parts = 30;         // of a step
constexpr double next_attempt = 0.25;  // of a part that erred too much

}  // namespace

OwnStep::OwnStep(int size, Rates rates)
    : rates_(std::move(rates)), size_(static_cast<std::size_t>(size)) {
  end_rate_.assign(size_, 0.0);
  stage_ = start_ = end_rate_;
  use(explicit_pair(5));
}

void OwnStep::use(const ExplicitPair& pair) {
  pair_ = &pair;
  const auto stages = static_cast<std::size_t>(pair.table->stages);
  if (k_.size() < stages) k_.resize(stages, std::vector<double>(size_));
}

void OwnStep::from(double t, const double* y, const double* rate) {
  t_ = t;
  y_ = y;
  first_known_ = rate != nullptr;
  last_known_ = false;
  if (first_known_) std::copy_n(rate, size_, k_.front().begin());
}

void OwnStep::combine(const double* weights, int count, double h, double* y) const {
  for (std::size_t i = 0; i < size_; ++i) {
    double sum = 0.0;
    for (int j = 0; j < count; ++j) sum += weights[j] * k_[static_cast<std::size_t>(j)][i];
    y[i] = y_[i] + h * sum;
  }
}

bool OwnStep::calc_stages(int first, int last, double h) {
  for (int i = first; i < last; ++i) {
    combine(pair_->table->A[i], i, h, stage_.data());
    if (!rates_(t_ + pair_->table->c[i] * h, stage_.data(), k_[static_cast<std::size_t>(i)].data()))
      return false;
  }
  return true;
}

bool OwnStep::to(double t, double* y) {
  last_known_ = false;
  if (!first_known_) first_known_ = rates_(t_, y_, k_[0].data());
  if (!first_known_ || !calc_stages(1, pair_->stages, t - t_)) return false;
  combine(pair_->table->b, pair_->stages, t - t_, y);
  return true;
}

const double* OwnStep::rate(double t, const double* y) {
  if (!last_known_) last_known_ = rates_(t, y, end_rate_.data());
  return last_known_ ? end_rate_.data() : nullptr;
}

double OwnStep::error(double t, const double* y, const Norm& norm) {
  constexpr double unknown = std::numeric_limits<double>::infinity();
  const ARKodeButcherTableMem& table = *pair_->table;
  const double h = t - t_;
  const int last = table.stages - 1;
  if (pair_->first_same_as_last) {
    if (rate(t, y) == nullptr) return unknown;
    k_[static_cast<std::size_t>(last)] = end_rate_;
  } else if (!calc_stages(pair_->stages, table.stages, h)) {
    return unknown;
  }
  for (std::size_t i = 0; i < size_; ++i) {
    double sum = 0.0;
    for (int j = 0; j <= last; ++j)
      sum += (table.b[j] - table.d[j]) * k_[static_cast<std::size_t>(j)][i];
    stage_[i] = h * sum;
  }
  return norm(stage_.data());
}

bool OwnStep::to(double t, double* y, const Norm& norm) {
  double t_next = t;
  for (int i = 0; i < most_parts; ++i) {
    if (!to(t_next, y) || rate(t_next, y) == nullptr) return false;
    if (!(error(t_next, y, norm) <= 1.0)) {
      t_next = t_ + next_attempt * (t_next - t_);
      continue;
    }
    if (t_next == t) return true;
    std::copy_n(y, size_, start_.begin());
    from(std::exchange(t_next, t), start_.data());
    std::swap(k_.front(), end_rate_);
    first_known_ = true;
  }
  return false;
}

}  // namespace yoke
