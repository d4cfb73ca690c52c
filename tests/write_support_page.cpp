// Writes docs/reference/support.md: the target plexway_support_page.

#include <fstream>

#include "house/support_page.hpp"

int main(int, char** argv) {
  std::ofstream out(argv[1]);
  out << house::support_page();
  return out.flush() ? 0 : 1;
}
