# SPDX-License-Identifier: BSD-3-Clause
# Copyright 2026 the Yoke authors
#
# SUNDIALS 7 built with MPI, as Debian builds it, names MPI::MPI_C and MPI::MPI_CXX in its targets.
# Its own configuration looks only for the languages that the project has enabled, so a C++ project
# would lack MPI::MPI_C. To be included after find_package(SUNDIALS); does nothing where SUNDIALS
# does not name MPI. Used in the tree and, installed beside yokeConfig.cmake, by find_package(yoke).

set(yoke_sundials_links "")
foreach(target core core_shared core_static arkode_shared arkode_static)
  if(TARGET SUNDIALS::${target})
    get_target_property(links SUNDIALS::${target} INTERFACE_LINK_LIBRARIES)
    list(APPEND yoke_sundials_links ${links})
  endif()
endforeach()
if(yoke_sundials_links MATCHES "MPI::MPI")
  if(NOT TARGET MPI::MPI_CXX AND NOT TARGET MPI::MPI_C)
    find_package(MPI QUIET)
  endif()
  foreach(pair "C;CXX" "CXX;C")
    list(GET pair 0 missing)
    list(GET pair 1 other)
    if(NOT TARGET MPI::MPI_${missing} AND TARGET MPI::MPI_${other})
      add_library(MPI::MPI_${missing} INTERFACE IMPORTED)
      target_link_libraries(MPI::MPI_${missing} INTERFACE MPI::MPI_${other})
    endif()
  endforeach()
  if(NOT TARGET MPI::MPI_C)
    message(FATAL_ERROR "SUNDIALS was built with MPI, which was not found (Debian: libopenmpi-dev)")
  endif()
endif()
unset(yoke_sundials_links)
