# SPDX-License-Identifier: BSD-3-Clause
# Copyright 2026 the Yoke authors
#
# Formats of results that need a library: results.h5 (HDF5) and results.mat (matio). What is not found
# is left out; the program then names the package that is missing when it is asked for the format.
# Only the program needs them, not the library.

option(YOKE_HDF5 "Write results as HDF5, if it is found" ON)
option(YOKE_MATIO "Write results as MAT files, if matio is found" ON)

function(yoke_result_formats target)
  if(YOKE_HDF5)
    # By hand: FindHDF5 would want a C compiler. Debian keeps the version without MPI apart.
    find_path(HDF5_INCLUDE_DIR hdf5.h PATH_SUFFIXES hdf5/serial)
    find_library(HDF5_LIBRARY NAMES hdf5_serial hdf5 PATH_SUFFIXES hdf5/serial)
    mark_as_advanced(HDF5_INCLUDE_DIR HDF5_LIBRARY)
    set(chunks "")  # written by ourselves, from HDF5 1.10.3 on
    if(HDF5_INCLUDE_DIR)
      file(STRINGS "${HDF5_INCLUDE_DIR}/H5Dpublic.h" chunks REGEX "H5Dwrite_chunk" LIMIT_COUNT 1)
    endif()
  endif()
  if(YOKE_HDF5 AND HDF5_INCLUDE_DIR AND HDF5_LIBRARY AND chunks)
    target_compile_definitions(${target} PRIVATE YOKE_HDF5)
    target_include_directories(${target} SYSTEM PRIVATE ${HDF5_INCLUDE_DIR})
    target_link_libraries(${target} PRIVATE ${HDF5_LIBRARY})
    message(STATUS "Results as HDF5: yes")
  else()
    message(STATUS "Results as HDF5: no (libhdf5-dev)")
  endif()
  if(YOKE_MATIO)
    find_path(MATIO_INCLUDE_DIR matio.h)
    find_library(MATIO_LIBRARY matio)
    mark_as_advanced(MATIO_INCLUDE_DIR MATIO_LIBRARY)
  endif()
  if(YOKE_MATIO AND MATIO_INCLUDE_DIR AND MATIO_LIBRARY)
    target_compile_definitions(${target} PRIVATE YOKE_MATIO)
    target_include_directories(${target} SYSTEM PRIVATE ${MATIO_INCLUDE_DIR})
    target_link_libraries(${target} PRIVATE ${MATIO_LIBRARY})
    message(STATUS "Results as MAT files: yes")
  else()
    message(STATUS "Results as MAT files: no (libmatio-dev)")
  endif()
endfunction()
