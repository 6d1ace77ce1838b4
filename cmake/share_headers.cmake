# share_headers(<name> [EXECUTABLES] [NOTHING_TO_OPTIMISE] [WITH <header> <library>] TARGETS <target>...): what nearly every
# source of the targets includes is read once, which saves a third of their time to compile. All of them get the same
# libraries and options, else GCC does not take the headers. Targets that do not exist are left out. JSON is not among what
# all share: its literals instantiate the parser in each unit, which takes longer than all other headers together.
function(share_headers name)
  cmake_parse_arguments(arg "EXECUTABLES;NOTHING_TO_OPTIMISE" "" "WITH;TARGETS" ${ARGN})
  set(header)
  set(library)
  if(arg_WITH)
    list(GET arg_WITH 0 header)
    list(GET arg_WITH 1 library)
  endif()
  file(CONFIGURE OUTPUT ${name}.cc CONTENT "int main() {}\n")
  if(arg_EXECUTABLES)  # compiled for other places in memory than libraries
    add_executable(${name} ${CMAKE_CURRENT_BINARY_DIR}/${name}.cc)
  else()
    add_library(${name} OBJECT ${CMAKE_CURRENT_BINARY_DIR}/${name}.cc)
  endif()
  target_precompile_headers(${name} PRIVATE ${header} ${CMAKE_SOURCE_DIR}/src/numeric/compiled_products.h <fmt/format.h>
                            <algorithm> <cmath> <filesystem> <fstream> <functional> <map> <numbers> <optional> <random>
                            <span> <sstream> <string> <variant> <vector>)
  foreach(target ${name} ${arg_TARGETS})
    if(NOT TARGET ${target})
      continue()
    endif()
    if(NOT target STREQUAL name)
      target_precompile_headers(${target} REUSE_FROM ${name})
      if(NOT target STREQUAL rheocyte_numeric)
        target_link_libraries(${target} PRIVATE rheocyte_numeric)
      endif()
    endif()
    target_link_libraries(${target} PRIVATE rheocyte_flags ${library} fmt::fmt nlohmann_json::nlohmann_json Eigen3::Eigen)
    # GCC 12 sees an overlap in "text" + std::string (GCC bug 105651), and reads behind texts that are not done.
    target_compile_options(${target} PRIVATE "$<$<CXX_COMPILER_ID:GNU>:-Wno-restrict;-Wno-stringop-overread>")
    set_target_properties(${target} PROPERTIES NOTHING_TO_OPTIMISE "${arg_NOTHING_TO_OPTIMISE}")
  endforeach()
endfunction()
