# Installs each component with its headers and its own export file, so that find_package can hand
# out just the ones asked for and name the one that is missing.
include(CMakePackageConfigHelpers)

# plexway_pkg_config(NAME depends): a file plexway-NAME.pc for who builds without CMake. What a static
# library links is told with it, as CMake's files tell it.
function(plexway_pkg_config name depends)
  set(of_Threads::Threads -pthread)
  set(of_OpenMP::OpenMP_CXX -fopenmp)
  set(of_pugixml::pugixml -lpugixml)
  set(of_ZLIB::ZLIB -lz)
  set(of_LibLZMA::LibLZMA -llzma)
  set(of_PNG::PNG -lpng)
  get_property(of_MPI::MPI_CXX GLOBAL PROPERTY PLEXWAY_MPI_LIBRARIES)
  set(links "")
  get_target_property(linked plexway_${name} INTERFACE_LINK_LIBRARIES)
  foreach(item IN LISTS linked)
    string(REGEX REPLACE "^\\$<LINK_ONLY:(.*)>$" "\\1" item "${item}")
    if(item STREQUAL "" OR item MATCHES "^plexway::|^\\$<")
      continue()
    elseif(item MATCHES "::")
      if(NOT DEFINED of_${item})
        message(FATAL_ERROR "plexway-${name}.pc: which library is ${item}?")
      endif()
      list(APPEND links ${of_${item}})
    elseif(IS_ABSOLUTE "${item}" OR item MATCHES "^-")
      list(APPEND links "${item}")
    else()
      list(APPEND links "-l${item}")
    endif()
  endforeach()
  get_target_property(options plexway_${name} INTERFACE_LINK_OPTIONS)
  if(options MATCHES "gc-sections")
    list(APPEND links -Wl,--gc-sections)
  endif()
  list(REMOVE_DUPLICATES links)
  list(JOIN links " " links)
  list(TRANSFORM depends PREPEND "plexway-")
  list(JOIN depends ", " requires)
  set(file "${PROJECT_BINARY_DIR}/pkgconfig/plexway-${name}.pc")
  file(WRITE "${file}" "prefix=\${pcfiledir}/${up_to_prefix}
libdir=\${prefix}/${CMAKE_INSTALL_LIBDIR}
includedir=\${prefix}/${CMAKE_INSTALL_INCLUDEDIR}

Name: plexway-${name}
Description: ${PROJECT_DESCRIPTION}
Version: ${PROJECT_VERSION}
Requires: ${requires}
Libs: -L\${libdir} -lplexway_${name} ${links}
Cflags: -I\${includedir}
")
  install(FILES "${file}" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig" COMPONENT dev)
endfunction()
file(RELATIVE_PATH up_to_prefix "/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/")

set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/plexway")
get_property(components GLOBAL PROPERTY PLEXWAY_COMPONENTS)
set(plexway_component_depends "")

foreach(component IN LISTS components)
  get_property(depends GLOBAL PROPERTY PLEXWAY_DEPENDS_${component})
  get_property(header_dirs GLOBAL PROPERTY PLEXWAY_HEADERS_${component})
  get_property(packages GLOBAL PROPERTY PLEXWAY_PACKAGES_${component})
  string(APPEND plexway_component_depends "set(plexway_${component}_depends ${depends})\n"
    "set(plexway_${component}_packages ${packages})\n")
  install(TARGETS plexway_${component} EXPORT plexway-${component}
    LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT dev
    ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT dev
    RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT dev)
  plexway_pkg_config(${component} "${depends}")
  install(EXPORT plexway-${component} NAMESPACE plexway::
    FILE plexway-${component}.cmake DESTINATION "${package_dir}" COMPONENT dev)
  foreach(dir IN LISTS header_dirs)
    install(DIRECTORY "${dir}/plexway" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT dev)
  endforeach()
endforeach()

# What the tool is installed with is made of its own table of options.
if(TARGET plexway_tool)
  install(TARGETS plexway_tool RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT tool)
  set(pages "${PROJECT_BINARY_DIR}/pages")
  set(made "")
  foreach(page man:plexway.1 bash:plexway zsh:_plexway fish:plexway.fish)
    string(REGEX MATCH "^(.*):(.*)$" matched "${page}")
    set(kind "${CMAKE_MATCH_1}")
    set(file "${pages}/${kind}/${CMAKE_MATCH_2}")
    file(MAKE_DIRECTORY "${pages}/${kind}")
    add_custom_command(OUTPUT "${file}" COMMAND plexway_tool --help-page ${kind} > "${file}"
      DEPENDS plexway_tool COMMENT "Writing ${CMAKE_MATCH_2}" VERBATIM)
    list(APPEND made "${file}")
  endforeach()
  add_custom_target(plexway_pages ALL DEPENDS ${made})
  install(FILES "${pages}/man/plexway.1" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1" COMPONENT tool)
  install(FILES "${pages}/bash/plexway"
    DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions" COMPONENT tool)
  install(FILES "${pages}/zsh/_plexway"
    DESTINATION "${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions" COMPONENT tool)
  install(FILES "${pages}/fish/plexway.fish"
    DESTINATION "${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d" COMPONENT tool)
  install(FILES "${PROJECT_SOURCE_DIR}/README.md" "${PROJECT_SOURCE_DIR}/CHANGELOG.md" "${PROJECT_SOURCE_DIR}/docs/reference/cli.md"
      "${PROJECT_SOURCE_DIR}/docs/reference/options.md"
      "${PROJECT_SOURCE_DIR}/docs/reference/formats.md"
    DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/plexway" COMPONENT tool)
endif()
if(TARGET plexway_mpi_tool)
  install(TARGETS plexway_mpi_tool RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT mpi)
  configure_file("${PROJECT_SOURCE_DIR}/src/tool_mpi/plexway-mpi.1.in"
    "${PROJECT_BINARY_DIR}/plexway-mpi.1" @ONLY)
  install(FILES "${PROJECT_BINARY_DIR}/plexway-mpi.1"
    DESTINATION "${CMAKE_INSTALL_MANDIR}/man1" COMPONENT mpi)
endif()
foreach(part pcl openvdb tetgen hdf5)
  if(TARGET plexway_${part}_module)
    install(TARGETS plexway_${part}_module
      LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}/plexway" COMPONENT ${part})
  endif()
  if(TARGET plexway_${part}_helper)
    install(TARGETS plexway_${part}_helper
      RUNTIME DESTINATION "${CMAKE_INSTALL_LIBDIR}/plexway" COMPONENT ${part})
  endif()
endforeach()

configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/plexwayConfig.cmake.in"
  "${PROJECT_BINARY_DIR}/plexwayConfig.cmake" INSTALL_DESTINATION "${package_dir}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/plexwayConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)
install(FILES
  "${PROJECT_BINARY_DIR}/plexwayConfig.cmake"
  "${PROJECT_BINARY_DIR}/plexwayConfigVersion.cmake"
  DESTINATION "${package_dir}" COMPONENT dev)
include(PlexwayPackage)
