#pragma once
#include "reference/model/root_tables.hpp"

namespace lockstep {

/// Measures the current context's 1/x and inversesqrt(x), 2^24 vertices; some tenths of a second on a GPU.
RootTables measure_root_tables();

} // namespace lockstep
