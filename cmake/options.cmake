# Compiler options shared by every target, as the interface library palpa_options.
find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)

option(PALPA_PYTHON "Build the Python package palpa (docs/python.md)" ON)
option(PALPA_MPI "Build palpa-mpi, for several processes or machines (docs/cluster.md)" OFF)
set(PALPA_SANITIZE "" CACHE STRING "Sanitizers to build with, as in -fsanitize=…; empty for none")

add_library(palpa_options INTERFACE)
set_target_properties(palpa_options PROPERTIES EXPORT_NAME options)
# Programs that use the installed libraries choose their own warnings.
target_include_directories(palpa_options INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                                   $<INSTALL_INTERFACE:include/palpa>)
target_compile_features(palpa_options INTERFACE cxx_std_20)
target_compile_options(palpa_options INTERFACE
  $<BUILD_INTERFACE:-Wall> $<BUILD_INTERFACE:-Wextra> $<BUILD_INTERFACE:-Wpedantic> $<BUILD_INTERFACE:-Wshadow>
  $<BUILD_INTERFACE:-Werror>
  # g++ 12 reports overlapping and oversized copies in plain string concatenation (GCC bug 105651); there are none.
  $<BUILD_INTERFACE:$<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>>
  $<BUILD_INTERFACE:$<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overflow>>
  $<BUILD_INTERFACE:$<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overread>>
  $<BUILD_INTERFACE:$<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds>>)
target_link_libraries(palpa_options INTERFACE Threads::Threads $<INSTALL_INTERFACE:Eigen3::Eigen>)
if(PALPA_SANITIZE)
  target_compile_options(palpa_options INTERFACE -fsanitize=${PALPA_SANITIZE} -fno-omit-frame-pointer)
  # g++ 12 finds empty std::optional uninitialised in instrumented code.
  target_compile_options(palpa_options INTERFACE
    $<BUILD_INTERFACE:$<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>>)
  target_link_options(palpa_options INTERFACE -fsanitize=${PALPA_SANITIZE})
endif()

# Headers of other projects must not break our warnings-as-errors build.
get_target_property(eigen_include Eigen3::Eigen INTERFACE_INCLUDE_DIRECTORIES)
target_include_directories(palpa_options SYSTEM INTERFACE $<BUILD_INTERFACE:${eigen_include}>)

# palpa_position_independent(TARGET…): libraries that the Python module contains, and users of their precompiled header.
# Symbols of the module are not replaced at run time, so the compiler may inline as it does in programs.
function(palpa_position_independent)
  if(PALPA_PYTHON)
    foreach(target IN LISTS ARGN)
      set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
      target_compile_options(${target} PRIVATE -fno-semantic-interposition)
    endforeach()
  endif()
endfunction()
