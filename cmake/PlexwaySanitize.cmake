# Sanitizers act on the whole build: instrumented and plain code must not be mixed.
if(PLEXWAY_FUZZ AND NOT CMAKE_CXX_COMPILER_ID MATCHES Clang)
  message(FATAL_ERROR "plexway: PLEXWAY_FUZZ needs clang: configure with --preset fuzz")
endif()

set(plexway_sanitize_flags "")
if(PLEXWAY_SANITIZE)
  list(JOIN PLEXWAY_SANITIZE "," names)
  list(APPEND plexway_sanitize_flags
    -fsanitize=${names} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  if(names MATCHES "address" AND names MATCHES "undefined")
    # AddressSanitizer finds null and stray pointers too; these checks double the time to compile.
    list(APPEND plexway_sanitize_flags -fno-sanitize=null,alignment,object-size,vptr)
  endif()
endif()
if(PLEXWAY_FUZZ)
  list(APPEND plexway_sanitize_flags -fsanitize=fuzzer-no-link)
endif()
if(plexway_sanitize_flags)
  add_compile_options(${plexway_sanitize_flags})
  add_link_options(${plexway_sanitize_flags})
  add_compile_definitions(_GLIBCXX_ASSERTIONS)
endif()
