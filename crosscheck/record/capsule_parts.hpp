#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "crosscheck/files/json_reader.hpp"
#include "reference/known_operations.hpp"
#include "reference/model/profile.hpp"

namespace lockstep {

/// Largest file that a capsule makes, bytes.
inline constexpr std::size_t largest_capsule = 100'000;

/// What capsules of every system are made of, as JSON and back. Readers throw Error naming the key and what it may be.

/// Groups of eight hexadecimal digits, a space between them.
std::string words_text(std::span<const std::uint32_t> words);
/// `count` of them, or any number where it is 0.
std::vector<std::uint32_t> read_words(const JsonValue& value, std::size_t count);

nlohmann::json known_json(const KnownOperations& known);
KnownOperations read_known(const JsonValue& value);

/// Of the driver's tables the values that `judge` looks up with the profile it is given; null where there are none.
nlohmann::json roots_json(const Profile& profile, const std::function<void(const Profile&)>& judge);
std::shared_ptr<const RootTables> read_roots(const JsonValue& value);

} // namespace lockstep
