#pragma once
#include <array>
#include <cstdint>
#include <functional>

#include "reference/model/profile.hpp"
#include "reference/text/coverage.hpp"
#include "reference/text/invocation.hpp"
#include "reference/text/memory.hpp"

namespace lockstep::text {

/// A dispatch of a compute shader. `wants(group)`: whether a group runs; empty: all do. `is_watched`: races, operands
/// without a result and values that were never set are looked for, which takes some 10 times as long. `most_branches`:
/// that up to lanes_at_once invocations, which run together, take.
struct Dispatch {
    std::array<std::uint32_t, 3> groups{1, 1, 1};
    std::function<bool(const std::array<std::uint32_t, 3>& group)> wants = {};
    bool is_watched = false;
    std::uint32_t most_branches = 50'000'000;
    std::uint32_t subgroup_size =
        0;                        ///< that it runs with, at most lanes_at_once; 0: what the driver chooses is refused
    Writers* writers = nullptr;   ///< is told who wrote each word; null: nobody asks
    bool is_reversed = false;     ///< the last group runs first
    Coverage* coverage = nullptr; ///< of the program: takes up where invocations come; null: nobody asks
};

/// An invocation by its number in a dispatch of so many groups.
Invocation invocation_of(const Program& program, const std::array<std::uint32_t, 3>& groups, std::uint32_t number);

/// Runs a dispatch in plain bits, group after group, with the arithmetic that was measured of a driver's compute stage.
/// What blocks and images are bound to is read and written. A group whose invocations do not all come to one barrier
/// ends there, which is a finding. Where an invocation does not end, a watched dispatch ends with a finding; another
/// throws DoesNotEnd by FILE:LINE.
///
/// Returns whether a group has used what another handed on to it by an atomic operation; known where it is watched.
bool run_dispatch(const Program& program, const Dispatch& dispatch, const Bindings& bindings, const Profile& profile,
                  Findings& findings);

} // namespace lockstep::text
