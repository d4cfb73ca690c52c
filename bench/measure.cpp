#include "measure.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <numeric>
#include <stdexcept>

#include <plexway/io/triangles.hpp>

#include "data/shapes.hpp"

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace bench {

Surface read_surface(const std::filesystem::path& file) {
  auto read = plexway::io::read_triangles(file);
  return {file.stem().string(), std::move(read.positions), std::move(read.triangles)};
}

Surface bumpy_surface(std::size_t vertices) {
  const double n = std::max(1.0, std::round(std::sqrt(static_cast<double>(vertices) / 10)));
  samples::Shape shape = samples::bumpy(static_cast<Index>(n));
  return {"bumpy_" + std::to_string(shape.points.size()), std::move(shape.points),
          std::move(shape.faces)};
}

std::vector<Truth> read_truths(const std::filesystem::path& folder, const std::string& name,
                               std::size_t vertices) {
  std::vector<Truth> truths;
  if (folder.empty() || !std::filesystem::is_directory(folder)) return truths;
  const std::string prefix = name + ".v";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string file = entry.path().filename().string();
    if (!file.starts_with(prefix) || !file.ends_with(".txt")) continue;
    const std::string id = file.substr(prefix.size(), file.size() - prefix.size() - 4);
    if (id.empty() || id.find_first_not_of("0123456789") != std::string::npos) continue;
    Truth truth{static_cast<Index>(std::stoul(id)), {}};
    std::ifstream in(entry.path());
    for (std::string line; std::getline(in, line);) truth.distance.push_back(std::stod(line));
    if (truth.distance.size() != vertices || truth.source >= vertices)
      throw std::runtime_error(entry.path().string() + ": not one value for each vertex of " +
                               name);
    truths.push_back(std::move(truth));
  }
  std::sort(truths.begin(), truths.end(),
            [](const Truth& a, const Truth& b) { return a.source < b.source; });
  return truths;
}

void Meshes::add_options(Arguments& arguments, const std::string& sizes_named) {
  arguments.option("MESH", &files, "Surfaces (.obj .off .ply .stl)");
  arguments.option("--truth-dir", &truth,
                   "Folder of the exact answers NAME.vID.txt (default: beside each mesh)");
  if (!sizes_named.empty())
    arguments.option(sizes_named, &sizes, "Also bumpy spheres of about so many vertices");
}

void Meshes::each(
    const std::function<void(const Surface&, const std::vector<Truth>&)>& work) const {
  const auto on = [&](const Surface& surface, const std::filesystem::path& folder) {
    work(surface, read_truths(folder, surface.name, surface.positions.size()));
  };
  for (const std::filesystem::path file : files)
    on(read_surface(file), truth.empty() ? file.parent_path() : std::filesystem::path(truth));
  for (const std::size_t size : sizes) on(bumpy_surface(size), truth);
}

// ---- Times ----

double median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

void Effort::add_options(Arguments& arguments) {
  arguments.positive("--sources", &sources, "Sources to rotate");
  arguments.positive("--repeats", &repeats, "Solves from each source");
  arguments.option("--warm", &warm, "An untimed solve before each timed one");
  arguments.option("--processor", &processor, "The processor's time instead of the clock's");
  arguments.positive("--budget", &budget, "Seconds after which a row ends early");
}

Times take_turns(std::span<const Index> sources, const Effort& effort, const Solve& first,
                 const Solve& second) {
  std::vector<double> a, b, ratios;
  const auto timed = [&](const auto& work) {
    return effort.processor ? processor_seconds(work) : seconds(work);
  };
  const auto turn = [&](std::size_t i) {
    const std::size_t ahead = (i + sources.size() / 2) % sources.size();
    const std::size_t other = (i + sources.size() / 3) % sources.size();
    if (effort.warm) first(sources[other]);
    a.push_back(timed([&] { first(sources[i]); }));
    if (effort.warm) second(sources[other]);
    b.push_back(timed([&] { second(sources[ahead]); }));
    ratios.push_back(b.back() / a.back());
    return a.back() + b.back();
  };
  // The first turn warms up, unless a single turn is all that the budget allows.
  double spent = turn(sources.size() - 1);
  if (spent < effort.budget) {
    a.clear();
    b.clear();
    ratios.clear();
  }
  for (std::size_t repeat = 0; repeat < effort.repeats; ++repeat)
    for (std::size_t i = 0; i < sources.size(); ++i)
      if (ratios.empty() || spent < effort.budget) spent += turn(i);
  return {median(a), median(b), median(ratios), ratios.size()};
}

// ---- Sources ----

std::vector<Index> spread_numbers(std::size_t count, std::size_t size) {
  std::vector<Index> numbers;
  double place = 0.5;
  for (std::size_t i = 0; i < count; ++i) {
    numbers.push_back(static_cast<Index>(place * static_cast<double>(size)));
    place = std::fmod(place + 0.6180339887498949, 1.0);
  }
  return numbers;
}

std::vector<Index> rotating_sources(const Surface& surface, std::size_t count) {
  std::vector<Index> parent(surface.positions.size());
  std::iota(parent.begin(), parent.end(), Index{0});
  const auto root = [&](Index v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const auto& [a, b, c] : surface.faces) {
    parent[root(a)] = root(b);
    parent[root(b)] = root(c);
  }
  std::vector<std::size_t> size(parent.size(), 0);
  for (Index v = 0; v < parent.size(); ++v) ++size[root(v)];
  const auto largest =
      static_cast<Index>(std::max_element(size.begin(), size.end()) - size.begin());
  std::vector<Index> members;
  for (Index v = 0; v < parent.size(); ++v)
    if (root(v) == largest) members.push_back(v);
  auto sources = spread_numbers(count, members.size());
  for (Index& source : sources) source = members[source];
  return sources;
}

// ---- Errors ----

void add_errors(Row& row, const Errors& errors) {
  const auto found = errors.summary();
  if (!found) return;
  row["mean"] = found->mean;
  row["p99"] = found->p99;
  row["max"] = found->max;
  row["below"] = found->most_below;
  row["wrong"] = found->wrong;
}

// ---- Memory ----

void return_free_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

std::optional<double> status_bytes(std::string_view key) {
  std::ifstream in("/proc/self/status");
  for (std::string line; std::getline(in, line);)
    if (line.starts_with(key) && line.size() > key.size() && line[key.size()] == ':')
      return 1024 * std::stod(line.substr(key.size() + 1));
  return std::nullopt;
}

}  // namespace bench
