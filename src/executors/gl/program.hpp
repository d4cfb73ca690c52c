#pragma once

#include <GL/glcorearb.h>
#include <cstddef>
#include <string>

namespace plexway::detail::gl {

// The OpenGL functions we call: exactly these, found through EGL, since what libGL exports differs
// from vendor to vendor.
#define PLEXWAY_GL_FUNCTIONS(F)                       \
  F(ATTACHSHADER, AttachShader)                       \
  F(BINDBUFFER, BindBuffer)                           \
  F(BINDBUFFERBASE, BindBufferBase)                   \
  F(BUFFERDATA, BufferData)                           \
  F(BUFFERSUBDATA, BufferSubData)                     \
  F(CLEARBUFFERDATA, ClearBufferData)                 \
  F(CLEARBUFFERSUBDATA, ClearBufferSubData)           \
  F(CLIENTWAITSYNC, ClientWaitSync)                   \
  F(COMPILESHADER, CompileShader)                     \
  F(COPYBUFFERSUBDATA, CopyBufferSubData)             \
  F(CREATEPROGRAM, CreateProgram)                     \
  F(CREATESHADER, CreateShader)                       \
  F(DELETEBUFFERS, DeleteBuffers)                     \
  F(DELETEPROGRAM, DeleteProgram)                     \
  F(DELETESHADER, DeleteShader)                       \
  F(DELETESYNC, DeleteSync)                           \
  F(DISPATCHCOMPUTE, DispatchCompute)                 \
  F(DISPATCHCOMPUTEINDIRECT, DispatchComputeIndirect) \
  F(FENCESYNC, FenceSync)                             \
  F(FINISH, Finish)                                   \
  F(FLUSH, Flush)                                     \
  F(GENBUFFERS, GenBuffers)                           \
  F(GETBUFFERSUBDATA, GetBufferSubData)               \
  F(GETERROR, GetError)                               \
  F(GETINTEGER64V, GetInteger64v)                     \
  F(GETINTEGERI_V, GetIntegeri_v)                     \
  F(GETINTEGERV, GetIntegerv)                         \
  F(GETPROGRAMINFOLOG, GetProgramInfoLog)             \
  F(GETPROGRAMIV, GetProgramiv)                       \
  F(GETSHADERINFOLOG, GetShaderInfoLog)               \
  F(GETSHADERIV, GetShaderiv)                         \
  F(GETSTRING, GetString)                             \
  F(GETUNIFORMLOCATION, GetUniformLocation)           \
  F(LINKPROGRAM, LinkProgram)                         \
  F(MEMORYBARRIER, MemoryBarrier)                     \
  F(PROGRAMUNIFORM1F, ProgramUniform1f)               \
  F(PROGRAMUNIFORM1UI, ProgramUniform1ui)             \
  F(SHADERSOURCE, ShaderSource)                       \
  F(USEPROGRAM, UseProgram)

// In 4.4 and later, or by ARB_buffer_storage; null where missing.
#define PLEXWAY_GL_OPTIONAL_FUNCTIONS(F) \
  F(BUFFERSTORAGE, BufferStorage)        \
  F(MAPBUFFERRANGE, MapBufferRange)

struct Functions {
#define PLEXWAY_GL_DECLARE(upper, name) PFNGL##upper##PROC name = nullptr;
  PLEXWAY_GL_FUNCTIONS(PLEXWAY_GL_DECLARE)
  PLEXWAY_GL_OPTIONAL_FUNCTIONS(PLEXWAY_GL_DECLARE)
#undef PLEXWAY_GL_DECLARE
};

/// A shader as it was embedded when this was built.
struct ShaderText {
  const char* name;   ///< its file in shaders/
  const char* files;  ///< the files it was put together from, in the order of `#line`, by `;`
  const char* text;
};

extern const ShaderText shader_texts[];
extern const std::size_t shader_text_count;

/// A compute program from an embedded shader, with `defines` (whole lines) after its #version.
/// Throws Error with the compiler's message, where files have their names: `saddle_step.inl:12:
/// ...`.
GLuint compile(const Functions& gl, const std::string& shader, const std::string& defines);

/// The same from any text put together from `files` (see ShaderText::files), for tests.
GLuint compile_text(const Functions& gl, const std::string& text, const std::string& files,
                    const std::string& defines);

}  // namespace plexway::detail::gl
