#include "file/checksum.hpp"

#include <cstring>

namespace plexway::detail::file {
namespace {

// One to one in both of its arguments, so that nothing that differs becomes the same.
std::uint64_t mixed(std::uint64_t before, std::uint64_t word) {
  const std::uint64_t product = (before ^ word) * 0x9e3779b97f4a7c15;
  return product ^ (product >> 32);
}

}  // namespace

void Checksum::add(const std::byte* bytes, std::size_t size) {
  // The processor itself fetches ahead only to the end of a page.
  constexpr std::size_t ahead = 4096;
  std::array<std::uint64_t, lanes> lane = lane_;
  for (std::size_t at = 0; at < size; at += block) {
    if (at + ahead < size) __builtin_prefetch(bytes + at + ahead);
    for (std::size_t i = 0; i < lanes; ++i) {
      std::uint64_t word;
      std::memcpy(&word, bytes + at + sizeof(word) * i, sizeof(word));
      lane[i] = mixed(lane[i], word);
    }
  }
  lane_ = lane;
}

std::uint64_t Checksum::value() const {
  std::uint64_t all = 0;
  for (const std::uint64_t one : lane_) all = mixed(all, one);
  return all;
}

}  // namespace plexway::detail::file
