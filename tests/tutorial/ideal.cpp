// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#define slotted_lever_case slotted_lever_ideal
#include <yoke/tests/tutorial/ideal.hpp>
