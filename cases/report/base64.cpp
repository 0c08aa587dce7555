// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/report/base64.hpp>

#include <cstdint>

namespace yoke::cases {

std::string base64(const void* bytes, std::size_t count) {
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto* in = static_cast<const unsigned char*>(bytes);
  std::string text;
  text.reserve((count + 2) / 3 * 4);
  for (std::size_t i = 0; i < count; i += 3) {
    const std::size_t left = count - i;
    std::uint32_t three = static_cast<std::uint32_t>(in[i]) << 16;
    if (left > 1) three |= static_cast<std::uint32_t>(in[i + 1]) << 8;
    if (left > 2) three |= in[i + 2];
    text += digits[three >> 18];
    text += digits[three >> 12 & 63];
    text += left > 1 ? digits[three >> 6 & 63] : '=';
    text += left > 2 ? digits[three & 63] : '=';
  }
  return text;
}

}  // namespace yoke::cases
