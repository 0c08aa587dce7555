// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <yoke/core/equations/linear/sparse.hpp>

namespace {

using namespace yoke;

double& at(std::vector<double>& values, int i) { return values[static_cast<std::size_t>(i)]; }

/// [ a 1 ; 1 0 ]: its pivots are on the diagonal for a = 1.3, and must not be for a = 0.
struct TwoByTwo {
  SparseMatrix matrix;
  std::vector<int> slot;
  TwoByTwo() {
    PatternBuilder pattern(2);
    pattern.add(0, 0);
    pattern.add(0, 1);
    pattern.add(1, 0);
    pattern.add(1, 1);
    matrix = pattern.compile(slot);
    set(1.3, 1.0, 1.0, 0.0);
  }
  void set(double a, double b, double c, double d) {
    const double values[] = {a, b, c, d};
    for (std::size_t i = 0; i < 4; ++i) at(matrix.value, slot[i]) = values[i];
  }
};

}  // namespace

TEST_CASE("requests become sorted columns; duplicates share a slot and foreign entries are lost") {
  PatternBuilder pattern(3);
  CHECK(pattern.add(2, 1) == 0);
  CHECK(pattern.add(0, 0) == 1);
  CHECK(pattern.add(2, 1) == 2);
  CHECK(pattern.add(-1, 1) == 3);
  CHECK(pattern.add(1, 3) == 4);
  CHECK(pattern.add(1, 1) == 5);
  CHECK(pattern.add(1, 2) == 6);
  CHECK(pattern.add(0, -1) == 7);
  std::vector<int> slot;
  const SparseMatrix matrix = pattern.compile(slot);
  CHECK(matrix.size == 3);
  CHECK(matrix.column_start == std::vector<int>{0, 1, 3, 4});
  CHECK(matrix.row == std::vector<int>{0, 1, 2, 1});
  CHECK(matrix.nonzeros() == 4);
  CHECK(matrix.value.size() == 5);
  CHECK(matrix.value == std::vector<double>(5, 0.0));
  CHECK(slot == std::vector<int>{2, 0, 2, 4, 4, 1, 3, 4});
  CHECK(matrix.discard_slot() == 4);
}

TEST_CASE("what is written to the discard slot changes no solution, not even if it is NaN") {
  TwoByTwo m;
  SparseLU lu(m.matrix);
  at(m.matrix.value, m.matrix.discard_slot()) = std::numeric_limits<double>::quiet_NaN();
  REQUIRE(lu.factorise(m.matrix));
  double b[] = {0.7, -0.4};
  lu.solve(b);  // x = -0.4, 1.3 x + y = 0.7
  CHECK(b[0] == doctest::Approx(-0.4).epsilon(1e-15));
  CHECK(b[1] == doctest::Approx(0.7 + 1.3 * 0.4).epsilon(1e-15));
}

TEST_CASE("an empty matrix is factorised and solved") {
  std::vector<int> slot;
  const SparseMatrix matrix = PatternBuilder(0).compile(slot);
  SparseLU lu(matrix);
  CHECK(lu.factorise(matrix));
  lu.solve(nullptr);
  CHECK(lu.counters().fresh == 0);
}

TEST_CASE("the pivots are chosen once and again only when they have become poor") {
  TwoByTwo m;
  SparseLU lu(m.matrix);
  REQUIRE(lu.factorise(m.matrix));
  CHECK(lu.counters().fresh == 1);
  CHECK(lu.counters().refactorisations == 0);

  for (const double a : {1.1, 2.9, 0.3}) {
    m.set(a, 1.0, 1.0, 0.0);
    REQUIRE(lu.factorise(m.matrix));
  }
  CHECK(lu.counters().fresh == 1);
  CHECK(lu.counters().refactorisations == 3);

  // With the old pivot 1e-12 the second one would be 1e12.
  m.set(1e-12, 1.0, 1.0, 0.0);
  REQUIRE(lu.factorise(m.matrix));
  CHECK(lu.counters().fresh == 2);
  double b[] = {0.7, -0.4};
  lu.solve(b);
  CHECK(b[0] == doctest::Approx(-0.4).epsilon(1e-15));
  CHECK(b[1] == doctest::Approx(0.7).epsilon(1e-11));
  CHECK(lu.reciprocal_condition() > 0.1);

  lu.reset();
  REQUIRE(lu.factorise(m.matrix));
  CHECK(lu.counters().fresh == 3);
}

