# Fails when PROGRAM has a test suite that SUITES (a list) does not name.
execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE listed
                COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "(^|\n)[A-Za-z0-9_/]+\\." found "${listed}")
foreach(suite IN LISTS found)
  string(REGEX REPLACE "[\n.]" "" suite "${suite}")
  if(NOT suite IN_LIST SUITES)
    message(FATAL_ERROR "tests/gui/CMakeLists.txt does not run the suite ${suite}")
  endif()
endforeach()
list(LENGTH found count)
if(count EQUAL 0)
  message(FATAL_ERROR "${PROGRAM} lists no tests")
endif()
