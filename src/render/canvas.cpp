#include "render/canvas.hpp"

#include <algorithm>
#include <string>

#include <plexway/error.hpp>

#include "render/device.hpp"

namespace plexway::render {
namespace {

constexpr std::size_t plenty = 3'000'000;  // pixels of a picture: from here on one drawn for each

// A framebuffer with colour, depth and stencil.
class Target {
 public:
  Target(const DrawFunctions& gl, GLsizei width, GLsizei height, GLsizei samples) : gl_(gl) {
    gl.GenFramebuffers(1, &frame_);
    gl.GenRenderbuffers(2, buffers_.data());
    gl.BindFramebuffer(GL_FRAMEBUFFER, frame_);
    constexpr std::array<GLenum, 2> formats = {GL_RGBA8, GL_DEPTH32F_STENCIL8};
    constexpr std::array<GLenum, 2> places = {GL_COLOR_ATTACHMENT0, GL_DEPTH_STENCIL_ATTACHMENT};
    for (std::size_t k = 0; k < 2; ++k) {
      gl.BindRenderbuffer(GL_RENDERBUFFER, buffers_[k]);
      gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, samples, formats[k], width, height);
      gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, places[k], GL_RENDERBUFFER, buffers_[k]);
    }
    if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE ||
        gl.GetError() != GL_NO_ERROR)
      throw NotBuiltError("the OpenGL driver cannot draw a picture of " + std::to_string(width) +
                          " x " + std::to_string(height) + " pixels with " +
                          std::to_string(samples) + " samples each: make it smaller");
  }
  ~Target() {
    gl_.DeleteFramebuffers(1, &frame_);
    gl_.DeleteRenderbuffers(2, buffers_.data());
  }
  Target(const Target&) = delete;
  Target& operator=(const Target&) = delete;

  [[nodiscard]] GLuint name() const { return frame_; }

 private:
  const DrawFunctions& gl_;
  GLuint frame_ = 0;
  std::array<GLuint, 2> buffers_{};
};

const void* offset(std::size_t bytes) { return reinterpret_cast<const void*>(bytes); }

// Triangles on the device.
class Mesh {
 public:
  Mesh(const DrawFunctions& gl, std::span<const Corner> corners, std::span<const Others> others)
      : gl_(gl), corners_(static_cast<GLsizei>(corners.size())) {
    gl.GenVertexArrays(1, &array_);
    gl.BindVertexArray(array_);
    gl.GenBuffers(2, buffers_.data());
    load(0, corners);
    attribute(0, 3, GL_FLOAT, sizeof(Corner), 0);
    attribute(1, 4, GL_SHORT, sizeof(Corner), 12);
    attribute(2, 1, GL_FLOAT, sizeof(Corner), 20);
    attribute(3, 4, GL_UNSIGNED_BYTE, sizeof(Corner), 24);
    if (others.empty()) {
      gl.VertexAttrib2f(4, 1e30f, 1e30f);
      for (const GLuint a : {5u, 6u}) gl.VertexAttrib4f(a, 0, 0, 0, 0);
      return;
    }
    load(1, others);
    attribute(4, 2, GL_FLOAT, sizeof(Others), 0);
    attribute(5, 4, GL_UNSIGNED_BYTE, sizeof(Others), 8);
    attribute(6, 4, GL_UNSIGNED_BYTE, sizeof(Others), 12);
  }
  ~Mesh() {
    gl_.DeleteVertexArrays(1, &array_);
    gl_.DeleteBuffers(2, buffers_.data());
  }
  Mesh(const Mesh&) = delete;
  Mesh& operator=(const Mesh&) = delete;

  void draw() const {
    gl_.BindVertexArray(array_);
    gl_.DrawArrays(GL_TRIANGLES, 0, corners_);
  }

 private:
  template <class Item>
  void load(std::size_t k, std::span<const Item> items) {
    gl_.BindBuffer(GL_ARRAY_BUFFER, buffers_[k]);
    gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(items.size_bytes()), items.data(),
                   GL_STATIC_DRAW);
  }
  void attribute(GLuint place, GLint count, GLenum type, std::size_t stride, std::size_t at) {
    gl_.EnableVertexAttribArray(place);
    gl_.VertexAttribPointer(place, count, type, type == GL_FLOAT ? GL_FALSE : GL_TRUE,
                            static_cast<GLsizei>(stride), offset(at));
  }

  const DrawFunctions& gl_;
  GLuint array_ = 0;
  std::array<GLuint, 2> buffers_{};
  GLsizei corners_;
};

