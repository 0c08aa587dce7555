// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/program/yoke.hpp>

int main(int argc, char** argv) { return yoke::cases::run_yoke(argc, argv); }
