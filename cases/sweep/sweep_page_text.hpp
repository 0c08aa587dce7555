// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The files of cases/sweep/page/ as text, put into the program by CMake.
#pragma once

#include <string>

namespace yoke::cases::sweep_page_text {

std::string html();                     ///< page.html
std::string style();                    ///< of reports and of the page
std::string script();                   ///< the page's modules in their order
extern const char* const style_sha256;  ///< hexadecimal
extern const char* const script_sha256;

}  // namespace yoke::cases::sweep_page_text
