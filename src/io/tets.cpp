#include <plexway/io/tets.hpp>

#include <string>

#include <plexway/error.hpp>

#include "by_extension.hpp"
#include "input_name.hpp"

namespace plexway::io {
namespace {

namespace fs = std::filesystem;

using TetParser = Tets (*)(std::string_view, std::string_view);

constexpr std::array<std::string_view, 6> tet_suffixes = {".node", ".ele", ".mesh",
                                                          ".msh",  ".vtu", ".vtk"};
/// In the order of the extensions; a pair of files is none of these.
constexpr std::array<TetParser, 6> tet_parsers = {nullptr,    nullptr,   parse_medit,
                                                  parse_gmsh, parse_vtu, parse_vtk};

/// The file beside `file` that makes it whole; its extension may be in capitals.
fs::path partner(fs::path file, std::string_view lower, std::string_view upper) {
  std::error_code ignored;
  const fs::path other = file.replace_extension(lower);
  if (fs::exists(other, ignored)) return other;
  return fs::exists(file.replace_extension(upper), ignored) ? file : other;
}

Tets read_node_ele(const fs::path& file, bool is_node) {
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

}  // namespace

std::span<const std::string_view> tet_extensions() { return tet_suffixes; }

Tets read_tets(const fs::path& file) {
  const std::string extension = InputName(file).extension;
  if (extension == ".node" || extension == ".ele") return read_node_ele(file, extension == ".node");
  std::error_code ignored;
  if (extension == ".meshb" && !fs::is_directory(file, ignored))
    throw InputError(file.string() + ": binary .meshb is not read; save it as ascii .mesh");
  return read_by_extension<Tets>(file, tet_suffixes, tet_parsers);
}

}  // namespace plexway::io
