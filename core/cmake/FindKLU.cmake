# SPDX-License-Identifier: BSD-3-Clause
# Copyright 2026 the Yoke authors
#
# Finds SuiteSparse's KLU and defines KLU::KLU. Its header is included as <suitesparse/klu.h>.
# Used in the tree and, installed beside yokeConfig.cmake, by find_package(yoke).

find_path(KLU_INCLUDE_DIR suitesparse/klu.h)
set(klu_libraries)
foreach(library klu amd colamd btf suitesparseconfig)
  find_library(KLU_${library}_LIBRARY ${library})
  mark_as_advanced(KLU_${library}_LIBRARY)
  list(APPEND klu_libraries KLU_${library}_LIBRARY)
endforeach()
mark_as_advanced(KLU_INCLUDE_DIR)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(KLU
  REQUIRED_VARS KLU_INCLUDE_DIR ${klu_libraries}
  REASON_FAILURE_MESSAGE "KLU is a part of SuiteSparse (Debian: libsuitesparse-dev)")

if(KLU_FOUND AND NOT TARGET KLU::KLU)
  add_library(KLU::KLU UNKNOWN IMPORTED)
  set_target_properties(KLU::KLU PROPERTIES
    IMPORTED_LOCATION "${KLU_klu_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${KLU_INCLUDE_DIR}"
    INTERFACE_LINK_LIBRARIES
      "${KLU_amd_LIBRARY};${KLU_colamd_LIBRARY};${KLU_btf_LIBRARY};${KLU_suitesparseconfig_LIBRARY}")
endif()
