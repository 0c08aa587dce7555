// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/report/page.hpp>

#include <fmt/format.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string_view>

#include <yoke/cases/report/base64.hpp>
#include <yoke/cases/report/page_text.hpp>
#include <yoke/core/result.hpp>

namespace yoke::cases {

namespace {

std::string escaped_html(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    if (c == '&')
      safe += "&amp;";
    else if (c == '<')
      safe += "&lt;";
    else if (c == '>')
      safe += "&gt;";
    else
      safe += c;
  }
  return safe;
}

/// JSON within a script element: no "<" may end it. In JSON that character is in strings alone.
std::string escaped_json(const std::string& json) {
  std::string safe;
  safe.reserve(json.size());
  for (const char c : json) {
    if (c == '<')
      safe += "\\u003c";
    else
      safe += c;
  }
  return safe;
}

/// A hash as a Content-Security-Policy names it, from its hexadecimal digits.
std::string policy_hash(std::string_view hex) {
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
    bytes.push_back(
        static_cast<std::uint8_t>(std::stoul(std::string(hex.substr(i, 2)), nullptr, 16)));
  return "'sha256-" + base64(bytes.data(), bytes.size()) + "'";
}

std::string policy(const PageText& text) {
  return fmt::format(
      "default-src 'none'; script-src {}; style-src {}; img-src data: blob:; base-uri 'none'; "
      "form-action 'none'",
      policy_hash(text.script_sha256), policy_hash(text.style_sha256));
}

const char* kind_of(PageKind kind) {
  switch (kind) {
    case PageKind::report:
      return "report";
    case PageKind::comparison:
      return "comparison";
    case PageKind::view:
      break;
  }
  return "view";
}

}  // namespace

std::string json_block(const std::string& attributes, const std::string& json) {
  return fmt::format("<script type=\"application/json\" {}>{}</script>\n", attributes,
                     escaped_json(json));
}

void write_filled_page(const std::filesystem::path& path, const PageText& text,
                       const std::string& title, const std::string& data) {
  const auto filling = [&](std::string_view mark) {
    if (mark == "title") return escaped_html(title);
    if (mark == "policy") return policy(text);
    if (mark == "style") return text.style;
    if (mark == "script") return text.script;
    return data;
  };
  // Marks are looked for in the template alone: what is filled in may hold anything.
  const std::string& html = text.html;
  std::string page;
  std::size_t at = 0;
  for (;;) {
    const std::size_t open = html.find("{{", at);
    if (open == std::string::npos) break;
    const std::size_t close = html.find("}}", open);
    page += html.substr(at, open - at);
    page += filling(std::string_view(html).substr(open + 2, close - open - 2));
    at = close + 2;
  }
  page += html.substr(at);
  write_text(path, page);
}

void write_page(const std::filesystem::path& path, const std::string& title, PageKind kind,
                const std::vector<std::string>& replays) {
  const nlohmann::json about = {{"title", title}, {"kind", kind_of(kind)}};
  std::string data = json_block("id=\"about\"", about.dump());
  for (const std::string& replay : replays) data += json_block("class=\"run\"", replay);
  write_filled_page(path,
                    {page_text::html(), page_text::style(), page_text::script(),
                     page_text::style_sha256, page_text::script_sha256},
                    title, data);
}

}  // namespace yoke::cases
