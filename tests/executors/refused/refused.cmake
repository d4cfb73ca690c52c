# What the types alone rule out does not compile, and the compiler says why in the table's sentence
# (include/plexway/support.hpp). One run of the compiler a case:
#   cmake -DCXX=... -DINCLUDES=a|b -DSOURCE=refused.cpp -DCASE=name -DSENTENCE=... -P refused.cmake
string(REPLACE "|" ";-I" includes "-I${INCLUDES}")
execute_process(COMMAND "${CXX}" -std=c++20 -fsyntax-only ${includes} "-DPLEXWAY_${CASE}" "${SOURCE}"
  RESULT_VARIABLE result ERROR_VARIABLE errors OUTPUT_VARIABLE errors)
if(CASE STREQUAL "FITS")
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "what goes together does not compile:\n${errors}")
  endif()
  return()
endif()
string(FIND "${errors}" "${SENTENCE}" at)
if(result EQUAL 0 OR at EQUAL -1)
  message(FATAL_ERROR "expected an error that says '${SENTENCE}', got ${result}:\n${errors}")
endif()
