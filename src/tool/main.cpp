#include "tool/app.hpp"

int main(int argc, char** argv) { return plexway::cli::run(argc, argv); }
