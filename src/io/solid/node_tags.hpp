#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <vector>

namespace plexway::io {

/// The numbers a file gives its vertices, to be looked up. Those that count on from the first, as
/// nearly all do, take no search.
class NodeTags {
 public:
  void reserve(std::size_t count) { tags_.reserve(count); }
  void add(std::int64_t tag) { tags_.push_back(tag); }
  std::size_t size() const { return tags_.size(); }

  /// To be called when all are added; a tag that occurs twice, if there is one.
  std::optional<std::int64_t> finish() {
    consecutive_ = true;
    for (std::size_t i = 1; i < tags_.size() && consecutive_; ++i)
      consecutive_ = tags_[i] > tags_[i - 1] && tags_[i] - 1 == tags_[i - 1];
    if (consecutive_) return std::nullopt;
    order_.resize(tags_.size());
    std::iota(order_.begin(), order_.end(), 0U);
    const auto tag = [&](std::uint32_t i) { return tags_[i]; };
    std::sort(order_.begin(), order_.end(),
              [&](std::uint32_t a, std::uint32_t b) { return tag(a) < tag(b); });
    for (std::size_t i = 1; i < order_.size(); ++i)
      if (tag(order_[i]) == tag(order_[i - 1])) return tag(order_[i]);
    return std::nullopt;
  }

  /// The place of the vertex with this tag in the file.
  std::optional<std::uint32_t> find(std::int64_t tag) const {
    if (tags_.empty()) return std::nullopt;
    if (consecutive_) {
      if (tag < tags_.front() || tag > tags_.back()) return std::nullopt;
      return static_cast<std::uint32_t>(tag - tags_.front());
    }
    const auto at =
        std::lower_bound(order_.begin(), order_.end(), tag,
                         [&](std::uint32_t i, std::int64_t value) { return tags_[i] < value; });
    if (at == order_.end() || tags_[*at] != tag) return std::nullopt;
    return *at;
  }

 private:
  std::vector<std::int64_t> tags_;
  std::vector<std::uint32_t> order_;  ///< sorted by tag; empty when consecutive
  bool consecutive_ = false;
};

}  // namespace plexway::io
