// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Which rows of a run a report keeps: few enough for a page, without losing an extreme of any
// column or an impact.
#pragma once

#include <cstddef>
#include <vector>

#include <yoke/cases/results/contact_spans.hpp>
#include <yoke/core/result.hpp>

namespace yoke::cases {

/// Rows in rising order: all of them if there are at most `most`. Otherwise the first and last, of
/// each impact its ends, its peak and rows between them, and of equal stretches of the run the rows
/// where a column is least and greatest. Only where the impacts alone need more than `most` there
/// are more.
std::vector<std::size_t> thinned_rows(const Table& samples, const std::vector<ContactSpan>& impacts,
                                      std::size_t most);

}  // namespace yoke::cases
