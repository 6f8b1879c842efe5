# cmake -DBUILD=… -DSOURCE=… -DWORK=… -DPYTHON=… -P install_test.cmake: installs into an empty folder, runs the installed program
# from there, compiles each installed header alone, and builds and runs a program that uses the installed libraries.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  message("${output}")
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "failed: ${ARGN}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
run(${WORK}/prefix/bin/palpa-cli touch ${SOURCE}/projects/sphere.json --threads 1)
# The reference solutions are in the program.
run(${WORK}/prefix/bin/palpa-cli verify --case patch_linear_box_nu0.30)
foreach(file bin/palpa libexec/palpa/palpa-read-cad share/man/man1/palpa-cli.1 share/man/man1/palpa.1
    share/bash-completion/completions/palpa-cli share/applications/palpa.desktop share/mime/packages/palpa.xml
    share/icons/hicolor/scalable/apps/palpa.svg share/doc/palpa/docs/guide/README.md)
  if(NOT EXISTS ${WORK}/prefix/${file})
    message(FATAL_ERROR "not installed: ${file}")
  endif()
endforeach()
# So does the Python package, with a CAD reader beside it.
if(PYTHON)
  file(GLOB site ${WORK}/prefix/lib/python3*/dist-packages)
  set(ENV{PYTHONPATH} ${site})
  file(WRITE ${WORK}/touch.py "import palpa\nassert palpa.__file__.startswith('${WORK}')\n"
    "palpa.box().export('${WORK}/python.step')\nassert palpa.read_step('${WORK}/python.step').is_solid\n")
  run(${PYTHON} ${WORK}/touch.py)
  unset(ENV{PYTHONPATH})
endif()
# CAD files are read with the help of a program that is found from the installed one.
run(${WORK}/prefix/bin/palpa-cli export ${SOURCE}/projects/box.json -o ${WORK}/box.step)
run(${WORK}/prefix/bin/palpa-cli import ${WORK}/box.step -o ${WORK}/box.json)

# The public headers are installed and no others, and each compiles alone.
include(${SOURCE}/cmake/public_headers.cmake)
file(GLOB_RECURSE headers RELATIVE ${WORK}/prefix/include/palpa ${WORK}/prefix/include/palpa/*.h)
list(SORT headers)
list(SORT palpa_public_headers)
if(NOT headers STREQUAL palpa_public_headers)
  message(FATAL_ERROR "installed headers: ${headers}\npublic headers: ${palpa_public_headers}")
endif()
run(${CMAKE_COMMAND} -G Ninja -S ${SOURCE}/tests/install/headers -B ${WORK}/headers -DCMAKE_PREFIX_PATH=${WORK}/prefix
  "-DHEADERS=${headers}")
run(${CMAKE_COMMAND} --build ${WORK}/headers)

run(${CMAKE_COMMAND} -G Ninja -S ${SOURCE}/tests/install/consumer -B ${WORK}/consumer -DCMAKE_PREFIX_PATH=${WORK}/prefix
  -DCMAKE_BUILD_TYPE=Release)
run(${CMAKE_COMMAND} --build ${WORK}/consumer)
run(${WORK}/consumer/consumer ${SOURCE}/projects/sphere.json)
