# A provider (layer 4) builds a complex with the help of another library and hides that library's
# headers in its .cpp files. It is an optional component, ruled by PLEXWAY_WITH_<NAME>:
# ON fails when the library is missing, AUTO leaves the provider out and says so, OFF never looks.

# Sets OUT when the provider NAME exists in this tree and is not switched off.
function(plexway_provider_wanted name out)
  string(TOUPPER "PLEXWAY_WITH_${name}" option)
  set(${option} AUTO CACHE STRING "Build the provider ${name}: AUTO, ON or OFF")
  set_property(CACHE ${option} PROPERTY STRINGS AUTO ON OFF)
  set_property(GLOBAL APPEND PROPERTY PLEXWAY_PROVIDERS ${name})
  set(wanted ON)
  string(TOUPPER "${${option}}" value)
  if(value MATCHES "^(OFF|NO|FALSE|0|)$")
    set(wanted OFF)
  endif()
  set(${out} ${wanted} PARENT_SCOPE)
endfunction()

# plexway_add_provider(NAME IN <folder> FOUND <bool> PACKAGE <Debian package> [INCLUDES dir...]
#   [LIBRARIES lib...] [BATCH n])
# Header-only needs go to INCLUDES, which users of the installed package never see.
function(plexway_add_provider name)
  cmake_parse_arguments(arg "" "IN;FOUND;PACKAGE;BATCH" "INCLUDES;LIBRARIES" ${ARGN})
  string(TOUPPER "PLEXWAY_WITH_${name}" option)
  if(NOT arg_FOUND)
    if("${${option}}" STREQUAL "AUTO")
      message(STATUS "plexway: provider ${name} left out: ${arg_PACKAGE} is not installed")
      return()
    endif()
    message(FATAL_ERROR "plexway: ${option}=ON but its library was not found: "
      "install ${arg_PACKAGE} (or set ${option}=AUTO)")
  endif()
  set(dir "${PROJECT_SOURCE_DIR}/${arg_IN}/${name}")
  set_property(GLOBAL PROPERTY PLEXWAY_FOLDER_${name} "${dir}")
  file(GLOB sources CONFIGURE_DEPENDS "${dir}/src/*.cpp")
  plexway_add_component(${name} SOURCES ${sources} HEADERS_FROM "${dir}/include" DEPENDS core
    BATCH ${arg_BATCH})
  target_include_directories(plexway_${name} PRIVATE "${dir}/src")
  target_include_directories(plexway_${name} SYSTEM PRIVATE ${arg_INCLUDES})
  target_link_libraries(plexway_${name} PRIVATE ${arg_LIBRARIES})
  message(STATUS "plexway: provider ${name}")
endfunction()

# plexway_add_helper(NAME [INCLUDES dir...] [LIBRARIES lib...])
# A program plexway-NAME that the provider NAME runs as a child process, made of NAME/helper/; it lies
# in a folder of its own, so that no one finds it on a PATH. See helper_process.hpp.
function(plexway_add_helper name)
  cmake_parse_arguments(arg "" "" "INCLUDES;LIBRARIES" ${ARGN})
  if(NOT TARGET plexway_${name})
    return()
  endif()
  set(target plexway_${name}_helper)
  get_property(dir GLOBAL PROPERTY PLEXWAY_FOLDER_${name})
  set(folder "${CMAKE_INSTALL_LIBDIR}/plexway")
  file(GLOB sources CONFIGURE_DEPENDS "${dir}/helper/*.cpp")
  add_executable(${target} ${sources})
  plexway_compile_options(${target})
  set_target_properties(${target} PROPERTIES OUTPUT_NAME plexway-${name}
    RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/${folder}")
  target_include_directories(${target} PRIVATE
    "${PROJECT_SOURCE_DIR}/include" "${PROJECT_BINARY_DIR}/include"
    "${PROJECT_SOURCE_DIR}" "${dir}/include" "${dir}/src")
  target_include_directories(${target} SYSTEM PRIVATE ${arg_INCLUDES})
  target_link_libraries(${target} PRIVATE ${arg_LIBRARIES})
  add_dependencies(plexway_${name} ${target})
  target_link_libraries(plexway_${name} PRIVATE ${CMAKE_DL_LIBS})
  if(PLEXWAY_INSTALL)
    set(place "${CMAKE_INSTALL_FULL_LIBDIR}/plexway")
  else()
    set(place "${PROJECT_BINARY_DIR}/${folder}")
  endif()
  target_compile_definitions(plexway_${name} PRIVATE
    PLEXWAY_HELPER_SUBFOLDER="${folder}" PLEXWAY_HELPER_FOLDER="${place}")
endfunction()

# An option for a provider that does not exist must not pass unnoticed.
function(plexway_check_provider_options)
  get_property(known GLOBAL PROPERTY PLEXWAY_PROVIDERS)
  get_cmake_property(cached CACHE_VARIABLES)
  foreach(variable IN LISTS cached)
    if(variable MATCHES "^PLEXWAY_WITH_(.+)$" AND ${variable})
      string(TOLOWER ${CMAKE_MATCH_1} name)
      if(NOT name IN_LIST known)
        message(FATAL_ERROR "plexway: ${variable}=${${variable}}, but there is no provider "
          "${name}; there are: ${known}")
      endif()
    endif()
  endforeach()
endfunction()
