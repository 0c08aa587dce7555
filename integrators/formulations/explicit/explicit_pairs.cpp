// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <cstdio>  // what the header below uses and does not include

#include <arkode/arkode_butcher_erk.h>

#include <yoke/integrators/formulations/explicit/explicit_pairs.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace yoke {

namespace {

constexpr int verner_stages = 10;
using Row = std::array<double, verner_stages>;

constexpr Row verner_c = {
    0.0, 0.005, 0.10888888888888888, 0.16333333333333333, 0.4555, 0.6095094489978381, 0.884, 0.925,
    1.0, 1.0};
constexpr std::array<Row, verner_stages> verner_a = {
    {{},
     {0.005},
     {-1.07679012345679, 1.185679012345679},
     {0.04083333333333333, 0.0, 0.1225},
     {0.6389139236255726, 0.0, -2.455672638223657, 2.272258714598084},
     {-2.6615773750187572, 0.0, 10.804513886456137, -8.3539146573962, 0.820487594956657},
     {6.067741434696771, 0.0, -24.711273635911084, 20.427517930788895, -1.9061579788166472,
      1.006172249242068},
     {12.054670076253203, 0.0, -49.75478495046899, 41.142888638604674, -4.461760149974004,
      2.042334822239175, -0.09834843665406108},
     {10.138146522881808, 0.0, -42.6411360317175, 35.76384003992257, -4.3480228403929075,
      2.0098622683770357, 0.3487490460338272, -0.27143900510483127},
     {-45.030072034298676, 0.0, 187.3272437654589, -154.02882369350186, 18.56465306347536,
      -7.141809679295079, 1.3088085781613785}}};
constexpr Row verner_b = {0.04715561848627222,
                          0.0,
                          0.0,
                          0.25750564298434153,
                          0.2621665397741262,
                          0.15216092656738558,
                          0.49399691700324844,
                          -0.29430311714032503,
                          0.0813174723249511};
constexpr Row verner_judge = {
    0.044608606606341174, 0.0, 0.0, 0.26716403785713727, 0.2201018300177293, 0.2188431703143157,
    0.22898717054112028,  0.0, 0.0, 0.020295184663356284};

ARKodeButcherTable make_verner() {
  std::array<double, verner_stages * verner_stages> a{};
  for (std::size_t i = 0; i < verner_stages; ++i)
    std::ranges::copy(verner_a[i], a.begin() + static_cast<std::ptrdiff_t>(i * verner_stages));
  Row c = verner_c, b = verner_b, judge = verner_judge;  // it takes them for its own
  return ARKodeButcherTable_Create(verner_stages, 7, 6, c.data(), a.data(), b.data(), judge.data());
}

/// Of a solution of y' = -y over one step.
double growth(const ARKodeButcherTableMem& table, double step) {
  std::vector<double> k(static_cast<std::size_t>(table.stages));
  double y = 1.0;
  for (std::size_t i = 0; i < k.size(); ++i) {
    double stage = 1.0;
    for (std::size_t j = 0; j < i; ++j) stage += step * table.A[i][j] * k[j];
    k[i] = -stage;
    y += step * table.b[i] * k[i];
  }
  return std::abs(y);
}

double find_stable(const ARKodeButcherTableMem& table) {
  constexpr double stride = 0.1;
  constexpr int halvings = 20;
  double stable = stride, not_stable = 2.0 * stride;
  while (growth(table, not_stable) <= 1.0) stable = std::exchange(not_stable, not_stable + stride);
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (stable + not_stable);
    (growth(table, middle) <= 1.0 ? stable : not_stable) = middle;
  }
  return stable;
}

ExplicitPair describe(ARKodeButcherTable table) {
  const int last = table->stages - 1;
  int stages = table->stages;
  while (table->b[stages - 1] == 0.0) --stages;
  return {.order = table->q,
          .table = table,
          .stages = stages,
          .first_same_as_last =
              table->c[last] == 1.0 && std::equal(table->b, table->b + last, table->A[last]),
          .stable = find_stable(*table)};
}

}  // namespace

int ExplicitPair::evaluations(bool moved) const {
  return table->stages - (first_same_as_last && !moved ? 1 : 0);
}

std::span<const ExplicitPair> explicit_pairs() {
  struct Pairs {
    ARKodeButcherTable tables[2] = {ARKodeButcherTable_LoadERK(ARKODE_DORMAND_PRINCE_7_4_5),
                                    make_verner()};
    ExplicitPair pairs[2] = {describe(tables[0]), describe(tables[1])};
    ~Pairs() {
      for (ARKodeButcherTable table : tables) ARKodeButcherTable_Free(table);
    }
  };
  static const Pairs all;
  return all.pairs;
}

const ExplicitPair& explicit_pair(int order) {
  return *std::ranges::find(explicit_pairs(), order, &ExplicitPair::order);
}

}  // namespace yoke
