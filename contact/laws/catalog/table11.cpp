// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/contact/laws/catalog/table11.hpp>

#include <fmt/ranges.h>

#include <array>

namespace yoke {

namespace {
struct Fit {
  double K, n;  // [N/mm^n]
};
struct Column {
  const char* name;
  Fit inner, outer, cap;
};
constexpr std::array<Column, 5> columns{{
    {"table11-lankarani-nikravesh", {1.220e5, 1.50}, {1.424e5, 1.50}, {1.198e6, 1.50}},
    {"table11-radzimovsky", {4.321e4, 1.09}, {4.315e4, 1.09}, {1.846e5, 1.22}},
    {"table11-johnson", {4.914e4, 1.10}, {4.907e4, 1.10}, {3.147e5, 1.28}},
    {"table11-goldsmith", {1.717e4, 1.04}, {1.743e4, 1.04}, {2.221e4, 1.05}},
    {"table11-esdu-78035", {1.300e4, 1.09}, {1.254e4, 1.09}, {4.786e4, 1.22}},
}};
}  // namespace

const std::vector<std::string>& table11_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const Column& column : columns) list.emplace_back(column.name);
    return list;
  }();
  return names;
}

Table11 table11(std::string_view name, double scale) {
  require_positive(fmt::format("law '{}'", name), "scale", scale, "");
  for (const Column& column : columns) {
    if (name != column.name) continue;
    const auto law = [&](const Fit& entry) {
      return per_mm(scale * entry.K, entry.n, column.name);
    };
    return {law(column.inner), law(column.outer), law(column.cap)};
  }
  throw ModelError(fmt::format("unknown column '{}' of Table 11; there are {}", name,
                               fmt::join(table11_names(), ", ")));
}

}  // namespace yoke
