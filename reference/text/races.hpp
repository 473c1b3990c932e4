#pragma once
#include <array>
#include <cstdint>
#include <string_view>
#include <unordered_map>

#include "reference/text/findings.hpp"

namespace lockstep::text {

/// Finds what two invocations of a dispatch touch without an order between them, one of them writing (GL 4.6, 7.13.1):
/// of shared memory between the same two barriers of a group; of a buffer or image in a group without a barrier and a
/// memory barrier between, and in two groups always. Two atomic operations are no race.
class Races {
  public:
    enum class How : std::uint8_t { read, write, atomic };
    enum class Space : std::uint8_t { shared, buffer, image };

    /// `has_groups`: invocations are in groups, which barriers may order.
    explicit Races(Findings& findings, bool has_groups = true) : findings_(findings), has_groups_(has_groups) {}

    void start_group(std::uint32_t number);
    /// SPIR-V's memory semantics (SPIR-V 3.25) of a barrier that all of the group came to, or of a memory barrier.
    void barrier(std::uint32_t semantics);
    void fence(std::uint32_t semantics);
    /// `name`, `number`: of the buffer or image; `word`: of it, or of its texels.
    void touch(Space space, std::uint32_t number, std::uint32_t word, How how, Place place, std::string_view name);

  private:
    static constexpr std::uint32_t nobody = 0xffffffffU;
    struct Touch {
        Place place;
        std::uint32_t by = nobody; ///< an invocation, or a group
    };
    /// As many as decide whether a later one races: two different ones may both be no race with it alone.
    struct Touches {
        std::array<Touch, 2> reads, atomics;
        Touch write;
        std::uint32_t group = nobody, epoch = 0;
    };
    struct Word {
        Touches in_group, in_dispatch;
    };
    /// Nothing: no race with what is there.
    static const Touch* conflict(const Touches& with, How how, std::uint32_t by);
    static void note(Touches& in, How how, Place place, std::uint32_t by);
    void found(const Touch& before, Space space, How how, Place place, std::string_view name, bool in_group);

    Findings& findings_;
    bool has_groups_;
    std::unordered_map<std::uint64_t, Word> words_;
    std::uint32_t group_ = 0;
    std::array<std::uint32_t, 3> epochs_{}; ///< by space: how many times all before was ordered
    std::array<bool, 3> fenced_{};
};

} // namespace lockstep::text
