# Compiles every shader with glslangValidator.
#   cmake -DROOT=<source tree> -DOUT=<scratch folder> -DGLSLANG=<program> -P glsl_check.cmake
include("${ROOT}/cmake/ShaderText.cmake")
file(MAKE_DIRECTORY "${OUT}")

# Those of pictures as they are.
file(GLOB pictures "${ROOT}/shaders/*.vert" "${ROOT}/shaders/*.frag")
foreach(shader IN LISTS pictures)
  execute_process(COMMAND "${GLSLANG}" "${shader}" RESULT_VARIABLE failed OUTPUT_VARIABLE log
                  ERROR_VARIABLE log)
  if(failed)
    message(FATAL_ERROR "${shader}: not legal GLSL\n${log}")
  endif()
endforeach()

# One shader with some lines of #define after its #version.
function(check_shader name text defines what)
  string(FIND "${text}" "\n" at)
  math(EXPR at "${at} + 1")
  string(SUBSTRING "${text}" 0 ${at} version)
  string(SUBSTRING "${text}" ${at} -1 rest)
  set(file "${OUT}/${what}.comp")
  file(WRITE "${file}" "${version}${defines}#line 2 0\n${rest}")
  execute_process(COMMAND "${GLSLANG}" "${file}" RESULT_VARIABLE failed OUTPUT_VARIABLE log
                  ERROR_VARIABLE log)
  if(failed)
    message(FATAL_ERROR "${what}: not legal GLSL\n${log}")
  endif()
endfunction()

file(GLOB shaders RELATIVE "${ROOT}/shaders" "${ROOT}/shaders/*.comp")
foreach(shader IN LISTS shaders)
  set(files "")
  plexway_expand_shader("${ROOT}" "${shader}" text files)
  string(REPLACE ".comp" "" name "${shader}")
  check_shader("${shader}" "${text}" "" "${name}")
  check_shader("${shader}" "${text}" "#define PLEXWAY_LABELS\n#define PLEXWAY_REVIVE\n#define PLEXWAY_SOLIDS\n"
    "${name}_variant")
endforeach()
