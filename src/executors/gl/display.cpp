#include "executors/gl/display.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <string_view>

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <plexway/error.hpp>

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

}  // namespace plexway::detail::gl
