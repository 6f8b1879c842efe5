# Compiler options shared by every target, as the interface library palpa_options.
find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)

set(PALPA_SANITIZE "" CACHE STRING "Sanitizers to build with, as in -fsanitize=…; empty for none")

add_library(palpa_options INTERFACE)
target_include_directories(palpa_options INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_options(palpa_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Werror)
target_link_libraries(palpa_options INTERFACE Threads::Threads)
if(PALPA_SANITIZE)
  target_compile_options(palpa_options INTERFACE -fsanitize=${PALPA_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(palpa_options INTERFACE -fsanitize=${PALPA_SANITIZE})
endif()

# Headers of other projects must not break our warnings-as-errors build.
get_target_property(eigen_include Eigen3::Eigen INTERFACE_INCLUDE_DIRECTORIES)
target_include_directories(palpa_options SYSTEM INTERFACE ${eigen_include})
