# Resources become strings inside libraries: programs need no file at run time.
# palpa_embed(VARIABLE RESOURCE [VARIABLE RESOURCE …] TEMPLATE.cpp.in): makes TEMPLATE.cpp in the build folder, where
# @VARIABLE@ is the text of resources/RESOURCE.
function(palpa_embed)
  set(pairs ${ARGV})
  list(POP_BACK pairs template)
  while(pairs)
    list(POP_FRONT pairs variable resource)
    set(file ${PROJECT_SOURCE_DIR}/resources/${resource})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
    file(READ ${file} ${variable})
  endwhile()
  cmake_path(GET template STEM name)
  configure_file(${template} ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp @ONLY)
endfunction()
