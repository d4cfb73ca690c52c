#include "executors/gl/context.hpp"

#include <algorithm>
#include <vector>

#include <plexway/error.hpp>

#include "executors/gl/program.hpp"

namespace plexway::detail::gl {
namespace {

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

GLDevice gl_device(const GL& executor) { return gl::Context::of(executor.device)->device(); }

std::vector<GLDevice> gl_devices() {
  std::vector<GLDevice> devices;
  for (std::size_t n = 0; n < gl::displays().size(); ++n) {
    const int number = static_cast<int>(n);
    try {
      devices.push_back(gl::Context::of(number)->device());
    } catch (const NotBuiltError& error) {
      GLDevice broken;
      broken.number = number;
      broken.software = gl::displays()[n].software;
      broken.problem = error.what();
      devices.push_back(broken);
    }
  }
  return devices;
}

}  // namespace plexway
