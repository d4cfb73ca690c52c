#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <utility>
#include <vector>

/// Meshes, solids and clouds with exact distances: KIND/NAME.EXTENSION, and KIND/NAME.vID.txt, the
/// distances from vertex ID, one value a line. Looked for in the folder of large ones
/// (PLEXWAY_TRUTH_DIR), which may be missing, then in data/exact, which is always there.
namespace plexway::testing {

/// The path of KIND/FILE, empty if there is none.
inline std::filesystem::path exact_file(const std::string& kind, const std::string& file) {
  for (const std::filesystem::path root : {PLEXWAY_TRUTH_DIR, PLEXWAY_SOURCE_DIR "/data/exact"}) {
    if (!root.empty() && std::filesystem::exists(root / kind / file)) return root / kind / file;
  }
  return {};
}

/// All that KIND has with this extension (".obj"), sorted; of two with one name the large folder's.
inline std::vector<std::filesystem::path> exact_files(const std::string& kind,
                                                      const std::string& extension) {
  std::vector<std::filesystem::path> files;
  for (const std::filesystem::path root : {PLEXWAY_TRUTH_DIR, PLEXWAY_SOURCE_DIR "/data/exact"}) {
    if (root.empty() || !std::filesystem::exists(root / kind)) continue;
    for (const auto& entry : std::filesystem::directory_iterator(root / kind)) {
      if (entry.path().extension() != extension) continue;
      if (exact_file(kind, entry.path().filename().string()) == entry.path())
        files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// Values of a file, one a line; "inf" where nothing leads.
inline std::vector<double> exact_values(const std::filesystem::path& file) {
  std::vector<double> values;
  std::ifstream in(file);
  for (std::string value; in >> value;) values.push_back(std::stod(value));
  return values;
}

/// Exact distances from one vertex.
struct ExactAnswer {
  std::size_t source = 0;
  std::vector<double> distance;
};

/// All answers beside a file, by source.
inline std::vector<ExactAnswer> exact_answers(const std::filesystem::path& file) {
  std::vector<ExactAnswer> answers;
  const std::string stem = file.stem().string() + ".v";
  for (const auto& entry : std::filesystem::directory_iterator(file.parent_path())) {
    const std::string name = entry.path().filename().string();
    if (name.rfind(stem, 0) != 0 || entry.path().extension() != ".txt") continue;
    answers.push_back({std::stoul(name.substr(stem.size())), exact_values(entry.path())});
  }
  std::sort(answers.begin(), answers.end(), [](const ExactAnswer& a, const ExactAnswer& b) {
    return std::make_pair(a.source, a.distance.size()) <
           std::make_pair(b.source, b.distance.size());
  });
  return answers;
}

/// Relative errors of distances, but at the source.
struct ExactError {
  double mean = 0, worst = 0;
  std::size_t above = 0;  ///< vertices with more than a limit
};
template <class Real>
ExactError error_of(const std::vector<Real>& found, const ExactAnswer& exact,
                    double limit = std::numeric_limits<double>::infinity()) {
  ExactError error;
  std::size_t count = 0;
  for (std::size_t v = 0; v < exact.distance.size(); ++v) {
    if (!(exact.distance[v] > 0)) continue;
    const double e = std::abs(static_cast<double>(found[v]) / exact.distance[v] - 1);
    error.mean += e, ++count;
    error.worst = std::max(error.worst, e);
    error.above += e > limit;
  }
  error.mean /= static_cast<double>(count);
  return error;
}

}  // namespace plexway::testing
