// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The command line of a verb that takes an elastic law: --elastic, --reading, --material,
// --pin-radius, --wall-radius, --clearance, --internal, --external, --length.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>
#include <vector>

#include <yoke/contact/laws/catalog/elastic_catalog.hpp>

namespace yoke::cases {

/// The options as they were typed.
struct ElasticOptions {
  std::string elastic;
  std::string reading = "consistent";
  std::string material, pin_material, wall_material;
  std::string pin_radius, wall_radius, clearance, length;
  bool internal = false, external = false;
};

void add_elastic_options(CLI::App& verb, ElasticOptions& options);

/// What they mean. Throws ModelError for what is missing, in words of the command line.
ElasticArguments elastic_arguments(const ElasticOptions& options);

/// The law, and on stderr what is odd about the reading asked for.
ElasticLaw elastic_law(const ElasticOptions& options);

/// "csv", "json" or "text" among `known`, or ModelError.
void check_format(const std::string& format, const std::vector<std::string>& known);

}  // namespace yoke::cases
