# SPDX-License-Identifier: BSD-3-Clause
# Copyright 2026 the Yoke authors
#
# Puts the pages of reports (cases/report/page/, cases/report/uplot/) and sweeps (cases/sweep/page/) into the
# program as text, with the hashes their Content-Security-Policy names.

# The modules in the order in which they are read; they share one scope.
set(report_modules format data motion camera mechanism lens plots xyplots tables controls main)
set(sweep_modules data scales parallel map curves details main)

# C++ lines of a function that returns `text`: pieces, as literals have a greatest length.
function(yoke_text_as_cpp name text result)
  string(LENGTH "${text}" length)
  set(piece 12000)
  set(lines "std::string ${name}() {\n  std::string text;\n")
  set(at 0)
  while(at LESS length)
    string(SUBSTRING "${text}" ${at} ${piece} part)
    string(APPEND lines "  text += R\"yoke_page(${part})yoke_page\";\n")
    math(EXPR at "${at} + ${piece}")
  endwhile()
  string(APPEND lines "  return text;\n}\n")
  set(${result} "${lines}" PARENT_SCOPE)
endfunction()

# A page as functions of the namespace yoke::cases::${space} that `header` declares. `styles` and `modules` are
# files in their order; modules share one scope, `scripts` stand before it.
function(yoke_embed_page target space header html styles scripts modules)
  set_property(DIRECTORY "${PROJECT_SOURCE_DIR}" APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
    "${html}" ${styles} ${scripts} ${modules})
  file(READ "${html}" html_text)
  set(style "")
  foreach(file ${styles})
    file(READ "${file}" text)
    string(APPEND style "${text}\n")
  endforeach()
  set(script "")
  foreach(file ${scripts})
    file(READ "${file}" text)
    string(APPEND script "${text}\n")
  endforeach()
  string(APPEND script "(() => {\n\"use strict\";\n")
  foreach(file ${modules})
    file(READ "${file}" text)
    string(APPEND script "${text}\n")
  endforeach()
  string(APPEND script "})();\n")
  string(SHA256 style_hash "${style}")
  string(SHA256 script_hash "${script}")

  yoke_text_as_cpp(html "${html_text}" html_lines)
  yoke_text_as_cpp(style "${style}" style_lines)
  yoke_text_as_cpp(script "${script}" script_lines)
  set(source "${PROJECT_BINARY_DIR}/generated/${space}.cpp")
  string(CONCAT text "// SPDX-License-Identifier: BSD-3-Clause\n// Written by CMake.\n"
    "#include <yoke/${header}>\n\nnamespace yoke::cases::${space} {\n\n"
    "${html_lines}\n${style_lines}\n${script_lines}\n"
    "const char* const style_sha256 = \"${style_hash}\";\n"
    "const char* const script_sha256 = \"${script_hash}\";\n\n"
    "}  // namespace yoke::cases::${space}\n")
  set(old "")
  if(EXISTS "${source}")
    file(READ "${source}" old)
  endif()
  if(NOT old STREQUAL text)  # or everything behind it would be compiled again
    file(WRITE "${source}" "${text}")
  endif()
  target_sources(${target} PRIVATE "${source}")
  set_source_files_properties("${source}" PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

function(yoke_embed_pages target)
  set(room "${PROJECT_SOURCE_DIR}/cases/report")
  # uPlot is as it was published, or the build stops.
  file(STRINGS "${room}/uplot/SHA256SUMS" sums)
  foreach(line ${sums})
    string(REGEX MATCH "^([0-9a-f]+)  (.+)$" _ "${line}")
    file(SHA256 "${room}/uplot/${CMAKE_MATCH_2}" sum)
    if(NOT sum STREQUAL CMAKE_MATCH_1)
      message(FATAL_ERROR "cases/report/uplot/${CMAKE_MATCH_2} is not the file of SHA256SUMS")
    endif()
  endforeach()
  set(modules ${report_modules})
  list(TRANSFORM modules REPLACE "(.+)" "${room}/page/\\1.js")
  yoke_embed_page(${target} page_text cases/report/page_text.hpp "${room}/page/page.html"
    "${room}/uplot/uPlot.min.css;${room}/page/style.css" "${room}/uplot/uPlot.iife.min.js"
    "${modules}")
  set(sweep "${PROJECT_SOURCE_DIR}/cases/sweep/page")
  set(modules ${sweep_modules})
  list(TRANSFORM modules REPLACE "(.+)" "${sweep}/\\1.js")
  yoke_embed_page(${target} sweep_page_text cases/sweep/sweep_page_text.hpp "${sweep}/page.html"
    "${room}/page/style.css;${sweep}/style.css" "" "${room}/page/format.js;${modules}")
endfunction()
