// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>
