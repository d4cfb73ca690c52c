#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <plexway/render/picture.hpp>

#include "io/base64.hpp"
#include "io/names.hpp"
#include "io/output_file.hpp"
#include "render/canvas.hpp"
#include "render/composition.hpp"
#include "render/draw_list.hpp"
#include "render/png.hpp"

namespace plexway::render {

namespace {

using Place3 = std::array<float, 3>;
using Edge = std::pair<Place3, Place3>;  // the lesser end first: both triangles have the same

Point point_on(const Corner& a, const Corner& b, double value) {
  const double t = (value - static_cast<double>(a.value)) /
                   (static_cast<double>(b.value) - static_cast<double>(a.value));
  Point p;
  for (std::size_t k = 0; k < 3; ++k)
    p[k] = static_cast<double>(a.position[k]) +
           t * (static_cast<double>(b.position[k]) - static_cast<double>(a.position[k]));
  return p;
}

/// Whether all triangles of a batch meet and are coloured by one value, so that `contours` has all
/// its lines.
bool has_contours(const Batch& batch) {
  return batch.isolines && batch.joined && batch.look != Look::ghost && batch.others.empty() &&
         std::all_of(batch.corners.begin(), batch.corners.end(), [](const Corner& corner) {
           return corner.paint == by_value || corner.paint[3] == 255;
         });
}

/// Lines in a batch where the value is `value`, in the frame: of all triangles that are coloured by
/// it, joined over their edges.
std::vector<std::vector<Point>> contours(const Batch& batch, double value) {
  struct Piece {
    std::array<Edge, 2> edge;
    std::array<Point, 2> point;
    bool done = false;
  };
  std::vector<Piece> pieces;
  std::multimap<Edge, std::size_t> at;
  const auto above = [&](const Corner& c) { return static_cast<double>(c.value) >= value; };
  for (std::size_t n = 0; n + 2 < batch.corners.size(); n += 3) {
    const Corner* const corner = &batch.corners[n];
    if (corner[0].paint != by_value ||
        (above(corner[0]) == above(corner[1]) && above(corner[1]) == above(corner[2])))
      continue;
    Piece piece;
    std::size_t count = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Corner *a = &corner[i], *b = &corner[(i + 1) % 3];
      if (above(*a) == above(*b) || count == 2) continue;
      if (b->position < a->position) std::swap(a, b);
      piece.edge[count] = {a->position, b->position};
      piece.point[count++] = point_on(*a, *b, value);
    }
    for (const Edge& edge : piece.edge) at.emplace(edge, pieces.size());
    pieces.push_back(piece);
  }
  std::vector<std::vector<Point>> lines;
  const auto follow = [&](std::size_t p, std::size_t end) {
    std::vector<Point> line = {pieces[p].point[end]};
    for (bool more = true; more;) {
      pieces[p].done = true;
      line.push_back(pieces[p].point[1 - end]);
      const Edge to = pieces[p].edge[1 - end];
      more = false;
      const auto [first, last] = at.equal_range(to);
      for (auto next = first; next != last && !more; ++next) {
        if (pieces[next->second].done) continue;
        p = next->second;
        end = pieces[p].edge[0] == to ? 0 : 1;
        more = true;
      }
    }
    lines.push_back(std::move(line));
  };
  // Those with an end first; then what is closed.
  for (const bool open : {true, false})
    for (std::size_t p = 0; p < pieces.size(); ++p)
      for (std::size_t end = 0; end < 2; ++end)
        if (!pieces[p].done && (!open || at.count(pieces[p].edge[end]) == 1)) follow(p, end);
  return lines;
}

// Hundredths of a pixel.
std::string number(double x) {
  char text[32];
  const double rounded = std::round(100 * x) / 100;
  const auto end = std::to_chars(text, text + sizeof text, rounded == 0 ? 0 : rounded).ptr;
  return {text, end};
}

std::string exact(double x) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, x).ptr};
}

std::string hex(const Colour& c) {
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", unsigned{c[0]}, unsigned{c[1]}, unsigned{c[2]});
  return text;
}

std::string paint(const char* what, const Ink& ink) {
  std::string text = std::string(" ") + what + "=\"" + hex(ink.colour) + "\"";
  if (ink.opacity < 1) text += std::string(" ") + what + "-opacity=\"" + number(ink.opacity) + "\"";
  return text;
}

