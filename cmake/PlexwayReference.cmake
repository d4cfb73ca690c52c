# The reference of the library's interface by Doxygen: target plexway_reference, pages in
# BUILD/reference. A public symbol without its docstring is an error, so a new header is either
# documented or named below. PLEXWAY_WITH_REFERENCE is AUTO, ON or OFF.
include(PlexwayProvider)

# Headers that no user includes, since they are how propagation is done: public headers need those of
# the first three groups, for members of domains and workspaces, and none of the last. A test of the
# house holds us to it.
set(implementation
  # Floor 0: arithmetic, in one text for C++ and GLSL.
  kernel/hinge.hpp
  kernel/lanes.hpp
  # What domains are made of inside: records, their numbers, and what is found out about them.
  complex/box_tree.hpp
  complex/identity.hpp
  complex/rows.hpp
  complex/simplex_flat.hpp
  complex/simplex_record.hpp
  complex/tet_record.hpp
  complex/triangle_record.hpp
  # What a workspace is made of: labels, and room for them.
  propagate/front.hpp
  propagate/label_storage.hpp
  propagate/piece_memory.hpp
  propagate/plain_label.hpp
  propagate/plain_solid_label.hpp
  propagate/room.hpp
  propagate/saddle_label.hpp
  propagate/simplex_label.hpp
  propagate/solid_label.hpp
  propagate/visit_marks.hpp
  propagate/window_memory.hpp
  # The rules, step by step.
  complex/elimination.hpp
  propagate/endless.hpp
  propagate/plain_rule.hpp
  propagate/plain_solid_rule.hpp
  propagate/probe.hpp
  propagate/saddle_offers.hpp
  propagate/saddle_poses.hpp
  propagate/saddle_refraction.hpp
  propagate/saddle_rule.hpp
  propagate/saddle_step.hpp
  propagate/saddle_step_lanes.hpp
  propagate/simplex_rule.hpp
  propagate/simplex_string.hpp
  propagate/simplex_string_rule.hpp
  propagate/simplex_taut.hpp
  propagate/solid_clear_space.hpp
  propagate/solid_paths.hpp
  propagate/solid_rule.hpp
  propagate/solid_sight.hpp
  propagate/wavefront.hpp
  propagate/wire_step.hpp)

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

list(TRANSFORM implementation PREPEND "${PROJECT_SOURCE_DIR}/include/plexway/")
file(GLOB provider_headers "${PROJECT_SOURCE_DIR}/complexes/*/include")

set(DOXYGEN_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}")
set(DOXYGEN_HTML_OUTPUT reference)
set(DOXYGEN_FILE_PATTERNS "*.hpp")
set(DOXYGEN_EXCLUDE ${implementation})
# What implements, types that headers only declare, macros that headers take back.
set(DOXYGEN_EXCLUDE_SYMBOLS "plexway::detail" "plexway::*::detail" "boost"
  "plexway::JoinedPieces" "plexway::Solved" "plexway::openvdb::Bricks"
  PLEXWAY_NAME PLEXWAY_CASE)
set(DOXYGEN_STRIP_FROM_PATH
  "${PROJECT_SOURCE_DIR}/include" "${PROJECT_BINARY_DIR}/include" ${provider_headers})
set(DOXYGEN_STRIP_FROM_INC_PATH ${DOXYGEN_STRIP_FROM_PATH})
set(DOXYGEN_SOURCE_BROWSER YES)  # which header has it
set(DOXYGEN_USE_MDFILE_AS_MAINPAGE "${PROJECT_SOURCE_DIR}/docs/reference.md")
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
  "${PROJECT_SOURCE_DIR}/docs/reference.md"
  "${PROJECT_SOURCE_DIR}/include/plexway"
  "${PROJECT_BINARY_DIR}/include/plexway"
  ${provider_headers}
  WORKING_DIRECTORY "${PROJECT_BINARY_DIR}"
  COMMENT "API reference in reference/index.html")
set(PLEXWAY_DOXYFILE "${CMAKE_CURRENT_BINARY_DIR}/Doxyfile.plexway_reference")
