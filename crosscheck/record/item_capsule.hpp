#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "crosscheck/files/json_reader.hpp"
#include "crosscheck/judge/item_verdict.hpp"
#include "crosscheck/judge/system_run.hpp"
#include "crosscheck/report/value_text.hpp"

namespace lockstep {

/// One item's step in one pass of a run: the items that any of its legal runs reads, what the GPU made of it and told,
/// and what was measured of the driver. A program that has the system judges it anywhere, without GL and without the
/// run.
struct ItemCapsule {
    std::string system, renderer;
    std::string pass; ///< pass_argument
    int frame = 0;
    std::size_t item = 0;
    Profile profile;
    KnownOperations known;
    SystemState before; ///< zero but for the items that are read
    SystemState gpu;    ///< zero but for the item
    std::vector<ToldValue> told;
};

/// Throws Error where the item does not exist, or the capsule alone would be judged otherwise than the run.
ItemCapsule cut_item_capsule(SystemRun& run, std::size_t item, const std::string& renderer);

/// As a file; floats are eight hexadecimal digits, their bits. Throws Error where it would be larger than 100 kB.
std::string item_capsule_file(const ItemCapsule& capsule, const System& system);

/// Throws Error naming the key and what it may be, and for a capsule of another system.
ItemCapsule load_item_capsule(const std::filesystem::path& file, const System& system);
ItemCapsule read_item_capsule(const JsonValue& capsule, const System& system);

/// What explain_item says of the run's item.
std::string item_capsule_text(const ItemCapsule& capsule, const System& system,
                              NumberFormat format = NumberFormat::decimal);
ItemVerdict judge(const ItemCapsule& capsule, const System& system);

} // namespace lockstep
