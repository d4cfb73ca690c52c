# Compiles shaders/kernel_check.comp with glslangValidator for every K, in float and double.
#   cmake -DROOT=<source tree> -DOUT=<scratch folder> -DGLSLANG=<program> -P glsl_check.cmake
file(READ "${ROOT}/shaders/kernel_check.comp" shader)
file(READ "${ROOT}/include/plexway/kernel/hinge_kernel.inl" text)
string(REPLACE "//@include plexway/kernel/hinge_kernel.inl" "${text}" shader "${shader}")
file(MAKE_DIRECTORY "${OUT}")

foreach(k RANGE 3)
  foreach(type FLOAT DOUBLE)
    set(defines "#version 430\n#define PLEXWAY_K ${k}\n#define PLEXWAY_${type}\n")
    string(REPLACE "#version 430\n" "${defines}" source "${shader}")
    set(file "${OUT}/kernel_check_${k}_${type}.comp")
    file(WRITE "${file}" "${source}")
    execute_process(COMMAND "${GLSLANG}" "${file}" RESULT_VARIABLE failed OUTPUT_VARIABLE log
                    ERROR_VARIABLE log)
    if(failed)
      message(FATAL_ERROR "K = ${k}, ${type}: not legal GLSL\n${log}")
    endif()
  endforeach()
endforeach()
