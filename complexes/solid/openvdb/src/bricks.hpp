#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <unordered_map>
#include <vector>

namespace plexway::openvdb {

using Vector = std::array<double, 3>;
using Cell = std::array<std::int32_t, 3>;

/// Takes bricks one by one, dense (512 values) or, with a null pointer, inside as a whole.
using BrickTaker = std::function<void(const Cell& corner, const float* values)>;

/// Bricks of 8 x 8 x 8, found by their corner over 8.
class BrickNumbers {
 public:
  static constexpr std::uint32_t none = ~std::uint32_t{0};
  /// Corners lie in (-far, far).
  static constexpr std::int32_t far = 1 << 20;
  /// Bricks inside as a whole that a level set may have: 2^31 voxels.
  static constexpr std::size_t most_inside = std::size_t{1} << 22;

  /// Whether a corner lies in range, and those around it do.
  [[nodiscard]] static bool in_range(const Cell& corner) {
    for (const std::int32_t c : corner)
      if (c <= -far + 2 || c >= far - 2) return false;
    return true;
  }
  [[nodiscard]] std::uint32_t find(const Cell& corner) const {
    const auto at = numbers_.find(key(corner));
    return at == numbers_.end() ? none : at->second;
  }
  /// Numbers count up from 0; the second is false where it was there.
  std::pair<std::uint32_t, bool> add(const Cell& corner) {
    const auto [at, fresh] =
        numbers_.try_emplace(key(corner), static_cast<std::uint32_t>(corners_.size()));
    if (fresh) corners_.push_back(corner);
    return {at->second, fresh};
  }
  [[nodiscard]] const std::vector<Cell>& corners() const { return corners_; }
  [[nodiscard]] std::size_t size() const { return corners_.size(); }

 private:
  static std::uint64_t key(const Cell& corner) {
    std::uint64_t packed = 0;
    for (const std::int32_t c : corner) packed = packed << 21 | static_cast<std::uint64_t>(c + far);
    return packed;
  }
  struct Mix {
    std::size_t operator()(std::uint64_t key) const {
      key = (key ^ (key >> 31)) * 0x9E3779B97F4A7C15u;
      return static_cast<std::size_t>(key ^ (key >> 29));
    }
  };
  std::unordered_map<std::uint64_t, std::uint32_t, Mix> numbers_;
  std::vector<Cell> corners_;
};

/// An affine map from index space to the world.
struct Frame {
  std::array<Vector, 3> axes = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  ///< of one voxel
  Vector origin = {0, 0, 0};

  [[nodiscard]] Vector to_world(const Vector& p) const {
    Vector at = origin;
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t k = 0; k < 3; ++k) at[k] += p[a] * axes[a][k];
    return at;
  }
  [[nodiscard]] Vector to_index(const Vector& world) const;
  [[nodiscard]] double determinant() const {
    const auto& [a, b, c] = axes;
    return (a[1] * b[2] - a[2] * b[1]) * c[0] + (a[2] * b[0] - a[0] * b[2]) * c[1] +
           (a[0] * b[1] - a[1] * b[0]) * c[2];
  }
};

/// What a level set is made of: bricks of values, and bricks that lie inside as a whole. Where
/// there is no brick is outside.
struct Bricks {
  static constexpr std::uint32_t inside = ~std::uint32_t{0};

  Frame frame;
  float background = 0;
  std::string name;
  std::size_t active = 0;
  BrickNumbers numbers;
  std::vector<std::uint32_t> block;  ///< of a brick: its place in values, over 512; or `inside`
  std::vector<float> values;         ///< x the slowest, as OpenVDB has it

  static constexpr std::size_t offset(std::int32_t x, std::int32_t y, std::int32_t z) {
    return static_cast<std::size_t>((x & 7) << 6 | (y & 7) << 3 | (z & 7));
  }
  /// Adds a brick of 512 values, or one that is inside.
  void add(const Cell& corner, const float* from);
  void add_inside(const Cell& corner);
};

/// Looks values up, quickly where they lie together.
class Lookup {
 public:
  explicit Lookup(const Bricks& bricks) : bricks_(bricks) {}

  [[nodiscard]] float voxel(std::int32_t x, std::int32_t y, std::int32_t z) {
    const Cell corner = {x >> 3, y >> 3, z >> 3};
    if (corner != corner_) {
      corner_ = corner;
      const std::uint32_t number = bricks_.numbers.find(corner);
      whole_ = number == BrickNumbers::none ? bricks_.background : -bricks_.background;
      const bool has_values =
          number != BrickNumbers::none && bricks_.block[number] != Bricks::inside;
      values_ = has_values ? &bricks_.values[std::size_t{bricks_.block[number]} * 512] : nullptr;
    }
    return values_ == nullptr ? whole_ : values_[Bricks::offset(x, y, z)];
  }

  /// Linear between voxels.
  [[nodiscard]] double at(const Vector& p);

 private:
  const Bricks& bricks_;
  Cell corner_ = {INT32_MIN, 0, 0};
  const float* values_ = nullptr;
  float whole_ = 0;
};

}  // namespace plexway::openvdb
