// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Tables in a MAT file (version 5, compressed), as MATLAB and Octave load it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <yoke/cases/results/output_table.hpp>

namespace yoke::cases {

/// Was it built with matio? Without it write_mat() throws ModelError.
extern const bool has_matio;

/// Each table is a struct with a column vector for each column, text as a cell array of strings:
/// motion.crank_x_m. In `names` and `units` structs of the same fields hold the name that a column has
/// elsewhere and its unit; `summary` is JSON. Throws OutputError naming the path; then what was there
/// before stays.
void write_mat(const std::filesystem::path& path, const std::vector<OutputTable>& tables,
               const std::string& summary);

/// Names as fields of a struct: letters, digits and underscores, at most 63, all different.
std::vector<std::string> field_names(const OutputTable& table);

}  // namespace yoke::cases
