// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/paper/figures/case_figures.hpp>

namespace yoke::cases {

FigureMaker paper_figures(std::string_view case_name) {
  if (case_name == "scotch_yoke") return scotch_yoke_figures;
  return {};
}

}  // namespace yoke::cases
