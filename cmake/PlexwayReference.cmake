# The reference of the library's interface by Doxygen: target plexway_reference, pages in
# BUILD/reference. A public symbol without its docstring is an error; what public headers need and no
# user includes, such as the records that domains are made of, is in folders named detail and left
# out. PLEXWAY_WITH_REFERENCE is AUTO, ON or OFF.
include(PlexwayProvider)

if(NOT PROJECT_IS_TOP_LEVEL)
  set(PLEXWAY_WITH_REFERENCE OFF CACHE STRING "Make the API reference: AUTO, ON or OFF")
endif()
plexway_provider_wanted(reference wanted)
if(NOT wanted)
  return()
endif()
find_package(Doxygen 1.9.4 QUIET)
if(NOT DOXYGEN_FOUND)
  if(NOT PLEXWAY_WITH_REFERENCE STREQUAL "AUTO")
    message(FATAL_ERROR "plexway: PLEXWAY_WITH_REFERENCE=ON but Doxygen 1.9.4 or later was not "
      "found: install doxygen (or set PLEXWAY_WITH_REFERENCE=AUTO)")
  endif()
  message(STATUS "plexway: API reference left out: doxygen is not installed")
  return()
endif()

file(GLOB provider_headers "${PROJECT_SOURCE_DIR}/complexes/*/include")

set(DOXYGEN_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}")
set(DOXYGEN_HTML_OUTPUT reference)
set(DOXYGEN_FILE_PATTERNS "*.hpp")
set(DOXYGEN_EXCLUDE_PATTERNS "*/detail/*")
# What implements, types that headers only declare, macros that headers take back.
set(DOXYGEN_EXCLUDE_SYMBOLS "plexway::detail" "plexway::*::detail" "boost"
  "plexway::openvdb::Bricks"
  PLEXWAY_NAME PLEXWAY_CASE)
set(DOXYGEN_STRIP_FROM_PATH
  "${PROJECT_SOURCE_DIR}/include" "${PROJECT_BINARY_DIR}/include" ${provider_headers})
set(DOXYGEN_STRIP_FROM_INC_PATH ${DOXYGEN_STRIP_FROM_PATH})
set(DOXYGEN_SOURCE_BROWSER YES)  # which header has it
set(DOXYGEN_USE_MDFILE_AS_MAINPAGE "${PROJECT_SOURCE_DIR}/docs/reference/cpp.md")
set(DOXYGEN_MACRO_EXPANSION YES)  # of the list that an enumeration is made of
set(DOXYGEN_EXPAND_ONLY_PREDEF YES)
set(DOXYGEN_EXPAND_AS_DEFINED PLEXWAY_REFUSALS PLEXWAY_NAME)
set(DOXYGEN_JAVADOC_AUTOBRIEF YES)
set(DOXYGEN_DISTRIBUTE_GROUP_DOC YES)  # of ///@{ ... ///@}: one text for all of them
set(DOXYGEN_MAX_INITIALIZER_LINES 60)  # tables that are macros are shown
set(DOXYGEN_SORT_MEMBER_DOCS NO)
set(DOXYGEN_HAVE_DOT NO)
set(DOXYGEN_QUIET YES)
set(DOXYGEN_WARN_IF_UNDOCUMENTED YES)
set(DOXYGEN_WARN_NO_PARAMDOC NO)
set(DOXYGEN_WARN_AS_ERROR FAIL_ON_WARNINGS)
doxygen_add_docs(plexway_reference
  "${PROJECT_SOURCE_DIR}/docs/reference/cpp.md"
  "${PROJECT_SOURCE_DIR}/include/plexway"
  "${PROJECT_BINARY_DIR}/include/plexway"
  ${provider_headers}
  WORKING_DIRECTORY "${PROJECT_BINARY_DIR}"
  COMMENT "API reference in reference/index.html")
set(PLEXWAY_DOXYFILE "${CMAKE_CURRENT_BINARY_DIR}/Doxyfile.plexway_reference")
