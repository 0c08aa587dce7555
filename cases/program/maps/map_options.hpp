// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The command line of a verb that makes a map of a case: --at, --x, --y, --discard, --points ...
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include <yoke/cases/maps/section_choice.hpp>
#include <yoke/cases/program/request.hpp>

namespace yoke::cases {

/// The options as they were typed.
struct MapOptions {
  RequestOptions run{};
  std::string law{}, at{}, x{}, y{}, duration{};
  long discard = 100, points = 400;
};

void add_map_options(CLI::App& verb, MapOptions& options, bool with_x);

/// Checked; `verb` and `more` make the command and the default folder. Throws ModelError.
MapRequest map_request(const Case& c, const MapOptions& options, const std::string& verb,
                       const std::string& more);

}  // namespace yoke::cases
