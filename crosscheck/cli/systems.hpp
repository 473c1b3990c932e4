#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace lockstep {

class JsonValue;
struct RegisteredSystem;

/// The system that a scene without "system" is of. It has a state and verbs of its own.
inline constexpr std::string_view default_system = "collision";

/// The system of check files: passes of one's own.
inline constexpr std::string_view own_system = "own";

/// Every other that scene files may name, and those that this program is built without (CMake's LOCKSTEP_SYSTEMS).
std::span<const RegisteredSystem> registered_systems();
std::span<const std::string_view> left_out_systems();

std::string_view name_of(const RegisteredSystem& system);

/// The registered system of a scene; null where it is the default one's. Throws Error, with the names there are, where
/// it is of none.
const RegisteredSystem* system_of_scene(const JsonValue& scene);

} // namespace lockstep
