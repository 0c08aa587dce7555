# SPDX-License-Identifier: BSD-3-Clause
# Copyright 2026 the Yoke authors
#
# Puts the page of a report (cases/report/page/, cases/report/uplot/) into the program as text, with
# the hashes its Content-Security-Policy names.

# The modules in the order in which they are read; they share one scope.
set(report_modules format data motion camera mechanism lens plots xyplots tables controls main)

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

function(yoke_embed_report_page target)
  set(room "${PROJECT_SOURCE_DIR}/cases/report")
  set(files "${room}/page/page.html" "${room}/uplot/uPlot.min.css" "${room}/page/style.css"
            "${room}/uplot/uPlot.iife.min.js")
  foreach(module ${report_modules})
    list(APPEND files "${room}/page/${module}.js")
  endforeach()
  set_property(DIRECTORY "${PROJECT_SOURCE_DIR}" APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${files})

  # uPlot is as it was published, or the build stops.
  file(STRINGS "${room}/uplot/SHA256SUMS" sums)
  foreach(line ${sums})
    string(REGEX MATCH "^([0-9a-f]+)  (.+)$" _ "${line}")
    file(SHA256 "${room}/uplot/${CMAKE_MATCH_2}" sum)
    if(NOT sum STREQUAL CMAKE_MATCH_1)
      message(FATAL_ERROR "cases/report/uplot/${CMAKE_MATCH_2} is not the file of SHA256SUMS")
    endif()
  endforeach()

  file(READ "${room}/page/page.html" html)
  file(READ "${room}/uplot/uPlot.min.css" uplot_style)
  file(READ "${room}/page/style.css" page_style)
  file(READ "${room}/uplot/uPlot.iife.min.js" uplot)
  set(style "${uplot_style}\n${page_style}")
  set(script "${uplot}\n(() => {\n\"use strict\";\n")
  foreach(module ${report_modules})
    file(READ "${room}/page/${module}.js" text)
    string(APPEND script "${text}\n")
  endforeach()
  string(APPEND script "})();\n")
  string(SHA256 style_hash "${style}")
  string(SHA256 script_hash "${script}")

  yoke_text_as_cpp(html "${html}" html_lines)
  yoke_text_as_cpp(style "${style}" style_lines)
  yoke_text_as_cpp(script "${script}" script_lines)
  set(source "${PROJECT_BINARY_DIR}/generated/report_page_text.cpp")
  string(CONCAT text "// SPDX-License-Identifier: BSD-3-Clause\n// Written by CMake.\n"
    "#include <yoke/cases/report/page_text.hpp>\n\nnamespace yoke::cases::page_text {\n\n"
    "${html_lines}\n${style_lines}\n${script_lines}\n"
    "const char* const style_sha256 = \"${style_hash}\";\n"
    "const char* const script_sha256 = \"${script_hash}\";\n\n"
    "}  // namespace yoke::cases::page_text\n")
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
