// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <doctest/doctest.h>
#include <nvector/nvector_serial.h>

#include <yoke/integrators/sundials/context.hpp>
#include <yoke/integrators/sundials/vector.hpp>

#include <cmath>
#include <vector>

using namespace yoke;

namespace {

// Our vector and SUNDIALS' own with the same numbers, none of them simple.
struct Pair {
  Pair(int size, SUNContext context, double seed)
      : ours(new_vector(size, context)), theirs(N_VNew_Serial(size, context)) {
    for (int i = 0; i < size; ++i)
      NV_Ith_S(ours, i) = NV_Ith_S(theirs, i) = std::sin(seed + 0.7 * i) + 1e-3 * seed;
  }
  ~Pair() {
    N_VDestroy(ours);
    N_VDestroy(theirs);
  }
  Pair(const Pair&) = delete;
  Pair& operator=(const Pair&) = delete;

  double difference() const {
    double largest = 0.0;
    for (sunindextype i = 0; i < NV_LENGTH_S(ours); ++i)
      largest = std::fmax(largest, std::abs(NV_Ith_S(ours, i) - NV_Ith_S(theirs, i)));
    return largest;
  }
  N_Vector ours, theirs;
};

}  // namespace

TEST_CASE("vectors for SUNDIALS: our loops do what its own do, in place too") {
  CallbackFailure failure;
  SundialsContext context(failure);
  constexpr double rounding = 2e-15;
  for (const int size : {1, 3, 4, 7, 127, 128, 129, 1000}) {
    CAPTURE(size);
    Pair a(size, context, 1.0), b(size, context, 2.0), c(size, context, 3.0), d(size, context, 4.0);
    const auto both = [&](auto operation) {
      operation(a.ours, b.ours, c.ours, d.ours);
      operation(a.theirs, b.theirs, c.theirs, d.theirs);
      for (const Pair* p : {&a, &b, &c, &d}) CHECK(p->difference() < rounding);
    };
    for (const double x : {1.0, -1.0, 0.3})
      for (const double y : {1.0, -1.0, -0.3, 0.9}) {
        both([=](N_Vector p, N_Vector q, N_Vector r, N_Vector) { N_VLinearSum(x, p, y, q, r); });
        both([=](N_Vector p, N_Vector q, N_Vector, N_Vector) { N_VLinearSum(x, p, y, q, q); });
        both([](N_Vector, N_Vector q, N_Vector, N_Vector) { N_VScale(0.5, q, q); });
      }
    both([](N_Vector p, N_Vector, N_Vector r, N_Vector) { N_VScale(1.0, p, r); });
    both([](N_Vector p, N_Vector, N_Vector r, N_Vector) { N_VScale(-1.0, p, r); });
    both([](N_Vector p, N_Vector q, N_Vector r, N_Vector) { N_VProd(p, q, r); });
    both([](N_Vector p, N_Vector q, N_Vector r, N_Vector s) {
      double factors[] = {0.4, -0.3, 1.0, 0.2};
      N_Vector vectors[] = {p, q, r, s};
      for (int count = 1; count <= 4; ++count) N_VLinearCombination(count, factors, vectors, p);
      for (int count = 1; count <= 3; ++count) N_VLinearCombination(count, factors, vectors, s);
    });
    CHECK(N_VWrmsNorm(a.ours, b.ours) ==
          doctest::Approx(N_VWrmsNorm(a.theirs, b.theirs)).epsilon(1e-14));
    both([](N_Vector p, N_Vector, N_Vector, N_Vector) { N_VConst(0.7, p); });
    N_Vector clone = N_VClone(a.ours);
    CHECK((clone->ops->nvlinearsum == a.ours->ops->nvlinearsum));
    CHECK((clone->ops->nvlinearsum != a.theirs->ops->nvlinearsum));
    N_VDestroy(clone);
  }
}
