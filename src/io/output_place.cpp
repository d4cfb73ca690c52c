#include "io/output_place.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <vector>

#include <plexway/error.hpp>

#include "file/new_file.hpp"
#include "file/standard_output.hpp"
#include "io/did_you_mean.hpp"
#include "io/extension.hpp"

namespace plexway::io {
namespace {

namespace fs = std::filesystem;

// TetGen's files come in pairs: writing one writes the other, and reading a .poly may read both.
std::vector<fs::path> files_of(const fs::path& name) {
  std::vector<fs::path> files = {name};
  const std::string own = name.extension().string();
  const bool pair = own == ".node" || own == ".ele";
  if (pair) files.push_back(fs::path(name).replace_extension(".ele"));
  if (pair || own == ".poly" || own == ".smesh")
    files.push_back(fs::path(name).replace_extension(".node"));
  return files;
}

// And those that writing one makes.
std::vector<fs::path> written_files_of(const fs::path& name) {
  const std::string own = name.extension().string();
  return own == ".node" || own == ".ele" ? files_of(name) : std::vector<fs::path>{name};
}

// Where it lies once all links are followed, be there a file or not.
fs::path place_of(const fs::path& name) {
  try {
    return fs::weakly_canonical(fs::absolute(file::end_of_links(name)));
  } catch (const std::system_error&) {
    return name.lexically_normal();  // who writes it will say what is wrong
  }
}

bool one_file(const fs::path& a, const fs::path& b) {
  if (on_standard_output(a.string()) || on_standard_output(b.string()))
    return on_standard_output(a.string()) && on_standard_output(b.string());
  std::error_code error;
  return place_of(a) == place_of(b) || fs::equivalent(a, b, error);
}

}  // namespace

bool on_standard_output(const std::string& out) {
  return out == "-" || !file::format_on_standard_output(out).empty();
}

void check_output_place(const std::string& out, std::span<const std::string> inputs,
                        const char* option) {
  if (out.empty()) return;
  if (on_standard_output(out)) {
    // Two files, or written by a library that goes back in its file.
    for (const std::string_view whole : {".node", ".ele", ".pcd", ".vdb", ".npz", ".mtx"})
      if (lower_extension(out) == whole)
        throw UsageError(std::string(option) + " " + out + ": a " + std::string(whole) +
                         " does not go to standard output");
    return;
  }
  std::error_code error;
  for (const fs::path& written : files_of(out))
    for (const std::string& input : inputs)
      for (const fs::path& read : files_of(input))
        if (fs::equivalent(written, read, error))
          throw UsageError(std::string(option) + " " + out + ": would overwrite " + read.string() +
                           ", which the input needs");
  const fs::path folder =
      fs::path(out).has_parent_path() ? fs::path(out).parent_path() : fs::path(".");
  if (!fs::is_directory(folder, error))
    throw Error("cannot write " + out + ": there is no folder " + folder.string());
  if (fs::is_directory(out, error)) throw Error("cannot write " + out + ": it is a directory");
}

void check_output_name(const std::string& out, const std::string& input,
                       std::span<const std::string_view> known, const char* option) {
  if (out.empty()) return;
  const fs::path file = out;
  const std::string extension = io::lower_extension(file);
  if (std::find(known.begin(), known.end(), extension) == known.end()) {
    std::string names;
    for (const std::string_view name : known) names.append(" ").append(name);
    throw UsageError(std::string(option) + " " + out + ": " +
                     (extension.empty() ? "the extension is missing"
                                        : "unknown extension" + did_you_mean(extension, known)) +
                     "; those written are" + names);
  }
  check_output_place(out, {&input, 1}, option);
}

void check_outputs_differ(std::initializer_list<std::string> names) {
  const std::vector<std::string> all(names);
  for (auto a = all.begin(); a != all.end(); ++a) {
    if (a->empty()) continue;
    for (auto b = all.begin(); b != a; ++b)
      for (const fs::path& one : written_files_of(*a))
        for (const fs::path& other : written_files_of(*b))
          if (!b->empty() && one_file(one, other))
            throw UsageError(*a + ": two results would go into this one file" +
                             (*a == *b ? "" : ", the other as " + *b));
  }
}

}  // namespace plexway::io
