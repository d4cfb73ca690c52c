# Each tutorial of docs/tutorials is run as its reader would (run.py): those whose parts are built.
# That of Python, `cortex`, is in python/CMakeLists.txt.
# They draw pictures, so a driver for EGL is needed, as for the other tests of pictures.
find_program(PLEXWAY_TUTORIAL_PYTHON NAMES python3)
mark_as_advanced(PLEXWAY_TUTORIAL_PYTHON)
if(NOT PLEXWAY_TUTORIAL_PYTHON OR NOT TARGET plexway_tool OR NOT TARGET plexway_render
   OR PLEXWAY_SANITIZE)
  return()
endif()

function(plexway_tutorial name)
  add_test(NAME "tutorials/${name}"
    COMMAND "${PLEXWAY_TUTORIAL_PYTHON}" "${PROJECT_SOURCE_DIR}/tests/tutorials/run.py"
      "${PROJECT_SOURCE_DIR}/docs/tutorials/${name}.md" --tool "$<TARGET_FILE:plexway_tool>" ${ARGN})
  set_tests_properties("tutorials/${name}" PROPERTIES LABELS tool TIMEOUT 600)
endfunction()

plexway_tutorial(first-distance)
plexway_tutorial(solid)
if(TARGET plexway_flann)
  plexway_tutorial(cloud)
endif()
if(PLEXWAY_INSTALL)
  plexway_tutorial(mixed-cpp --prefix "${consumer_prefix}")
  set_tests_properties("tutorials/mixed-cpp" PROPERTIES FIXTURES_REQUIRED plexway_installed)
endif()