class Painter {
 public:
  Painter(const DrawFunctions& gl, GLuint program, const Style& style, double scale)
      : gl_(gl), program_(program), style_(style), scale_(scale) {
    gl.UseProgram(program);
    const Camera& camera = style.camera;
    gl.UniformMatrix4fv(at("to_clip"), 1, GL_FALSE, camera.to_clip.data());
    std::array<float, 9> axes{};
    std::size_t k = 0;
    for (const Point* axis : {&camera.axes.right, &camera.axes.up, &camera.axes.toward})
      for (const double c : *axis) axes[k++] = static_cast<float>(c);
    gl.UniformMatrix3fv(at("axes"), 1, GL_FALSE, axes.data());
    gl.Uniform4fv(at("eye"), 1, camera.eye.data());
    gl.Uniform2f(at("range"), static_cast<float>(style.low), static_cast<float>(style.high));
    gl.Uniform1f(at("border"), static_cast<float>(0.55 * style.pen * scale));
    std::array<float, 99> colours{};
    for (std::size_t c = 0; c < 33; ++c)
      for (std::size_t j = 0; j < 3; ++j)
        colours[3 * c + j] = static_cast<float>(style.map[(c * 255 + 16) / 32][j]) / 255.0f;
    gl.Uniform3fv(at("colours"), 33, colours.data());
  }

  void draw(const Mesh& mesh, const Batch& batch) const {
    const std::array<float, 4> lines = {static_cast<float>(style_.first_line),
                                        static_cast<float>(style_.line_step),
                                        batch.isolines ? static_cast<float>(style_.lines) : 0.0f,
                                        static_cast<float>(0.5 * style_.pen * scale_)};
    gl_.Uniform4fv(at("isolines"), 1, lines.data());
    gl_.Uniform1i(at("look"), batch.look == Look::cap ? 1 : batch.look == Look::ghost ? 2 : 0);
    mesh.draw();
  }

  /// All in one colour, wider by so many pixels of the picture, and nearer to the camera.
  void draw_tinted(const Mesh& mesh, const std::array<float, 4>& tint, double wider,
                   double nearer) const {
    gl_.Uniform4fv(at("tint"), 1, tint.data());
    gl_.Uniform1f(at("inflate"), static_cast<float>(wider * style_.pen * style_.camera.pixel));
    gl_.Uniform1f(at("pull"), static_cast<float>(nearer));
    mesh.draw();
    gl_.Uniform1f(at("pull"), 0);
    const std::array<float, 4> none{};
    gl_.Uniform4fv(at("tint"), 1, none.data());
    gl_.Uniform1f(at("inflate"), 0);
  }

 private:
  [[nodiscard]] GLint at(const char* name) const { return gl_.GetUniformLocation(program_, name); }

  const DrawFunctions& gl_;
  GLuint program_;
  const Style& style_;
  double scale_;
};

constexpr double clearly_behind = 0.04;  // of the scene's size
constexpr std::array<float, 4> outline_ink = {0.07f, 0.08f, 0.1f, 1};

// What is behind something, once a sample, faintly; it does not count for what is in front.
void draw_behind(const DrawFunctions& gl, const Painter& painter, const Mesh& mesh,
                 const std::array<float, 4>& veil) {
  gl.Enable(GL_STENCIL_TEST);
  gl.StencilFunc(GL_EQUAL, 0, 0xFF);
  gl.StencilOp(GL_KEEP, GL_KEEP, GL_INCR);
  gl.DepthFunc(GL_GREATER);
  gl.DepthMask(GL_FALSE);
  gl.Enable(GL_BLEND);
  gl.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  painter.draw_tinted(mesh, veil, 0, clearly_behind);
  gl.Disable(GL_BLEND);
  gl.DepthMask(GL_TRUE);
  gl.DepthFunc(GL_LEQUAL);
  gl.Disable(GL_STENCIL_TEST);
}

