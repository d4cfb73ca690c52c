#include "render/composition.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace plexway::render {
namespace {

// A glyph is drawn by a pen: `m x y` moves it, `l x y` draws a line, `a x y rx ry from to` an arc
// of an ellipse around (x, y) between two angles in degrees, after a line to where the arc begins.
// From '!' to '~', in the order of ASCII.
constexpr std::array<const char*, 94> glyphs = {
    "m 0.4 8 l 0.4 2.4 m 0.4 0.1",                                              // !
    "m 0.2 8 l 0.2 5.8 m 2 8 l 2 5.8",                                          // "
    "m 1 0 l 2 8 m 3.6 0 l 4.6 8 m 0 2.6 l 5.2 2.6 m 0.4 5.4 l 5.6 5.4",        // #
    "a 2.4 5.4 2.2 1.6 30 270 a 2.4 2.2 2.4 1.6 90 -150 m 2.4 8.4 l 2.4 -0.8",  // $
    "m 0.8 0 l 6 8 m 2.8 6.4 a 1.4 6.4 1.4 1.6 0 360 "
    "m 7 1.6 a 5.6 1.6 1.4 1.6 0 360",                                                // %
    "m 5.6 0 l 1 5.4 a 2.3 6.5 1.5 1.5 215 -35 l 1.4 4 a 2 2 2 2 125 325 l 5.4 3.6",  // &
    "m 0.2 8 l 0.2 5.8",                                                              // '
    "a 4 3.4 4 6.4 130 230",                                                          // (
    "a -1.6 3.4 4 6.4 50 -50",                                                        // )
    "m 1.8 7.8 l 1.8 4.2 m 0.2 6.9 l 3.4 5.1 m 3.4 6.9 l 0.2 5.1",                    // *
    "m 0.2 3.4 l 4.4 3.4 m 2.3 1.3 l 2.3 5.5",                                        // +
    "m 0.7 0.3 l 0.2 -1.4",                                                           // ,
    "m 0.2 3.4 l 3.4 3.4",                                                            // -
    "m 0.4 0.1",                                                                      // .
    "m 0 -0.8 l 3.4 8.6",                                                             // /
    "m 5 5.5 a 2.5 5.5 2.5 2.5 0 180 a 2.5 2.5 2.5 2.5 180 360 l 5 5.5",              // 0
    "m 0.9 6.2 l 3.1 8 l 3.1 0",                                                      // 1
    "a 2.45 5.6 2.25 2.4 170 -36 l 0.1 0 l 4.9 0",                                    // 2
    "a 2.4 6.1 2.1 1.9 155 -90 l 1.8 4.2 m 2.4 4.2 a 2.4 2.1 2.5 2.1 90 -152",        // 3
    "m 3.7 0 l 3.7 8 l 0 2.2 l 5 2.2",                                                // 4
    "m 4.5 8 l 0.8 8 l 0.45 4.3 a 2.4 2.6 2.55 2.6 140 -150",                         // 5
    "m 2.8 8 l 0.33 3.75 a 2.5 2.5 2.5 2.5 150 510",                                  // 6
    "m 0.1 8 l 4.9 8 l 1.7 0",                                                        // 7
    "a 2.5 6.15 2.1 1.85 -90 270 a 2.5 2.15 2.5 2.15 90 450",                         // 8
    "m 2.2 0 l 4.67 4.25 a 2.5 5.5 2.5 2.5 -30 330",                                  // 9
    "m 0.4 0.1 m 0.4 4.6",                                                            // :
    "m 0.7 0.3 l 0.2 -1.4 m 0.6 4.6",                                                 // ;
    "m 4 5.8 l 0.2 3.4 l 4 1",                                                        // <
    "m 0.2 4.4 l 4.4 4.4 m 0.2 2.4 l 4.4 2.4",                                        // =
    "m 0.2 5.8 l 4 3.4 l 0.2 1",                                                      // >
    "a 2 6.1 1.9 1.9 165 -50 l 2 3.6 l 2 2.4 m 2 0.1",                                // ?
    "m 5 2.6 a 3.6 3.4 1.5 1.7 0 360 m 5.1 5 l 5.1 2.6 a 6 2.6 0.9 0.9 180 360 l 6.9 3.6 "
    "a 3.6 3.6 3.3 4.4 0 300",                  // @
    "m 0 0 l 2.8 8 l 5.6 0 m 1 2.7 l 4.6 2.7",  // A
    "m 0 4.3 l 2.6 4.3 a 2.6 6.15 1.85 1.85 -90 90 l 0 8 l 0 0 l 2.8 0 "
    "a 2.8 2.15 2.15 2.15 -90 90",                                             // B
    "a 2.8 4 2.8 4 48 312",                                                    // C
    "m 0 0 l 0 8 l 1.8 8 a 1.8 4 3.4 4 90 -90 l 0 0",                          // D
    "m 4.4 8 l 0 8 l 0 0 l 4.5 0 m 0 4.2 l 3.8 4.2",                           // E
    "m 4.4 8 l 0 8 l 0 0 m 0 4.2 l 3.8 4.2",                                   // F
    "a 2.8 4 2.8 4 48 345 m 3.2 3.6 l 5.55 3.6 l 5.55 0",                      // G
    "m 0 8 l 0 0 m 5 8 l 5 0 m 0 4.2 l 5 4.2",                                 // H
    "m 0.3 8 l 0.3 0",                                                         // I
    "m 3 8 l 3 2 a 1.3 2 1.7 2 0 -150",                                        // J
    "m 0 8 l 0 0 m 4.8 8 l 0 3 m 1.7 4.8 l 5 0",                               // K
    "m 0 8 l 0 0 l 4.2 0",                                                     // L
    "m 0 0 l 0 8 l 3 2.5 l 6 8 l 6 0",                                         // M
    "m 0 0 l 0 8 l 5 0 l 5 8",                                                 // N
    "a 3 4 3 4 0 360",                                                         // O
    "m 0 0 l 0 8 l 2.6 8 a 2.6 5.8 2.2 2.2 90 -90 l 0 3.6",                    // P
    "a 3 4 3 4 0 360 m 3.6 2 l 5.8 -0.4",                                      // Q
    "m 0 0 l 0 8 l 2.6 8 a 2.6 5.8 2.2 2.2 90 -90 l 0 3.6 m 2.6 3.6 l 4.9 0",  // R
    "a 2.4 5.9 2.2 2.1 30 270 a 2.4 1.9 2.5 1.9 90 -150",                      // S
    "m 0 8 l 5.4 8 m 2.7 8 l 2.7 0",                                           // T
    "m 0 8 l 0 2.6 a 2.5 2.6 2.5 2.6 180 360 l 5 8",                           // U
    "m 0 8 l 2.7 0 l 5.4 8",                                                   // V
    "m 0 8 l 2 0 l 4 8 l 6 0 l 8 8",                                           // W
    "m 0 8 l 5 0 m 5 8 l 0 0",                                                 // X
    "m 0 8 l 2.6 4 l 5.2 8 m 2.6 4 l 2.6 0",                                   // Y
    "m 0.2 8 l 5 8 l 0 0 l 5.2 0",                                             // Z
    "m 1.8 8.8 l 0.3 8.8 l 0.3 -1.6 l 1.8 -1.6",                               // [
    "m 0 8.6 l 3.4 -0.8",                                                      // backslash
    "m 0 8.8 l 1.5 8.8 l 1.5 -1.6 l 0 -1.6",                                   // ]
    "m 0.2 5.6 l 2 8 l 3.8 5.6",                                               // ^
    "m 0 -1.2 l 4.6 -1.2",                                                     // _
    "m 0.2 8 l 1.4 6.4",                                                       // `
    "m 4.4 5.5 l 4.4 0 m 4.4 2.75 a 2.2 2.75 2.2 2.75 0 360",                  // a
    "m 0 8 l 0 0 m 0 2.75 a 2.2 2.75 2.2 2.75 180 540",                        // b
    "a 2.25 2.75 2.25 2.75 42 318",                                            // c
    "m 4.4 8 l 4.4 0 m 4.4 2.75 a 2.2 2.75 2.2 2.75 0 360",                    // d
    "m 0.05 2.9 l 4.45 2.9 a 2.25 2.75 2.2 2.75 3 318",                        // e
    "m 1 0 l 1 6.4 a 2.5 6.5 1.5 1.5 180 80 m 0 5.3 l 2.5 5.3",                // f
    "m 4.4 5.5 l 4.4 -0.4 a 2.2 -0.4 2.2 2 0 -150 m 4.4 2.75 a 2.2 2.75 2.2 2.75 0 360",  // g
    "m 0 8 l 0 0 m 0 3.3 a 2.1 3.4 2.1 2.1 180 0 l 4.2 0",                                // h
    "m 0.3 0 l 0.3 5.5 m 0.3 7.6",                                                        // i
    "m 1.3 5.5 l 1.3 -0.8 a -0.1 -0.8 1.4 1.4 0 -80 m 1.3 7.6",                           // j
    "m 0 8 l 0 0 m 3.8 5.5 l 0 2.2 m 1.4 3.4 l 4 0",                                      // k
    "m 0.3 8 l 0.3 1.3 a 1.6 1.3 1.3 1.3 180 265",                                        // l
    "m 0 5.5 l 0 0 m 0 3.6 a 1.6 3.8 1.6 1.7 180 0 l 3.2 0 m 3.2 3.6 "
    "a 4.8 3.8 1.6 1.7 180 0 l 6.4 0",                                        // m
    "m 0 5.5 l 0 0 m 0 3.3 a 2.1 3.4 2.1 2.1 180 0 l 4.2 0",                  // n
    "a 2.25 2.75 2.25 2.75 0 360",                                            // o
    "m 0 5.5 l 0 -2.4 m 0 2.75 a 2.2 2.75 2.2 2.75 180 540",                  // p
    "m 4.4 5.5 l 4.4 -2.4 m 4.4 2.75 a 2.2 2.75 2.2 2.75 0 360",              // q
    "m 0 5.5 l 0 0 m 0 3.4 a 2 3.5 2 2 180 70",                               // r
    "a 1.95 4.1 1.75 1.4 35 270 a 1.95 1.35 1.95 1.35 90 -145",               // s
    "m 1 7.3 l 1 1.3 a 2.3 1.3 1.3 1.3 180 275 m 0 5.4 l 2.5 5.4",            // t
    "m 0 5.5 l 0 2.1 a 2.1 2.1 2.1 2.1 180 360 l 4.2 5.5 m 4.2 2.1 l 4.2 0",  // u
    "m 0 5.5 l 2.1 0 l 4.2 5.5",                                              // v
    "m 0 5.5 l 1.6 0 l 3.2 5.5 l 4.8 0 l 6.4 5.5",                            // w
    "m 0 5.5 l 4 0 m 4 5.5 l 0 0",                                            // x
    "m 0 5.5 l 2.2 0 m 4.4 5.5 l 1.4 -2.4",                                   // y
    "m 0.1 5.5 l 4 5.5 l 0 0 l 4.1 0",                                        // z
    "m 2 8.8 l 1.2 8.4 l 1.2 4.4 l 0.2 3.6 l 1.2 2.8 l 1.2 -1.2 l 2 -1.6",    // {
    "m 0.3 8.8 l 0.3 -1.6",                                                   // |
    "m 0.2 8.8 l 1 8.4 l 1 4.4 l 2 3.6 l 1 2.8 l 1 -1.2 l 0.2 -1.6",          // }
    "a 1.2 3.2 1 0.8 180 50 l 2.6 3 a 3.4 3.8 1 0.8 230 360",                 // ~
};
constexpr const char* unknown_glyph = "m 0 0 l 4 0 l 4 8 l 0 8 l 0 0";
constexpr double gap = 1.75, blank = 3.2, digit_width = 5;

void add_glyph(StrokeText& text, const char* pen, bool digit) {
  std::istringstream in(pen);
  const double left = text.width;
  double right = 0;
  const std::size_t first = text.strokes.size();
  const auto put = [&](double x, double y) {
    text.strokes.back().push_back({left + x, y});
    right = std::max(right, x);
  };
  char what = 0;
  while (in >> what) {
    if (what == 'm' || text.strokes.size() == first) text.strokes.emplace_back();
    double x = 0, y = 0;
    in >> x >> y;
    if (what != 'a') {
      put(x, y);
      continue;
    }
    double rx = 0, ry = 0, from = 0, to = 0;
    in >> rx >> ry >> from >> to;
    const int steps = std::max(1, static_cast<int>(std::abs(to - from) / 9));
    for (int k = 0; k <= steps; ++k) {
      constexpr double degree = 3.14159265358979323846 / 180;
      const double angle = (from + (to - from) * k / steps) * degree;
      put(x + rx * std::cos(angle), y + ry * std::sin(angle));
    }
  }
  text.width = left + (digit ? digit_width : right) + gap;
}

}  // namespace

StrokeText stroke_text(std::string_view line) {
  StrokeText text;
  for (const char c : line) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte == ' ')
      text.width += blank;
    else if (byte > ' ' && byte <= '~')
      add_glyph(text, glyphs[byte - '!'], byte >= '0' && byte <= '9');
    else if ((byte & 0xC0u) != 0x80u)  // not the rest of a character
      add_glyph(text, unknown_glyph, false);
  }
  if (text.width > 0 && !line.empty() && line.back() != ' ') text.width -= gap;
  return text;
}

}  // namespace plexway::render
