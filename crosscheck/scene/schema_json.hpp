#pragma once
#include <nlohmann/json_fwd.hpp>

#include "reference/model/schema.hpp"

namespace lockstep {

/// Buffers and images with their fields, in order: what a page needs to name what it shows.
nlohmann::json schema_json(const Schema& schema);

} // namespace lockstep
