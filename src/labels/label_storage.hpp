#pragma once

#include <cstddef>
#include <memory>

namespace plexway {

/// Room for one label a simplex, allocated without being touched.
template <class Label>
struct LabelStorage {
  std::unique_ptr<Label[]> labels;
  std::size_t count = 0;

  Label* reserve(std::size_t simplices) {
    if (count != simplices) {
      labels = std::make_unique_for_overwrite<Label[]>(simplices);
      count = simplices;
    }
    return labels.get();
  }
  [[nodiscard]] std::size_t bytes() const { return count * sizeof(Label); }
};

}  // namespace plexway
