// Argument lines: whole runs of the tool on small files in a folder of its own. Two bytes a word:
// mostly options, names and values that there are, now and then any bytes.

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <vector>

#include "fuzz_named_file.hpp"
#include "tool/app.hpp"

namespace fuzz_arguments {

namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A folder that is the current one, with files to work on; all else goes away after each run.
class Sandbox {
 public:
  Sandbox() : folder_(fs::temp_directory_path() / ("plexway-lines-" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
    fs::current_path(folder_);
    files_ = {
        {"square.off",
         "OFF\n5 4 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n.5 .4 .1\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n"},
        {"apart.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 0 0\nv 6 0 0\nv 5 1 0\nf 1 2 3\nf 4 5 6\n"},
        {"two.mesh",
         "MeshVersionFormatted 2\nDimension 3\nVertices\n5\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
         "1 1 1 0\nTetrahedra\n2\n1 2 3 4 0\n2 3 4 5 0\nEnd\n"},
        {"wires.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 2 1 0\nl 1 2\nl 2 3\nl 3 4\n"},
        {"cloud.xyz",
         "0 0 0\n1 0 0\n0 1 0\n1 1 0\n.5 .5 0\n2 0 0\n2 1 0\n0 2 0\n1 2 0\n2 2 0\n.5 1.5 0\n"},
        {"numbers.txt", "0\n1\n2\n"},
        {"speeds.txt", "1\n2\n1\n1\n"},
        {"broken.ply", "ply\nformat ascii 1.0\nelement vertex 3\n"}};
    for (const auto& [name, text] : files_) std::ofstream(name, std::ios::binary) << text;
  }
  ~Sandbox() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  /// Nothing that was read has changed, unless it was named as an output, too, and nothing was
  /// left unfinished.
  void check_and_clear() {
    for (const auto& entry : fs::recursive_directory_iterator(folder_))
      fuzz::require(entry.path().string().find(".plexway-part") == std::string::npos,
                    "no file is left unfinished");
    for (const auto& [name, text] : files_)
      fuzz::require(text_of(folder_ / name) == text, "what is read stays as it is");
    for (const auto& entry : fs::directory_iterator(folder_))
      if (!files_.contains(entry.path().filename().string())) fs::remove_all(entry.path());
  }

 private:
  fs::path folder_;
  std::map<std::string, std::string> files_;
};

/// What a run writes to a standard stream.
class Caught {
 public:
  explicit Caught(std::FILE* stream) : stream_(stream), memory_(::memfd_create("caught", 0)) {
    std::fflush(stream);
    before_ = ::dup(::fileno(stream));
    ::dup2(memory_, ::fileno(stream));
  }
  std::string end() {
    std::fflush(stream_);
    ::dup2(before_, ::fileno(stream_));
    ::close(before_);
    std::string text(static_cast<std::size_t>(::lseek(memory_, 0, SEEK_END)), '\0');
    const ssize_t got = ::pread(memory_, text.data(), text.size(), 0);
    ::close(memory_);
    fuzz::require(got == static_cast<ssize_t>(text.size()), "what was written can be read");
    return text;
  }

 private:
  std::FILE* stream_;
  int memory_, before_ = -1;
};

/// How often each command was tried, told at the end.
class Tally {
 public:
  ~Tally() {
    for (const auto& [command, counts] : counts_)
      std::cerr << "lines of " << command << ": " << counts[0] << ", " << counts[1]
                << " of them with code 0, " << counts[2] << " refused\n";
  }
  void count(const std::string& command, int code) {
    auto& counts = counts_[command];
    ++counts[0];
    ++counts[code == 0 ? 1 : 2];
  }

