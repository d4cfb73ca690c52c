#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace plexway::io {

/// The extension of `file` with its dot, ascii letters in lower case; of "ply:-", standard output
/// as a .ply, ".ply".
std::string lower_extension(const std::filesystem::path& file);

/// "FILE: unknown extension '.xyz'; known are .a .b"
std::string unknown_extension(const std::filesystem::path& file,
                              std::span<const std::string_view> known);

}  // namespace plexway::io
