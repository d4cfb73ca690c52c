# Sanitizers act on the whole build: instrumented and plain code must not be mixed.
if(PLEXWAY_FUZZ AND NOT CMAKE_CXX_COMPILER_ID MATCHES Clang)
  message(FATAL_ERROR "plexway: PLEXWAY_FUZZ needs clang: configure with --preset fuzz")
endif()

set(plexway_sanitize_flags "")
if(PLEXWAY_SANITIZE)
  list(JOIN PLEXWAY_SANITIZE "," names)
  list(APPEND plexway_sanitize_flags
    -fsanitize=${names} -fno-sanitize-recover=all -fno-omit-frame-pointer)
endif()
if(PLEXWAY_FUZZ)
  list(APPEND plexway_sanitize_flags -fsanitize=fuzzer-no-link)
endif()
if(plexway_sanitize_flags)
  add_compile_options(${plexway_sanitize_flags})
  add_link_options(${plexway_sanitize_flags})
  add_compile_definitions(_GLIBCXX_ASSERTIONS)
endif()
