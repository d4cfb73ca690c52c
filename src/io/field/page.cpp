#include <plexway/io/page.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include <plexway/error.hpp>

#include "complexes/common/box_tree.hpp"
#include "io/base64.hpp"
#include "io/field/colours.hpp"
#include "io/field/page_text.hpp"
#include "io/numbers.hpp"
#include "io/output_file.hpp"

namespace plexway::io {
using namespace detail;
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr float unreached = 3e38f;  // what the shader takes for none

/// A quoted text for JSON in HTML: no '<' ends the script.
std::string script_text(std::string_view text) {
  constexpr char digits[] = "0123456789abcdef";
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || c == '"' || c == '\\' || c == '<' || c == '>' || c == '&' || byte == 0x7F) {
      out.append("\\u00");
      out += digits[byte >> 4];
      out += digits[byte & 15];
    } else {
      out += c;
    }
  }
  return out + "\"";
}

class PageWriter {
 public:
  PageWriter(OutputFile& out, const Page& page) : out_(out), page_(page) {}

  void write() {
    find_frame();
    find_range();
    out_.write(page_head);
    out_.write("{\"title\":" + script_text(page_.title) + ",\"up\":\"" + page_.up + "\"");
    out_.write(",\"positions\":\"");
    for (const auto& p : page_.positions)
      for (const double c : in_frame(p)) put(static_cast<float>(c));
    end_base64();
    write_rows("triangles", page_.triangles);
    write_rows("edges", page_.edges);
    out_.write(",\"value\":\"");
    for (const double v : page_.value) put(std::isfinite(v) ? static_cast<float>(v) : unreached);
    end_base64();
    out_.write(",\"colour\":\"");
    for (const std::int32_t label : page_.label) {
      const Rgb c = label < 0 ? unreached_grey
                              : cell_colours[static_cast<std::size_t>(label) % cell_colours.size()];
      put(c[0] | std::uint32_t{c[1]} << 8 | std::uint32_t{c[2]} << 16 | 0xFF000000u);
    }
    end_base64();
    write_colours();
    for (const auto& [name, points] :
         {std::pair("sources", &page_.sources), std::pair("targets", &page_.targets),
          std::pair("dots", &page_.dots)}) {
      out_.write(",\"", name, "\":");
      write_points(*points);
    }
    out_.write(",\"paths\":[");
    for (std::size_t k = 0; k < page_.paths.size(); ++k) {
      if (k > 0) out_.write(",");
      write_points(page_.paths[k]);
    }
    out_.write("]}");
    out_.write(page_tail);
  }

