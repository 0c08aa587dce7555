// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <suitesparse/klu.h>

#include <yoke/core/equations/linear/sparse.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

#include <yoke/core/equations/linear/index.hpp>

namespace yoke {

int PatternBuilder::add(int row, int column) {
  const bool inside = row >= 0 && row < size_ && column >= 0 && column < size_;
  requests_.emplace_back(inside ? column : size_, inside ? row : 0);
  return static_cast<int>(requests_.size()) - 1;
}

// One pass by columns, then each column by itself: it is short and in the cache.
SparseMatrix PatternBuilder::compile(std::vector<int>& slot_of_request) const {
  struct Entry {
    int row, request;
  };
  std::vector<int> next(at(size_) + 2, 0);
  for (const auto& [column, row] : requests_) ++next[at(column) + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<Entry> entries(requests_.size());
  for (std::size_t i = 0; i < requests_.size(); ++i) {
    const auto& [column, row] = requests_[i];
    entries[at(next[at(column)]++)] = {row, static_cast<int>(i)};
  }
  SparseMatrix matrix;
  matrix.size = size_;
  matrix.column_start.assign(at(size_) + 1, 0);
  matrix.row.reserve(requests_.size());
  slot_of_request.resize(requests_.size());
  auto begin = entries.begin();
  for (int column = 0; column < size_; ++column) {
    const auto end = entries.begin() + next[at(column)];
    std::sort(begin, end, [](const Entry& a, const Entry& b) { return a.row < b.row; });
    int last = -1;
    for (; begin != end; ++begin) {
      if (begin->row != last) matrix.row.push_back(begin->row);
      last = begin->row;
      slot_of_request[at(begin->request)] = matrix.nonzeros() - 1;
    }
    matrix.column_start[at(column) + 1] = matrix.nonzeros();
  }
  for (; begin != entries.end(); ++begin)
    slot_of_request[at(begin->request)] = matrix.discard_slot();
  matrix.value.assign(matrix.row.size() + 1, 0.0);
  return matrix;
}

struct SparseLU::Klu {
  klu_common common{};
  klu_symbolic* symbolic = nullptr;
  klu_numeric* numeric = nullptr;
};

namespace {
// Below this the factors carry no correct digit: treat as singular.
constexpr double singular = 1e-15;
// KLU takes a pivot on the diagonal, which keeps the factors sparse, if it is this part of the
// largest in its column. Beside masses of many decades such a pivot may lose all digits: where the
// factors are doubtful only pivots that are nearly the largest are taken.
constexpr double careful = 0.1, doubtful = 1e-10;
// KLU's interface is not const-correct; it does not write to the pattern or the values.
int* mutable_data(const std::vector<int>& v) { return const_cast<int*>(v.data()); }
double* mutable_data(const std::vector<double>& v) { return const_cast<double*>(v.data()); }
}  // namespace

SparseLU::SparseLU(const SparseMatrix& matrix, Scaling scaling) : klu_(std::make_unique<Klu>()) {
  klu_defaults(&klu_->common);
  if (scaling == Scaling::none) klu_->common.scale = -1;
  klu_->symbolic = klu_analyze(matrix.size, mutable_data(matrix.column_start),
                               mutable_data(matrix.row), &klu_->common);
}

SparseLU::~SparseLU() {
  klu_free_numeric(&klu_->numeric, &klu_->common);
  klu_free_symbolic(&klu_->symbolic, &klu_->common);
}

double SparseLU::multiplications() const {
  return klu_->symbolic == nullptr ? 0.0 : 0.5 * klu_->symbolic->est_flops;
}

void SparseLU::reset() { klu_free_numeric(&klu_->numeric, &klu_->common); }

bool SparseLU::factorise(const SparseMatrix& matrix) {
  if (klu_->symbolic == nullptr) return matrix.size == 0;
  if (klu_->numeric == nullptr) return fresh(matrix);
  ++counters_.refactorisations;
  const int done =
      klu_refactor(mutable_data(matrix.column_start), mutable_data(matrix.row),
                   mutable_data(matrix.value), klu_->symbolic, klu_->numeric, &klu_->common);
  if (done == 1 && klu_->common.status == KLU_OK) {
    klu_rcond(klu_->symbolic, klu_->numeric, &klu_->common);
    rcond_ = klu_->common.rcond;
    if (rcond_ >= 1e-3 * rcond_fresh_) return true;
  }
  return fresh(matrix);
}

bool SparseLU::fresh(const SparseMatrix& matrix) {
  // KLU does not look for NaN while it pivots.
  const auto finite = [](double x) { return std::isfinite(x); };
  if (!std::all_of(matrix.value.begin(), matrix.value.end() - 1, finite)) return false;
  ++counters_.fresh;
  const double usual = klu_->common.tol;
  if (!choose_pivots(matrix) || rcond_ < doubtful) {
    klu_->common.tol = careful;
    choose_pivots(matrix);
    klu_->common.tol = usual;
  }
  rcond_fresh_ = rcond_;
  if (rcond_ > singular) return true;
  reset();
  return false;
}

bool SparseLU::choose_pivots(const SparseMatrix& matrix) {
  rcond_ = 0.0;
  reset();
  klu_->numeric = klu_factor(mutable_data(matrix.column_start), mutable_data(matrix.row),
                             mutable_data(matrix.value), klu_->symbolic, &klu_->common);
  if (klu_->numeric == nullptr || klu_->common.status != KLU_OK) return false;
  klu_rcond(klu_->symbolic, klu_->numeric, &klu_->common);
  rcond_ = klu_->common.rcond;
  return true;
}

void SparseLU::solve(double* b) {
  if (klu_->symbolic == nullptr) return;
  klu_solve(klu_->symbolic, klu_->numeric, klu_->symbolic->n, 1, b, &klu_->common);
}

}  // namespace yoke
