# Installs each component with its headers and its own export file, so that find_package can hand
# out just the ones asked for and name the one that is missing.
include(CMakePackageConfigHelpers)

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
    LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}"
    ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}"
    RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
  install(EXPORT plexway-${component} NAMESPACE plexway::
    FILE plexway-${component}.cmake DESTINATION "${package_dir}")
  foreach(dir IN LISTS header_dirs)
    install(DIRECTORY "${dir}/plexway" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
  endforeach()
endforeach()

if(TARGET plexway_tool)
  install(TARGETS plexway_tool RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
endif()
foreach(module plexway_pcl_module plexway_openvdb_module)
  if(TARGET ${module})
    install(TARGETS ${module} LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}/plexway")
  endif()
endforeach()
foreach(helper plexway_tetgen_helper plexway_openvdb_helper)
  if(TARGET ${helper})
    install(TARGETS ${helper} RUNTIME DESTINATION "${CMAKE_INSTALL_LIBDIR}/plexway")
  endif()
endforeach()

configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/plexwayConfig.cmake.in"
  "${PROJECT_BINARY_DIR}/plexwayConfig.cmake" INSTALL_DESTINATION "${package_dir}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/plexwayConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)
install(FILES
  "${PROJECT_BINARY_DIR}/plexwayConfig.cmake"
  "${PROJECT_BINARY_DIR}/plexwayConfigVersion.cmake"
  DESTINATION "${package_dir}")
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DOCDIR}")
