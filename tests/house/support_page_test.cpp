#include <catch2/catch.hpp>
#include <string>

#include "house/source_tree.hpp"
#include "house/support_page.hpp"

namespace support_page_test {

TEST_CASE("the page of what goes together says what the table says") {
  std::string there;
  for (const std::string& line : house::lines_of("docs/reference/support.md")) there += line + '\n';
  INFO("make it anew: ninja plexway_support_page");
  CHECK(there == house::support_page());
}

}  // namespace support_page_test