 private:
  std::map<std::string, std::array<std::size_t, 3>> counts_;
};

struct Outcome {
  int code;
  std::string out, err;
};

Outcome run(const std::vector<std::string>& words) {
  std::vector<const char*> argv = {"plexway"};
  for (const std::string& word : words) argv.push_back(word.c_str());
  Caught out(stdout), err(stderr);
  const int code = plexway::detail::cli::run(static_cast<int>(argv.size()), argv.data());
  return {code, out.end(), err.end()};
}

/// All options that the tool has, from its own completions.
std::vector<std::string> options() {
  const std::string text = run({"--help-page", "bash"}).out;
  std::vector<std::string> found;
  for (std::size_t at = text.find("--"); at != text.npos; at = text.find("--", at + 2)) {
    const std::size_t end = text.find_first_not_of("abcdefghijklmnopqrstuvwxyz-", at);
    const std::string word = text.substr(at, end - at);
    // What takes minutes however small the input is.
    if (word.size() > 3 && word != "--help-page") found.push_back(word);
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  fuzz::require(found.size() > 50, "completions name the options");
  return found;
}

constexpr std::array<const char*, 11> commands = {
    "distance", "path",     "info",  "convert", "pairs",         "poisson",
    "cvt",      "farthest", "bench", "prepare", "tetrahedralize"};
constexpr std::array<const char*, 9> inputs = {"square.off",  "apart.obj",   "two.mesh",
                                               "wires.obj",   "cloud.xyz",   "broken.ply",
                                               "nowhere.ply", "numbers.txt", "."};
constexpr std::array<const char*, 64> values = {"vertex:0",
                                                "vertex:2",
                                                "vertex:99",
                                                "vertex:-1",
                                                "point:0,0,0",
                                                "point:.5,.5,0",
                                                "point:1,nan,0",
                                                "boundary",
                                                "vertices:numbers.txt",
                                                "line:0,1,2",
                                                "face:0",
                                                "ball:0,.2",
                                                "0",
                                                "1",
                                                "2",
                                                "3",
                                                "0.5",
                                                ".25",
                                                "-1",
                                                "1e300",
                                                "nan",
                                                "inf",
                                                "",
                                                "x",
                                                "y",
                                                "z",
                                                "all",
                                                "float",
                                                "double",
                                                "serial",
                                                "openmp",
                                                "gl",
                                                "fast",
                                                "accurate",
                                                "exact",
                                                "surface",
                                                "solid",
                                                "cloud",
                                                "wireframe",
                                                "mixed",
                                                "out.obj",
                                                "out.ply",
                                                "out.vtu",
                                                "out.csv",
                                                "out.json",
                                                "out.npy",
                                                "out.glb",
                                                "out.html",
                                                "out.nothing",
                                                "-",
                                                "csv:-",
                                                "numbers.txt",
                                                "speed:speeds.txt",
                                                "square.off",
                                                "input",
                                                "delaunay",
                                                "out.plexway",
                                                "out.svg",
                                                "out.mesh",
                                                "out.off",
                                                "out.stl",
                                                "out.vtk",
                                                "out.h5",
                                                "auto"};

std::vector<std::string> line_of(const std::uint8_t* data, std::size_t size) {
  static const std::vector<std::string> known = options();
  std::vector<std::string> line;
  const auto pick = [](const auto& from, std::uint8_t b) {
    return std::string(from[b % std::size(from)]);
  };
  for (std::size_t at = 0; at + 1 < size && line.size() < 24;) {
    const std::uint8_t kind = data[at], which = data[at + 1];
    at += 2;
    if (line.empty() && kind < 240) {
      line.push_back(pick(commands, which));
      line.push_back(pick(inputs, kind));
    } else if (kind < 110) {
      line.push_back(pick(known, which));
    } else if (kind < 200) {
      line.push_back(pick(values, which));
    } else if (kind < 220) {
      line.push_back(pick(known, which) + "=" + pick(values, kind));
    } else if (kind < 230) {
      line.push_back(pick(inputs, which));
    } else {
      const std::size_t length = std::min<std::size_t>(which % 12, size - at);
      line.emplace_back(reinterpret_cast<const char*>(data + at), length);
      std::erase(line.back(), '\0');
      // Numbers of one's own may ask for more than there is time for.
      std::replace_if(
          line.back().begin(), line.back().end(), [](char c) { return c >= '0' && c <= '9'; }, '1');
      at += length;
    }
  }
  return line;
}

}  // namespace

PLEXWAY_FUZZER(arguments)(const std::uint8_t* data, std::size_t size) {
  static Sandbox sandbox;
  static const bool no_input = [] {
    const int null = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
    return ::dup2(null, STDIN_FILENO) == STDIN_FILENO;
  }();
  fuzz::require(no_input, "nothing on standard input");
  const std::vector<std::string> line = line_of(data, size);
  std::string typed = "plexway";
  for (const std::string& word : line) typed += " '" + word + "'";
  const Outcome outcome = run(line);
  static Tally tally;
  if (!line.empty() && std::find(commands.begin(), commands.end(), line[0]) != commands.end())
    tally.count(line[0], outcome.code);
  const auto require = [&](bool holds, const char* what) {
    fuzz::require(holds, std::string(what) + ": " + typed + "\n" + outcome.out + outcome.err);
  };
  require(outcome.code >= 0 && outcome.code <= 6, "a code that is documented");
  require(outcome.err.empty() || outcome.err.back() == '\n', "lines end");
  std::size_t errors = 0;
  for (std::size_t at = 0; at < outcome.err.size();) {
    const std::size_t end = outcome.err.find('\n', at);
    const std::string_view said = std::string_view(outcome.err).substr(at, end - at);
    errors += said.starts_with("plexway: error: ");
    for (const char c : said)
      require(static_cast<unsigned char>(c) >= ' ' && c != 0x7F, "a line is one printable line");
    at = end + 1;
  }
  require(errors == (outcome.code == 0 ? 0 : 1), "one error if it failed, none if it did not");
  if (outcome.code == 2) require(outcome.out.empty(), "a line that makes no sense prints nothing");
  sandbox.check_and_clear();
  return 0;
}

}  // namespace fuzz_arguments
