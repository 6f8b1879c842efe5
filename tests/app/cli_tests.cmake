# End-to-end tests of the program palpa-cli.
find_package(nlohmann_json 3.11 REQUIRED)
add_library(palpa_cli_runner STATIC cli_runner.cpp)
target_link_libraries(palpa_cli_runner PUBLIC palpa_options nlohmann_json::nlohmann_json GTest::gtest)
target_compile_definitions(palpa_cli_runner PUBLIC
  PALPA_CLI="$<TARGET_FILE:palpa-cli>"
  PALPA_PROJECTS="${PROJECT_SOURCE_DIR}/projects"
  PALPA_TEST_DATA="${PROJECT_SOURCE_DIR}/tests/data"
  PALPA_REFERENCE="${PROJECT_SOURCE_DIR}/resources/reference"
  PALPA_WITH_DISPLAY="${PROJECT_SOURCE_DIR}/scripts/with-display")
palpa_use_precompiled(tests palpa_cli_runner)
add_dependencies(palpa_cli_runner palpa-cli)

palpa_add_test(palpa_cli_tests
  SOURCES
    cli_bad_input_test.cpp
    cli_cancel_test.cpp
    cli_compare_test.cpp
    cli_drawing_test.cpp
    cli_edit_test.cpp
    cli_examples_test.cpp
    cli_exchange_test.cpp
    cli_gradient_test.cpp
    cli_measure_test.cpp
    cli_optimise_test.cpp
    cli_page_test.cpp
    cli_place_test.cpp
    cli_project_test.cpp
    cli_recording_test.cpp
    cli_section_test.cpp
    cli_simulation_test.cpp
    cli_solids_test.cpp
    cli_usage_test.cpp
    cli_verify_test.cpp
  LIBRARIES palpa_cli_runner
  LIGHT
  LABEL cli)
add_test(NAME cli.corpus COMMAND ${CMAKE_CURRENT_LIST_DIR}/corpus_test.sh $<TARGET_FILE:palpa-cli>)
set_tests_properties(cli.corpus PROPERTIES LABELS cli TIMEOUT 300)
# Sanitizer presets leave out the label render: graphics drivers leak and race on their own.
palpa_add_test(palpa_cli_render_tests
  SOURCES cli_render_test.cpp cli_report_test.cpp
  LIBRARIES palpa_cli_runner
  LIGHT
  LABEL render)
# The examples at several finenesses: half a minute to a minute each.
palpa_add_test(palpa_cli_slow_tests
  SOURCES cli_accuracy_slow_test.cpp
  LIBRARIES palpa_cli_runner
  LIGHT
  LABEL slow)
