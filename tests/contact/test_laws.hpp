// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The library's dissipative laws, one of every kind, to show that the contact element takes them
// all: proportional damping, damping with the effective mass, a step of force at first touch, a
// permanent set with memory, a transition function of the penetration.
#pragma once

#include <yoke/contact/exact_restitution.hpp>
#include <yoke/contact/hunt_crossley.hpp>
#include <yoke/contact/kelvin_voigt.hpp>
#include <yoke/contact/lankarani_nikravesh_1994.hpp>
#include <yoke/contact/lee_wang_2.hpp>
#include <yoke/contact/tsuji.hpp>

namespace yoke::tests {

using PermanentSet = LankaraniNikravesh1994;

}  // namespace yoke::tests
