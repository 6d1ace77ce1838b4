# discover_suites(<target> [PREFIX <prefix>] [LABEL <label>] [ONLY <regex>] [EXCEPT <regex>]): one test of ctest for each
# suite of a program of GoogleTest, so that what its tests share is made once. The suites are listed when the program has
# been built; ONLY and EXCEPT choose them by their names. The target check-<name of the program without _test> builds the
# program and runs its suites but the slow ones, as many at a time as there are processors.
set(list_suites ${CMAKE_CURRENT_LIST_DIR}/list_suites.cmake)
function(discover_suites target)
  cmake_parse_arguments(arg "" "PREFIX;LABEL;ONLY;EXCEPT" "" ${ARGN})
  set(tests ${CMAKE_CURRENT_BINARY_DIR}/${target}${arg_LABEL}_suites.cmake)
  string(REGEX REPLACE "_test$" "" room ${target})
  add_custom_command(TARGET ${target} POST_BUILD BYPRODUCTS ${tests}
                     COMMAND ${CMAKE_COMMAND} -D PROGRAM=$<TARGET_FILE:${target}> -D "PREFIX=${arg_PREFIX}"
                             -D "LABEL=${arg_LABEL}" -D "ONLY=${arg_ONLY}" -D "EXCEPT=${arg_EXCEPT}" -D ROOM=${room}
                             -D FOLDER=${CMAKE_CURRENT_BINARY_DIR} -D TESTS=${tests} -P ${list_suites}
                     VERBATIM)
  file(CONFIGURE OUTPUT ${tests}.in CONTENT [[
if(EXISTS "@tests@")
  include("@tests@")
else()
  add_test(@target@_is_not_built @target@_is_not_built)
endif()
]] @ONLY)
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${tests}.in)
  if(NOT TARGET check-${room})
    include(ProcessorCount)
    ProcessorCount(processors)
    add_custom_target(check-${room} COMMAND ${CMAKE_CTEST_COMMAND} --parallel ${processors} --output-on-failure
                                            --label-regex "^of ${room}$" --label-exclude slow
                      WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR} VERBATIM USES_TERMINAL)
    add_dependencies(check-${room} ${target})
  endif()
endfunction()
