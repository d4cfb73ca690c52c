#pragma once

#include <plexway/executors/forward.hpp>
