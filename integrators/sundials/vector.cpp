// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/integrators/sundials/vector.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <new>
#include <utility>

namespace yoke {

namespace {

template <class F>
void for_each(N_Vector z, F&& f) {
  const sunindextype n = NV_LENGTH_S(z);
  for (sunindextype i = 0; i < n; ++i) f(i);
}

// In and out may be the same vector, so the compiler checks for overlap once per call.
void linear_sum(sunrealtype a, N_Vector x_vector, sunrealtype b, N_Vector y_vector,
                N_Vector z_vector) {
  const double* x = NV_DATA_S(x_vector);
  const double* y = NV_DATA_S(y_vector);
  double* z = NV_DATA_S(z_vector);
  if (b == 1.0) {
    for_each(z_vector, [=](auto i) { z[i] = a * x[i] + y[i]; });
  } else {
    for_each(z_vector, [=](auto i) { z[i] = a * x[i] + b * y[i]; });
  }
}

void scale(sunrealtype c, N_Vector x_vector, N_Vector z_vector) {
  const double* x = NV_DATA_S(x_vector);
  double* z = NV_DATA_S(z_vector);
  if (c == 1.0) {
    if (x != z) std::copy_n(x, NV_LENGTH_S(z_vector), z);
  } else {
    for_each(z_vector, [=](auto i) { z[i] = c * x[i]; });
  }
}

void set_constant(sunrealtype c, N_Vector z) { std::fill_n(NV_DATA_S(z), NV_LENGTH_S(z), c); }

void product(N_Vector x_vector, N_Vector y_vector, N_Vector z_vector) {
  const double* x = NV_DATA_S(x_vector);
  const double* y = NV_DATA_S(y_vector);
  double* z = NV_DATA_S(z_vector);
  for_each(z_vector, [=](auto i) { z[i] = x[i] * y[i]; });
}

/// Sum of term(i), in four parts: four additions are then under way at once.
template <class F>
double sum(sunindextype n, F&& term) {
  std::array<double, 4> part{};
  sunindextype i = 0;
  for (; i + 4 <= n; i += 4)
    for (int k = 0; k < 4; ++k) part[static_cast<std::size_t>(k)] += term(i + k);
  for (; i < n; ++i) part[0] += term(i);
  return (part[0] + part[1]) + (part[2] + part[3]);
}

sunrealtype wrms_norm(N_Vector x_vector, N_Vector w_vector) {
  const double* x = NV_DATA_S(x_vector);
  const double* w = NV_DATA_S(w_vector);
  const sunindextype n = NV_LENGTH_S(x_vector);
  const double squares = sum(n, [=](auto i) {
    const double r = x[i] * w[i];
    return r * r;
  });
  return std::sqrt(squares / static_cast<double>(n));
}

/// The content of SUNDIALS' serial vector, which its own functions know, and what norms need.
struct Content {
  _N_VectorContent_Serial serial;
  ErrorGroups* groups;
};

// The content is allocated with malloc, as SUNDIALS' destructor expects.
void enlarge_content(N_Vector vector, ErrorGroups* groups) {
  vector->content = std::realloc(vector->content, sizeof(Content));
  if (vector->content == nullptr) throw std::bad_alloc();
  static_cast<Content*>(vector->content)->groups = groups;
}

ErrorGroups* groups_of(N_Vector vector) { return static_cast<Content*>(vector->content)->groups; }

N_Vector clone(N_Vector vector) {
  N_Vector copy = N_VClone_Serial(vector);
  enlarge_content(copy, groups_of(vector));
  return copy;
}

sunrealtype largest_group(N_Vector x_vector, N_Vector w_vector) {
  const double* x = NV_DATA_S(x_vector);
  const double* w = NV_DATA_S(w_vector);
  ErrorGroups& groups = *groups_of(w_vector);
  // Of the six of a body: a ball that falls moves in one, so the mean of all would be too mild for
  // the worst of many. Bodies that count together are averaged over all six.
  constexpr double coordinates = 4.0;
  const int n = groups.dofs, size = static_cast<int>(NV_LENGTH_S(x_vector));
  const auto square = [=](int i) {
    const double r = x[i] * w[i];
    return r * r;
  };
  double largest = 0.0, sum = 0.0;  // the sum: NaN must not get lost
  std::ranges::fill(groups.sum, 0.0);
  for (int i = 0; i < n; i += 3) {
    const double body = square(i) + square(i + 1) + square(i + 2) + square(n + i) +
                        square(n + i + 1) + square(n + i + 2);
    sum += body;
    if (groups.together.empty())
      largest = std::max(largest, body);
    else
      groups.sum[static_cast<std::size_t>(groups.together[static_cast<std::size_t>(i / 3)])] +=
          body;
  }
  for (std::size_t i = 0; i < groups.sum.size(); ++i)
    if (groups.count[i] > 0.0)
      largest = std::max(largest, coordinates / 6.0 * groups.sum[i] / groups.count[i]);
  for (int i = size - groups.energies; i < size; ++i) {
    largest = std::max(largest, square(i));
    sum += square(i);
  }
  for (int i = 2 * n; i < 2 * n + groups.states; ++i) {
    largest = std::max(largest, coordinates * square(i));
    sum += square(i);
  }
  return std::isfinite(sum) ? std::sqrt(largest / coordinates) : sum;
}

/// Adds terms to a sum from left to right, four in one pass over it.
class Terms {
 public:
  explicit Terms(std::size_t size) : size_(size) {}

