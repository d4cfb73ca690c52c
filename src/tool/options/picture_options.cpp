#include <cmath>
#include <string_view>

#include <plexway/error.hpp>
#include <plexway/io/page.hpp>
#include <plexway/shape/support.hpp>

#include "io/field/colours.hpp"
#include "io/names.hpp"
#include "shape/arguments/arguments.hpp"
#include "shape/level_sets.hpp"
#include "shape/scene.hpp"
#include "tool/options/picture_options.hpp"
#include "tool/report/console.hpp"
#include "tool/report/summary.hpp"

#ifdef PLEXWAY_HAS_RENDER
#include <plexway/render/picture.hpp>
#endif

namespace plexway::detail::cli {
namespace {

constexpr std::array<std::string_view, 2> picture_extensions = {".png", ".svg"};
constexpr std::array<std::string_view, 2> page_extensions = {".html", ".htm"};

// Numbers between commas: so many, or any number of them for 0.
std::vector<double> numbers(const std::string& option, const std::string& text, std::size_t count,
                            const std::string& expected) {
  auto found = numbers_of(text, count);
  if (!found) throw UsageError(option + " '" + text + "': expected " + expected);
  return *std::move(found);
}

bool options_given(const PictureArguments& a) {
  for (const std::string* text :
       {&a.view, &a.size, &a.range, &a.map, &a.clip, &a.isosurfaces, &a.up, &a.title, &a.colour})
    if (!text->empty()) return true;
  return a.isolines || a.transparent || a.orthographic || a.small;
}

std::array<double, 2> range_of(const std::string& text) {
  const auto ends = numbers("--range", text, 2, "LO,HI");
  if (!(ends[0] < ends[1])) throw UsageError("--range: LO must be less than HI");
  return {ends[0], ends[1]};
}

void check_up(const std::string& text) {
  if (!text.empty()) choose<char>("--up", text, {{"x", 'x'}, {"y", 'y'}, {"z", 'z'}});
}

io::Page page_of(const PictureArguments& arguments) {
  io::Page page;
  check_up(arguments.up);
  if (!arguments.range.empty()) page.range = range_of(arguments.range);
  if (!arguments.map.empty()) {
    const io::ColourMap exists(arguments.map);
    page.map = arguments.map;
  }
  if (!arguments.title.empty()) page.title = arguments.title;
  return page;
}

void write_page(const PictureArguments& arguments, const Domain& domain,
                const SceneContent& content) {
  if (arguments.html.empty()) return;
  io::Page page = page_of(arguments);
  page.up = arguments.up_of(domain);
  fill_page(page, domain, content);
  io::write_page(arguments.html, page);
}

#ifdef PLEXWAY_HAS_RENDER

render::View view_of(const std::string& text) {
  struct Named {
    std::string_view name;
    render::View view;
  };
  constexpr std::array<Named, 7> named = {{{"front", {0, 0}},
                                           {"right", {90, 0}},
                                           {"back", {180, 0}},
                                           {"left", {270, 0}},
                                           {"top", {0, 90}},
                                           {"bottom", {0, -90}},
                                           {"iso", {45, 35.264389682754654}}}};
  for (const Named& n : named)
    if (n.name == text) return n.view;
  const auto angles =
      numbers("--view", text, 2, "front, back, left, right, top, bottom, iso, or AZ,EL in degrees");
  if (std::abs(angles[1]) > 90) throw UsageError("--view: EL is an angle from -90 to 90 degrees");
  return {angles[0], angles[1]};
}

render::Clip clip_of(const std::string& text) {
  render::Clip clip;
  for (std::size_t k = 0; k < 3; ++k)
    if (text == std::string(1, static_cast<char>('x' + k))) {
      clip.normal = {0, 0, 0};
      clip.normal[k] = 1;
      return clip;
    }
  const auto plane = numbers("--clip", text, 4, "x, y, z or a plane NX,NY,NZ,D");
  clip.normal = {plane[0], plane[1], plane[2]};
  if (clip.normal == render::Point{}) throw UsageError("--clip: NX,NY,NZ must not be 0,0,0");
  clip.offset = plane[3];
  return clip;
}

render::PictureOptions options_of(const PictureArguments& arguments) {
  render::PictureOptions options;
  if (!arguments.view.empty()) options.view = view_of(arguments.view);
  if (!arguments.size.empty()) {
    std::size_t rest = 0;
    const std::string& size = arguments.size;
    const std::size_t x = size.find('x');
    const bool digits = size.find_first_not_of("0123456789x") == size.npos && x != size.npos &&
                        x > 0 && x < 6 && size.size() - x > 1 && size.size() - x < 7;
    if (digits) {
      options.width = std::stoul(size.substr(0, x));
      options.height = std::stoul(size.substr(x + 1), &rest);
    }
    if (!digits || rest != size.size() - x - 1 || options.width == 0 || options.height == 0 ||
        options.width > 16384 || options.height > 16384)
      throw UsageError("--size '" + size + "': expected WIDTHxHEIGHT in pixels, such as 800x600");
  }
  if (!arguments.range.empty()) options.range = range_of(arguments.range);
  options.isolines = arguments.isolines;
  if (!arguments.map.empty()) {
    const io::ColourMap exists(arguments.map);
    options.map = arguments.map;
  }
  if (!arguments.clip.empty()) options.clip = clip_of(arguments.clip);
  if (!arguments.isosurfaces.empty())
    options.isosurfaces = numbers("--isosurfaces", arguments.isosurfaces, 0, "V,V,...");
  check_up(arguments.up);
  if (!arguments.title.empty()) options.title = arguments.title;
  options.transparent = arguments.transparent;
  options.orthographic = arguments.orthographic;
  return options;
}

#endif

}  // namespace

void add_picture_options(CLI::App& app, PictureArguments& arguments, bool cells) {
  const OptionGroup add(app);
  add_output(
      app, "--picture", arguments.file,
      "draw a picture without a display: .png, or .svg, whose lines and text are drawn over\n"
      "the shaded image; the next options go with it",
      "png");
  add_output(app, "--html", arguments.html,
             "a page to turn in a browser: one file, no network; --up, --range, --map and --title\n"
             "go with it",
             "html");
  add("--view", arguments.view, "VIEW",
      "from where: front, back, left, right, top, bottom, iso, or AZ,EL in\n"
      "degrees around the front (default: from above if flat, else 28,24)");
  add("--up", arguments.up, "AXIS",
      "which axis points up: x, y or z (default: y or z, by the shape)");
  add("--size", arguments.size, "WxH", "pixels (default 800x600)");
  add("--range", arguments.range, "LO,HI",
      "values at the ends of the colour bar (default: the field's own)");
  add("--isolines", arguments.isolines, "N",
      "so many lines of equal value, 0 for none (default: at round numbers)")
      ->check(CLI::Range(0, 10000));
  add("--map", arguments.map, "NAME", "colours: viridis (default), magma, cividis");
  if (cells)
    add("--colour", arguments.colour, "WHAT",
        "what colours show: distance (default), or cells: the nearest source");
  add("--clip", arguments.clip, "x|y|z|NX,NY,NZ,D",
      "cut open: x, y or z through the middle, the near half goes; or a plane,\n"
      "beyond which all goes");
  add("--isosurfaces", arguments.isosurfaces, "V,V,...",
      "of a solid: surfaces of these values inside");
  add("--title", arguments.title, "TEXT", "over the colour bar (default 'distance')");
  app.add_flag("--orthographic", arguments.orthographic, "parallel lines stay parallel");
  app.add_flag("--transparent", arguments.transparent, "no background");
  app.add_flag("--small", arguments.small, "256 colours, a quarter of the bytes");
}

char PictureArguments::up_of(const Domain& domain) const {
  return up.empty() ? probable_up(domain) : up[0];
}

void report_picture(const PictureArguments& arguments, const Domain& domain, Summary& summary) {
  if (!arguments.wanted() || domain.positions().empty()) return;
  const std::string axis(1, arguments.up_of(domain));
  summary.add("up", axis,
              axis + (arguments.up.empty() ? ", by the shape; --up says another axis" : ""));
}

void check_picture(const PictureArguments& arguments, const std::string& input) {
  if (!arguments.wanted()) {
    if (!arguments.isosurfaces.empty())
      throw UsageError(
          "--isosurfaces draws: it needs --picture FILE or --html FILE; files have them by "
          "--isoline-step STEP --isolines-out FILE");
    if (options_given(arguments))
      throw UsageError(
          "--view, --size, --range, --clip and the like need --picture FILE or --html FILE");
    return;
  }
  check_output_name(arguments.html, input, page_extensions, "--html");
  if (arguments.file.empty()) {
    (void)page_of(arguments);
    return;
  }
#ifdef PLEXWAY_HAS_RENDER
  static_cast<void>(options_of(arguments));
  if (!arguments.colour.empty())
    choose<bool>("--colour", arguments.colour, {{"distance", false}, {"cells", true}});
  check_output_name(arguments.file, input, picture_extensions, "--picture");
#else
  static_cast<void>(input);
  throw NotBuiltError(
      "--picture: this plexway draws no pictures: rebuild with libpng-dev, libegl-dev and "
      "libgl-dev "
      "installed");
#endif
}

#ifdef PLEXWAY_HAS_RENDER

void write_picture(const PictureArguments& arguments, const Domain& domain,
                   const SceneContent& content, bool quiet) {
  write_page(arguments, domain, content);
  if (arguments.file.empty()) return;
  render::PictureOptions options = options_of(arguments);
  options.up = arguments.up_of(domain);
  require("--picture: " + domain.file().string(), support(Purpose::pictures, domain));
  if (!options.isosurfaces.empty())
    require("--isosurfaces", support(Purpose::isosurfaces, domain.kind()));
  SceneContent shown = content;
  shown.look_inside = content.look_inside && !options.clip;
  const ShapeScene scene(domain, shown);
  if (scene.is_line() && !quiet)
    say_note("all points lie in a line: the picture shows the edges, for there is no area");
  const std::size_t colours = arguments.small ? 256 : 0;
  if (io::lower_extension(arguments.file) == ".svg")
    render::write_svg(arguments.file, scene.scene(), options, colours);
  else
    render::write_png(arguments.file, render::picture(scene.scene(), options), colours);
}

#else

void write_picture(const PictureArguments& arguments, const Domain& domain,
                   const SceneContent& content, bool) {
  write_page(arguments, domain, content);
}

#endif

void add_isoline_options(CLI::App& command, IsolineOptions& options) {
  const OptionGroup add(command);
  add("--isoline-step", options.step, "STEP",
      "lines on a surface or a cloud, or surfaces in a solid, at each multiple of this\n"
      "distance, for --isolines-out");
  add_output(command, "--isolines-out", options.out,
             "where to: .obj (lines), .ply, .vtp, .csv or .json; of a solid .obj, .off, .ply,\n"
             ".stl, .glb, .gltf or .vtu (triangles); - for .obj on standard output",
             "obj");
}

void check_isolines(const IsolineOptions& options, const std::string& input) {
  if (options.out.empty() != !options.step)
    throw UsageError("give --isoline-step STEP and --isolines-out FILE both");
  if (options.step && !(*options.step > 0 && std::isfinite(*options.step)))
    throw UsageError("--isoline-step: the step must be > 0");
  check_output_name(options.out, input, level_set_extensions(), "--isolines-out");
}

void check_isolines(const IsolineOptions& options, const Domain& domain) {
  if (options.out.empty()) return;
  check_output_name(options.out, domain.file().string(), level_set_extensions(domain.kind()),
                    "--isolines-out");
}

std::vector<double> isoline_values(const IsolineOptions& options,
                                   std::span<const double> distance) {
  if (options.out.empty()) return {};
  std::vector<double> values = level_set_values(distance, *options.step);
  const std::string extension = io::lower_extension(options.out);
  if (values.empty() && (extension == ".glb" || extension == ".gltf"))
    throw UsageError("--isolines-out " + options.out + ": would hold nothing, which a " +
                     extension + " cannot: no distance is as large as the step");
  return values;
}

}  // namespace plexway::detail::cli
