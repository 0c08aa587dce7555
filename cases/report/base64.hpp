// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Bytes as text (RFC 4648), for numbers within a page.
#pragma once

#include <cstddef>
#include <string>

namespace yoke::cases {

std::string base64(const void* bytes, std::size_t count);

}  // namespace yoke::cases
