# scumble_sources(FILES...): adds a room's sources to the library; files named *_test.cpp go to the test program.
function(scumble_sources)
  foreach(file ${ARGN})
    if(file MATCHES "_test\\.cpp$")
      if(SCUMBLE_TESTS)
        target_sources(scumble_tests PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/${file})
      endif()
    else()
      target_sources(scumble PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/${file})
    endif()
  endforeach()
endfunction()

# scumble_arithmetic_tests(FILES...): tests of arithmetic on numbers of their own, which touch no memory that anybody gives.
# Builds with sanitizers leave them out: compiling them costs more there than they could find.
function(scumble_arithmetic_tests)
  if(NOT SCUMBLE_SANITIZE)
    scumble_sources(${ARGN})
  endif()
endfunction()
