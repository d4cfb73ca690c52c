#include "io/names.hpp"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <system_error>
#include <vector>

#include <plexway/error.hpp>

#include "file/new_file.hpp"

namespace plexway::io {

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = lower_case(c);
  return lower;
}

std::string lower_extension(const std::filesystem::path& file) {
  const std::string name = file.string();
  if (const auto format = plexway::detail::file::format_on_standard_output(name); !format.empty())
    return std::string(1, '.').append(format);
  return lower_case(file.extension().string());
}

std::string unknown_extension(const std::filesystem::path& file,
                              std::span<const std::string_view> known) {
  const bool stream = !plexway::detail::file::format_on_standard_output(file.string()).empty();
  const std::string extension = stream ? lower_extension(file) : file.extension().string();
  std::string message = file.string() + ": ";
  message += extension.empty() ? "no extension" : "unknown extension " + quote(extension);
  message += did_you_mean(extension, known);
  message += message.ends_with('?') ? " known are" : "; known are";
  for (const auto name : known) message.append(" ").append(name);
  return message;
}

InputName::InputName(const std::filesystem::path& given)
    : file(given), extension(lower_extension(given)) {
  std::error_code ignored;
  if (std::filesystem::exists(given, ignored)) return;
  const std::string name = given.string();
  // Of one letter it would be a drive.
  if (const auto colon = name.find(':'); colon != name.npos && colon >= 2 && colon <= 8) {
    const bool is_format =
        std::all_of(name.begin(), name.begin() + static_cast<std::ptrdiff_t>(colon),
                    [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'); });
    if (is_format && colon + 1 < name.size()) {
      extension.assign(1, '.').append(name, 0, colon);
      file = name.substr(colon + 1);
    }
  }
  standard_input = file == "-" && !std::filesystem::exists(file, ignored);
}

namespace {

// Letters to change, add, drop or swap with the next: the restricted Damerau-Levenshtein distance.
std::size_t slips_between(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), row(b.size() + 1), next(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    next[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower_case(a[i - 1]) == lower_case(b[j - 1]);
      next[j] = std::min({row[j - 1] + (same ? 0 : 1), row[j] + 1, next[j - 1] + 1});
      if (i > 1 && j > 1 && lower_case(a[i - 1]) == lower_case(b[j - 2]) &&
          lower_case(a[i - 2]) == lower_case(b[j - 1]))
        next[j] = std::min(next[j], before[j - 2] + 1);
    }
    before.swap(row);
    row.swap(next);
  }
  return row[b.size()];
}

}  // namespace

std::string did_you_mean(std::string_view word, std::span<const std::string_view> known) {
  constexpr std::size_t longest = 64;
  if (word.size() > longest) return "";
  const auto letters = [](std::string_view of) {
    return static_cast<std::size_t>(
        std::count_if(of.begin(), of.end(), [](char c) { return c != '-' && c != '.'; }));
  };
  std::string_view best;
  std::size_t least = std::max<std::size_t>(letters(word) / 3, 1) + 1;
  for (const std::string_view one : known) {
    if (one.size() > longest || letters(one) < 2) continue;
    const std::size_t slips = slips_between(word, one);
    if (slips >= least || slips >= letters(one)) continue;
    least = slips;
    best = one;
  }
  if (best.empty() || letters(word) == 0) return "";
  return std::string("; did you mean '").append(best).append("'?");
}

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
    return fs::weakly_canonical(fs::absolute(plexway::detail::file::end_of_links(name)));
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
  return out == "-" || !plexway::detail::file::format_on_standard_output(out).empty();
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
