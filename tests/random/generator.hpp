// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// From a seed to a mechanism. The bodies are placed first and the joints put where they coincide,
// so loops are closed by construction. Rough velocities: the start of a run makes them consistent.
//
//   family      bodies hang on the ground and on each other, each by one joint (or by springs), and
//   tree          nothing else
//   loop          joints between bodies already connected, each independent of the others, at least
//                 one degree of freedom left
//   overclosed    more of them, dependent ones too
//   driven        as tree or loop, with drivers that are independent of the joints
//   slot          as tree or loop, with pins in slots under laws of the whole catalogue
//   change-point  parallelograms and chains of them, which pass through truly singular positions
//
// From seed second_series on all but those at change points also have rods without mass, rods without
// inertia (not trees), and pins with friction.
//
// All have 1 to 10 bodies, springs, dampers and loads. Masses spread over up to six decades. Rates
// are of order 1/s, lengths of order `size`, so that the motion of one run is moderately nonlinear.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <yoke/tests/random/description.hpp>

namespace yoke::tests::random {

const std::vector<std::string>& families();

/// Seeds before keep the mechanisms they have always had.
constexpr std::uint64_t second_series = 1'000'000;

/// The family follows from the seed. The same on every platform.
Description generate(std::uint64_t seed);

}  // namespace yoke::tests::random
