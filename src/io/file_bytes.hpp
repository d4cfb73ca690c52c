#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string_view>

namespace plexway::io {

/// All bytes of a file, in memory.
class FileBytes {
 public:
  /// Throws InputError "FILE: cause" when it is missing, a directory, empty or not readable.
  explicit FileBytes(const std::filesystem::path& file);

  std::string_view view() const { return {bytes_.get(), size_}; }

 private:
  std::unique_ptr<char[]> bytes_;
  std::size_t size_ = 0;
};

}  // namespace plexway::io
