#pragma once

#include <cstddef>
#include <memory>
#include <span>

namespace plexway {

/// Distances of N vertices from each of K sources: row k is the field of source k alone, in the
/// caller's order of vertices and the domain's unit, as DistanceField::distance.
template <class Real>
class Fields {
 public:
  Fields() = default;
  /// Room for K rows of N numbers, which are not set.
  Fields(std::size_t rows, std::size_t columns)
      : values_(std::make_unique_for_overwrite<Real[]>(rows * columns)),
        rows_(rows),
        columns_(columns) {}

  [[nodiscard]] std::size_t rows() const { return rows_; }        ///< K, sources
  [[nodiscard]] std::size_t columns() const { return columns_; }  ///< N, vertices
  /// Row k, not a copy; k < rows().
  [[nodiscard]] std::span<const Real> row(std::size_t k) const {
    return {values_.get() + k * columns_, columns_};
  }
  /// To be written to.
  [[nodiscard]] std::span<Real> row(std::size_t k) {
    return {values_.get() + k * columns_, columns_};
  }
  /// All rows, one after another.
  [[nodiscard]] std::span<const Real> values() const { return {values_.get(), rows_ * columns_}; }
  /// To be written to.
  [[nodiscard]] std::span<Real> values() { return {values_.get(), rows_ * columns_}; }

  bool complete = true;  ///< false if max_expansions ended one of them early

 private:
  std::unique_ptr<Real[]> values_;
  std::size_t rows_ = 0, columns_ = 0;
};

}  // namespace plexway
