// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Literals for the units of drawings; the value is always SI. using namespace yoke::literals;
//   60.0_mm == 0.060, 31_deg == 0.541..., 207_GPa == 2.07e11, 30.40_kg_mm2 == 3.040e-5
#pragma once

namespace yoke::literals {

#define YOKE_UNIT(suffix, factor)                                       \
  constexpr double operator""_##suffix(long double x) {                 \
    return static_cast<double>(x * (factor));                           \
  }                                                                     \
  constexpr double operator""_##suffix(unsigned long long x) {          \
    return static_cast<double>(static_cast<long double>(x) * (factor)); \
  }

YOKE_UNIT(m, 1.0L)
YOKE_UNIT(cm, 1e-2L)
YOKE_UNIT(mm, 1e-3L)
YOKE_UNIT(um, 1e-6L)
YOKE_UNIT(s, 1.0L)
YOKE_UNIT(ms, 1e-3L)
YOKE_UNIT(us, 1e-6L)
YOKE_UNIT(kg, 1.0L)
YOKE_UNIT(g, 1e-3L)
YOKE_UNIT(kg_m2, 1.0L)
YOKE_UNIT(kg_mm2, 1e-6L)
YOKE_UNIT(rad, 1.0L)
YOKE_UNIT(deg, 3.14159265358979323846264338327950288L / 180.0L)
YOKE_UNIT(rpm, 3.14159265358979323846264338327950288L / 30.0L)
YOKE_UNIT(rad_per_s, 1.0L)
YOKE_UNIT(m_per_s, 1.0L)
YOKE_UNIT(mm_per_s, 1e-3L)
YOKE_UNIT(N, 1.0L)
YOKE_UNIT(kN, 1e3L)
YOKE_UNIT(N_m, 1.0L)
YOKE_UNIT(N_per_m, 1.0L)
YOKE_UNIT(N_per_mm, 1e3L)
YOKE_UNIT(N_s_per_m, 1.0L)
YOKE_UNIT(N_m_per_rad, 1.0L)
YOKE_UNIT(Pa, 1.0L)
YOKE_UNIT(MPa, 1e6L)
YOKE_UNIT(GPa, 1e9L)
YOKE_UNIT(s_per_m, 1.0L)
YOKE_UNIT(J, 1.0L)

#undef YOKE_UNIT

}  // namespace yoke::literals
