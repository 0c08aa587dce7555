// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The tables and figures of Machines 2022, 10, 966 about the laws themselves, made again.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace yoke::cases {

/// A fit in the units of the tables.
struct TableFit {
  double K = 0.0, n = 0.0;  // (N/mm)/mm^n
  double error = 0.0;       // [%] |K d^n/F - 1| at the first fitted load with d >= 1 um
};

/// One entry of a table: printed, made again the same way, and made with the right law.
struct ReproducedEntry {
  int table = 0;
  std::string law{}, material{}, wall{};  // wall: of Table 11
  double DR = 0.0;                        // [mm] as printed
  TableFit published{}, reproduced{};
  std::optional<TableFit> corrected{};  // nothing where the law does not reach the range of loads
  bool K_differs = false;               // printed and reproduced, by more than one unit of the
  bool n_differs = false;               // last digit printed
  bool error_differs = false;           // the same
  std::string misprint{};               // what is known to be wrong with the printed entry
};

/// Tables 2 to 9 and 11, in order; about a second.
std::vector<ReproducedEntry> reproduce_tables();

std::string tables_document();
/// The same as tables.md and tables.csv.
void write_tables(const std::filesystem::path& folder);

/// Figures 2, 3, 5, 6, 7, 10, 15 and the loops of all dissipative laws: data, gnuplot scripts and
/// pictures. Returns what to tell the user.
std::string write_figures(const std::filesystem::path& folder);

}  // namespace yoke::cases
