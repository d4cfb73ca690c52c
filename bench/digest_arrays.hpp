#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <map>
#include <string>
#include <vector>

/// Files of named arrays, and how two of them differ.
namespace digest {

/// An array: its name, then integers or floating-point numbers, widened to 64 bits.
struct Array {
  std::string name;
  std::uint32_t bytes_each = 0;  // 0: integers
  std::vector<std::uint64_t> bits;
};

/// Writes arrays to a file, each under the name of what was entered last.
class Writer {
 public:
  explicit Writer(const std::string& file) : out_(file, std::ios::binary) {}

  void enter(std::string name) { prefix_ = std::move(name); }
  template <class Make>
  void integers(const char* name, std::size_t count, Make make) {
    Array a{prefix_ + " " + name, 0, {}};
    for (std::size_t i = 0; i < count; ++i) a.bits.push_back(static_cast<std::uint64_t>(make(i)));
    write(a);
  }
  template <class Real, class Make>
  void numbers(const char* name, std::size_t count, Make make) {
    Array a{prefix_ + " " + name, sizeof(Real), {}};
    for (std::size_t i = 0; i < count; ++i) {
      const Real value = make(i);
      if constexpr (sizeof(Real) == 4)
        a.bits.push_back(std::bit_cast<std::uint32_t>(value));
      else
        a.bits.push_back(std::bit_cast<std::uint64_t>(value));
    }
    write(a);
  }
  void text(const std::string& what) {
    integers("text", what.size(), [&](std::size_t i) { return what[i]; });
    std::printf("%s: %s\n", prefix_.c_str(), what.c_str());
  }

 private:
  void write(const Array& a) {
    const std::uint64_t head[3] = {a.name.size(), a.bytes_each, a.bits.size()};
    out_.write(reinterpret_cast<const char*>(head), sizeof head);
    out_.write(a.name.data(), static_cast<std::streamsize>(a.name.size()));
    out_.write(reinterpret_cast<const char*>(a.bits.data()),
               static_cast<std::streamsize>(8 * a.bits.size()));
  }
  std::ofstream out_;
  std::string prefix_;
};

inline bool read(std::ifstream& in, Array& a) {
  std::uint64_t head[3];
  if (!in.read(reinterpret_cast<char*>(head), sizeof head)) return false;
  a.name.resize(head[0]);
  a.bytes_each = static_cast<std::uint32_t>(head[1]);
  a.bits.resize(head[2]);
  in.read(a.name.data(), static_cast<std::streamsize>(head[0]));
  in.read(reinterpret_cast<char*>(a.bits.data()), static_cast<std::streamsize>(8 * head[2]));
  return static_cast<bool>(in);
}

/// How many numbers of their precision lie between two.
inline std::uint64_t apart(std::uint64_t a, std::uint64_t b, std::uint32_t bytes) {
  const auto place = [&](std::uint64_t bits) {
    const std::uint64_t sign = std::uint64_t{1} << (8 * bytes - 1);
    return bits & sign ? -static_cast<std::int64_t>(bits & ~sign) : static_cast<std::int64_t>(bits);
  };
  const std::int64_t p = place(a), q = place(b);
  return static_cast<std::uint64_t>(p > q ? p - q : q - p);
}

inline int compare(const std::string& old_file, const std::string& new_file) {
  std::ifstream a(old_file, std::ios::binary), b(new_file, std::ios::binary);
  struct Sum {
    std::size_t arrays = 0, items = 0, differ = 0;
    std::uint64_t most = 0;
    double largest = 0;
    std::string where;
  };
  std::map<std::string, Sum> by_kind;
  Array x, y;
  std::size_t other = 0;
  for (;;) {
    const bool more = read(a, x);
    if (more != read(b, y)) {
      std::printf("one file ends before the other\n");
      return 1;
    }
    if (!more) break;
    if (x.name != y.name || x.bits.size() != y.bits.size()) {
      std::printf("%s of %zu beside %s of %zu\n", x.name.c_str(), x.bits.size(), y.name.c_str(),
                  y.bits.size());
      if (x.name != y.name) return 1;
      ++other;
      continue;
    }
    // Refinement takes the largest triangle next: a rounding error leads to other vertices.
    const std::string kind = (x.name.find(" refined ") != x.name.npos ? "refined: " : "") +
                             x.name.substr(x.name.rfind(' ') + 1) +
                             (x.bytes_each == 4   ? " float"
                              : x.bytes_each == 8 ? " double"
                                                  : "");
    Sum& sum = by_kind[kind];
    ++sum.arrays;
    sum.items += x.bits.size();
    std::size_t differ = 0;
    std::uint64_t most = 0;
    for (std::size_t i = 0; i < x.bits.size(); ++i) {
      if (x.bits[i] == y.bits[i]) continue;
      ++differ;
      if (x.bytes_each == 0) continue;
      const auto value = [&](std::uint64_t bits) {
        return x.bytes_each == 4 ? std::bit_cast<float>(static_cast<std::uint32_t>(bits))
                                 : std::bit_cast<double>(bits);
      };
      const double gap = std::abs(value(x.bits[i]) - value(y.bits[i]));
      if (!(gap <= sum.largest)) sum.largest = gap;
      const std::uint64_t units = apart(x.bits[i], y.bits[i], x.bytes_each);
      most = std::max(most, units);
      if (units > sum.most) sum.most = units, sum.where = x.name;
    }
    if (differ > 0 && (x.bytes_each == 0 || most > 1))
      std::printf("%s: %zu of %zu differ, by %llu units at most\n", x.name.c_str(), differ,
                  x.bits.size(), static_cast<unsigned long long>(most));
    sum.differ += differ;
  }
  bool same = other == 0;
  for (const auto& [kind, sum] : by_kind) {
    std::printf("%-26s %6zu arrays %10zu items %8zu differ", kind.c_str(), sum.arrays, sum.items,
                sum.differ);
    if (sum.most > 0)
      std::printf(", by %llu units at most (%s), %.1e", static_cast<unsigned long long>(sum.most),
                  sum.where.c_str(), sum.largest);
    std::printf("\n");
    same = same && sum.differ == 0;
  }
  return same ? 0 : 1;
}

}  // namespace digest
