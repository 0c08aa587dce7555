// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <cstdio>
#include <yoke/core/version.hpp>

int main() { std::printf("yoke %s\n", yoke::version); }
