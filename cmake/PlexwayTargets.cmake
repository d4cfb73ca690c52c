# How every plexway target is made, so that flags, include paths and install rules agree.

# Flags of all our code. They stay PRIVATE: a consumer keeps its own.
#   -fno-math-errno    sqrt compiles to one instruction, without a branch that sets errno
#   -ffp-contract=off  no fused multiply-add: the kernel gives the same bits as its GLSL twin
function(plexway_compile_options target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
  if(MSVC)
    target_compile_options(${target} PRIVATE /W4 /permissive- /fp:precise
      $<$<BOOL:${PLEXWAY_WERROR}>:/WX>)
    return()
  endif()
  target_compile_options(${target} PRIVATE
    -fno-math-errno -ffp-contract=off -Wno-psabi
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion
    $<$<BOOL:${PLEXWAY_WERROR}>:-Werror>
    $<$<CONFIG:Release>:-O3>
    $<$<BOOL:${PLEXWAY_NATIVE}>:-march=native>)
endfunction()

# Compiles the sources of a target together, so many at a time: what headers and templates cost is
# paid once a batch. Names in anonymous namespaces are therefore unique within a target.
function(plexway_compile_together target files)
  set_target_properties(${target} PROPERTIES
    UNITY_BUILD ${PLEXWAY_UNITY} UNITY_BUILD_BATCH_SIZE ${files})
  # A local name may be that of another file's anonymous namespace; and g++ takes each file for a
  # header, which may not name what is in one.
  if(PLEXWAY_UNITY AND NOT MSVC)
    target_compile_options(${target} PRIVATE -Wno-shadow
      $<$<CXX_COMPILER_ID:GNU>:-Wshadow=local -Wno-subobject-linkage>)
  endif()
endfunction()

# plexway_add_component(NAME SOURCES ... HEADERS_FROM dir... DEPENDS component... BATCH n)
# BATCH is how many of the sources are compiled at a time (1 without it).
# A library plexway_NAME, also known as plexway::NAME, installed as the package component NAME.
function(plexway_add_component name)
  cmake_parse_arguments(arg "" "BATCH" "SOURCES;HEADERS_FROM;DEPENDS" ${ARGN})
  set(target plexway_${name})
  add_library(${target} ${arg_SOURCES})
  add_library(plexway::${name} ALIAS ${target})
  plexway_compile_options(${target})
  if(arg_BATCH)
    plexway_compile_together(${target} ${arg_BATCH})
  endif()
  set_target_properties(${target} PROPERTIES
    EXPORT_NAME ${name}
    POSITION_INDEPENDENT_CODE ON
    VERSION ${PROJECT_VERSION}
    SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
    WINDOWS_EXPORT_ALL_SYMBOLS ON)
  target_include_directories(${target} PRIVATE "${PROJECT_SOURCE_DIR}/src" "${PROJECT_SOURCE_DIR}")
  foreach(dir IN LISTS arg_HEADERS_FROM)
    target_include_directories(${target} PUBLIC "$<BUILD_INTERFACE:${dir}>")
  endforeach()
  target_include_directories(${target} INTERFACE "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>")
  foreach(component IN LISTS arg_DEPENDS)
    target_link_libraries(${target} PUBLIC plexway::${component})
  endforeach()
  # Who links a static library gets its objects whole, and many sources are in one; what nothing
  # refers to in them goes again, function by function.
  if(NOT BUILD_SHARED_LIBS AND CMAKE_SYSTEM_NAME STREQUAL "Linux")
    target_compile_options(${target} PRIVATE -ffunction-sections -fdata-sections)
    target_link_options(${target} INTERFACE LINKER:--gc-sections)
  endif()
  set_property(GLOBAL APPEND PROPERTY PLEXWAY_COMPONENTS ${name})
  set_property(GLOBAL PROPERTY PLEXWAY_DEPENDS_${name} "${arg_DEPENDS}")
  set_property(GLOBAL PROPERTY PLEXWAY_HEADERS_${name} "${arg_HEADERS_FROM}")
endfunction()

# plexway_use_package(component package target message): links the target into the component, hidden
# from its users, when find_package finds it, and defines PLEXWAY_<component>_<package> in capitals;
# otherwise says the message.
macro(plexway_use_package component package target message)
  find_package(${package} QUIET)
  if(TARGET ${target})
    string(TOUPPER "PLEXWAY_${component}_${package}" definition)
    target_link_libraries(plexway_${component} PRIVATE ${target})
    target_compile_definitions(plexway_${component} PRIVATE ${definition}=1)
    if(NOT BUILD_SHARED_LIBS)  # who links a static library links what it needs, too
      set_property(GLOBAL APPEND PROPERTY PLEXWAY_PACKAGES_${component} ${package})
    endif()
  else()
    message(STATUS "plexway: ${message}")
  endif()
endmacro()

# plexway_require(NAME [version] PACKAGE <Debian package> FOR <option>): find_package that fails with
# what to install. A macro, because some packages set variables that their user needs.
macro(plexway_require name)
  cmake_parse_arguments(require "" "PACKAGE;FOR" "" ${ARGN})
  find_package(${name} ${require_UNPARSED_ARGUMENTS} QUIET)
  if(NOT ${name}_FOUND)
    message(FATAL_ERROR "plexway: ${require_FOR} needs ${name}: install ${require_PACKAGE} "
      "(.ci/packages installs all) or set ${require_FOR}=OFF")
  endif()
endmacro()

# The command-line tool: target plexway_tool, file name plexway, and plexway_mpi_tool, plexway-mpi,
# the same among ranks. They take every component built.
function(plexway_add_tool)
  if(NOT PLEXWAY_BUILD_TOOL)
    return()
  endif()
  file(GLOB sources CONFIGURE_DEPENDS
    "${PROJECT_SOURCE_DIR}/src/tool/*.cpp" "${PROJECT_SOURCE_DIR}/src/tool/*/*.cpp")
  list(REMOVE_ITEM sources "${PROJECT_SOURCE_DIR}/src/tool/main.cpp")
  plexway_require(CLI11 PACKAGE libcli11-dev FOR PLEXWAY_BUILD_TOOL)
  plexway_require(nlohmann_json PACKAGE nlohmann-json3-dev FOR PLEXWAY_BUILD_TOOL)
  add_library(plexway_cli OBJECT ${sources})
  plexway_compile_options(plexway_cli)
  plexway_compile_together(plexway_cli 20)
  if(NOT MSVC)  # nothing there is hot
    target_compile_options(plexway_cli PRIVATE $<$<CONFIG:Release>:-O1>)
  endif()
  target_include_directories(plexway_cli PRIVATE "${PROJECT_SOURCE_DIR}/src" "${PROJECT_SOURCE_DIR}")
  target_link_libraries(plexway_cli PRIVATE CLI11::CLI11 nlohmann_json::nlohmann_json)
  plexway_link_all(plexway_cli EXCEPT pcl openvdb hdf5 mpi)
  foreach(module pcl openvdb hdf5)
    if(TARGET plexway_${module}_module)
      string(TOUPPER ${module} upper)
      target_compile_definitions(plexway_cli PRIVATE PLEXWAY_HAS_${upper}=1)
    endif()
  endforeach()

  plexway_add_tool_program(plexway_tool plexway "${PROJECT_SOURCE_DIR}/src/tool/main.cpp")
  if(TARGET plexway_mpi)
    plexway_add_tool_program(plexway_mpi_tool plexway-mpi
      "${PROJECT_SOURCE_DIR}/src/tool_mpi/main.cpp")
    target_link_libraries(plexway_mpi_tool PRIVATE plexway::mpi)
  endif()
endfunction()

function(plexway_add_tool_program target name main)
  add_executable(${target} "${main}" $<TARGET_OBJECTS:plexway_cli>)
  set_target_properties(${target} PROPERTIES OUTPUT_NAME ${name})
  plexway_compile_options(${target})
  target_include_directories(${target} PRIVATE "${PROJECT_SOURCE_DIR}/src")
  plexway_link_all(${target} EXCEPT pcl openvdb hdf5 mpi)
  foreach(module pcl openvdb hdf5)
    if(TARGET plexway_${module}_module)
      add_dependencies(${target} plexway_${module}_module)
    endif()
  endforeach()
  set_target_properties(${target} PROPERTIES
    BUILD_RPATH "${PROJECT_BINARY_DIR}/${CMAKE_INSTALL_LIBDIR}/plexway"
    INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}/plexway")
endfunction()

# The component of domains of any kind. It takes every provider that this build has, but for those
# whose libraries take longer to load than all that is done with most files: what needs them is in
# modules, src/shape/modules/NAME/, that are loaded when they are needed.
function(plexway_add_any)
  set(depends core io apps)
  foreach(provider gl flann tetgen boost_graph)
    if(TARGET plexway_${provider})
      list(APPEND depends ${provider})
    endif()
  endforeach()
  set(folder "${PROJECT_SOURCE_DIR}/src/shape")
  file(GLOB sources CONFIGURE_DEPENDS "${folder}/*.cpp" "${folder}/arguments/*.cpp"
    "${folder}/errors/*.cpp" "${folder}/files/*.cpp" "${folder}/modules/*.cpp"
    "${folder}/pairs/*.cpp" "${folder}/warnings/*.cpp")
  # Reports and policies are JSON; only the tool asks for them, and does not do without.
  find_package(nlohmann_json QUIET)
  if(TARGET nlohmann_json::nlohmann_json)
    file(GLOB reports CONFIGURE_DEPENDS "${folder}/info/*.cpp" "${folder}/tuning/*.cpp")
    list(APPEND sources ${reports})
  endif()
  plexway_add_component(any SOURCES ${sources} DEPENDS ${depends} BATCH 18)
  if(TARGET nlohmann_json::nlohmann_json)
    target_include_directories(plexway_any SYSTEM PRIVATE
      $<TARGET_PROPERTY:nlohmann_json::nlohmann_json,INTERFACE_INCLUDE_DIRECTORIES>)
  endif()
  foreach(provider IN LISTS depends)
    string(TOUPPER ${provider} upper)
    target_compile_definitions(plexway_any PRIVATE PLEXWAY_HAS_${upper}=1)
  endforeach()
  get_target_property(core_has plexway_core COMPILE_DEFINITIONS)
  if(core_has MATCHES "PLEXWAY_CORE_OPENMP|PLEXWAY_TEAM_OF_THREADS")
    target_compile_definitions(plexway_any PRIVATE PLEXWAY_HAS_TEAMS=1)
  endif()
  if(UNIX)
    plexway_add_module(pcl)
    plexway_add_module(openvdb)
    plexway_add_module(hdf5 FILE src/shape/modules/module.cpp)
  endif()
endfunction()

# FILE is the only one of the component that has to know what the module is called; without it all
# do.
function(plexway_add_module name)
  cmake_parse_arguments(arg "" "FILE" "" ${ARGN})
  if(NOT TARGET plexway_${name})
    return()
  endif()
  string(TOUPPER ${name} upper)
  set(module plexway_${name}_module)
  set(folder "${CMAKE_INSTALL_LIBDIR}/plexway")
  add_library(${module} MODULE "${PROJECT_SOURCE_DIR}/src/shape/modules/${name}/module.cpp")
  plexway_compile_options(${module})
  set_target_properties(${module} PROPERTIES PREFIX "" OUTPUT_NAME plexway_${name}
    LIBRARY_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/${folder}")
  target_include_directories(${module} PRIVATE "${PROJECT_SOURCE_DIR}/src" "${PROJECT_SOURCE_DIR}")
  target_link_libraries(${module} PRIVATE plexway::${name} plexway::io)
  set(definitions "PLEXWAY_${upper}_MODULE=\"plexway_${name}${CMAKE_SHARED_MODULE_SUFFIX}\"")
  if(arg_FILE)
    set_source_files_properties("${PROJECT_SOURCE_DIR}/${arg_FILE}" PROPERTIES
      COMPILE_DEFINITIONS "${definitions}")
  else()
    target_compile_definitions(plexway_any PRIVATE PLEXWAY_HAS_${upper}=1 "${definitions}")
  endif()
  target_compile_definitions(plexway_any PRIVATE PLEXWAY_MODULE_FOLDER="${folder}")
  target_link_libraries(plexway_any PRIVATE ${CMAKE_DL_LIBS})
endfunction()

# Links every component that this build has, but those named behind EXCEPT; PLEXWAY_HAS_<COMPONENT>
# says so to the code. Other people's libraries that nothing calls are not loaded.
function(plexway_link_all target)
  cmake_parse_arguments(arg "" "" "EXCEPT" ${ARGN})
  get_property(components GLOBAL PROPERTY PLEXWAY_COMPONENTS)
  list(REMOVE_ITEM components ${arg_EXCEPT})
  if(UNIX AND NOT APPLE)
    target_link_options(${target} PRIVATE LINKER:--as-needed)
  endif()
  foreach(component IN LISTS components)
    target_link_libraries(${target} PRIVATE plexway::${component})
    string(TOUPPER ${component} upper)
    target_compile_definitions(${target} PRIVATE PLEXWAY_HAS_${upper}=1)
  endforeach()
endfunction()