  void add(double c, const double* x, double* sum) {
    c_[count_] = c;
    x_[count_++] = x;
    if (count_ == most) flush(sum);
  }

  void flush(double* sum) {
    if (count_ == most) {
      const double a = c_[0], b = c_[1], c = c_[2], d = c_[3];
      const double *x = x_[0], *y = x_[1], *z = x_[2], *w = x_[3];
      for (std::size_t i = 0; i < size_; ++i)
        sum[i] = sum[i] + a * x[i] + b * y[i] + c * z[i] + d * w[i];
    } else {
      for (std::size_t k = 0; k < count_; ++k)
        for (std::size_t i = 0; i < size_; ++i) sum[i] += c_[k] * x_[k][i];
    }
    count_ = 0;
  }

 private:
  static constexpr std::size_t most = 4;
  std::array<double, most> c_;
  std::array<const double*, most> x_;
  std::size_t count_ = 0, size_;
};

/// In blocks that stay in the cache nearest to the processor.
int linear_combination(int count, sunrealtype* c, N_Vector* x, N_Vector z) {
  constexpr sunindextype block = 128;
  std::array<double, block> sum;
  const sunindextype n = NV_LENGTH_S(z);
  for (sunindextype begin = 0; begin < n; begin += block) {
    const auto m = static_cast<std::size_t>(std::min(block, n - begin));
    const double* first = NV_DATA_S(x[0]) + begin;
    for (std::size_t i = 0; i < m; ++i) sum[i] = c[0] * first[i];
    Terms terms(m);
    for (int k = 1; k < count; ++k)
      if (c[k] != 0.0)  // as many coefficients of Runge-Kutta methods are
        terms.add(c[k], NV_DATA_S(x[k]) + begin, sum.data());
    terms.flush(sum.data());
    std::copy_n(sum.begin(), m, NV_DATA_S(z) + begin);
  }
  return 0;
}

}  // namespace

void ErrorGroups::tie(std::vector<int> bodies) {
  together = std::move(bodies);
  sum.assign(together.size(), 0.0);
  count = sum;
  for (const int group : together) ++count[static_cast<std::size_t>(group)];
}

N_Vector new_vector(int size, SUNContext context, ErrorGroups* groups) {
  N_Vector vector = N_VNew_Serial(size, context);
  enlarge_content(vector, groups);
  vector->ops->nvclone = clone;
  vector->ops->nvlinearsum = linear_sum;
  vector->ops->nvscale = scale;
  vector->ops->nvconst = set_constant;
  vector->ops->nvprod = product;
  vector->ops->nvwrmsnorm = groups != nullptr ? largest_group : wrms_norm;
  vector->ops->nvlinearcombination = linear_combination;
  N_VConst(0.0, vector);
  return vector;
}

}  // namespace yoke
