#include "cli/report/distance_output.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <filesystem>
#include <system_error>
#include <vector>

#include <plexway/error.hpp>

#include "cli/report/console.hpp"
#include "file/new_file.hpp"
#include "file/standard_output.hpp"
#include "io/did_you_mean.hpp"
#include "io/extension.hpp"

namespace plexway::cli {
namespace {

namespace fs = std::filesystem;

template <class Number>
void append(std::string& text, Number value) {
  char digits[32];
  const auto result = std::to_chars(digits, digits + sizeof digits, value);
  text.append(digits, result.ptr);
}

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

void add_output(CLI::App& command, const std::string& name, std::string& out,
                const std::string& help, const char* usual) {
  const std::string on_output = std::string(usual) + ":-";
  command.add_option(name, out, help)
      ->type_name("FILE")
      ->transform(
          [on_output](const std::string& given) { return given == "-" ? on_output : given; });
}

bool on_standard_output(const std::string& out) {
  return out == "-" || !file::format_on_standard_output(out).empty();
}

void check_output_place(const std::string& out, std::span<const std::string> inputs,
                        const char* option) {
  if (out.empty()) return;
  if (on_standard_output(out)) {
    // Two files, or written by a library that goes back in its file.
    for (const std::string_view whole : {".node", ".ele", ".pcd", ".vdb", ".npz", ".mtx"})
      if (io::lower_extension(out) == whole)
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
    throw UsageError(std::string(option) + " " + out + ": unknown extension" +
                     io::did_you_mean(extension, known) + "; those written are" + names);
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

void write_distance_csv(std::span<const double> distance, std::span<const std::int32_t> label,
                        std::span<const std::uint32_t> original, std::span<const double> error) {
  std::string text = "vertex,distance";
  if (!label.empty()) text += ",label";
  if (!original.empty()) text += ",original";
  if (!error.empty()) text += ",error";
  text += '\n';
  for (std::size_t v = 0; v < distance.size(); ++v) {
    append(text, v);
    text += ',';
    append(text, distance[v]);
    if (!label.empty()) {
      text += ',';
      append(text, label[v]);
    }
    if (!original.empty()) {
      text += ',';
      append(text, original[v]);
    }
    if (!error.empty()) {
      text += ',';
      append(text, error[v]);
    }
    text += '\n';
    if (text.size() < (std::size_t{1} << 16)) continue;
    write_output(text);
    text.clear();
  }
  write_output(text);
  flush_output();
}

}  // namespace plexway::cli