void draw_piece(const DrawFunctions& gl, const Painter& painter, const Batch& batch,
                std::span<const Corner> corners, std::span<const Others> others) {
  const Mesh mesh(gl, corners, others);
  if (batch.look == Look::ghost) {
    gl.Enable(GL_BLEND);
    gl.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    gl.DepthMask(GL_FALSE);
    painter.draw(mesh, batch);
    gl.DepthMask(GL_TRUE);
    gl.Disable(GL_BLEND);
    return;
  }
  if (batch.look == Look::overlay) {
    if (batch.behind.empty())
      draw_behind(gl, painter, mesh, batch.veil);
    else
      draw_behind(gl, painter, Mesh(gl, batch.behind, {}), batch.veil);
    // The outline: the far side of a slightly thicker body.
    gl.Enable(GL_CULL_FACE);
    gl.CullFace(GL_FRONT);
    painter.draw_tinted(mesh, outline_ink, 1.1, 0);
    gl.Disable(GL_CULL_FACE);
  }
  painter.draw(mesh, batch);
}

void draw_all(const DrawFunctions& gl, const Painter& painter, std::span<const Batch> batches) {
  gl.Enable(GL_DEPTH_TEST);
  gl.DepthFunc(GL_LEQUAL);
  for (const Look look : {Look::lit, Look::cap, Look::overlay, Look::ghost})
    for (const Batch& batch : batches) {
      if (batch.look != look || batch.corners.empty()) continue;
      // The device copies what it gets, so of much it gets a piece at a time. An overlay is whole.
      constexpr std::size_t piece = 3 * (std::size_t{1} << 18);
      const std::span<const Corner> corners = batch.corners;
      const std::span<const Others> others = batch.others;
      const std::size_t step = look == Look::overlay ? corners.size() : piece;
      for (std::size_t from = 0; from < corners.size(); from += step) {
        const std::size_t count = std::min(step, corners.size() - from);
        draw_piece(gl, painter, batch, corners.subspan(from, count),
                   others.empty() ? others : others.subspan(from, count));
        if (count < corners.size()) gl.Finish();  // else it keeps them all until the end
      }
    }
}

}  // namespace

Drawn draw(std::span<const Batch> batches, std::size_t width, std::size_t height,
           const Style& style) {
  Device device(style.device);
  const DrawFunctions& gl = device.gl;
  Drawn drawn;
  drawn.scale = width * height < plenty ? 2 : 1;
  drawn.width = width * drawn.scale;
  drawn.height = height * drawn.scale;
  const auto w = static_cast<GLsizei>(drawn.width), h = static_cast<GLsizei>(drawn.height);
  GLint largest = 0;
  gl.GetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest);
  if (w > largest || h > largest)
    throw NotBuiltError("the OpenGL driver draws at most " + std::to_string(largest) + " x " +
                        std::to_string(largest) + " pixels: make the picture smaller");
  const GLuint program = device.program({"render_mesh.vert", "render_mesh.frag"});
  const Target resolved(gl, w, h, 0);
  const Target target(gl, w, h, 4);
  gl.Viewport(0, 0, w, h);
  const float back = style.transparent ? 0 : 1;
  gl.ClearColor(back, back, back, back);
  gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
  draw_all(gl, Painter(gl, program, style, static_cast<double>(drawn.scale)), batches);

  gl.BindFramebuffer(GL_READ_FRAMEBUFFER, target.name());
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved.name());
  for (const GLbitfield what : {GL_COLOR_BUFFER_BIT, GL_DEPTH_BUFFER_BIT})
    gl.BlitFramebuffer(0, 0, w, h, 0, 0, w, h, what, GL_NEAREST);
  gl.BindFramebuffer(GL_READ_FRAMEBUFFER, resolved.name());
  gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
  drawn.colour.resize(drawn.width * drawn.height);
  drawn.depth.resize(drawn.colour.size());
  gl.ReadPixels(0, 0, w, h, GL_RGBA, GL_UNSIGNED_BYTE, drawn.colour.data());
  gl.ReadPixels(0, 0, w, h, GL_DEPTH_COMPONENT, GL_FLOAT, drawn.depth.data());
  if (const GLenum error = gl.GetError(); error != GL_NO_ERROR)
    throw Error("OpenGL error " + std::to_string(error) + " while drawing a picture");
  return drawn;
}

}  // namespace plexway::render
