// The table of peers without CGAL. bench_cgal prints the same one with CGAL's peers in it.

#include "compare.hpp"

int main(int argc, char** argv) { return bench::compare_peers(argc, argv, bench::common_peers()); }
