#pragma once
#include <nlohmann/json_fwd.hpp>

#include "crosscheck/files/json_reader.hpp"
#include "crosscheck/judge/check.hpp"

namespace lockstep {

/// All that joining (crosscheck/judge/joined_parts.hpp) needs of a report on part of a run, before it is concluded. Of
/// floats the bits, so that what is read back is what was written.
nlohmann::json part_json(const CheckReport& report);

/// The report again; its times are not kept. Throws Error naming the place where it is not what part_json writes.
CheckReport read_part(const JsonValue& value, const Schema& schema);

} // namespace lockstep
