#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <string>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/io/page.hpp>
#include <plexway/shape/scene.hpp>
#include <plexway/shape/support.hpp>

#include "arrays.hpp"
#include "domain.hpp"
#include "shape/scene.hpp"

#ifdef PLEXWAY_HAS_RENDER
#include <plexway/render/picture.hpp>
#endif

namespace plexway::python {
using namespace detail;
namespace {

// What is drawn; `value` has the distances.
SceneContent content_of(const Domain& domain, const py::object& distance,
                        std::vector<double>& value, const std::vector<PointSource>& sources,
                        const py::list& paths) {
  SceneContent content;
  if (!distance.is_none()) value = numbers_of(distance, "distance");
  content.distance = value;
  for (const PointSource& source : sources)
    content.sources.push_back(domain.shape().position(source));
  for (const py::handle& path : paths) content.paths.push_back(points_of(path, "paths"));
  return content;
}

#ifdef PLEXWAY_HAS_RENDER

py::array_t<std::uint8_t> picture(const Domain& domain, const py::object& distance,
                                  const std::vector<PointSource>& sources, const py::list& paths,
                                  std::size_t width, std::size_t height, const py::object& view,
                                  const py::object& isolines, const std::string& map,
                                  bool transparent, const std::string& title, bool clip) {
  support(Purpose::pictures, domain.shape()).require();
  std::vector<double> value;
  const SceneContent content = content_of(domain, distance, value, sources, paths);
  const ShapeScene scene(domain.open(), content);
  render::PictureOptions options;
  options.width = width;
  options.height = height;
  if (!view.is_none()) {
    const auto angles = view.cast<std::array<double, 2>>();
    options.view = {.azimuth = angles[0], .elevation = angles[1]};
  }
  if (!isolines.is_none()) options.isolines = isolines.cast<std::size_t>();
  options.map = map;
  options.transparent = transparent;
  options.title = title;
  if (clip) options.clip.emplace();
  render::Image image;
  {
    const py::gil_scoped_release free;
    image = render::picture(scene.scene(), options);
  }
  return owned(std::move(image.pixels))
      .reshape({static_cast<py::ssize_t>(image.height), static_cast<py::ssize_t>(image.width),
                py::ssize_t{4}});
}

#else

py::object picture(const py::args&) {
  throw NotBuiltError("pictures are not in this build: it needs libpng and OpenGL");
}

#endif

// One file of HTML, to turn and come nearer in a browser.
void page(const Domain& domain, const std::filesystem::path& file, const py::object& distance,
          const std::vector<PointSource>& sources, const py::list& paths, const std::string& title,
          const std::string& map) {
  std::vector<double> value;
  const SceneContent content = content_of(domain, distance, value, sources, paths);
  const py::gil_scoped_release free;
  io::Page page;
  fill_page(page, domain.open(), content);
  page.title = title;
  page.map = map;
  io::write_page(file, page);
}

}  // namespace

void bind_picture(py::module_& module) {
  module.def("picture", &picture);
  module.def("page", &page);
}

}  // namespace plexway::python
