// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Tables 2 to 9 and 11 of Machines 2022, 10, 966, as printed: constants K, n of the power law
// F = K d^n nearest to each elastic law, of the force per millimetre of pin (the paper does not say
// per millimetre). Nothing here is computed.
#pragma once

#include <array>

#include <yoke/contact/laws/material.hpp>

namespace yoke::cases {

struct PublishedFit {
  double DR;                       // [mm]
  double K, n;                     // K in (N/mm)/mm^n
  double error;                    // "Max Error %"
  const char* misprint = nullptr;  // what is wrong with it
};

/// One of Tables 2 to 9. The constants of steel have three digits, those of aluminium all before
/// the point; n has three decimals, the error one.
struct PublishedTable {
  int number;
  const char* law;  // of the catalog
  bool is_steel;
  std::array<PublishedFit, 6> rows;
};

inline constexpr const char* power_of_ten = "power of ten of K: ten times that";
inline constexpr const char* copied_n = "n copied from Table 8 (steel)";

inline constexpr std::array<PublishedTable, 8> published_tables{{
    {2,
     "radzimovsky",
     true,
     {{{0.5, 104000, 1.162, 6.1},
       {5, 62400, 1.118, 4.1},
       {10, 55500, 1.109, 3.8},
       {30, 47200, 1.097, 3.2},
       {60, 43200, 1.091, 3.0},
       {80, 41700, 1.089, 2.9}}}},
    {3,
     "radzimovsky",
     false,
     {{{0.5, 41308, 1.195, 14.6},
       {5, 22979, 1.135, 9.0},
       {10, 20228, 1.123, 8.0},
       {30, 16993, 1.108, 6.7},
       {60, 15434, 1.100, 6.1},
       {80, 14867, 1.098, 5.8}}}},
    {4,
     "johnson",
     true,
     {{{0.5, 142000, 1.192, 7.4},
       {5, 75300, 1.133, 4.8},
       {10, 65400, 1.122, 4.3, "K: 6.54 printed for 6.56"},
       {30, 54400, 1.107, 3.7},
       {60, 49100, 1.100, 3.4},
       {80, 47200, 1.097, 3.2}}}},
    {5,
     "johnson",
     false,
     {{{0.5, 60628, 1.242, 18.9},
       {5, 28324, 1.155, 10.9},
       {10, 24286, 1.140, 9.5},
       {30, 19782, 1.121, 7.8},
       {60, 17703, 1.111, 7.0},
       {80, 16962, 1.083, 6.7, "n: digits swapped, 1.083 printed for 1.108"}}}},
    {6,
     "goldsmith",
     true,
     {{{0.5, 28600, 1.066, 2.0},
       {5, 23900, 1.057, 1.6},
       {10, 22700, 1.055, 1.5},
       {30, 20900, 1.051, 1.4},
       {60, 19400, 1.048, 1.3},
       {80, 18400, 1.046, 1.2}}}},
    {7,
     "goldsmith",
     false,
     {{{0.5, 10032, 1.071, 3.7},
       {5, 8354, 1.061, 2.9},
       {10, 7933, 1.058, 2.8},
       {30, 7273, 1.054, 2.5},
       {60, 6752, 1.050, 2.3},
       {80, 6394, 1.048, 2.1}}}},
    {8,
     "esdu-78035",
     true,
     {{{0.5, 2840, 1.165, 12.2, power_of_ten},
       {5, 1770, 1.119, 8.0, power_of_ten},
       {10, 1590, 1.110, 7.2, power_of_ten},
       {30, 1360, 1.098, 6.1, power_of_ten},
       {60, 1250, 1.092, 5.6, power_of_ten},
       {80, 1210, 1.090, 5.4, power_of_ten}}}},
    {9,
     "esdu-78035",
     false,
     {{{0.5, 10868, 1.165, 23.6, copied_n},
       {5, 6395, 1.119, 14.4, copied_n},
       {10, 5691, 1.110, 12.8, copied_n},
       {30, 4849, 1.098, 10.7, copied_n},
       {60, 4437, 1.092, 9.6, copied_n},
       {80, 4286, 1.090, 9.3, copied_n}}}},
}};

struct PublishedConstants {
  const char* law;  // of the catalog
  double K, n;      // K of four digits (Lankarani and Nikravesh' in N/mm^n), n of two decimals
};

/// A wall of Table 11: a steel pin of 7.9 mm in the slot of the scotch-yoke.
struct PublishedWall {
  const char* name;
  double DR;           // [mm] as labelled
  double wall_radius;  // [mm]
  Conformity conformity;
  double stated_pin, used_pin;  // [mm] in the text; in the numbers
  const char* misprint;
  std::array<PublishedConstants, 5> constants;
};

inline constexpr std::array<PublishedWall, 3> published_table11{{
    {"Ri/Rp",
     60.1,
     52.0,
     Conformity::external,
     7.9,
     7.5,
     "label: 59.9, not 60.1; made with a pin of 7.5 mm, not 7.9",
     {{{"lankarani-nikravesh", 122000, 1.50},
       {"radzimovsky", 43210, 1.09},
       {"johnson", 49140, 1.10},
       {"goldsmith", 17170, 1.04},
       {"esdu-78035", 13000, 1.09}}}},
    {"Ro/Rp",
     59.9,
     68.0,
     Conformity::internal,
     7.9,
     7.9,
     "label: 60.1, not 59.9",
     {{{"lankarani-nikravesh", 142400, 1.50},
       {"radzimovsky", 43150, 1.09},
       {"johnson", 49070, 1.10},
       {"goldsmith", 17430, 1.04},
       {"esdu-78035", 12540, 1.09}}}},
    {"Rc/Rp",
     0.1,
     8.0,
     Conformity::internal,
     7.9,
     7.9,
     nullptr,
     {{{"lankarani-nikravesh", 1198000, 1.50},
       {"radzimovsky", 184600, 1.22},
       {"johnson", 314700, 1.28},
       {"goldsmith", 22210, 1.05},
       {"esdu-78035", 47860, 1.22}}}},
}};

}  // namespace yoke::cases
