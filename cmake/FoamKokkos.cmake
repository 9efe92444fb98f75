# Target foam_kokkos: what the KOKKOS styles are compiled with beside foam_lammps. Only there if
# LAMMPS was built with the KOKKOS package and its sources are at hand.

if(NOT FOAM_KOKKOS OR SKBUILD)    # the wheel has no KOKKOS
  return()
endif()
set(base_only "only the base styles are built")
if(NOT LAMMPS_BUILD_DIR)
  # Installed copies of LAMMPS have neither the headers of KOKKOS styles nor those of Kokkos.
  message(STATUS "KOKKOS styles need LAMMPS_SOURCE_DIR and LAMMPS_BUILD_DIR: ${base_only}")
  return()
elseif(NOT LMP_PKG_KOKKOS)
  message(STATUS "This LAMMPS was built without PKG_KOKKOS: ${base_only}")
  return()
endif()
file(STRINGS ${LAMMPS_SOURCE_DIR}/KOKKOS/kokkos_type.h kk_float REGEX KK_FLOAT LIMIT_COUNT 1)
if(NOT kk_float)
  message(STATUS "The KOKKOS package of this LAMMPS is older than 4 Jul 2026: ${base_only}")
  return()
endif()

# The Kokkos that LAMMPS was built with describes itself to CMake: bundled, external or downloaded
unset(Kokkos_DIR CACHE)    # of another LAMMPS_BUILD_DIR
find_package(Kokkos CONFIG COMPONENTS separable_compilation NO_DEFAULT_PATH HINTS
  ${LAMMPS_BUILD_DIR}/lib/kokkos ${LMP_Kokkos_DIR} ${LAMMPS_BUILD_DIR}/kokkos_build-prefix)
if(NOT Kokkos_FOUND)
  message(STATUS "No KokkosConfig.cmake of the Kokkos that LAMMPS was built with: ${base_only}")
  return()
endif()

# code for GPUs takes nvcc_wrapper (or hipcc ...), all the way
get_filename_component(theirs "${LMP_CMAKE_CXX_COMPILER}" REALPATH)
get_filename_component(ours "${CMAKE_CXX_COMPILER}" REALPATH)
if(Kokkos_DEVICES MATCHES "CUDA|HIP|SYCL" AND NOT ours STREQUAL theirs)
  message(FATAL_ERROR "This LAMMPS was built for GPUs, so the plugin needs the same compiler: "
    "start with an empty build directory and -DCMAKE_CXX_COMPILER=${LMP_CMAKE_CXX_COMPILER} (or "
    "leave the KOKKOS styles out with -DFOAM_KOKKOS=off)")
endif()

# everything that Kokkos asks of its users, but for its libraries
add_library(foam_kokkos INTERFACE)
target_include_directories(foam_kokkos SYSTEM INTERFACE ${LAMMPS_SOURCE_DIR}/KOKKOS
  $<TARGET_PROPERTY:Kokkos::kokkos,INTERFACE_INCLUDE_DIRECTORIES>)
target_compile_definitions(foam_kokkos INTERFACE
  $<TARGET_PROPERTY:Kokkos::kokkos,INTERFACE_COMPILE_DEFINITIONS>)
target_compile_options(foam_kokkos INTERFACE
  $<TARGET_PROPERTY:Kokkos::kokkos,INTERFACE_COMPILE_OPTIONS>)
target_include_directories(foam_kokkos INTERFACE ${PROJECT_SOURCE_DIR}/src/KOKKOS_FOAM)

# as LAMMPS' cmake/Modules/Packages/KOKKOS.cmake defines them
string(TOUPPER "${LMP_KOKKOS_PREC}" precision)
set(DOUBLE DOUBLE_DOUBLE)
set(MIXED SINGLE_DOUBLE)
set(SINGLE SINGLE_SINGLE)
string(TOUPPER "${LMP_KOKKOS_LAYOUT}" layout)
target_compile_definitions(foam_kokkos INTERFACE FOAM_KOKKOS
  LMP_KOKKOS LMP_KOKKOS_${${precision}} LMP_KOKKOS_LAYOUT_${layout})
# the run-time library of CUDA comes with LAMMPS too
if(Kokkos_DEVICES MATCHES CUDA)
  target_link_options(foam_kokkos INTERFACE -cudart none $<TARGET_PROPERTY:Kokkos::kokkos,INTERFACE_LINK_OPTIONS>)
endif()
message(STATUS "With KOKKOS styles: ${Kokkos_DEVICES}, ${LMP_KOKKOS_PREC} precision")
