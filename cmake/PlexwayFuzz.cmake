# tests/fuzz/fuzz_<format>.cpp holds one fuzzed function, fuzz_readers.cpp those of the readers,
# tests/fuzz/corpus/<format> has their seeds. One program, test_fuzz, replays the seeds as tests; with
# PLEXWAY_FUZZ each function is a program of its own besides, by libFuzzer.
set(fuzz_dir "${PROJECT_SOURCE_DIR}/tests/fuzz")
file(GLOB fuzzers CONFIGURE_DEPENDS RELATIVE "${fuzz_dir}" "${fuzz_dir}/fuzz_*.cpp")
list(TRANSFORM fuzzers REPLACE "^fuzz_(.*)\\.cpp$" "\\1")
list(REMOVE_ITEM fuzzers readers)
file(STRINGS "${fuzz_dir}/fuzz_readers.cpp" fuzz_readers REGEX "^PLEXWAY_FUZZER")
list(TRANSFORM fuzz_readers REPLACE "^PLEXWAY_FUZZER\\(([a-z_]+)\\).*" "\\1")
if(NOT TARGET plexway_cli)
  list(REMOVE_ITEM fuzzers arguments)
endif()
if(NOT UNIX)
  list(REMOVE_ITEM fuzzers vdb)
endif()

# Adds the function of a format to a program, with what it reads by.
function(plexway_add_fuzzer target format)
  if(NOT format IN_LIST fuzz_readers)
    target_sources(${target} PRIVATE "${fuzz_dir}/fuzz_${format}.cpp")
  elseif(NOT TARGET plexway_fuzz_readers)
    add_library(plexway_fuzz_readers OBJECT "${fuzz_dir}/fuzz_readers.cpp")
    plexway_compile_options(plexway_fuzz_readers)
    target_include_directories(plexway_fuzz_readers PRIVATE "${fuzz_dir}" "${PROJECT_SOURCE_DIR}/src"
      "${PROJECT_SOURCE_DIR}")
    target_link_libraries(plexway_fuzz_readers PUBLIC plexway::core plexway::io)
  endif()
  if(format IN_LIST fuzz_readers)
    target_link_libraries(${target} PRIVATE plexway_fuzz_readers)
  endif()
  target_include_directories(${target} PRIVATE "${fuzz_dir}" "${PROJECT_SOURCE_DIR}/src"
    "${PROJECT_SOURCE_DIR}")
  target_link_libraries(${target} PRIVATE plexway::core plexway::io)
  if(format STREQUAL "arguments")
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:plexway_cli>)
    plexway_link_all(${target} EXCEPT pcl openvdb hdf5 mpi)
  elseif(format STREQUAL "rows")  # readers that no component has by itself
    if(TARGET plexway_cli)
      target_link_libraries(${target} PRIVATE plexway::any)
    else()
      find_package(nlohmann_json QUIET)
      target_sources(${target} PRIVATE "${PROJECT_SOURCE_DIR}/src/shape/tuning/policy_file.cpp"
        "${PROJECT_SOURCE_DIR}/src/shape/errors/truth_file.cpp"
        "${PROJECT_SOURCE_DIR}/src/shape/info/report.cpp" "${PROJECT_SOURCE_DIR}/src/shape/words.cpp")
      target_link_libraries(${target} PRIVATE nlohmann_json::nlohmann_json)
    endif()
  elseif(format STREQUAL "pcd")  # what is looked at before PCL; PCL's own faults are not searched
    set(folder "${PROJECT_SOURCE_DIR}/complexes/cloud/pcl")
    target_include_directories(${target} PRIVATE "${folder}/src")
    if(TARGET plexway_pcl AND target STREQUAL "test_fuzz")
      target_link_libraries(${target} PRIVATE plexway::pcl)
      target_compile_definitions(${target} PRIVATE PLEXWAY_HAS_PCL=1)
    else()
      target_sources(${target} PRIVATE "${folder}/src/pcd_check.cpp")
    endif()
  elseif(format STREQUAL "vdb")  # without OpenVDB, what listens to the helper
    set(folder "${PROJECT_SOURCE_DIR}/complexes/solid/openvdb")
    target_include_directories(${target} PRIVATE "${folder}/include")
    if(TARGET plexway_openvdb)
      target_link_libraries(${target} PRIVATE plexway::openvdb)
    else()
      target_sources(${target} PRIVATE "${folder}/src/read_level_set.cpp"
        "${folder}/src/level_set.cpp")
      target_compile_definitions(${target} PRIVATE
        PLEXWAY_HELPER_SUBFOLDER="plexway" PLEXWAY_HELPER_FOLDER="plexway")
      target_link_libraries(${target} PRIVATE ${CMAKE_DL_LIBS})
    endif()
  elseif(format STREQUAL "poly" AND TARGET plexway_tetgen)
    target_link_libraries(${target} PRIVATE plexway::tetgen)
    target_compile_definitions(${target} PRIVATE PLEXWAY_HAS_TETGEN=1)
  endif()
endfunction()

if(PLEXWAY_BUILD_TESTS)
  add_executable(test_fuzz "${fuzz_dir}/replay_main.cpp")
  plexway_test_options(test_fuzz)
  foreach(format IN LISTS fuzzers fuzz_readers)
    plexway_add_fuzzer(test_fuzz ${format})
    add_test(NAME "fuzz/corpus ${format}"
      COMMAND test_fuzz ${format} "${fuzz_dir}/corpus/${format}")
    set_tests_properties("fuzz/corpus ${format}" PROPERTIES LABELS fuzz TIMEOUT 600)
  endforeach()
  # PCL's vectors are not instrumented, and ours are.
  set_tests_properties("fuzz/corpus pcd" PROPERTIES
    ENVIRONMENT "ASAN_OPTIONS=detect_container_overflow=0")
endif()

if(PLEXWAY_FUZZ)
  set(fuzz_programs ${fuzzers} ${fuzz_readers})
  list(TRANSFORM fuzz_programs PREPEND fuzz_)
  foreach(format IN LISTS fuzzers fuzz_readers)
    add_executable(fuzz_${format} "${fuzz_dir}/replay_main.cpp")
    plexway_compile_options(fuzz_${format})
    target_compile_definitions(fuzz_${format} PRIVATE PLEXWAY_LIBFUZZER="${format}")
    target_link_options(fuzz_${format} PRIVATE -fsanitize=fuzzer)
    plexway_add_fuzzer(fuzz_${format} ${format})
  endforeach()
  add_custom_target(plexway_fuzzers DEPENDS ${fuzz_programs})
endif()
