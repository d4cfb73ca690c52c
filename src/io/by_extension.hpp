#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include <plexway/error.hpp>

#include "extension.hpp"
#include "file_bytes.hpp"
#include "input_name.hpp"

namespace plexway::io {

/// Reads `file` with the parser whose place is that of its extension. Throws InputError for a
/// directory, an unknown extension, and what the parser does.
template <class Shape, std::size_t N>
Shape read_by_extension(
    const std::filesystem::path& file, const std::array<std::string_view, N>& extensions,
    const std::array<Shape (*)(std::string_view, std::string_view), N>& parsers) {
  const std::string extension = InputName(file).extension;
  for (std::size_t i = 0; i < N; ++i) {
    if (extension != extensions[i]) continue;
    const FileBytes bytes(file);
    return parsers[i](bytes.view(), file.string());
  }
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored))
    throw InputError(file.string() + ": is a directory, not a file");
  throw InputError(unknown_extension(file, extensions));
}

}  // namespace plexway::io
