#include "tool/app.hpp"

int main(int argc, char** argv) { return plexway::detail::cli::run(argc, argv); }
