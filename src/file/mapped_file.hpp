#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

namespace plexway::detail::file {

/// The bytes of a file where the system keeps them: nothing is copied, and processes that map the
/// same file share them. They may only be read. A file that is replaced by another (NewFile) stays
/// as it was here; one that is cut short while it is mapped ends the process by a signal, as the
/// system has it.
class MappedFile {
 public:
  /// Throws InputError "FILE: cause" if it is missing, no regular file, empty or not readable.
  explicit MappedFile(const std::filesystem::path& file);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  /// All of them, from the start of a page.
  [[nodiscard]] std::span<const std::byte> bytes() const { return {start_, size_}; }

 private:
  const std::byte* start_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace plexway::detail::file
