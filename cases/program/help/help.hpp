// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// What the program says of itself besides the verbs' own words: examples, exit codes, what was perhaps meant.
// Help, man page and completion are made of the same parser.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace yoke::cases {

/// Adds examples to the help of every verb, exit codes to that of the program.
void add_help_texts(CLI::App& app);

/// "; did you mean 'run'?" of a verb or an option that is none; empty if nothing comes near.
std::string nearest_meant(const CLI::App& app, const std::vector<std::string>& arguments);

/// The man page yoke(1), for man(7).
std::string man_page(const CLI::App& app);

/// Completion for "bash" or "zsh". Throws ModelError for another shell.
std::string completion_script(const CLI::App& app, const std::string& shell);

}  // namespace yoke::cases