 private:
  /// About 1 in size around the origin, so that single precision does wherever it lies.
  void find_frame() {
    auto box = Box<3>::empty();
    const auto& [low, high] = box;
    const auto add = [&](const std::array<double, 3>& p) {
      for (const double c : p)
        if (!std::isfinite(c)) throw UsageError("page: a position is not finite");
      box.add(p);
    };
    const auto add_rows = [&](const auto& rows) {
      for (const auto& row : rows)
        for (const std::uint32_t v : row) {
          if (v >= page_.positions.size())
            throw UsageError("page: vertex " + std::to_string(v) + " of " +
                             std::to_string(page_.positions.size()));
          add(page_.positions[v]);
        }
    };
    add_rows(page_.triangles);
    add_rows(page_.edges);
    if (page_.triangles.empty() && page_.edges.empty())
      for (const auto& p : page_.positions) add(p);
    for (const auto* points : {&page_.sources, &page_.targets, &page_.dots})
      for (const auto& p : *points) add(p);
    for (const auto& path : page_.paths)
      for (const auto& p : path) add(p);
    if (!(low[0] <= high[0])) throw UsageError("page: nothing to show");
    double diagonal = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      centre_[k] = low[k] / 2 + high[k] / 2;
      diagonal = std::hypot(diagonal, high[k] - low[k]);
    }
    if (diagonal > 0 && std::isfinite(1 / diagonal)) scale_ = 1 / diagonal;
  }

  [[nodiscard]] std::array<double, 3> in_frame(const std::array<double, 3>& p) const {
    std::array<double, 3> at{};
    for (std::size_t k = 0; k < 3; ++k) {
      at[k] = scale_ * (p[k] - centre_[k]);
      // Vertices that nothing names may lie anywhere.
      if (!(std::abs(at[k]) < 1e3)) at[k] = 0;
    }
    return at;
  }

  void find_range() {
    for (const double v : page_.value) {
      if (!std::isfinite(v)) continue;
      low_ = std::min(low_, v);
      high_ = std::max(high_, v);
    }
    bar_ = low_ <= high_ && page_.label.empty();
    if (!(low_ <= high_)) low_ = 0, high_ = 1;
    if (page_.range) low_ = (*page_.range)[0], high_ = (*page_.range)[1];
    if (!(low_ < high_)) high_ = low_ + (low_ == 0 ? 1 : std::abs(low_));
  }

  void write_colours() {
    const Ticks marks = ticks(low_, high_, 6);
    out_.write(",\"range\":[", low_, ",", high_, "],\"step\":", marks.fine_step(),
               ",\"spacing\":", 1.1 / std::sqrt(static_cast<double>(page_.positions.size()) + 1),
               bar_ ? ",\"bar\":true,\"marks\":[" : ",\"bar\":false,\"marks\":[");
    for (std::size_t k = 0; k < marks.at.size(); ++k)
      out_.write(k > 0 ? ",[" : "[", (marks.at[k] - low_) / (high_ - low_), ",",
                 script_text(marks.label[k]), "]");
    out_.write("],\"map\":[");
    const ColourMap map(page_.map);
    write_rows_of<unsigned>(map.table(), std::identity());
    out_.write("]");
  }

  void write_points(std::span<const std::array<double, 3>> points) {
    out_.write("[");
    write_rows_of<float>(points, [this](const auto& p) { return in_frame(p); });
    out_.write("]");
  }

  template <class Number, class Rows, class Of>
  void write_rows_of(const Rows& rows, const Of& of) {
    const char* open = "[";
    for (const auto& row : rows) {
      const auto& [x, y, z] = of(row);
      out_.write(open, static_cast<Number>(x), ",", static_cast<Number>(y), ",",
                 static_cast<Number>(z), "]");
      open = ",[";
    }
  }

  template <class Rows>
  void write_rows(const char* name, const Rows& rows) {
    out_.write(",\"", name, "\":\"");
    for (const auto& row : rows)
      for (const std::uint32_t v : row) put(v);
    end_base64();
  }

  // Four bytes in little endian.
  template <class Number>
  void put(Number value) {
    static_assert(sizeof value == 4);
    const auto bytes = little_endian(value);
    bytes_.append(bytes.data(), bytes.size());
  }
  void end_base64() {
    out_.write(encode_base64(bytes_) + "\"");
    bytes_.clear();
  }

  OutputFile& out_;
  const Page& page_;
  std::array<double, 3> centre_{};
  double scale_ = 1, low_ = infinite, high_ = -infinite;
  bool bar_ = false;
  std::string bytes_;  ///< of the array that is being written
};

}  // namespace

void write_page(const std::filesystem::path& file, const Page& page) {
  const auto require_length = [&](std::size_t length, const char* what) {
    if (length != 0 && length != page.positions.size())
      throw UsageError("page: " + std::to_string(length) + " " + what + " for " +
                       std::to_string(page.positions.size()) + " vertices");
  };
  require_length(page.value.size(), "values");
  require_length(page.label.size(), "labels");
  if (page.up != 'x' && page.up != 'y' && page.up != 'z')
    throw UsageError("page: up must be x, y or z");
  if (page.range && !((*page.range)[0] < (*page.range)[1]))
    throw UsageError("page: the range must be two numbers, the lower one first");
  (void)ColourMap(page.map);
  OutputFile out(file);
  PageWriter(out, page).write();
  out.commit();
}

}  // namespace plexway::io
