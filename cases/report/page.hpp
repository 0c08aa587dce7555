// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A report: one file that opens from disk, without a network. It holds the runs it shows, the page's
// style and script, and a Content-Security-Policy under which nothing else can be loaded or run.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace yoke::cases {

inline constexpr const char* report_name = "report.html";

enum class PageKind { report, comparison, view };

/// `replays`: texts of to_json(Replay), in the order in which they are shown. Throws OutputError.
void write_page(const std::filesystem::path& path, const std::string& title, PageKind kind,
                const std::vector<std::string>& replays);

}  // namespace yoke::cases
