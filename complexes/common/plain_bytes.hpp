#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

/// What a caller and its helper say to each other: plain values and rows of them, as they lie in
/// memory. Both are of one build, on one machine.
namespace plexway::detail::isolated {

/// Where a helper's answer goes.
constexpr int to_caller = 3;
/// What a helper returns that is of another version than its caller.
constexpr int helper_is_foreign = 65;

class BytesOut {
 public:
  template <class Plain>
  void put(const Plain& value) {
    static_assert(std::is_trivially_copyable_v<Plain>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <class Plain>
  void put_row(const Plain* values, std::size_t count) {
    static_assert(std::is_trivially_copyable_v<Plain>);
    put(static_cast<std::uint64_t>(count));
    if (count > 0) bytes_.append(reinterpret_cast<const char*>(values), count * sizeof(Plain));
  }
  template <class Row>
  void put_row(const Row& row) {
    put_row(row.data(), row.size());
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// Each returns false where the bytes end too soon.
class BytesIn {
 public:
  explicit BytesIn(std::string_view bytes) : rest_(bytes) {}

  template <class Plain>
  bool get(Plain& value) {
    static_assert(std::is_trivially_copyable_v<Plain>);
    if (rest_.size() < sizeof value) return false;
    std::memcpy(&value, rest_.data(), sizeof value);
    rest_.remove_prefix(sizeof value);
    return true;
  }
  template <class Row>
  bool get_row(Row& row) {
    using Plain = typename Row::value_type;
    static_assert(std::is_trivially_copyable_v<Plain>);
    std::uint64_t count = 0;
    if (!get(count) || rest_.size() / sizeof(Plain) < count) return false;
    row.resize(count);
    if (count > 0) std::memcpy(row.data(), rest_.data(), count * sizeof(Plain));
    rest_.remove_prefix(count * sizeof(Plain));
    return true;
  }

 private:
  std::string_view rest_;
};

}  // namespace plexway::detail::isolated
