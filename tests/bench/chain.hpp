// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What several benchmarks measure: a chain that swings under gravity, and KLU by itself.
#pragma once

#include <benchmark/benchmark.h>
#include <suitesparse/klu.h>

#include <yoke/core/equations/linear/sparse.hpp>
#include <yoke/core/units.hpp>
#include <yoke/joints/forces/gravity.hpp>
#include <yoke/joints/revolute.hpp>
#include <yoke/tests/bench/clock.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace yoke::bench {

inline double median(std::vector<double> x) {
  std::ranges::nth_element(x, x.begin() + static_cast<std::ptrdiff_t>(x.size() / 2));
  return x[x.size() / 2];
}

// Links of 1 m and 1 kg, each turned a little against the last, so that no entry is special.
inline Model chain(int links, const std::optional<PinFriction>& friction = {}) {
  Model model;
  Vec2 joint(0.0, 0.0);
  BodyId last = ground;
  for (int i = 0; i < links; ++i) {
    const double angle = -1.1 + 0.7 * std::sin(0.37 * i);
    const Vec2 half = rotate(angle, Vec2(0.5, 0.0));
    const BodyId link = model.add(Body{.name = "link " + std::to_string(i),
                                       .mass = 1.0,
                                       .inertia = 1.0 / 12.0,
                                       .pose = {joint + half, angle},
                                       .twist = {{0.0, 0.0}, 0.1 * std::cos(1.3 * i)}});
    model.add(Revolute{.name = "joint " + std::to_string(i),
                       .a = last,
                       .b = link,
                       .at = joint,
                       .friction = friction});
    joint += 2.0 * half;
    last = link;
  }
  model.add(Gravity{});
  return model;
}

// KLU alone, on a copy of the matrix.
class BareKlu {
 public:
  explicit BareKlu(const SparseMatrix& matrix) : matrix_(matrix) {
    klu_defaults(&common_);
    symbolic_ =
        klu_analyze(matrix_.size, matrix_.column_start.data(), matrix_.row.data(), &common_);
    numeric_ = klu_factor(matrix_.column_start.data(), matrix_.row.data(), matrix_.value.data(),
                          symbolic_, &common_);
    b_.assign(static_cast<std::size_t>(matrix_.size), 1.0);
  }
  ~BareKlu() {
    klu_free_numeric(&numeric_, &common_);
    klu_free_symbolic(&symbolic_, &common_);
  }
  BareKlu(const BareKlu&) = delete;
  BareKlu& operator=(const BareKlu&) = delete;
  void refactor_and_solve() {
    klu_refactor(matrix_.column_start.data(), matrix_.row.data(), matrix_.value.data(), symbolic_,
                 numeric_, &common_);
    std::fill(b_.begin(), b_.end(), 1.0);
    klu_solve(symbolic_, numeric_, matrix_.size, 1, b_.data(), &common_);
    benchmark::DoNotOptimize(b_.data());
  }

 private:
  SparseMatrix matrix_;
  klu_common common_{};
  klu_symbolic* symbolic_ = nullptr;
  klu_numeric* numeric_ = nullptr;
  std::vector<double> b_;
};

}  // namespace yoke::bench
