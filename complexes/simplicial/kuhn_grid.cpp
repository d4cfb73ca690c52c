#include <plexway/simplicial/kuhn_grid.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <plexway/error.hpp>

namespace plexway {

template <int N>
KuhnGrid<N>::KuhnGrid(const Place& cells, const Point& spacing, const Point& origin) {
  for (std::size_t a = 0; a < N; ++a) {
    if (cells[a] >= none || !(spacing[a] > 0) || !std::isfinite(spacing[a]))
      throw InputError("axis " + std::to_string(a) + " of the grid: cells of size > 0 are needed");
    planes_[a].resize(cells[a] + 1);
    for (std::size_t i = 0; i <= cells[a]; ++i)
      planes_[a][i] = origin[a] + spacing[a] * static_cast<double>(i);
  }
  check();
}

template <int N>
KuhnGrid<N>::KuhnGrid(std::array<std::vector<double>, N> planes) : planes_(std::move(planes)) {
  check();
}

template <int N>
void KuhnGrid<N>::check() {
  vertex_count_ = 1;
  for (std::size_t a = 0; a < N; ++a) {
    const std::vector<double>& planes = planes_[a];
    const std::string axis = "axis " + std::to_string(a) + " of the grid: ";
    if (planes.size() < 2) throw InputError(axis + "there is no cell");
    for (std::size_t i = 0; i < planes.size(); ++i)
      if (!std::isfinite(planes[i]) || (i > 0 && !(planes[i - 1] < planes[i])))
        throw InputError(axis + "planes must ascend and be finite");
    if (planes.size() >= none / vertex_count_) throw InputError("the grid has too many vertices");
    vertex_count_ *= planes.size();
  }
}

template <int N>
Index KuhnGrid<N>::vertex(const Place& at) const {
  std::size_t v = 0;
  for (std::size_t a = N; a-- > 0;) v = v * planes_[a].size() + at[a];
  return static_cast<Index>(v);
}

template <int N>
typename KuhnGrid<N>::Place KuhnGrid<N>::place(Index vertex) const {
  Place at;
  std::size_t rest = vertex;
  for (std::size_t a = 0; a < N; ++a) {
    at[a] = rest % planes_[a].size();
    rest /= planes_[a].size();
  }
  return at;
}

template <int N>
typename KuhnGrid<N>::Point KuhnGrid<N>::position(Index vertex) const {
  const Place at = place(vertex);
  Point p;
  for (std::size_t a = 0; a < N; ++a) p[a] = planes_[a][at[a]];
  return p;
}

template <int N>
Index KuhnGrid<N>::nearest(const Point& point) const {
  Place at;
  for (std::size_t a = 0; a < N; ++a) {
    const std::vector<double>& planes = planes_[a];
    const auto above = std::lower_bound(planes.begin(), planes.end() - 1, point[a]);
    at[a] = static_cast<std::size_t>(above - planes.begin());
    if (at[a] > 0 && point[a] - planes[at[a] - 1] < planes[at[a]] - point[a]) --at[a];
  }
  return vertex(at);
}

template <int N>
typename KuhnGrid<N>::Point KuhnGrid<N>::centre(const Place& cell) const {
  Point p;
  for (std::size_t a = 0; a < N; ++a) p[a] = planes_[a][cell[a]] / 2 + planes_[a][cell[a] + 1] / 2;
  return p;
}

template <int N>
std::vector<double> KuhnGrid<N>::positions() const {
  std::vector<double> all;
  all.reserve(vertex_count_ * N);
  for (Index v = 0; v < vertex_count_; ++v) {
    const Point p = position(v);
    all.insert(all.end(), p.begin(), p.end());
  }
  return all;
}

template <int N>
std::vector<typename KuhnGrid<N>::Simplex> KuhnGrid<N>::simplices(const Absent& absent) const {
  std::size_t total = 1, cell_count = 1;
  for (std::size_t a = 0; a < N; ++a) {
    total *= a + 1;
    cell_count *= cells(a);
  }
  std::vector<Simplex> all;
  all.reserve(absent ? 0 : total * cell_count);
  Place cell{};
  for (std::size_t c = 0; c < cell_count; ++c) {
    if (!absent || !absent(cell)) {
      std::array<std::size_t, N> axes;
      for (std::size_t a = 0; a < N; ++a) axes[a] = a;
      do {
        Place at = cell;
        Simplex simplex;
        simplex[0] = vertex(at);
        for (std::size_t a = 0; a < N; ++a) {
          ++at[axes[a]];
          simplex[a + 1] = vertex(at);
        }
        all.push_back(simplex);
      } while (std::next_permutation(axes.begin(), axes.end()));
    }
    for (std::size_t a = 0; a < N && ++cell[a] == cells(a); ++a) cell[a] = 0;
  }
  return all;
}

template class KuhnGrid<2>;
template class KuhnGrid<3>;
template class KuhnGrid<4>;

}  // namespace plexway
