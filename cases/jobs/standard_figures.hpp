// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The figures every case gets: motion, velocities, reactions, energy; with contacts also contact
// force and penetration of each law and the loop of its hardest contact. Then the case's own portraits.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <yoke/cases/jobs/law_run.hpp>
#include <yoke/cases/jobs/plot.hpp>

namespace yoke::cases {

/// [m] A frame for paths, neither narrow nor flat.
struct PathBox {
  double x_low = -0.5, x_high = 0.5, y_low = -0.5, y_high = 0.5;
};

/// What the figures of one run show; its data is in the folder of the plots.
struct DrawnRun {
  std::string law, folder;
  std::vector<ContactRecord> contacts{};
  std::vector<std::string> bodies{};
  std::vector<std::string> still{};  // quantities of bodies that stay as they are: "y_m"
  std::vector<std::string> paths{};  // bodies whose path is drawn
  double force_top = 0.0;            // [N] end of the axis of reactions; 0: as high as they are
  PathBox path_box{};                // around all paths
  std::vector<std::string> forces{}, moments{};  // joints that carry a force, a moment
  std::vector<std::string> energies{};           // terms of the ledger: "kinetic"
  std::vector<Portrait> portraits{};             // without their points
};

/// Writes the data of one run for the figures into `folder`; `paths` as in Case. Throws OutputError.
DrawnRun write_standard_data(const LawRun& run, const std::filesystem::path& folder,
                             const std::vector<std::string>& paths = {});

/// The figures of runs whose data was written. Motion, velocities, reactions and energy are those
/// of the first run.
std::vector<Figure> standard_figures(const std::string& case_name,
                                     const std::vector<DrawnRun>& runs,
                                     const Sheet& sheet = on_screen);

}  // namespace yoke::cases
