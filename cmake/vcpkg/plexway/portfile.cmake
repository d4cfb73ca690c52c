# The library alone (core, io, apps) by vcpkg, out of this checkout:
#   vcpkg install plexway --overlay-ports=cmake/vcpkg
# What takes more libraries (TetGen, PCL, OpenVDB, LZ4, Draco, ...) is left out; so is the tool.
get_filename_component(SOURCE_PATH "${CURRENT_PORT_DIR}/../../.." ABSOLUTE)

set(without "")
foreach(part TETGEN BOOST_GRAPH FLANN PCL OPENVDB HDF5 MPI GL RENDER PYTHON REFERENCE)
  list(APPEND without "-DPLEXWAY_WITH_${part}=OFF")
endforeach()

vcpkg_cmake_configure(
  SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS
    -DPLEXWAY_BUILD_TOOL=OFF
    -DPLEXWAY_BUILD_TESTS=OFF
    -DPLEXWAY_BUILD_BENCH=OFF
    -DPLEXWAY_BUILD_EXAMPLES=OFF
    -DPLEXWAY_INSTALL=ON
    ${without})
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/plexway)
vcpkg_fixup_pkgconfig()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
