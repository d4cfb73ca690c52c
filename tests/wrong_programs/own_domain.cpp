// A class of one's own that is no domain.
#include <array>
#include <vector>

#include <plexway/solve.hpp>

using namespace plexway;

struct Mine {
  int vertex_count() const { return 3; }
};
auto field(const Mine& mine) { return solve(Serial{}, mine, 0); }
