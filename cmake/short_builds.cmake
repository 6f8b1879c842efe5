# Short builds: most of what the compiler reads are headers of other projects. The build is correct without
# them (-DPALPA_FAST_BUILD=OFF): every file includes what it uses. docs/decisions/025-short-builds.md has figures.
option(PALPA_FAST_BUILD "Precompile headers of other projects, compile the command line in few large files" ON)

set(palpa_standard_headers <algorithm> <array> <atomic> <chrono> <cmath> <condition_variable> <filesystem> <fstream>
  <functional> <limits> <map> <memory> <mutex> <numbers> <numeric> <optional> <set> <span> <sstream> <stdexcept> <string>
  <string_view> <thread> <tuple> <utility> <variant> <vector>)

# palpa_precompile(TARGET HEADER…): precompiles the standard library and these headers for the target.
function(palpa_precompile target)
  if(PALPA_FAST_BUILD)
    target_precompile_headers(${target} PRIVATE ${palpa_standard_headers} ${ARGN})
  endif()
endfunction()

# palpa_precompiled_set(NAME HEADERS … [LIBRARIES …] [OPTIONS …]): headers that several targets share. LIBRARIES of the
# set give their folders; OPTIONS are compiler options that the targets have as well.
function(palpa_precompiled_set name)
  cmake_parse_arguments(ARG "" "" "HEADERS;LIBRARIES;OPTIONS" ${ARGN})
  if(PALPA_FAST_BUILD)
    file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/precompiled_${name}.cpp CONTENT "")
    add_library(palpa_precompiled_${name} OBJECT ${CMAKE_CURRENT_BINARY_DIR}/precompiled_${name}.cpp)
    target_link_libraries(palpa_precompiled_${name} PRIVATE palpa_options ${ARG_LIBRARIES})
    target_compile_options(palpa_precompiled_${name} PRIVATE ${ARG_OPTIONS})
    palpa_precompile(palpa_precompiled_${name} ${ARG_HEADERS})
  endif()
endfunction()

# palpa_use_precompiled(NAME TARGET…)
function(palpa_use_precompiled name)
  if(PALPA_FAST_BUILD)
    foreach(target IN LISTS ARGN)
      target_precompile_headers(${target} REUSE_FROM palpa_precompiled_${name})
    endforeach()
  endif()
endfunction()

# palpa_compile_together(TARGET COUNT [APART FILE…]): compiles COUNT neighbouring files of the target as one, because
# each file alone spends half of its time in headers. APART: files that define a name of a neighbour.
function(palpa_compile_together target count)
  cmake_parse_arguments(ARG "" "" "APART" ${ARGN})
  if(PALPA_FAST_BUILD)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${count})
    if(ARG_APART)
      set_source_files_properties(${ARG_APART} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    endif()
  endif()
endfunction()

# palpa_compile_apart(FILE…): files whose compiler options no precompiled header fits.
function(palpa_compile_apart)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_PRECOMPILE_HEADERS ON SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()
