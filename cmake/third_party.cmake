# Libraries that bring no CMake targets of their own, or targets that we want thinner. All are imported, so their
# headers count as system headers and our warnings do not reach into them.
#
#   rheocyte::toml       toml++: headers only
#   rheocyte::hdf5       HDF5 without MPI
#   rheocyte::zstd       Zstandard
#   rheocyte::qhull      Delaunay triangulation
#   rheocyte::boost_math Boost.Math's distributions: headers only
#   rheocyte::beast      Boost.Beast and Boost.Asio: headers only
#
# and RHEOCYTE_PYTHON_EXECUTABLE, an interpreter that has matplotlib and numpy.

include(CheckCXXSourceCompiles)

# rheocyte_import(<target> [LIBRARY <name>] HEADER <file> [SUFFIXES <folder>...] PACKAGE <Debian package>)
function(rheocyte_import target)
  cmake_parse_arguments(arg "" "LIBRARY;HEADER;PACKAGE" "SUFFIXES" ${ARGN})
  string(TOUPPER "RHEOCYTE_${target}" prefix)
  find_path(${prefix}_INCLUDE_DIR ${arg_HEADER} PATH_SUFFIXES ${arg_SUFFIXES})
  mark_as_advanced(${prefix}_INCLUDE_DIR)
  set(location ${${prefix}_INCLUDE_DIR})
  if(arg_LIBRARY)
    find_library(${prefix}_LIBRARY ${arg_LIBRARY} PATH_SUFFIXES ${arg_SUFFIXES})
    mark_as_advanced(${prefix}_LIBRARY)
    set(location ${${prefix}_LIBRARY})
  endif()
  if(NOT ${prefix}_INCLUDE_DIR OR NOT location)
    message(FATAL_ERROR "${arg_HEADER} or its library was not found. Debian's package is called ${arg_PACKAGE}; "
                        "./quickstart installs it.")
  endif()
  if(arg_LIBRARY)
    add_library(rheocyte::${target} UNKNOWN IMPORTED)
    set_target_properties(rheocyte::${target} PROPERTIES IMPORTED_LOCATION ${location})
  else()
    add_library(rheocyte::${target} INTERFACE IMPORTED)
  endif()
  target_include_directories(rheocyte::${target} INTERFACE ${${prefix}_INCLUDE_DIR})
endfunction()

rheocyte_import(toml HEADER toml++/toml.h PACKAGE libtomlplusplus-dev)
target_compile_definitions(rheocyte::toml INTERFACE TOML_HEADER_ONLY=1)

rheocyte_import(shared_hdf5 LIBRARY hdf5 HEADER hdf5.h SUFFIXES hdf5/serial PACKAGE libhdf5-dev)
# Debian's shared HDF5 loads 25 libraries of the network, a third of what a program takes to start. Programs take the
# static one, where there is one that needs no more than compression (that of HDF5 1.14 needs the network, too); modules
# of Python cannot, because its code is not independent of its place.
find_library(RHEOCYTE_STATIC_HDF5_LIBRARY libhdf5.a PATH_SUFFIXES hdf5/serial)
find_library(RHEOCYTE_SZIP_LIBRARY sz)
find_library(RHEOCYTE_ZLIB_LIBRARY z)
mark_as_advanced(RHEOCYTE_STATIC_HDF5_LIBRARY RHEOCYTE_SZIP_LIBRARY RHEOCYTE_ZLIB_LIBRARY)
set(hdf5_of_programs rheocyte::shared_hdf5)
if(RHEOCYTE_STATIC_HDF5_LIBRARY AND RHEOCYTE_SZIP_LIBRARY AND RHEOCYTE_ZLIB_LIBRARY)
  set(static_hdf5 ${RHEOCYTE_STATIC_HDF5_LIBRARY} ${RHEOCYTE_SZIP_LIBRARY} ${RHEOCYTE_ZLIB_LIBRARY} ${CMAKE_DL_LIBS} m)
  set(CMAKE_REQUIRED_INCLUDES ${RHEOCYTE_SHARED_HDF5_INCLUDE_DIR})
  set(CMAKE_REQUIRED_LIBRARIES ${static_hdf5})
  check_cxx_source_compiles("#include <hdf5.h>\nint main() { return H5open(); }" RHEOCYTE_STATIC_HDF5_LINKS)
  unset(CMAKE_REQUIRED_INCLUDES)
  unset(CMAKE_REQUIRED_LIBRARIES)
  if(RHEOCYTE_STATIC_HDF5_LINKS)
    set(hdf5_of_programs ${static_hdf5})
  endif()
