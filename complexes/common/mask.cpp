#include <plexway/common/mask.hpp>

#include <string>

#include <plexway/error.hpp>

namespace plexway {
namespace {

void close(std::vector<char>& closed, Index number, const char* what) {
  if (number >= closed.size())
    throw UsageError(std::string("masked ") + what + " " + std::to_string(number) +
                     " is out of range, there are " + std::to_string(closed.size()));
  closed[number] = 1;
}

}  // namespace

void Mask::close_vertex(Index vertex) { close(vertex_, vertex, "vertex"); }
void Mask::close_simplex(Index simplex) { close(simplex_, simplex, "simplex"); }

void Mask::check_rows(std::size_t rows) const {
  if (rows != simplex_.size())
    throw UsageError("a mask of " + std::to_string(simplex_.size()) + " simplices for " +
                     std::to_string(rows));
}

void Mask::check_vertex(Index largest) const {
  if (largest >= vertex_.size())
    throw UsageError("a mask of " + std::to_string(vertex_.size()) +
                     " vertices for a simplex with vertex " + std::to_string(largest));
}

}  // namespace plexway
