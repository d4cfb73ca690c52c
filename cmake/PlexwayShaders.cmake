# Shaders become part of the library when it is built: sets OUT to a C++ source with all of them,
# made anew when one changes, or a text that one includes.
function(plexway_embed_shaders out)
  file(GLOB shaders CONFIGURE_DEPENDS RELATIVE "${PROJECT_SOURCE_DIR}/shaders"
    "${PROJECT_SOURCE_DIR}/shaders/*.comp")
  file(GLOB texts CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/shaders/*"
    "${PROJECT_SOURCE_DIR}/include/plexway/*/*.inl")
  set(source "${CMAKE_CURRENT_BINARY_DIR}/shader_texts.cpp")
  set(script "${PROJECT_SOURCE_DIR}/cmake/ShaderText.cmake")
  list(JOIN shaders "," names)
  add_custom_command(OUTPUT "${source}"
    COMMAND "${CMAKE_COMMAND}" "-DROOT=${PROJECT_SOURCE_DIR}" "-DOUT=${source}"
      "-DSHADERS=${names}" -P "${script}"
    DEPENDS ${texts} "${script}" COMMENT "Embedding shaders" VERBATIM)
  set(${out} "${source}" PARENT_SCOPE)
endfunction()
