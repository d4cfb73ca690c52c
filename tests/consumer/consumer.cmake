# The consumer project, built both ways. The sanitizers of this build must be those of the consumer,
# which links our libraries; the same holds for the compiler.
set(consumer_dir "${CMAKE_CURRENT_BINARY_DIR}/consumer")
set(consumer_prefix "${consumer_dir}/prefix")
list(JOIN plexway_sanitize_flags " " consumer_flags)
string(REPLACE ";" "$<SEMICOLON>" consumer_launcher "${CMAKE_CXX_COMPILER_LAUNCHER}")
set(consumer_common
  --build-generator "${CMAKE_GENERATOR}"
  --build-target consumer
  --build-options
    "-DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}"
    "-DCMAKE_CXX_COMPILER_LAUNCHER=${consumer_launcher}"
    "-DCMAKE_CXX_FLAGS=${CMAKE_CXX_FLAGS} ${consumer_flags}")

add_test(NAME "consumer/install"
  COMMAND "${CMAKE_COMMAND}" --install "${PROJECT_BINARY_DIR}" --config $<CONFIG>
    --prefix "${consumer_prefix}")
set_tests_properties("consumer/install" PROPERTIES FIXTURES_SETUP plexway_installed LABELS consumer)

# plexway_consumer_test(NAME options...) configures and builds in a fresh folder, then runs it.
# Long tests begin first, so that no core waits for the last of them.
function(plexway_consumer_test name)
  add_test(NAME "consumer/${name}"
    COMMAND "${CMAKE_CTEST_COMMAND}"
      --build-and-test "${CMAKE_CURRENT_SOURCE_DIR}/consumer" "${consumer_dir}/${name}"
      ${consumer_common} ${ARGN}
      --test-command consumer)
  set_tests_properties("consumer/${name}" PROPERTIES LABELS consumer TIMEOUT 1500 COST 1000)
endfunction()

plexway_consumer_test(find_package
  "-DCMAKE_BUILD_TYPE=$<CONFIG>"
  "-DCMAKE_PREFIX_PATH=${consumer_prefix}" "-DPLEXWAY_WANTED=core,io" -DPLEXWAY_WANTED_VERSION=0.1)
set_tests_properties("consumer/find_package" PROPERTIES
  FIXTURES_REQUIRED plexway_installed FIXTURES_SETUP plexway_consumer)
# What it does not use is not in it: 0.77 MB, where 5.5 MB of core and io come with whole objects.
if(CMAKE_SYSTEM_NAME STREQUAL "Linux" AND CMAKE_BUILD_TYPE STREQUAL "Release"
    AND NOT BUILD_SHARED_LIBS AND NOT PLEXWAY_SANITIZE)
  add_test(NAME "consumer/size" COMMAND find "${consumer_dir}/find_package" -name consumer -type f
    -size -1000k)
  set_tests_properties("consumer/size" PROPERTIES LABELS consumer
    FIXTURES_REQUIRED plexway_consumer PASS_REGULAR_EXPRESSION "find_package/consumer")
endif()

# What a component depends on comes with it; and all that there are.
if(TARGET plexway_render)
  plexway_consumer_test(one_component
    "-DCMAKE_PREFIX_PATH=${consumer_prefix}" "-DPLEXWAY_WANTED=render")
  set_tests_properties("consumer/one_component" PROPERTIES FIXTURES_REQUIRED plexway_installed)
endif()
plexway_consumer_test(every_component "-DCMAKE_PREFIX_PATH=${consumer_prefix}" -DPLEXWAY_WANTED=)
set_tests_properties("consumer/every_component" PROPERTIES FIXTURES_REQUIRED plexway_installed)

plexway_consumer_test(missing_component
  "-DCMAKE_PREFIX_PATH=${consumer_prefix}" "-DPLEXWAY_WANTED=core,teapots")
set_tests_properties("consumer/missing_component" PROPERTIES
  FIXTURES_REQUIRED plexway_installed
  PASS_REGULAR_EXPRESSION "no component 'teapots', only: core, io")
# As where a distribution has components in packages of their own: the build has none of their files.
plexway_consumer_test(missing_package "-Dplexway_DIR=${PROJECT_BINARY_DIR}" "-DPLEXWAY_WANTED=core")
set_tests_properties("consumer/missing_package" PROPERTIES
  PASS_REGULAR_EXPRESSION "component 'core' of this plexway is in a package that is not installed")

# All of core and io are compiled once more here, so without optimisation: a third of the time.
plexway_consumer_test(add_subdirectory "-DPLEXWAY_SUBDIRECTORY=${PROJECT_SOURCE_DIR}"
  -DCMAKE_BUILD_TYPE=Debug "-DCMAKE_CXX_FLAGS_DEBUG=-O0"
  -DPLEXWAY_WITH_BOOST_GRAPH=OFF -DPLEXWAY_WITH_TETGEN=OFF -DPLEXWAY_WITH_FLANN=OFF
  -DPLEXWAY_WITH_PCL=OFF -DPLEXWAY_WITH_OPENVDB=OFF -DPLEXWAY_WITH_GL=OFF)
