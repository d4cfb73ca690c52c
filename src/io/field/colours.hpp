#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace plexway::io {

using Rgb = std::array<std::uint8_t, 3>;

/// Of cells, such that neighbours can be distinguished.
inline constexpr std::array<Rgb, 8> cell_colours = {{{119, 170, 221},
                                                     {238, 136, 102},
                                                     {238, 221, 136},
                                                     {68, 187, 153},
                                                     {255, 170, 187},
                                                     {153, 221, 255},
                                                     {187, 204, 51},
                                                     {190, 170, 220}}};
inline constexpr Rgb unreached_grey = {128, 128, 128};

/// 256 colours in sRGB from dark to light, lightness growing evenly: equal steps of the value look
/// equally far apart, in grey print and to the colour-blind too.
///
/// viridis and magma are by S. van der Walt and N. Smith (matplotlib 1.5, CC0), cividis by J.
/// Nunez, C. Anderton and R. Renslow (PLOS ONE 13(7), 2018, CC0): 33 colours of each, straight
/// lines between them, 2 of 255 off at most (cividis 6).
class ColourMap {
 public:
  /// Throws UsageError for a name that is not among `names()`.
  explicit ColourMap(std::string_view name = "viridis");
  static std::span<const std::string_view> names();

  /// The colour of `value` between 0 and `largest`; grey when it is not finite.
  [[nodiscard]] Rgb operator()(double value, double largest) const;
  [[nodiscard]] const std::array<Rgb, 256>& table() const { return table_; }

 private:
  std::array<Rgb, 256> table_{};
};

/// Round numbers along a scale.
struct Ticks {
  double step = 1;                 ///< 1, 2 or 5 times a power of ten
  std::vector<double> at;          ///< multiples of it, within the scale
  std::vector<std::string> label;  ///< with as many digits as tell them apart

  /// A step for isolines: a quarter or a fifth of `step`, round as well.
  [[nodiscard]] double fine_step() const;
};

/// About `wanted` of them between low and high, low < high, both finite.
Ticks ticks(double low, double high, std::size_t wanted);

}  // namespace plexway::io
