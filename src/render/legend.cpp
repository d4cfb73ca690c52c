#include "render/composition.hpp"

#include <algorithm>
#include <cmath>

#include "io/field/colours.hpp"

namespace plexway::render {
namespace {

constexpr Ink text_ink = {{38, 43, 52}, 1};
constexpr Ink fine_ink = {{38, 43, 52}, 0.55};

// Measures of the column at the right, in pixels.
struct Layout {
  double text;    // height of a capital
  double margin;  // around everything
  double bar_width, bar_top, bar_height, left, width;
  io::Ticks numbers;
};

Layout layout(const Legend& legend, double width, double height) {
  Layout l{};
  l.text = std::clamp(std::sqrt(width * height) / 62, 6.5, 40.0);
  l.margin = 0.045 * std::min(width, height);
  l.bar_width = 1.35 * l.text;
  l.bar_height = std::round(0.56 * height);
  const double swatches = legend.swatches.empty()
                              ? 0
                              : (2.0 * static_cast<double>(legend.swatches.size()) + 1) * l.text;
  const double title = legend.title.empty() || !legend.bar ? 0 : 2.2 * l.text;
  const double whole = (legend.bar ? l.bar_height : 0) + swatches + title;
  l.bar_top = std::round((height - whole) / 2 + title);
  l.width = 0;
  if (legend.bar) {
    const double room = l.bar_height / (2.6 * l.text);
    l.numbers =
        io::ticks(legend.low, legend.high, static_cast<std::size_t>(std::clamp(room, 1.0, 6.0)));
    for (const std::string& label : l.numbers.label)
      l.width = std::max(l.width, text_width(label, l.text));
    l.width += l.bar_width + 0.95 * l.text;
    l.width = std::max(l.width, text_width(legend.title, l.text));
  }
  for (const auto& swatch : legend.swatches)
    l.width = std::max(l.width, 2.1 * l.text + text_width(swatch.text, l.text));
  l.left = std::round(width - l.margin - l.width);
  return l;
}

}  // namespace

double line_width(double width, double height) {
  return std::max(1.0, std::sqrt(width * height / (800.0 * 600.0)));
}

Window scene_window(const Legend& legend, double width, double height) {
  const Layout l = layout(legend, width, height);
  const double taken = l.width > 0 ? l.width + 1.9 * l.margin : 0;
  // Too narrow for both: the scene goes under the legend.
  const double right = taken > 0.4 * width ? l.margin : std::max(taken, l.margin);
  return {l.margin, l.margin, std::max(width - l.margin - right, 1.0),
          std::max(height - 2 * l.margin, 1.0)};
}

Ink line_ink(const Legend& legend, double value) {
  const auto place = static_cast<std::size_t>(
      std::clamp(255 * (value - legend.low) / (legend.high - legend.low), 0.0, 255.0));
  const Colour c = legend.map[place];
  const bool bright = 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2] > 97;
  return bright ? Ink{{20, 22, 30}, 0.55} : Ink{{255, 255, 255}, 0.5};
}

void draw_legend(Sheet& sheet, const Legend& legend) {
  const double width = sheet.width(), height = sheet.height();
  const Layout l = layout(legend, width, height);
  const double pen = line_width(width, height);
  double below = l.bar_top;
  if (legend.bar) {
    if (!legend.title.empty())
      sheet.text(legend.title, {l.left, l.bar_top - 1.25 * l.text}, l.text, text_ink);
    const double right = l.left + std::round(l.bar_width), bottom = l.bar_top + l.bar_height;
    sheet.ramp({l.left, l.bar_top}, {right, bottom}, legend.map);
    const auto y_of = [&](double value) {
      return bottom - l.bar_height * (value - legend.low) / (legend.high - legend.low);
    };
    for (const double value : legend.isolines) {
      const double y = y_of(value);
      sheet.box({l.left, y - 0.4 * pen}, {right, y + 0.4 * pen}, line_ink(legend, value));
    }
    for (std::size_t k = 0; k < l.numbers.at.size(); ++k) {
      const double y = y_of(l.numbers.at[k]);
      sheet.box({right, y - 0.5 * pen}, {right + 0.4 * l.text, y + 0.5 * pen}, fine_ink);
      sheet.text(l.numbers.label[k], {right + 0.95 * l.text, y + 0.5 * l.text}, l.text, text_ink);
    }
    below = bottom + l.text;
  }
  for (const auto& swatch : legend.swatches) {
    const double size = std::round(1.35 * l.text);
    sheet.box({l.left, std::round(below)}, {l.left + size, std::round(below) + size},
              {swatch.colour, 1});
    sheet.text(swatch.text, {l.left + 2.1 * l.text, std::round(below) + 1.17 * l.text}, l.text,
               text_ink);
    below += 2 * l.text;
  }
}

}  // namespace plexway::render
