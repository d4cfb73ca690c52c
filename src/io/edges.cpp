#include <plexway/io/edges.hpp>

#include <string>

#include <plexway/error.hpp>

#include "extension.hpp"
#include "file_bytes.hpp"

namespace plexway::io {
namespace {

using Parser = Edges (*)(std::string_view, std::string_view);

constexpr std::array<std::string_view, 2> extensions = {".obj", ".edges"};
constexpr std::array<Parser, 2> parsers = {parse_obj_lines, parse_edge_list};

}  // namespace

std::span<const std::string_view> edge_extensions() { return extensions; }

Edges read_edges(const std::filesystem::path& file) {
  const std::string extension = lower_extension(file);
  for (std::size_t i = 0; i < extensions.size(); ++i) {
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
