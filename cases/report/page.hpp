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

/// The parts of a page: {{title}}, {{policy}}, {{style}}, {{data}}, {{script}} in `html` are filled in. The
/// hashes are hexadecimal SHA-256 of style and script.
struct PageText {
  std::string html, style, script;
  std::string style_sha256, script_sha256;
};

/// A block of JSON in the page, as an element `script` with these attributes, id or class.
std::string json_block(const std::string& attributes, const std::string& json);

/// Writes a page with `data`, blocks one after another. Throws OutputError.
void write_filled_page(const std::filesystem::path& path, const PageText& text,
                       const std::string& title, const std::string& data);

/// `replays`: texts of to_json(Replay), in the order in which they are shown. Throws OutputError.
void write_page(const std::filesystem::path& path, const std::string& title, PageKind kind,
                const std::vector<std::string>& replays);

}  // namespace yoke::cases
