// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <cstdio>  // what the header below uses and does not include

#include <arkode/arkode_butcher_erk.h>

#include <yoke/integrators/formulations/own_step.hpp>

#include <algorithm>
#include <utility>

namespace yoke {

namespace {

constexpr int most_parts = 30;         // of a step
constexpr double next_attempt = 0.25;  // of a part that erred too much

}  // namespace

OwnStep::OwnStep(int size, Rates rates)
    : rates_(std::move(rates)),
      table_(ARKodeButcherTable_LoadERK(ARKODE_DORMAND_PRINCE_7_4_5)),
      stages_(table_->stages) {
  while (table_->b[stages_ - 1] == 0.0) --stages_;  // first same as last
  stage_.assign(static_cast<std::size_t>(size), 0.0);
  start_ = stage_;
  k_.assign(static_cast<std::size_t>(table_->stages), stage_);
}

OwnStep::~OwnStep() { ARKodeButcherTable_Free(table_); }

void OwnStep::from(double t, const double* y) {
  t_ = t;
  y_ = y;
  first_known_ = last_known_ = false;
}

void OwnStep::combine(const double* weights, int count, double h, double* y) const {
  for (std::size_t i = 0; i < stage_.size(); ++i) {
    double sum = 0.0;
    for (int j = 0; j < count; ++j) sum += weights[j] * k_[static_cast<std::size_t>(j)][i];
    y[i] = y_[i] + h * sum;
  }
}

bool OwnStep::calc_stages(double t) {
  const double h = t - t_;
  last_known_ = false;
  if (!first_known_) first_known_ = rates_(t_, y_, k_[0].data());
  if (!first_known_) return false;
  for (int i = 1; i < stages_; ++i) {
    combine(table_->A[i], i, h, stage_.data());
    if (!rates_(t_ + table_->c[i] * h, stage_.data(), k_[static_cast<std::size_t>(i)].data()))
      return false;
  }
  return true;
}

bool OwnStep::to(double t, double* y) {
  if (!calc_stages(t)) return false;
  combine(table_->b, stages_, t - t_, y);
  return true;
}

const double* OwnStep::rate(double t, const double* y) {
  if (!last_known_) last_known_ = rates_(t, y, k_.back().data());
  return last_known_ ? k_.back().data() : nullptr;
}

double OwnStep::error_of_step(double h, const Norm& norm) {
  for (std::size_t i = 0; i < stage_.size(); ++i) {
    double sum = 0.0;
    for (std::size_t j = 0; j < k_.size(); ++j) sum += (table_->b[j] - table_->d[j]) * k_[j][i];
    stage_[i] = h * sum;
  }
  return norm(stage_.data());
}

bool OwnStep::to(double t, double* y, const Norm& norm) {
  double t_next = t;
  for (int i = 0; i < most_parts; ++i) {
    const double h = t_next - t_;
    if (!to(t_next, y) || rate(t_next, y) == nullptr) return false;
    if (error_of_step(h, norm) > 1.0 && i + 1 < most_parts) {
      t_next = t_ + next_attempt * h;
      continue;
    }
    if (t_next == t) return true;
    std::copy_n(y, start_.size(), start_.begin());
    from(std::exchange(t_next, t), start_.data());
    std::swap(k_.front(), k_.back());
    first_known_ = true;
  }
  return false;
}

}  // namespace yoke
