// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/terminal/terminal.hpp>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace yoke::cases {

namespace {

std::string_view variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string_view{} : value;
}

}  // namespace

bool is_terminal(std::FILE* stream) { return isatty(fileno(stream)) != 0; }

bool has_colours(std::FILE* stream) {
  return is_terminal(stream) && variable("NO_COLOR").empty() && variable("TERM") != "dumb";
}

bool has_blocks(std::FILE* stream) {
  std::string_view locale = variable("LC_ALL");
  if (locale.empty()) locale = variable("LC_CTYPE");
  if (locale.empty()) locale = variable("LANG");
  const bool utf8 = locale.find("UTF-8") != locale.npos || locale.find("utf8") != locale.npos;
  return is_terminal(stream) && utf8 && variable("TERM") != "dumb";
}

std::string painted(std::string_view text, Paint paint, std::FILE* stream) {
  if (!has_colours(stream)) return std::string(text);
  const char* code = paint == Paint::bold ? "1" : paint == Paint::good ? "32" : "31";
  return "\033[" + std::string(code) + "m" + std::string(text) + "\033[0m";
}

std::string sparkline(std::span<const double> values) {
  constexpr const char* blocks[] = {"\u2581", "\u2582", "\u2583", "\u2584",
                                    "\u2585", "\u2586", "\u2587", "\u2588"};
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double x : values)
    if (std::isfinite(x)) {
      low = std::min(low, x);
      high = std::max(high, x);
    }
  std::string line;
  for (const double x : values) {
    if (!std::isfinite(x)) {
      line += ' ';
      continue;
    }
    const double part = high > low ? (x - low) / (high - low) : 0.0;
    line += blocks[static_cast<std::size_t>(std::min(7.0, 8.0 * part))];
  }
  return line;
}

}  // namespace yoke::cases
