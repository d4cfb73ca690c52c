#pragma once

#include <GL/glcorearb.h>
#include <initializer_list>

#include "executors/gl/context.hpp"
#include "executors/gl/program.hpp"

/// The OpenGL functions that drawing calls, found through EGL as those of the executor are.
#define PLEXWAY_RENDER_FUNCTIONS(F)                                 \
  F(ATTACHSHADER, AttachShader)                                     \
  F(BINDBUFFER, BindBuffer)                                         \
  F(BINDFRAMEBUFFER, BindFramebuffer)                               \
  F(BINDRENDERBUFFER, BindRenderbuffer)                             \
  F(BINDVERTEXARRAY, BindVertexArray)                               \
  F(BLENDFUNCSEPARATE, BlendFuncSeparate)                           \
  F(BLITFRAMEBUFFER, BlitFramebuffer)                               \
  F(BUFFERDATA, BufferData)                                         \
  F(CHECKFRAMEBUFFERSTATUS, CheckFramebufferStatus)                 \
  F(CLEAR, Clear)                                                   \
  F(CLEARCOLOR, ClearColor)                                         \
  F(COMPILESHADER, CompileShader)                                   \
  F(CREATEPROGRAM, CreateProgram)                                   \
  F(CREATESHADER, CreateShader)                                     \
  F(CULLFACE, CullFace)                                             \
  F(DELETEBUFFERS, DeleteBuffers)                                   \
  F(DELETEFRAMEBUFFERS, DeleteFramebuffers)                         \
  F(DELETEPROGRAM, DeleteProgram)                                   \
  F(DELETERENDERBUFFERS, DeleteRenderbuffers)                       \
  F(DELETESHADER, DeleteShader)                                     \
  F(DELETEVERTEXARRAYS, DeleteVertexArrays)                         \
  F(DEPTHFUNC, DepthFunc)                                           \
  F(DEPTHMASK, DepthMask)                                           \
  F(DISABLE, Disable)                                               \
  F(DISABLEVERTEXATTRIBARRAY, DisableVertexAttribArray)             \
  F(DRAWARRAYS, DrawArrays)                                         \
  F(ENABLE, Enable)                                                 \
  F(ENABLEVERTEXATTRIBARRAY, EnableVertexAttribArray)               \
  F(FINISH, Finish)                                                 \
  F(FRAMEBUFFERRENDERBUFFER, FramebufferRenderbuffer)               \
  F(GENBUFFERS, GenBuffers)                                         \
  F(GENFRAMEBUFFERS, GenFramebuffers)                               \
  F(GENRENDERBUFFERS, GenRenderbuffers)                             \
  F(GENVERTEXARRAYS, GenVertexArrays)                               \
  F(GETERROR, GetError)                                             \
  F(GETINTEGERV, GetIntegerv)                                       \
  F(GETPROGRAMINFOLOG, GetProgramInfoLog)                           \
  F(GETPROGRAMIV, GetProgramiv)                                     \
  F(GETSHADERINFOLOG, GetShaderInfoLog)                             \
  F(GETSHADERIV, GetShaderiv)                                       \
  F(GETUNIFORMLOCATION, GetUniformLocation)                         \
  F(LINKPROGRAM, LinkProgram)                                       \
  F(PIXELSTOREI, PixelStorei)                                       \
  F(READPIXELS, ReadPixels)                                         \
  F(RENDERBUFFERSTORAGEMULTISAMPLE, RenderbufferStorageMultisample) \
  F(SHADERSOURCE, ShaderSource)                                     \
  F(STENCILFUNC, StencilFunc)                                       \
  F(STENCILOP, StencilOp)                                           \
  F(UNIFORM1F, Uniform1f)                                           \
  F(UNIFORM1I, Uniform1i)                                           \
  F(UNIFORM2F, Uniform2f)                                           \
  F(UNIFORM3FV, Uniform3fv)                                         \
  F(UNIFORM4FV, Uniform4fv)                                         \
  F(UNIFORMMATRIX3FV, UniformMatrix3fv)                             \
  F(UNIFORMMATRIX4FV, UniformMatrix4fv)                             \
  F(USEPROGRAM, UseProgram)                                         \
  F(VERTEXATTRIB2F, VertexAttrib2f)                                 \
  F(VERTEXATTRIB4F, VertexAttrib4f)                                 \
  F(VERTEXATTRIBPOINTER, VertexAttribPointer)                       \
  F(VIEWPORT, Viewport)

namespace plexway::render {

using detail::gl::ShaderText;
extern const ShaderText shader_texts[];
extern const std::size_t shader_text_count;

struct DrawFunctions {
#define PLEXWAY_RENDER_DECLARE(upper, name) PFNGL##upper##PROC name = nullptr;
  PLEXWAY_RENDER_FUNCTIONS(PLEXWAY_RENDER_DECLARE)
#undef PLEXWAY_RENDER_DECLARE
};

/// A context to draw with, current in this thread while it lives. Drawings wait for each other.
class Device {
 public:
  /// `number`: as in PictureOptions::device. Throws NotBuiltError saying what is missing, and
  /// UsageError where there is no such device.
  explicit Device(int number);
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  DrawFunctions gl;

  /// A program of the embedded shaders; deleted with this.
  GLuint program(std::initializer_list<const char*> shaders);

 private:
  detail::gl::NativeContext native_;
  detail::gl::MakeCurrent current_;
  GLuint program_ = 0;
};

}  // namespace plexway::render
