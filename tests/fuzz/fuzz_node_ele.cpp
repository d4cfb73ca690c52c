// The two files of TetGen as one: what stands behind the first '@' is the .ele.

#include "fuzz_reader.hpp"

PLEXWAY_FUZZER(node_ele)(const std::uint8_t* data, std::size_t size) {
  const auto parse = [](std::string_view both, std::string_view name) {
    const auto at = both.find('@');
    const std::string_view ele = at == std::string_view::npos ? "" : both.substr(at + 1);
    return plexway::io::parse_node_ele({both.substr(0, at), name}, {ele, name});
  };
  return fuzz::check_reader(parse, data, size);
}
