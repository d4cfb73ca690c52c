#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "extension.hpp"
#include "file_bytes.hpp"

namespace plexway::io {

/// A file to be read: its bytes, when they are requested, and unpacked where they are gzip's.
class OpenedFile {
 public:
  explicit OpenedFile(const std::filesystem::path& file);

  /// As given, for messages.
  [[nodiscard]] const std::string& name() const { return name_; }
  /// With its dot, in lower case, without .gz behind it.
  [[nodiscard]] const std::string& extension() const { return input_.extension; }
  [[nodiscard]] bool is_standard_input() const { return input_.standard_input; }
  /// Throws InputError as FileBytes, and NotBuiltError without zlib for what is packed.
  [[nodiscard]] std::string_view bytes() const;

 private:
  std::string name_;
  InputName input_;
  mutable std::optional<FileBytes> bytes_;
  mutable std::string unpacked_;
};

}  // namespace plexway::io
