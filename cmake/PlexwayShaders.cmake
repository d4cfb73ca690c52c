# Shaders become part of the library when it is built: sets OUT to a C++ source with those of
# shaders/ that fit the patterns, in the namespace plexway::SPACE and declared in HEADER, made anew
# when one changes, or a text that one includes.
function(plexway_embed_shaders out space header)
  list(TRANSFORM ARGN PREPEND "${PROJECT_SOURCE_DIR}/shaders/" OUTPUT_VARIABLE patterns)
  file(GLOB shaders CONFIGURE_DEPENDS RELATIVE "${PROJECT_SOURCE_DIR}/shaders" ${patterns})
  file(GLOB texts CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/shaders/*"
    "${PROJECT_SOURCE_DIR}/src/kernel/*.inl" "${PROJECT_SOURCE_DIR}/src/labels/*/*.inl")
  string(MAKE_C_IDENTIFIER "${space}" file)
  set(source "${CMAKE_CURRENT_BINARY_DIR}/${file}_shader_texts.cpp")
  set(script "${PROJECT_SOURCE_DIR}/cmake/ShaderText.cmake")
  list(JOIN shaders "," names)
  add_custom_command(OUTPUT "${source}"
    COMMAND "${CMAKE_COMMAND}" "-DROOT=${PROJECT_SOURCE_DIR}" "-DOUT=${source}"
      "-DSHADERS=${names}" "-DSPACE=${space}" "-DHEADER=${header}" -P "${script}"
    DEPENDS ${texts} "${script}" COMMENT "Embedding shaders" VERBATIM)
  set(${out} "${source}" PARENT_SCOPE)
endfunction()