// The d of a path; a line that ends where it began is closed.
std::string shape_of(const std::vector<std::vector<Place>>& lines) {
  std::string d;
  for (const auto& line : lines) {
    const bool closed = line.size() > 3 && line.front() == line.back();
    for (std::size_t k = 0; k + (closed ? 1 : 0) < line.size(); ++k)
      d.append(k == 0   ? "M"
               : k == 1 ? "L"
                        : " ")
          .append(number(line[k][0]))
          .append(",")
          .append(number(line[k][1]));
    if (closed) d += "Z";
  }
  return d;
}

class SvgSheet final : public Sheet {
 public:
  using Sheet::Sheet;

  void box(const Place& from, const Place& to, const Ink& ink) override {
    body += "<rect x=\"" + number(from[0]) + "\" y=\"" + number(from[1]) + "\" width=\"" +
            number(to[0] - from[0]) + "\" height=\"" + number(to[1] - from[1]) + "\"" +
            paint("fill", ink) + "/>\n";
  }
  void ramp(const Place& from, const Place& to, const std::array<Colour, 256>& map) override {
    body += "<linearGradient id=\"map\" x1=\"0\" y1=\"1\" x2=\"0\" y2=\"0\">";
    for (std::size_t k = 0; k <= 32; ++k)
      body += "<stop offset=\"" + exact(static_cast<double>(k) / 32) + "\" stop-color=\"" +
              hex(map[(k * 255 + 16) / 32]) + "\"/>";
    body += "</linearGradient>\n<rect x=\"" + number(from[0]) + "\" y=\"" + number(from[1]) +
            "\" width=\"" + number(to[0] - from[0]) + "\" height=\"" + number(to[1] - from[1]) +
            "\" fill=\"url(#map)\"/>\n";
  }
  void text(std::string_view line, const Place& at, double size, const Ink& ink) override {
    // A capital of a usual typeface is about 0.72 of its size; it is made as wide as the layout
    // has it, so that it ends within the picture whatever the typeface.
    body += "<text x=\"" + number(at[0]) + "\" y=\"" + number(at[1]) + "\" font-size=\"" +
            number(size / 0.72) + "\" textLength=\"" + number(text_width(line, size)) +
            "\" lengthAdjust=\"spacingAndGlyphs\"" + paint("fill", ink) + ">" +
            io::escape_xml(line) + "</text>\n";
  }
  void path(const std::string& d, const std::string& attributes) {
    if (!d.empty()) body += "<path d=\"" + d + "\"" + attributes + "/>\n";
  }
  void circle(const Place& at, double radius, const std::string& attributes) {
    body += "<circle cx=\"" + number(at[0]) + "\" cy=\"" + number(at[1]) + "\" r=\"" +
            number(radius) + "\"" + attributes + "/>\n";
  }
  void group(const char* id, const std::string& attributes) {
    body += std::string("<g id=\"") + id + "\"" + attributes + ">\n";
  }
  void end_group() { body += "</g>\n"; }

  std::string body;
};

// What is drawn over the raster.
class Overlay {
 public:
  Overlay(SvgSheet& sheet, const Composition& made, const Sight& sight)
      : sheet_(sheet), made_(made), sight_(sight) {}

  void isolines(std::span<const Batch> batches) {
    sheet_.group("isolines", " fill=\"none\" stroke-linejoin=\"round\" stroke-width=\"" +
                                 number(made_.style.pen) + "\"");
    for (double k = 0; k < made_.style.lines; ++k) {
      const double value = made_.style.first_line + k * made_.style.line_step;
      std::vector<std::vector<Place>> shown;
      for (const Batch& batch : batches)
        for (const auto& line : contours(batch, value)) {
          const Sight::Parts parts = sight_.parts(line, 0);
          shown.insert(shown.end(), parts.open.begin(), parts.open.end());
        }
      Legend colours;
      colours.low = made_.style.low;
      colours.high = made_.style.high;
      colours.map = made_.style.map;
      sheet_.path(shape_of(shown), " data-value=\"" + exact(value) + "\"" +
                                       paint("stroke", line_ink(colours, value)));
    }
    sheet_.end_group();
  }

