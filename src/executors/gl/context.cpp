#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <algorithm>
#include <array>
#include <cstdio>
#include <string_view>
#include <vector>

#include <plexway/error.hpp>

#include "executors/gl/context.hpp"

namespace plexway::detail::gl {
namespace {

bool lists(const char* extensions, std::string_view name) {
  if (extensions == nullptr) return false;
  std::string_view rest = extensions;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(' '), rest.size());
    if (rest.substr(0, end) == name) return true;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return false;
}

template <class Function>
Function find(const char* name) {
  return reinterpret_cast<Function>(eglGetProcAddress(name));
}

std::string egl_error() {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "EGL error 0x%x", static_cast<unsigned>(eglGetError()));
  return text.data();
}

Display open(EGLenum platform, void* native, bool software) {
  Display d;
  d.software = software;
  const auto get_display = find<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  d.display = get_display(platform, native, nullptr);
  EGLint major = 0, minor = 0;
  if (d.display == EGL_NO_DISPLAY || eglInitialize(d.display, &major, &minor) != EGL_TRUE) {
    d.problem = "EGL cannot open it (" + egl_error() + ")";
    return d;
  }
  const char* const extensions = eglQueryString(d.display, EGL_EXTENSIONS);
  if (!lists(extensions, "EGL_KHR_surfaceless_context"))
    d.problem = "EGL makes no context without a surface there (EGL_KHR_surfaceless_context)";
  else if (!lists(extensions, "EGL_KHR_no_config_context") &&
           !lists(extensions, "EGL_MESA_configless_context"))
    d.problem = "EGL makes no context without a configuration there (EGL_KHR_no_config_context)";
  return d;
}

std::vector<Display> find_displays() {
  std::vector<Display> found;
  const char* const client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (!lists(client, "EGL_EXT_platform_base"))
    throw NotBuiltError(
        "the EGL of this machine has no EGL_EXT_platform_base: install libegl1 and a driver, such "
        "as libgl1-mesa-dri");
  const auto query = find<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
  const auto query_string = find<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
  if (lists(client, "EGL_EXT_platform_device") && query != nullptr && query_string != nullptr) {
    EGLint count = 0;
    query(0, nullptr, &count);
    std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
    if (count > 0 && query(count, devices.data(), &count) == EGL_TRUE)
      for (const EGLDeviceEXT device : devices)
        found.push_back(
            open(EGL_PLATFORM_DEVICE_EXT, device,
                 lists(query_string(device, EGL_EXTENSIONS), "EGL_MESA_device_software")));
  }
  if (found.empty() && lists(client, "EGL_MESA_platform_surfaceless"))
    found.push_back(open(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, true));
  if (found.empty())
    throw NotBuiltError(
        "EGL knows no device on this machine: install a driver, such as libgl1-mesa-dri");
  return found;
}

std::string text_of(const Functions& gl, GLenum name) {
  const GLubyte* text = gl.GetString(name);
  return text == nullptr ? "" : reinterpret_cast<const char*>(text);
}

// A device that works, preferably one that is not the processor itself.
int choose() {
  std::string problems;
  for (const bool software : {false, true})
    for (std::size_t n = 0; n < displays().size(); ++n) {
      if (displays()[n].software != software) continue;
      try {
        const NativeContext works(displays()[n]);
        return static_cast<int>(n);
      } catch (const NotBuiltError& error) {
        problems += "; device " + std::to_string(n) + ": " + error.what();
      }
    }
  throw NotBuiltError("no device of this machine can run compute shaders" + problems);
}

const Display& display_of(int number) {
  const auto count = displays().size();
  if (number < 0 || static_cast<std::size_t>(number) >= count)
    throw UsageError("there is no GL device " + std::to_string(number) + ", only 0 to " +
                     std::to_string(count - 1));
  return displays()[static_cast<std::size_t>(number)];
}

}  // namespace

const std::vector<Display>& displays() {
  static const std::vector<Display> all = find_displays();
  return all;
}

NativeContext::NativeContext(const Display& display)
    : display_(display.display), context_(EGL_NO_CONTEXT) {
  if (!display.problem.empty()) throw NotBuiltError(display.problem);
  const EGLenum before = eglQueryAPI();
  if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE)
    throw NotBuiltError("EGL offers no OpenGL there, only OpenGL ES");
  const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION,
                           4,
                           EGL_CONTEXT_MINOR_VERSION,
                           3,
                           EGL_CONTEXT_OPENGL_PROFILE_MASK,
                           EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                           EGL_NONE};
  context_ = eglCreateContext(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted);
  const std::string error = context_ == EGL_NO_CONTEXT ? egl_error() : "";
  eglBindAPI(before);
  if (context_ == EGL_NO_CONTEXT)
    throw NotBuiltError("its driver has no OpenGL 4.3 with compute shaders (" + error + ")");
  try {
    load();
  } catch (...) {
    eglDestroyContext(display_, context_);
    throw;
  }
}

NativeContext::~NativeContext() { eglDestroyContext(display_, context_); }