TEST_CASE("singular and not finite matrices are refused, and a good one afterwards is not") {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  TwoByTwo m;
  SparseLU lu(m.matrix);
  const auto good_again = [&] {
    m.set(1.3, 1.0, 1.0, 0.0);
    REQUIRE(lu.factorise(m.matrix));
    double b[] = {0.7, -0.4};
    lu.solve(b);
    CHECK(b[1] == doctest::Approx(0.7 + 1.3 * 0.4).epsilon(1e-15));
  };
  for (const bool factorised_before : {false, true}) {
    CAPTURE(factorised_before);
    for (const double bad : {nan, infinity, -infinity}) {
      CAPTURE(bad);
      if (!factorised_before) lu.reset();
      m.set(bad, 1.0, 1.0, 0.0);
      CHECK_FALSE(lu.factorise(m.matrix));
      good_again();
      if (!factorised_before) lu.reset();
      m.set(1.3, bad, 1.0, 0.0);
      CHECK_FALSE(lu.factorise(m.matrix));
      good_again();
    }
    if (!factorised_before) lu.reset();
    m.set(0.0, 0.0, 0.0, 0.0);
    CHECK_FALSE(lu.factorise(m.matrix));
    good_again();
    if (!factorised_before) lu.reset();
    m.set(0.6, 0.3, 1.2, 0.6);  // rank 1
    CHECK_FALSE(lu.factorise(m.matrix));
    good_again();
    if (!factorised_before) lu.reset();
    m.set(0.6, 0.3, 1.2, 0.6 * (1.0 + 1e-16));  // rank 1 but for rounding
    CHECK_FALSE(lu.factorise(m.matrix));
    good_again();
  }
}

TEST_CASE("a saddle matrix beside a mass of 8e6 kg keeps its digits whatever pivots come first") {
  // A crank of 8e6 kg, pinned to the ground and to a rod of 8 kg with a point on a line, in a pose
  // where a pivot on the diagonal that is small but not the smallest loses all digits.
  const double mass[] = {8474611.9371286891, 8474611.9371286891, 228272.22886687712,
                         7.7522071034503517, 7.7522071034503517, 0.19423301409270369};
  const double G[5][6] = {
      {1.0, 0.0, 0.16482340909876275, 0.0, 0.0, 0.0},
      {0.0, 1.0, -0.00030951875915904287, 0.0, 0.0, 0.0},
      {0.0, 0.0, 0.0, 0.38737355411169339, 0.92192284361267185, -0.0095947777536894707},
      {1.0, 0.0, 0.18977799610695606, -1.0, 0.0, -0.4611950029198571},
      {0.0, 1.0, -0.27356351567447512, 0.0, -1.0, 0.044579886985868289}};
  PatternBuilder pattern(11);
  std::vector<double> entries;
  const auto add = [&](int row, int column, double value) {
    pattern.add(row, column);
    entries.push_back(value);
  };
  for (int i = 0; i < 6; ++i) add(i, i, mass[i]);
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 6; ++j)
      if (G[i][j] != 0.0) {
        add(6 + i, j, G[i][j]);
        add(j, 6 + i, G[i][j]);
      }
  std::vector<int> slot;
  SparseMatrix matrix = pattern.compile(slot);
  for (std::size_t i = 0; i < entries.size(); ++i) at(matrix.value, slot[i]) = entries[i];
  SparseLU lu(matrix);
  REQUIRE(lu.factorise(matrix));
  CHECK(lu.reciprocal_condition() > 1e-9);
  // The acceleration of a free turn of the crank is that of a rigid rod on the line.
  std::vector<double> b(11, 0.0);
  b[2] = 1e6;
  lu.solve(b.data());
  for (int i = 0; i < 5; ++i) {
    double sum = 0.0, size = 0.0;
    for (int j = 0; j < 6; ++j) {
      sum += G[i][j] * b[static_cast<std::size_t>(j)];
      size = std::max(size, std::abs(G[i][j] * b[static_cast<std::size_t>(j)]));
    }
    CHECK(std::abs(sum) < 1e-13 * size);
  }
}

TEST_CASE("solutions of random sparse systems leave a residual of rounding size") {
  constexpr int n = 60;
  std::mt19937 random(3);
  std::uniform_int_distribution<int> index(0, n - 1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  PatternBuilder pattern(n);
  for (int i = 0; i < n; ++i) pattern.add(i, i);
  for (int i = 0; i < 5 * n; ++i) pattern.add(index(random), index(random));
  std::vector<int> slot;
  SparseMatrix matrix = pattern.compile(slot);
  SparseLU lu(matrix);
  for (int round = 0; round < 20; ++round) {
    for (double& value : matrix.value) value = uniform(random);
    for (int i = 0; i < n; ++i) at(matrix.value, slot[static_cast<std::size_t>(i)]) += 4.0;
    REQUIRE(lu.factorise(matrix));
    std::vector<double> b(n), x(n);
    for (double& value : b) value = uniform(random);
    x = b;
    lu.solve(x.data());
    for (int j = 0; j < n; ++j)
      for (int k = matrix.column_start[static_cast<std::size_t>(j)];
           k < matrix.column_start[static_cast<std::size_t>(j) + 1]; ++k)
        at(b, matrix.row[static_cast<std::size_t>(k)]) -= at(matrix.value, k) * at(x, j);
    for (const double residual : b) CHECK(std::abs(residual) < 1e-14);
  }
  CHECK(lu.counters().fresh + lu.counters().refactorisations >= 20);
  CHECK(lu.counters().fresh == 1);
}
