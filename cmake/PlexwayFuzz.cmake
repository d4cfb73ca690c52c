# tests/fuzz/fuzz_<format>.cpp holds one libFuzzer entry point; tests/fuzz/corpus/<format> its seeds.
# With PLEXWAY_FUZZ each becomes a fuzzer, otherwise a program that replays the corpus as a test.
set(fuzz_dir "${PROJECT_SOURCE_DIR}/tests/fuzz")
file(GLOB fuzzers CONFIGURE_DEPENDS "${fuzz_dir}/fuzz_*.cpp")
set(fuzz_programs "")
foreach(source IN LISTS fuzzers)
  get_filename_component(target "${source}" NAME_WE)
  string(REPLACE "fuzz_" "" format "${target}")
  if(PLEXWAY_FUZZ)
    add_executable(${target} "${source}")
    target_link_options(${target} PRIVATE -fsanitize=fuzzer)
  else()
    add_executable(${target} "${source}" "${fuzz_dir}/replay_main.cpp")
    add_test(NAME "fuzz/corpus ${format}" COMMAND ${target} "${fuzz_dir}/corpus/${format}")
    set_tests_properties("fuzz/corpus ${format}" PROPERTIES LABELS fuzz TIMEOUT 600)
  endif()
  if(format STREQUAL "rows")  # the tool's own readers
    find_package(nlohmann_json QUIET)
    file(GLOB_RECURSE readers CONFIGURE_DEPENDS
      "${PROJECT_SOURCE_DIR}/src/cli/number_rows.cpp" "${PROJECT_SOURCE_DIR}/src/cli/table_file.cpp"
      "${PROJECT_SOURCE_DIR}/src/cli/truth_file.cpp" "${PROJECT_SOURCE_DIR}/src/cli/report.cpp")
    target_sources(${target} PRIVATE ${readers})
    target_link_libraries(${target} PRIVATE nlohmann_json::nlohmann_json)
  endif()
  plexway_compile_options(${target})
  target_include_directories(${target} PRIVATE "${fuzz_dir}" "${PROJECT_SOURCE_DIR}/src")
  plexway_link_all(${target})
  list(APPEND fuzz_programs ${target})
endforeach()