void NativeContext::load() {
  const MakeCurrent current(*this);
#define PLEXWAY_GL_LOAD(upper, name)                      \
  functions_.name = find<PFNGL##upper##PROC>("gl" #name); \
  if (functions_.name == nullptr) throw NotBuiltError("its driver lacks gl" #name);
  PLEXWAY_GL_FUNCTIONS(PLEXWAY_GL_LOAD)
#undef PLEXWAY_GL_LOAD
  // EGL may answer with an entry for a function that the context does not have.
  GLint major = 0, minor = 0;
  functions_.GetIntegerv(GL_MAJOR_VERSION, &major);
  functions_.GetIntegerv(GL_MINOR_VERSION, &minor);
  if (major < 4 || (major == 4 && minor < 3))
    throw NotBuiltError("its driver has OpenGL " + std::to_string(major) + "." +
                        std::to_string(minor) + ", and compute shaders need 4.3");
  if (major == 4 && minor < 4) return;
#define PLEXWAY_GL_LOAD(upper, name) functions_.name = find<PFNGL##upper##PROC>("gl" #name);
  PLEXWAY_GL_OPTIONAL_FUNCTIONS(PLEXWAY_GL_LOAD)
#undef PLEXWAY_GL_LOAD
}

MakeCurrent::MakeCurrent(const NativeContext& context)
    : display_(context.display_), before_api_(eglQueryAPI()) {
  // OpenGL and OpenGL ES share the place of the current context.
  before_display_ = eglGetCurrentDisplay();
  before_draw_ = eglGetCurrentSurface(EGL_DRAW);
  before_read_ = eglGetCurrentSurface(EGL_READ);
  before_context_ = eglGetCurrentContext();
  eglBindAPI(EGL_OPENGL_API);
  if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context.context_) != EGL_TRUE) {
    const std::string error = egl_error();
    eglBindAPI(before_api_);
    throw NotBuiltError("EGL cannot make a context current without a surface (" + error + ")");
  }
}

MakeCurrent::~MakeCurrent() {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglBindAPI(before_api_);
  if (before_context_ != EGL_NO_CONTEXT)
    eglMakeCurrent(before_display_, before_draw_, before_read_, before_context_);
}

std::shared_ptr<Context> Context::of(int number) {
  static std::mutex mutex;
  static auto* const all = new std::map<int, std::shared_ptr<Context>>;
  const std::lock_guard lock(mutex);
  if (number < 0) {
    static const int chosen = choose();
    number = chosen;
  }
  std::shared_ptr<Context>& context = (*all)[number];
  if (!context) context = std::make_shared<Context>(number);
  return context;
}

Context::Context(int number) : native_(display_of(number)) {
  const MakeCurrent current(native_);
  const Functions& gl = native_.functions();
  device_.number = number;
  device_.vendor = text_of(gl, GL_VENDOR);
  device_.renderer = text_of(gl, GL_RENDERER);
  device_.version = text_of(gl, GL_VERSION);
  device_.software = displays()[static_cast<std::size_t>(number)].software ||
                     device_.renderer.find("llvmpipe") != std::string::npos ||
                     device_.renderer.find("softpipe") != std::string::npos;
  const auto number_of = [&](GLenum name) {
    GLint64 value = 0;
    gl.GetInteger64v(name, &value);
    return static_cast<std::size_t>(std::max<GLint64>(value, 0));
  };
  limits_.block = number_of(GL_MAX_SHADER_STORAGE_BLOCK_SIZE);
  limits_.group_size = number_of(GL_MAX_COMPUTE_WORK_GROUP_INVOCATIONS);
  limits_.blocks = number_of(GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS);
  limits_.groups = ~std::size_t{0};
  for (GLuint dimension = 0; dimension < 2; ++dimension) {
    GLint most = 0;
    gl.GetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_COUNT, dimension, &most);
    limits_.groups = std::min(limits_.groups, static_cast<std::size_t>(std::max(most, 1)));
  }
  device_.largest_buffer = limits_.block;
  device_.group_size = limits_.group_size;
}

GLuint Context::program(const std::string& shader, const std::string& defines) {
  const auto [place, fresh] = programs_.try_emplace(shader + '\n' + defines, 0);
  if (fresh) try {
      place->second = compile(native_.functions(), shader,
                              "#define PLEXWAY_GROUP " + std::to_string(group_) + "\n" + defines);
    } catch (...) {
      programs_.erase(place);
      throw;
    }
  return place->second;
}

}  // namespace plexway::detail::gl

namespace plexway {

GLDevice gl_device(const GL& executor) {
  return detail::gl::Context::of(executor.device)->device();
}

std::vector<GLDevice> gl_devices() {
  std::vector<GLDevice> devices;
  for (std::size_t n = 0; n < detail::gl::displays().size(); ++n) {
    const int number = static_cast<int>(n);
    try {
      devices.push_back(detail::gl::Context::of(number)->device());
    } catch (const NotBuiltError& error) {
      GLDevice broken;
      broken.number = number;
      broken.software = detail::gl::displays()[n].software;
      broken.problem = error.what();
      devices.push_back(broken);
    }
  }
  return devices;
}

}  // namespace plexway
