#pragma once

#include "executors/solid_growth.hpp"
#include "executors/surface_growth.hpp"

/// Growth<Complex>: a field that goes on from what is there. What is known stays, and each new
/// source is propagated only where it is nearer than those before. Numbers and unit inside. Cost of
/// a source: what it reaches; nothing is read out.
