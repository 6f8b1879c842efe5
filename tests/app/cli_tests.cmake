# End-to-end tests of the program palpa-cli.
find_package(nlohmann_json 3.11 REQUIRED)
palpa_add_test(palpa_cli_tests
  SOURCES cli_bad_input_test.cpp cli_cancel_test.cpp cli_project_test.cpp cli_render_test.cpp
          cli_runner.cpp cli_simulation_test.cpp
  LIBRARIES nlohmann_json::nlohmann_json)
target_compile_definitions(palpa_cli_tests PRIVATE
  PALPA_CLI="$<TARGET_FILE:palpa-cli>"
  PALPA_PROJECTS="${PROJECT_SOURCE_DIR}/projects"
  PALPA_WITH_DISPLAY="${PROJECT_SOURCE_DIR}/scripts/with-display")
add_dependencies(palpa_cli_tests palpa-cli)