endif()
if(CMAKE_CROSSCOMPILING OR NOT RHEOCYTE_PROCESSES)  # static libraries alone
  target_link_libraries(rheocyte::shared_hdf5 INTERFACE ${RHEOCYTE_ZLIB_LIBRARY} $<$<BOOL:${WIN32}>:shlwapi>)
endif()
set(is_program "$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>")
add_library(rheocyte::hdf5 INTERFACE IMPORTED)
target_include_directories(rheocyte::hdf5 INTERFACE ${RHEOCYTE_SHARED_HDF5_INCLUDE_DIR})
foreach(library ${hdf5_of_programs})
  target_link_libraries(rheocyte::hdf5 INTERFACE $<${is_program}:${library}>)
endforeach()
target_link_libraries(rheocyte::hdf5 INTERFACE $<$<NOT:${is_program}>:rheocyte::shared_hdf5>)
rheocyte_import(zstd LIBRARY zstd HEADER zstd.h PACKAGE libzstd-dev)
rheocyte_import(qhull LIBRARY qhull_r HEADER libqhull_r/libqhull_r.h PACKAGE libqhull-dev)
rheocyte_import(boost_math HEADER boost/math/distributions/students_t.hpp PACKAGE libboost-dev)
# Numbers of double precision stay so on the way: longer ones differ from machine to machine, and WebAssembly has none.
target_compile_definitions(rheocyte::boost_math INTERFACE BOOST_MATH_PROMOTE_DOUBLE_POLICY=false)
if(RHEOCYTE_SOLVER AND RHEOCYTE_PROCESSES)
  rheocyte_import(beast HEADER boost/beast/http.hpp PACKAGE libboost-dev)
  # Without what nobody uses and some compilers take for something else; Boost.System is headers only.
  target_compile_definitions(rheocyte::beast INTERFACE BOOST_ASIO_DISABLE_CO_AWAIT BOOST_ERROR_CODE_HEADER_ONLY)
  if(WIN32)
    target_link_libraries(rheocyte::beast INTERFACE ws2_32 mswsock)
  endif()
endif()

if(WIN32 OR CMAKE_CROSSCOMPILING)  # the user's own, in the PATH
  return()
endif()
# Debian's interpreter first: another python3 that stands earlier in PATH often lacks the packages.
if(NOT RHEOCYTE_PYTHON_EXECUTABLE)
  find_program(RHEOCYTE_PATH_PYTHON python3)
  mark_as_advanced(RHEOCYTE_PATH_PYTHON)
  foreach(candidate IN ITEMS /usr/bin/python3 ${RHEOCYTE_PATH_PYTHON})
    execute_process(COMMAND ${candidate} -c "import matplotlib, numpy" RESULT_VARIABLE failed OUTPUT_QUIET ERROR_QUIET)
    if(failed EQUAL 0)
      set(RHEOCYTE_PYTHON_EXECUTABLE ${candidate} CACHE FILEPATH "Python interpreter with matplotlib and numpy")
      break()
    endif()
  endforeach()
endif()
if(NOT RHEOCYTE_PYTHON_EXECUTABLE)
  message(WARNING "No Python 3 with matplotlib and numpy was found: results will have no pictures. "
                  "Debian's packages are called python3-matplotlib and python3-numpy.")
endif()
