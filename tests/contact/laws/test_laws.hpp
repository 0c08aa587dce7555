// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The library's dissipative laws, one of every kind, to show that the contact element takes them
// all: proportional damping, damping with the effective mass, a step of force at first touch, a
// permanent set with memory, a transition function of the penetration.
#pragma once

#include <yoke/contact/laws/dissipative/exact_restitution.hpp>
#include <yoke/contact/laws/dissipative/hunt_crossley.hpp>
#include <yoke/contact/laws/dissipative/kelvin_voigt.hpp>
#include <yoke/contact/laws/dissipative/lankarani_nikravesh_1994.hpp>
#include <yoke/contact/laws/dissipative/lee_wang_2.hpp>
#include <yoke/contact/laws/dissipative/tsuji.hpp>

namespace yoke::tests {

using PermanentSet = LankaraniNikravesh1994;

}  // namespace yoke::tests
