#include <plexway/propagate/probe_table.hpp>

namespace plexway {

ProbeTable ProbeTable::learned() { return published(); }

}  // namespace plexway
