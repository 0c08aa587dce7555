// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/jobs/standard_figures.hpp>

#include <utility>

#include <yoke/cases/jobs/figure_parts.hpp>

namespace yoke::cases {

DrawnRun write_standard_data(const LawRun& run, const std::filesystem::path& folder,
                             const std::vector<std::string>& paths) {
  DrawnRun drawn{.law = run.law, .folder = run.folder};
  if (run.samples.rows() < 2) return drawn;
  make_output_folder(folder);
  write_motion_data(run, folder, paths, drawn);
  write_portrait_data(run, folder, drawn);
  write_contact_data(run, folder, drawn);
  return drawn;
}

std::vector<Figure> standard_figures(const std::string& case_name,
                                     const std::vector<DrawnRun>& runs, const Sheet& sheet) {
  std::vector<Figure> figures = motion_figures(case_name, runs.front(), sheet);
  for (std::vector<Figure> more :
       {contact_figures(case_name, runs, sheet), portrait_figures(case_name, runs, sheet)})
    for (Figure& figure : more) figures.push_back(std::move(figure));
  return figures;
}

}  // namespace yoke::cases
