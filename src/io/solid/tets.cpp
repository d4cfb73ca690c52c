#include <plexway/io/tets.hpp>

#include <array>
#include <string>

#include <plexway/error.hpp>

#include "io/extension.hpp"
#include "io/file_bytes.hpp"
#include "io/readers.hpp"

namespace plexway::io {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 6> extensions = {".node", ".ele", ".mesh",
                                                        ".msh",  ".vtu", ".vtk"};

/// The file beside `file` that makes it whole; its extension may be in capitals.
fs::path partner(fs::path file, std::string_view lower, std::string_view upper) {
  std::error_code ignored;
  const fs::path other = file.replace_extension(lower);
  if (fs::exists(other, ignored)) return other;
  return fs::exists(file.replace_extension(upper), ignored) ? file : other;
}

}  // namespace

Tets read_node_ele(const fs::path& file) {
  const bool is_node = lower_extension(file) == ".node";
  const FileBytes given(file);
  const fs::path other = is_node ? partner(file, ".ele", ".ELE") : partner(file, ".node", ".NODE");
  std::error_code ignored;
  if (!fs::exists(other, ignored))
    throw InputError(file.string() + ": holds only the " +
                     (is_node ? "vertices; the tetrahedra" : "tetrahedra; the vertices") +
                     " must lie beside it in " + other.string());
  const FileBytes second(other);
  const std::string given_name = file.string();
  const std::string other_name = other.string();
  const NamedText a{given.view(), given_name};
  const NamedText b{second.view(), other_name};
  return is_node ? parse_node_ele(a, b) : parse_node_ele(b, a);
}

std::span<const std::string_view> tet_extensions() { return extensions; }

}  // namespace plexway::io
