// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <doctest/doctest.h>

#include <yoke/core/types.hpp>
#include <yoke/core/units.hpp>

using namespace yoke;
using namespace yoke::literals;

// Known at compile time, and rounded once: the decimal number in SI, not a product of two doubles.
static_assert(60.0_mm == 0.060);
static_assert(7.9_mm == 0.0079);
static_assert(45_mm == 0.045);
static_assert(30.40_kg_mm2 == 3.040e-5);
static_assert(3495.6_kg_mm2 == 3.4956e-3);
static_assert(0.48_kg_mm2 == 4.8e-7);
static_assert(0.32_s_per_m == 0.32);
static_assert(207.0_GPa == 2.07e11);
static_assert(70_GPa == 7.0e10);

TEST_CASE("a literal is the number in SI") {
  CHECK(1.7_m == 1.7);
  CHECK(3_cm == 0.03);
  CHECK(5.0_um == 5.0e-6);
  CHECK(2.5_s == 2.5);
  CHECK(4.0_ms == 0.004);
  CHECK(20_us == 2e-5);
  CHECK(15.0_g == 0.015);
  CHECK(0.090_kg == 0.090);
  CHECK(1.25_kg_m2 == 1.25);
  CHECK(1.1_kN == 1100.0);
  CHECK(6.0_N == 6.0);
  CHECK(0.3_N_m == 0.3);
  CHECK(12.0_N_per_m == 12.0);
  CHECK(12.0_N_per_mm == 12000.0);
  CHECK(0.7_N_s_per_m == 0.7);
  CHECK(9.0_N_m_per_rad == 9.0);
  CHECK(101325_Pa == 101325.0);
  CHECK(235_MPa == 2.35e8);
  CHECK(1.5_rad == 1.5);
  CHECK(3.0_rad_per_s == 3.0);
  CHECK(190.0_mm_per_s == 0.190);
  CHECK(0.19_m_per_s == 0.19);
  CHECK(2_J == 2.0);
}

TEST_CASE("angles and speeds of rotation come from whole turns") {
  CHECK(180_deg == pi);
  CHECK(360.0_deg == 2.0 * pi);
  CHECK(-31.0_deg == doctest::Approx(-31.0 * pi / 180.0).epsilon(1e-16));
  CHECK(720_rpm == doctest::Approx(24.0 * pi).epsilon(1e-16));
  CHECK(60_rpm == 2.0 * pi);
}