  void paths(const Scene& scene, double tube) {
    sheet_.group("paths", " fill=\"none\" stroke-linejoin=\"round\" stroke-linecap=\"round\"");
    for (const auto& path : scene.paths) {
      std::vector<Point> line;
      double distance = 0;
      for (const Point& p : path) {
        line.push_back(made_.frame(p));
        distance += sight_(line.back()).distance / static_cast<double>(path.size());
      }
      if (line.size() < 2) continue;
      const Sight::Parts parts = sight_.parts(line, tube);
      const double wide = 1.2 * sight_.pixels(tube, distance);
      const auto stroke = [&](const auto& lines, const Ink& ink, double width) {
        sheet_.path(shape_of(lines),
                    paint("stroke", ink) + " stroke-width=\"" + number(width) + "\"");
      };
      stroke(parts.hidden, {path_white, 0.3}, wide);
      stroke(parts.open, {{18, 20, 26}, 1}, wide + 2.2 * made_.style.pen);
      stroke(parts.open, {path_white, 1}, wide);
    }
    sheet_.end_group();
  }

  void ends(const std::vector<Point>& points, const char* id, const Colour& colour, double radius) {
    sheet_.group(id, "");
    for (const Point& p : points) {
      const Sight::Seen seen = sight_(made_.frame(p));
      const double wide = sight_.pixels(radius, seen.distance);
      const std::string rim =
          " stroke=\"#12141a\" stroke-width=\"" + number(1.1 * made_.style.pen) + "\"";
      if (sight_.open(seen, radius))
        sheet_.circle(seen.place, wide, paint("fill", {colour, 1}) + rim);
      else  // one that is hidden is a ring: a dot would seem to lie on the near side
        sheet_.circle(seen.place, 0.9 * wide,
                      " fill=\"none\"" + paint("stroke", {colour, 0.9}) + " stroke-width=\"" +
                          number(0.36 * wide) + "\"");
    }
    sheet_.end_group();
  }

 private:
  SvgSheet& sheet_;
  const Composition& made_;
  const Sight& sight_;
};

}  // namespace

void write_svg(const std::filesystem::path& file, const Scene& scene, const PictureOptions& options,
               std::size_t colours) {
  Composition made = compose(scene, options);
  const double tube = tube_radius(made.pixel);
  std::erase_if(made.batches, [](const Batch& batch) { return batch.look == Look::overlay; });
  std::vector<bool> lined;
  for (Batch& batch : made.batches) {
    lined.push_back(has_contours(batch));
    if (lined.back()) batch.isolines = false;
  }
  Drawn drawn = draw(made.batches, options.width, options.height, made.style);
  const Sight sight(drawn, made.style.camera);
  SvgSheet sheet(static_cast<double>(options.width), static_cast<double>(options.height));
  Overlay overlay(sheet, made, sight);
  {
    std::vector<Batch> with_lines;
    for (std::size_t k = 0; k < lined.size(); ++k)
      if (lined[k]) with_lines.push_back(std::move(made.batches[k]));
    overlay.isolines(with_lines);
  }
  overlay.paths(scene, tube);
  overlay.ends(scene.targets, "targets", target_white, target_radius * tube);
  overlay.ends(scene.sources, "sources", source_red, source_radius * tube);
  if (options.legend) {
    sheet.group("legend", " font-family=\"Helvetica, Arial, sans-serif\"");
    draw_legend(sheet, made.legend);
    sheet.end_group();
  }
  shade_hollows(drawn, made.style.camera);
  const std::string size = " width=\"" + std::to_string(options.width) + "\" height=\"" +
                           std::to_string(options.height) + "\"";
  io::OutputFile out(file);
  out.write("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
  out.write("<svg xmlns=\"http://www.w3.org/2000/svg\"" + size + " viewBox=\"0 0 " +
            std::to_string(options.width) + " " + std::to_string(options.height) + "\">\n");
  out.write("<title>" + io::escape_xml(options.title) + "</title>\n");
  out.write("<image" + size + " href=\"data:image/png;base64,");
  out.write(io::encode_base64(png_bytes(reduced(drawn), colours)));
  out.write("\"/>\n");
  out.write(sheet.body);
  out.write("</svg>\n");
  out.commit();
}

}  // namespace plexway::render
