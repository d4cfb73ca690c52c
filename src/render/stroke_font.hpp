#pragma once

#include <array>
#include <string_view>
#include <vector>

namespace plexway::render {

/// Lettering made of strokes. Capitals and digits are 8 units high, y points up from the baseline.
struct StrokeText {
  std::vector<std::vector<std::array<double, 2>>> strokes;  ///< polylines; one point is a dot
  double width = 0;                                         ///< units
};

/// A line of text from (0, 0). Printable ASCII; a frame stands for any other byte, once for all the
/// bytes of a character in UTF-8. Digits are all of one width.
StrokeText stroke_text(std::string_view text);

}  // namespace plexway::render
